// SPDX-License-Identifier: Apache-2.0
#include "common/world/road/stations.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/base/assert.hpp"

namespace rodeira::road {
namespace {

std::vector<double> Joints(const Road& road) {
  std::vector<double> joints = {0.0, road.length_m()};
  double s = 0.0;
  for (const geometry::PlanPiece& piece : road.plan().pieces()) joints.push_back(s += piece.length_m);
  for (const geometry::GradePoint& point : road.profile().points()) {
    joints.push_back(point.s_m - 0.5 * point.parabola_m);
    joints.push_back(point.s_m + 0.5 * point.parabola_m);
  }
  std::sort(joints.begin(), joints.end());
  std::vector<double> kept;
  for (const double joint : joints) {
    if (joint < 0.0 || joint > road.length_m() || (!kept.empty() && joint - kept.back() < 1e-6)) continue;
    kept.push_back(joint);
  }
  kept.back() = road.length_m();
  return kept;
}

// The most curved line along the road between two s of one element: an offset line t turns by k ds on (1 - k t) ds, so
// its chord over h is off by k (1 - k t) h^2 / 8, worst on the outer side.
double Bend(const Road& road, double from_s_m, double to_s_m) {
  const double inward = 1e-9 * (to_s_m - from_s_m);  // at a joint the element between the two counts
  double bend = 0.0;
  for (const double s : {from_s_m + inward, to_s_m - inward}) {
    const RoadFrame frame = road.Evaluate(s);
    const double outer = frame.curvature_1pm > 0.0 ? road.section().verge_right_m() : road.section().verge_left_m();
    bend = std::max(bend, std::fabs(frame.curvature_1pm) * (1.0 - frame.curvature_1pm * outer));
    bend = std::max(bend, std::fabs(frame.vertical_curvature_1pm));
  }
  return bend;
}

}  // namespace

std::vector<double> Stations(const Road& road, double chord_error_m, double longest_m) {
  RODEIRA_ASSERT(chord_error_m > 0.0 && longest_m > 0.0);
  const std::vector<double> joints = Joints(road);
  std::vector<double> stations = {0.0};
  for (std::size_t i = 1; i < joints.size(); ++i) {
    const double from = joints[i - 1], length = joints[i] - from;
    const double bend = Bend(road, from, joints[i]);
    const double step = std::min(longest_m, bend > 0.0 ? std::sqrt(8.0 * chord_error_m / bend) : longest_m);
    const double count = std::ceil(length / step);
    for (double k = 1.0; k < count; k += 1.0) stations.push_back(from + length * k / count);
    stations.push_back(joints[i]);
  }
  return stations;
}

}  // namespace rodeira::road
