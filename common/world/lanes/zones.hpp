// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "common/core/base/huge_pages.hpp"
#include "common/world/lanes/graph.hpp"
#include "common/world/lanes/swath.hpp"

namespace rodeira::lanes {

// How two tracks come to share ground.
enum class ZoneKind : std::uint8_t {
  kCross,    // they cross, or run too close beside one another
  kMerge,    // they lead into one another's continuation
  kDiverge,  // they begin together: a vehicle there follows the one ahead, on either of them
};

// A stretch of two tracks on which a car on the one and a car on the other may touch.
struct Zone {
  std::array<std::uint32_t, 2> track{};   // ascending
  std::array<double, 2> in_m{}, out_m{};  // where it begins and ends, along each track
  ZoneKind kind = ZoneKind::kCross;
  int first = 0;         // the side that has the right of way
  bool signed_ = false;  // by sign, light or the file's priority, not by the rule of the side
};

// A track's part in a zone, with what is asked for most (the same as in the zone).
struct ZoneSide {
  std::uint32_t zone = 0;
  int side = 0;
  double in_m = 0.0, out_m = 0.0;  // along the track
  ZoneKind kind = ZoneKind::kCross;
};

// A track's part in a zone of tracks that part, with what is asked of the other one there.
struct DivergeZone {
  double out_m = 0.0;  // along the track
  std::uint32_t other = 0;
  double other_in_m = 0.0, other_out_m = 0.0;  // along that one
};

// Something of every track, by track, in one piece of memory.
template <class Item>
class ByTrack {
 public:
  // Once, with the items of all tracks.
  void Take(const std::vector<std::vector<Item>>& of) {
    for (const auto& items : of) {
      begins_.push_back(static_cast<std::uint32_t>(items_.size()));
      items_.insert(items_.end(), items.begin(), items.end());
    }
    begins_.push_back(static_cast<std::uint32_t>(items_.size()));
    base::PreferHugePages(items_);
  }
  std::span<const Item> Of(std::uint32_t track) const {
    return {items_.data() + begins_[track], items_.data() + begins_[track + 1]};
  }

 private:
  std::vector<Item> items_;
  std::vector<std::uint32_t> begins_{};
};

// How far to either side of a track's line cars reach beside one of its nodes that cannot keep to it there.
struct Swing {
  double left_m = 0.0, right_m = 0.0;
};
// By track and node; nothing of a track, or of all: cars keep to their lines.
using Swings = std::vector<std::vector<Swing>>;

// All conflict zones of a network's tracks, and for each track those that it leads through, by where they begin.
// Immutable: any number of threads may ask. Tracks are those of the graph that it was made from.
class Zones {
 public:
  // For cars as large as this one: what touches is told from HalfSwath_m of both tracks' curvatures, or a swing to the
  // other one's side that is larger.
  explicit Zones(const Graph& graph, const LargestCar& car = {}, const Swings& swings = {});

  const std::vector<Zone>& zones() const { return zones_; }
  const Zone& operator[](std::uint32_t zone) const { return zones_[zone]; }
  // All sides of zones on the track, ascending by where they begin.
  std::span<const ZoneSide> Of(std::uint32_t track) const { return all_.Of(track); }
  // Of these only where it crosses or merges; only where it parts from others.
  std::span<const ZoneSide> ConflictsOf(std::uint32_t track) const { return conflicts_.Of(track); }
  std::span<const DivergeZone> DivergeZonesOf(std::uint32_t track) const { return partings_.Of(track); }

 private:
  struct Touch {
    double a_m, b_m;  // along both tracks
  };
  void Pair(const Graph& graph, std::uint32_t a, std::uint32_t b,
            const std::vector<Touch>& touches);  // ascending in a_m

  std::vector<Zone> zones_;
  ByTrack<ZoneSide> all_, conflicts_;
  ByTrack<DivergeZone> partings_;
};

}  // namespace rodeira::lanes
