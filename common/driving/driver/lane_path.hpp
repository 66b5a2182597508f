// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "common/driving/driver/way.hpp"
#include "common/world/road/road.hpp"

namespace rodeira::driver {

// A lane as those who drive in it see it: distance d from where its traffic enters the road, measured along the lane's
// own middle, which is exact: d = s - t (heading(s) - heading(0)) for a lane at offset t of the axis. The road must
// outlive it.
class LanePath final : public Way {
 public:
  LanePath(const road::Road& road, int lane_id);  // the lane must be one of the road's

  const road::Road& road() const { return *road_; }
  const road::Lane& lane() const { return *lane_; }
  double length_m() const override { return length_m_; }
  double speed_limit_mps() const { return lane_->speed_limit_mps; }
  double SpeedLimit_mps(double /*d_m*/) const override { return speed_limit_mps(); }

  double AxisS(double d_m) const;     // s of the axis beside d, held within the road
  double Distance(double s_m) const;  // d beside s
  LaneFrame At(double d_m) const override;
  double VerticalCurvature_1pm(double d_m) const override;
  Eigen::Vector3d Position(double d_m, double offset_m) const override;
  std::optional<Place> Locate(double x_m, double y_m, std::optional<double> z_m = std::nullopt) const override;

 private:
  double AxisLength(double s_m) const;  // of the lane's middle, from the road's start

  const road::Road* road_;
  const road::Lane* lane_;
  double t_m_ = 0.0;
  bool along_ = true;  // traffic goes with growing s
  double start_heading_rad_ = 0.0;
  double length_m_ = 0.0;
  std::vector<double> nodes_m_;  // AxisLength at equal steps of s, where the search of AxisS starts
  double step_s_m_ = 1.0;
};

}  // namespace rodeira::driver
