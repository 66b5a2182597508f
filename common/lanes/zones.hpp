#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "common/lanes/graph.hpp"
#include "common/lanes/swath.hpp"

namespace rodeira::lanes {

// How two tracks come to share ground.
enum class ZoneKind : std::uint8_t {
  kCross,    // they cross, or run too close beside one another
  kMerge,    // they lead into one another's continuation
  kDiverge,  // they begin together: who drives there follows who is ahead, on whichever of them
};

// A stretch of two tracks on which a car on the one and a car on the other may touch.
struct Zone {
  std::array<std::uint32_t, 2> track{};  // ascending
  std::array<double, 2> in_m{}, out_m{};
  ZoneKind kind = ZoneKind::kCross;
  int first = 0;        // the side that has the right of way
  bool signed_ = false;  // by sign, light or the file's priority, not by the rule of the side
};

// A track's part in a zone, with what is asked for most (the same as in the zone).
struct ZoneSide {
  std::uint32_t zone = 0;
  int side = 0;
  double in_m = 0.0, out_m = 0.0;  // along the track
  ZoneKind kind = ZoneKind::kCross;
};

// All conflict zones of a network's tracks, and for each track those that it leads through, by where they begin.
class Zones {
 public:
  // For cars as large as this one.
  explicit Zones(const Graph& graph, const LargestCar& car = {});

  const std::vector<Zone>& zones() const { return zones_; }
  const Zone& operator[](std::uint32_t zone) const { return zones_[zone]; }
  const std::vector<ZoneSide>& Of(std::uint32_t track) const { return of_[track]; }

 private:
  struct Touch {
    double a_m, b_m;  // along both tracks
  };
  void Pair(const Graph& graph, std::uint32_t a, std::uint32_t b, const std::vector<Touch>& touches);  // ascending in a_m

  std::vector<Zone> zones_;
  std::vector<std::vector<ZoneSide>> of_;
};

}  // namespace rodeira::lanes
