// SPDX-License-Identifier: Apache-2.0
#include "common/core/geometry/vertical_profile.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>

#include "common/core/base/assert.hpp"

namespace rodeira::geometry {

VerticalProfile::VerticalProfile(std::vector<GradePoint> points) : points_(std::move(points)) {
  RODEIRA_ASSERT(!points_.empty());
  const std::size_t count = points_.size();
  const auto grade_after = [&](std::size_t i) {
    return (points_[i + 1].z_m - points_[i].z_m) / (points_[i + 1].s_m - points_[i].s_m);
  };
  double grade = count > 1 ? grade_after(0) : 0.0;
  stretches_.push_back({points_[0].s_m, points_[0].z_m, grade, 0.0});
  for (std::size_t i = 1; i + 1 < count; ++i) {
    RODEIRA_ASSERT(points_[i].s_m > points_[i - 1].s_m && points_[i].parabola_m >= 0.0);
    const double next = grade_after(i);
    const double half = 0.5 * points_[i].parabola_m;
    if (half > 0.0) {
      stretches_.push_back(
          {points_[i].s_m - half, points_[i].z_m - half * grade, grade, (next - grade) / (2.0 * half)});
    }
    stretches_.push_back({points_[i].s_m + half, points_[i].z_m + half * next, next, 0.0});
    grade = next;
  }
}

ProfilePoint VerticalProfile::Evaluate(double s_m) const {
  const auto after = std::upper_bound(stretches_.begin() + 1, stretches_.end(), s_m,
                                      [](double s, const Stretch& stretch) { return s < stretch.from_s_m; });
  const Stretch& stretch = *(after - 1);
  const double u = s_m - stretch.from_s_m;
  return {stretch.z_m + (stretch.grade + 0.5 * stretch.curvature_1pm * u) * u,
          stretch.grade + stretch.curvature_1pm * u, stretch.curvature_1pm};
}

}  // namespace rodeira::geometry
