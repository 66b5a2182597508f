#include "common/driver/speed_plan.hpp"

#include <algorithm>
#include <cmath>

namespace rodeira::driver {
namespace {

constexpr double kNodeStep_m = 1.0;
constexpr double kLeastSquared_m2ps2 = 1e-4;

double AllowedSquared(const Way& path, const SpeedPlanSettings& settings, double d_m) {
  const double limit = path.SpeedLimit_mps(d_m);
  double squared = limit * limit;
  const LaneFrame frame = path.At(d_m);
  const double vertical = std::fabs(path.VerticalCurvature_1pm(d_m));
  const double bend = std::fabs(frame.curvature_1pm);
  if (bend * squared > settings.lateral_mps2) squared = settings.lateral_mps2 / bend;
  if (vertical * squared > settings.vertical_mps2) squared = settings.vertical_mps2 / vertical;
  if (frame.grade < -settings.steep_grade) squared = std::min(squared, std::pow(settings.steep_factor * limit, 2));
  return squared;
}

}  // namespace

SpeedPlan::SpeedPlan(const Way& path, const SpeedPlanSettings& settings) {
  const auto count = static_cast<std::size_t>(std::max(1.0, std::ceil(path.length_m() / kNodeStep_m)));
  step_m_ = path.length_m() / static_cast<double>(count);
  for (std::size_t i = 0; i <= count; ++i) {
    const double d = static_cast<double>(i) * step_m_;
    double squared = AllowedSquared(path, settings, d);
    if (settings.stop_at_end && d >= path.length_m() - settings.end_margin_m) squared = 0.0;
    squared_m2ps2_.push_back(squared);
  }
  for (std::size_t i = count; i-- > 0;) {
    squared_m2ps2_[i] = std::min(squared_m2ps2_[i], squared_m2ps2_[i + 1] + 2.0 * settings.braking_mps2 * step_m_);
  }
}

SpeedPlan::Allowed SpeedPlan::At(double d_m) const {
  const double position = std::max(0.0, d_m) / step_m_;
  const auto last = squared_m2ps2_.size() - 1;
  const auto i = std::min(static_cast<std::size_t>(position), last);
  if (i == last) return {std::sqrt(squared_m2ps2_[last]), 0.0};
  const double share = position - static_cast<double>(i);
  const double squared = squared_m2ps2_[i] + share * (squared_m2ps2_[i + 1] - squared_m2ps2_[i]);
  const double rise = (squared_m2ps2_[i + 1] - squared_m2ps2_[i]) / step_m_;  // d(v²)/dd = 2 v dv/dd
  return {std::sqrt(squared), 0.5 * rise / std::sqrt(std::max(squared, kLeastSquared_m2ps2))};
}

}  // namespace rodeira::driver
