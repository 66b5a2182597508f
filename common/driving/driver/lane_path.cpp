// SPDX-License-Identifier: Apache-2.0
#include "common/driving/driver/lane_path.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/base/assert.hpp"
#include "common/core/geometry/angle.hpp"

namespace rodeira::driver {
namespace {

constexpr double kPathNodeStep_m = 2.0;
constexpr int kNewtonTurns = 3;  // from an interpolated start, quadratic: far below a nanometre

}  // namespace

LanePath::LanePath(const road::Road& road, int lane_id) : road_(&road), lane_(road.section().FindLane(lane_id)) {
  RODEIRA_ASSERT(lane_ != nullptr);
  t_m_ = lane_->centre_t_m();
  along_ = lane_->direction >= 0;
  start_heading_rad_ = road.plan().Evaluate(0.0).heading_rad;
  const auto count = static_cast<std::size_t>(std::max(1.0, std::ceil(road.length_m() / kPathNodeStep_m)));
  step_s_m_ = road.length_m() / static_cast<double>(count);
  for (std::size_t i = 0; i <= count; ++i) nodes_m_.push_back(AxisLength(static_cast<double>(i) * step_s_m_));
  length_m_ = nodes_m_.back();
}

double LanePath::AxisLength(double s_m) const {
  const double s = std::clamp(s_m, 0.0, road_->length_m());
  return s - t_m_ * (road_->plan().Evaluate(s).heading_rad - start_heading_rad_);
}

double LanePath::Distance(double s_m) const { return along_ ? AxisLength(s_m) : length_m_ - AxisLength(s_m); }

double LanePath::AxisS(double d_m) const {
  const double wanted = std::clamp(along_ ? d_m : length_m_ - d_m, 0.0, length_m_);
  const auto after = std::upper_bound(nodes_m_.begin(), nodes_m_.end(), wanted);
  const auto i = static_cast<std::size_t>(
      std::clamp<std::ptrdiff_t>(after - nodes_m_.begin() - 1, 0, static_cast<std::ptrdiff_t>(nodes_m_.size()) - 2));
  const double low = static_cast<double>(i) * step_s_m_;
  double s = low + step_s_m_ * (wanted - nodes_m_[i]) / (nodes_m_[i + 1] - nodes_m_[i]);
  for (int turn = 0; turn < kNewtonTurns; ++turn) {
    const geometry::PlanPoint point = road_->plan().Evaluate(s);
    const double error = s - t_m_ * (point.heading_rad - start_heading_rad_) - wanted;
    s = std::clamp(s - error / std::max(0.1, 1.0 - t_m_ * point.curvature_1pm), low, low + step_s_m_);
  }
  return s;
}

LaneFrame LanePath::At(double d_m) const {
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

Eigen::Vector3d LanePath::Position(double d_m, double offset_m) const {
  return road_->Position(AxisS(d_m), along_ ? t_m_ + offset_m : t_m_ - offset_m);
}

double LanePath::VerticalCurvature_1pm(double d_m) const { return road_->Evaluate(AxisS(d_m)).vertical_curvature_1pm; }

std::optional<Way::Place> LanePath::Locate(double x_m, double y_m, std::optional<double> /*z_m*/) const {
  const auto found = road_->Locate(x_m, y_m);
  if (!found) return std::nullopt;
  return Place{Distance(found->s_m), along_ ? found->t_m - t_m_ : t_m_ - found->t_m};
}

}  // namespace rodeira::driver
