// SPDX-License-Identifier: Apache-2.0
#include "common/editor/sketch.hpp"

#include <algorithm>
#include <cmath>

#include "common/editor/lane_tools.hpp"

namespace rodeira::editor {
namespace {

constexpr double kSame_m = 1e-6;
constexpr std::int32_t kMaxNumber = INT32_MAX - 1000;  // a template has fewer elements than this leaves

bool Same(const Points& a, const Points& b, bool reversed) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    if ((a[i] - b[reversed ? a.size() - 1 - i : i]).norm() > kSame_m) return false;
  }
  return true;
}

}  // namespace

Pose Pose::Moved(double ahead_m, double left_m) const {
  const double c = std::cos(heading_rad), s = std::sin(heading_rad);
  return {p_W + Eigen::Vector2d(ahead_m * c - left_m * s, ahead_m * s + left_m * c), heading_rad};
}

Sketch::Sketch(const Document& document)
    : next_curve_(NextNumber(document.map.curves)), next_lane_(NextNumber(document.map.lanes)) {}

traffic_map::LaneSide Sketch::Side(const Points& points, traffic_map::BorderType type) {
  for (const auto& [number, known] : curves_) {
    for (const bool reversed : {false, true}) {
      if (Same(points, known, reversed)) return {number, reversed, type};
    }
  }
  curves_.emplace_back(next_curve_++, points);
  return {curves_.back().first, false, type};
}

std::int32_t Sketch::Lane(const Pose& from, const Pose& to, double width_m, traffic_map::BorderType left,
                          traffic_map::BorderType right, traffic_map::LaneMode mode) {
  const auto border = [&](double left_m) {
    const Pose begin = from.Moved(0.0, left_m), end = to.Moved(0.0, left_m);
    return CurveBetween(begin.p_W, begin.heading_rad, end.p_W, end.heading_rad);
  };
  const traffic_map::LaneSide left_side = Side(border(0.5 * width_m), left),
                              right_side = Side(border(-0.5 * width_m), right);
  lanes_.push_back({next_lane_++, left_side, right_side, mode});
  return lanes_.back().id;
}

base::Result<Edit> Sketch::Finish(Document& document, std::string what) const {
  if (next_curve_ > kMaxNumber || next_lane_ > kMaxNumber)
    return base::WrongInput("edit.no_numbers_left", "there are no numbers left for so many curves and lanes");
  std::vector<traffic_map::Curve> curves;
  for (const auto& [number, points] : curves_) {
    const auto curve = CurveOf(number, points);
    if (!curve) return curve.error();
    curves.push_back(curve.value());
  }
  Recorder recorder(document);
  for (const traffic_map::Curve& curve : curves) recorder.Add(curve);
  for (const traffic_map::Lane& lane : lanes_) recorder.Add(lane);
  for (const traffic_map::Connection& connection : connections_) recorder.Add(connection);
  if (!signs_.empty()) {
    auto& signs = recorder.companion().signs;
    signs.insert(signs.end(), signs_.begin(), signs_.end());
  }
  return std::move(recorder).Finish(std::move(what));
}

}  // namespace rodeira::editor
