// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "common/core/geometry/angle.hpp"
#include "common/driving/driver/way.hpp"
#include "tests/version1_road.hpp"

namespace rodeira::driver {

// The middle of a lane of a version 1 road by closed formulas, which RoutePath shares none of: distance d from where
// its traffic enters the road is d = s - t (heading(s) - heading(0)) for a lane at offset t of the axis. The road must
// outlive it.
class LanePath final : public Way {
 public:
  LanePath(const Version1Road& road, int lane_id) : road_(&road), lane_(road.section().FindLane(lane_id)) {
    EXPECT_NE(lane_, nullptr);
    t_m_ = lane_->centre_t_m();
    along_ = lane_->direction >= 0;
    start_heading_rad_ = road.plan().Evaluate(0.0).heading_rad;
    const auto count = static_cast<std::size_t>(std::max(1.0, std::ceil(road.length_m() / 2.0)));
    step_s_m_ = road.length_m() / static_cast<double>(count);
    for (std::size_t i = 0; i <= count; ++i) nodes_m_.push_back(AxisLength(static_cast<double>(i) * step_s_m_));
    length_m_ = nodes_m_.back();
  }

  double length_m() const override { return length_m_; }
  double speed_limit_mps() const { return lane_->speed_limit_mps; }
  double SpeedLimit_mps(double /*d_m*/) const override { return speed_limit_mps(); }
  LaneFrame At(double d_m) const override {
    const double s = AxisS(d_m);
    const road::RoadFrame axis = road_->Evaluate(s);
    const double stretch = std::max(0.1, 1.0 - t_m_ * axis.curvature_1pm);  // lane's length a length of axis
    LaneFrame frame;
    frame.p_W = road_->Position(s, t_m_);
    frame.heading_rad = along_ ? axis.heading_rad : geometry::WrapAngle(axis.heading_rad + geometry::kPi);
    frame.curvature_1pm = (along_ ? 1.0 : -1.0) * axis.curvature_1pm / stretch;
    frame.grade = (along_ ? 1.0 : -1.0) * axis.grade / stretch;
    return frame;
  }
  double VerticalCurvature_1pm(double d_m) const override { return road_->Evaluate(AxisS(d_m)).vertical_curvature_1pm; }
  Eigen::Vector3d Position(double d_m, double offset_m) const override {
    return road_->Position(AxisS(d_m), along_ ? t_m_ + offset_m : t_m_ - offset_m);
  }
  std::optional<Place> Locate(double x_m, double y_m, std::optional<double> /*z_m*/ = std::nullopt) const override {
    const auto found = road_->Locate(x_m, y_m);
    if (!found) return std::nullopt;
    const double d = along_ ? AxisLength(found->s_m) : length_m_ - AxisLength(found->s_m);
    return Place{d, along_ ? found->t_m - t_m_ : t_m_ - found->t_m, At(d).heading_rad};
  }

 private:
  // Of the lane's middle, from the road's start.
  double AxisLength(double s_m) const {
    const double s = std::clamp(s_m, 0.0, road_->length_m());
    return s - t_m_ * (road_->plan().Evaluate(s).heading_rad - start_heading_rad_);
  }
  // s of the axis beside d, held within the road: Newton from a table's start.
  double AxisS(double d_m) const {
    const double wanted = std::clamp(along_ ? d_m : length_m_ - d_m, 0.0, length_m_);
    const auto after = std::upper_bound(nodes_m_.begin(), nodes_m_.end(), wanted);
    const auto i = static_cast<std::size_t>(
        std::clamp<std::ptrdiff_t>(after - nodes_m_.begin() - 1, 0, static_cast<std::ptrdiff_t>(nodes_m_.size()) - 2));
    const double low = static_cast<double>(i) * step_s_m_;
    double s = low + step_s_m_ * (wanted - nodes_m_[i]) / (nodes_m_[i + 1] - nodes_m_[i]);
    for (int turn = 0; turn < 3; ++turn) {
      const geometry::PlanPoint point = road_->plan().Evaluate(s);
      const double error = s - t_m_ * (point.heading_rad - start_heading_rad_) - wanted;
      s = std::clamp(s - error / std::max(0.1, 1.0 - t_m_ * point.curvature_1pm), low, low + step_s_m_);
    }
    return s;
  }

  const Version1Road* road_;
  const road::Lane* lane_;
  double t_m_ = 0.0;
  bool along_ = true;  // traffic goes with growing s
  double start_heading_rad_ = 0.0;
  double length_m_ = 0.0;
  std::vector<double> nodes_m_;  // AxisLength at equal steps of s, where the search of AxisS starts
  double step_s_m_ = 1.0;
};

}  // namespace rodeira::driver
