// SPDX-License-Identifier: Apache-2.0
#include "common/driving/driver/speed_plan.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/base/constants.hpp"

namespace rodeira::driver {
namespace {

constexpr double kPlanNodeStep_m = 1.0;
constexpr double kSame_m2ps2 = 1e-9;  // a step
constexpr double kMinSquared_m2ps2 = 1e-4;
constexpr double kMinShare = 0.25;  // of the comfortable, for a bend on ground that leans outward by itself
constexpr double kTipShare = 0.6;   // of what tips the car over: springs lean, and wheels meet bumps
constexpr double kCrawl_mps2 = 0.2;
constexpr double kBankHalfWidth_m = 0.5;  // the bank is measured over twice this

// The lean across at d: rise over the distance to the left.
double Bank(const Way& path, double d_m) {
  return (path.Position(d_m, kBankHalfWidth_m).z() - path.Position(d_m, -kBankHalfWidth_m).z()) /
         (2.0 * kBankHalfWidth_m);
}

double AllowedSquared(const Way& path, const SpeedPlanSettings& settings, double d_m) {
  const double limit = path.SpeedLimit_mps(d_m);
  double squared = limit * limit;
  const LaneFrame frame = path.At(d_m);
  const double vertical = std::fabs(path.VerticalCurvature_1pm(d_m));
  const double bend = std::fabs(frame.curvature_1pm);
  if (bend * squared > kCrawl_mps2) {
    const double bank = Bank(path, d_m), most = LateralAllowed(frame.curvature_1pm > 0.0 ? bank : -bank, settings);
    if (bend * squared > most) squared = most / bend;
  }
  if (vertical * squared > settings.vertical_mps2) squared = settings.vertical_mps2 / vertical;
  if (frame.grade < -settings.steep_grade) squared = std::min(squared, std::pow(settings.steep_factor * limit, 2));
  return squared;
}

SpeedPlan::Allowed Between(const SpeedPlan::Node& a, const SpeedPlan::Node& b, double d_m) {
  if (a.squared_m2ps2 == b.squared_m2ps2 && a.squared_m2ps2 >= 0.0)
    return {std::sqrt(a.squared_m2ps2), 0.0};                                 // most of a street, and the same bits
  const double rise = (b.squared_m2ps2 - a.squared_m2ps2) / (b.d_m - a.d_m);  // d(v²)/dd = 2 v dv/dd
  const double squared = a.squared_m2ps2 + (std::max(0.0, d_m) - a.d_m) * rise;
  return {std::sqrt(std::max(0.0, squared)), 0.5 * rise / std::sqrt(std::max(squared, kMinSquared_m2ps2))};
}

}  // namespace

double LateralAllowed(double outward, const SpeedPlanSettings& settings) {
  if (outward <= 0.0) return std::min(settings.lateral_mps2, std::max(kCrawl_mps2, kTipShare * settings.tips_mps2));
  const double lean = std::atan(outward);
  const auto beside = [&](double most_mps2) {
    return base::kGravity_mps2 * std::tan(std::atan(most_mps2 / base::kGravity_mps2) - lean);
  };
  const double comfortable = std::max(beside(settings.lateral_mps2), kMinShare * settings.lateral_mps2);
  return std::min(settings.lateral_mps2,
                  std::max(kCrawl_mps2, std::min(comfortable, beside(kTipShare * settings.tips_mps2))));
}

SpeedPlan::SpeedPlan(const Way& path, const SpeedPlanSettings& settings) {
  const auto count = static_cast<std::size_t>(std::max(1.0, std::ceil(path.length_m() / kPlanNodeStep_m)));
  const double step = path.length_m() / static_cast<double>(count);
  std::vector<double> squared;
  for (std::size_t i = 0; i <= count; ++i) {
    const double d = static_cast<double>(i) * step;
    const bool stops = settings.stop_at_end && d >= path.length_m() - settings.end_margin_m;
    squared.push_back(stops ? 0.0 : AllowedSquared(path, settings, d));
  }
  for (std::size_t i = count; i-- > 0;)
    squared[i] = std::min(squared[i], squared[i + 1] + 2.0 * settings.braking_mps2 * step);
  double rise = 0.0;  // a step, behind the node that was kept last
  for (std::size_t i = 0; i <= count; ++i) {
    const bool goes_on = i > 0 && i < count && std::fabs(squared[i + 1] - squared[i] - rise) < kSame_m2ps2;
    if (goes_on) continue;
    nodes_.push_back({static_cast<double>(i) * step, squared[i]});
    if (i < count) rise = squared[i + 1] - squared[i];
  }
  ends_ = {nodes_.front(), nodes_.back()};
  is_even_ = nodes_.size() == 2;
}

SpeedPlan::Allowed SpeedPlan::Even::At(double d_m) const {
  if (d_m >= last.d_m) return {std::sqrt(last.squared_m2ps2), 0.0};
  return Between(first, last, d_m);
}

SpeedPlan::Part SpeedPlan::Around(double d_m) const {
  constexpr double kFar_m = 1e300;
  if (is_even_) return {ends_, -kFar_m, kFar_m};
  if (d_m >= ends_.last.d_m) return {{ends_.last, ends_.last}, ends_.last.d_m, kFar_m};
  const auto after = std::upper_bound(nodes_.begin() + 1, nodes_.end() - 1, d_m,
                                      [](double d, const Node& node) { return d < node.d_m; });
  return {{*(after - 1), *after}, after - 1 == nodes_.begin() ? -kFar_m : (after - 1)->d_m, after->d_m};
}

SpeedPlan::Allowed SpeedPlan::At(double d_m) const {
  if (is_even_ || d_m >= ends_.last.d_m) return ends_.At(d_m);
  const auto after = std::upper_bound(nodes_.begin() + 1, nodes_.end() - 1, d_m,
                                      [](double d, const Node& node) { return d < node.d_m; });
  return Between(*(after - 1), *after, d_m);
}

}  // namespace rodeira::driver
