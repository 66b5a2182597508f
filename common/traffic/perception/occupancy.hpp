// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace rodeira::traffic {

// A vehicle on a track, in its own d, which may lie beyond its ends.
struct Occupant {
  std::uint32_t id = 0;
  std::int32_t from = -1;  // the track by which it came, as long as a part of it may be there
  double rear_m = 0.0, front_m = 0.0;

  double middle_m() const { return 0.5 * (rear_m + front_m); }
};

// The vehicles on each track in a step, ascending by middles and of equals by numbers: all in one piece of memory,
// found through a table of eight bytes a track, since each looks at several tracks and most of them hold none or one.
class Occupancy {
 public:
  explicit Occupancy(std::size_t tracks) : places_(tracks) {}

  // Once for all of a step.
  void Clear();
  // Behind Clear, in any order.
  void Add(std::uint32_t track, const Occupant& occupant) { added_.emplace_back(track, occupant); }
  // Ends the adding; On and Beyond hold from then on.
  void Sort();
  // One more, after Sort. What On has given before holds no more.
  void Insert(std::uint32_t track, const Occupant& occupant);

  const std::vector<std::uint32_t>& taken() const { return taken_; }  // tracks with a vehicle
  // Ascending by middles; valid until the next Insert or Clear.
  std::span<const Occupant> On(std::uint32_t track) const {
    return {all_.data() + places_[track].begin, places_[track].count};
  }
  // Those with middles beyond d, and perhaps a few more.
  std::span<const Occupant> Beyond(std::uint32_t track, double d_m) const;

 private:
  struct Place {
    std::uint32_t begin = 0, count = 0;
  };
  std::vector<Place> places_;  // by track
  std::vector<std::uint32_t> taken_;
  std::vector<std::pair<std::uint32_t, Occupant>> added_;
  std::vector<Occupant> all_;
};

}  // namespace rodeira::traffic
