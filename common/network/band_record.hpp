#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/geometry/plan_axis.hpp"
#include "common/network/band_index.hpp"
#include "common/network/road.hpp"

namespace rodeira::network {

// What is asked of a road where a point lies on one of its bands, side by side in memory: copies of the panel, of the lanes' edges and of the
// height, as they are about the panel's middle. Found through the road itself they are a dozen places far from one another.
struct BandRecord {
  geometry::AxisPanel panel;
  double low_s_m = 0.0, high_s_m = 0.0;    // the panel's part of the road
  double from_s_m = 0.0, to_s_m = -1.0;    // for these s, without the last, it holds; for none where the road is rolled
  geometry::Cubic centre_t, elevation;     // the cubics in force there
  double closed_before_m = 0.0, closed_behind_m = 0.0;
  std::uint32_t road = 0, section = 0;
  std::uint32_t first_lane = 0;            // of BandRecords: those on the left outward, then those on the right
  std::uint16_t left = 0, right = 0;
  bool flat = false;                       // the elevation is all of its height

  bool Holds(double s_m) const { return s_m >= from_s_m && s_m < to_s_m; }
};

// A lane's outer edge about there.
struct LaneRecord {
  geometry::Cubic edge;  // its width, or where it has a border
  const Lane* lane = nullptr;
  int id = 0;
  bool bordered = false, drivable = false;
};

// The records of all bands. Where a record holds, it gives every bit that the road gives.
class BandRecords {
 public:
  // The roads must stay where they are.
  BandRecords(std::span<const Road> roads, const BandIndex& index);

  const BandRecord& Of(std::uint32_t band) const { return records_[band]; }
  // A record that will be read soon: memory is asked for it meanwhile.
  void Fetch(std::uint32_t band) const {
    const auto* first = reinterpret_cast<const char*>(&records_[band]);
    for (std::size_t at = 0; at < sizeof(BandRecord); at += 64) __builtin_prefetch(first + at);
  }
  // As LaneSection::At, and whether the lane is driven on; outside_m too.
  struct LaneAt {
    LaneSpan span;
    int id = 0;  // 0: no lane
    bool drivable = false;
    double outside_m = 0.0;
  };
  LaneAt At(const BandRecord& record, double s_m, double t_m, const geometry::CubicPoint& centre_t) const;

 private:
  std::vector<BandRecord> records_;
  std::vector<LaneRecord> lanes_;  // bands of one section with the same edges share theirs
};

}  // namespace rodeira::network
