// SPDX-License-Identifier: Apache-2.0
#include "common/world/design/profile_reader.hpp"

#include <fmt/format.h>

#include <cmath>
#include <set>

#include "common/world/design/road_schema.hpp"
#include "common/world/design/tables.hpp"

namespace rodeira::design {
namespace {

using config::List;
using config::Map;

constexpr double kSteepestGrade = 0.5;
constexpr double kFeltKink = 0.005;  // of a grade, without a parabola

}  // namespace

std::vector<geometry::GradePoint> ReadGrades(const Map& road) {
  std::vector<geometry::GradePoint> grades;
  const List points = road.Items("vertical");
  const config::DeclaredList declared(points, config::FindKey(RoadKeys(), "vertical")->of.front());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const config::DeclaredMap keys = declared.At(i);
    const Map& item = keys.map();
    const geometry::GradePoint point{keys.Number("s_m"), keys.Number("z_m"), keys.Number("parabola_m")};
    if (i > 0 && point.s_m <= grades.back().s_m)
      item.Problem("s_m", "config.wrong_order", "the points of 'vertical' must come in ascending 's_m'");
    if ((i == 0 || i + 1 == points.size()) && point.parabola_m > 0.0) {
      item.Problem("parabola_m",
                   "the first and the last point of 'vertical' have no parabola: no two grades meet there");
    }
    grades.push_back(point);
  }
  if (road.Has("vertical") && points.size() == 0)
    road.Problem("vertical", "config.too_few", "'vertical' has no points; at least one was expected");
  for (std::size_t i = 1; i < grades.size(); ++i) {
    const geometry::GradePoint& before = grades[i - 1];
    const geometry::GradePoint& here = grades[i];
    const double between = here.s_m - before.s_m;
    if (!(between > 0.0)) continue;  // told above
    const double grade = (here.z_m - before.z_m) / between;
    if (!(std::fabs(grade) <= kSteepestGrade)) {
      points.Problem(
          i, "config.out_of_range",
          fmt::format("the grade before the point of 'vertical' at s_m: {} is {:.3g}; at most {} was expected",
                      here.s_m, grade, kSteepestGrade));
    }
    if (0.5 * (before.parabola_m + here.parabola_m) > between) {
      points.Problem(i, "config.wrong_order",
                     fmt::format("the parabolas of {} m and {} m overlap: their points are only {} m apart",
                                 before.parabola_m, here.parabola_m, between));
    }
  }
  return grades;
}

std::vector<std::string> GradeWarnings(const Map& road, const std::vector<geometry::GradePoint>& grades) {
  std::vector<std::string> warnings;
  const List points = road.Items("vertical");
  for (std::size_t i = 1; i + 1 < grades.size(); ++i) {
    const geometry::GradePoint &before = grades[i - 1], &here = grades[i], &behind = grades[i + 1];
    const double kink =
        (behind.z_m - here.z_m) / (behind.s_m - here.s_m) - (here.z_m - before.z_m) / (here.s_m - before.s_m);
    if (here.parabola_m > 0.0 || !(std::fabs(kink) > kFeltKink)) continue;
    warnings.push_back(fmt::format("{}: the grade kinks by {:.2f} % at s = {:.3f} m; a 'parabola_m' rounds it",
                                   points.Place(i), 100.0 * kink, here.s_m));
  }
  return warnings;
}

geometry::CubicTable Elevation(const geometry::VerticalProfile& profile, double length_m) {
  std::set<double> begins{0.0};
  const auto& points = profile.points();
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    for (const double side : {-0.5, 0.5}) {
      const double s = points[i].s_m + side * points[i].parabola_m;
      if (s > 0.0 && s < length_m) begins.insert(s);
    }
  }
  std::vector<geometry::Cubic> records;
  for (const double s : begins) {
    const geometry::ProfilePoint at = profile.Evaluate(s);
    records.push_back({s, at.z_m, at.grade, 0.5 * at.curvature_1pm, 0.0});
  }
  return geometry::CubicTable(std::move(records));
}

geometry::CubicTable ReadSuperelevation(const config::DeclaredMap& road) {
  std::vector<Knot> knots = ReadKnots(road, "superelevation", "slope");
  for (Knot& knot : knots) knot.value = std::atan(knot.value);
  return Eased(knots);
}

}  // namespace rodeira::design
