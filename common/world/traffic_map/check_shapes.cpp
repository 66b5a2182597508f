// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "common/core/base/constants.hpp"
#include "common/world/traffic_map/check_rules.hpp"
#include "common/world/traffic_map/lane_map.hpp"
#include "common/world/traffic_map/picture.hpp"

namespace rodeira::traffic_map {
namespace {

constexpr double kMinCurve_m = 0.01;
constexpr double kNarrowest_m = 1.5;  // of a lane: the narrowest car
constexpr double kWidest_m = 12.0;
constexpr double kWidestGap_m =
    0.05;  // between the borders of lanes that are connected: a network closes no more (opendrive::Tolerance)
constexpr double kSharpestKink_rad = 0.1;
constexpr double kHighestStep_m = 0.02;
constexpr double kSteepest = 0.2;
constexpr int kSamples = 32;  // along a lane

std::vector<std::optional<LaneShape>> ShapesOf(const MapFile& map, const Heights& heights) {
  std::vector<std::optional<LaneShape>> shapes(map.lanes.size());
  const NumberIndex curves(map.curves);
  for (std::size_t i = 0; i < map.lanes.size(); ++i) {
    const Lane& lane = map.lanes[i].value;
    const auto left = curves.Find(lane.left.curve), right = curves.Find(lane.right.curve);
    if (!left || !right || left == right) continue;
    const LaneShape shape(BorderOf(lane.left, map.curves[*left].value, heights),
                          BorderOf(lane.right, map.curves[*right].value, heights));
    if (shape.left().plan.PolygonLength() < kMinCurve_m || shape.right().plan.PolygonLength() < kMinCurve_m) continue;
    shapes[i] = shape;
  }
  return shapes;
}

// Where a lane is worst, by its samples.
struct Worst {
  double narrowest_m = 1e300, widest_m = -1e300;
  double sharpest = 0.0;  // curvature times the half width on the inner side; from 1 on the inner border turns back
  double sharpest_radius_m = 0.0, steepest = 0.0;
  bool crossed = false;  // the left border lies to the right of the right one somewhere
};

Worst Sample(const LaneShape& shape) {
  Worst worst;
  for (int i = 0; i <= kSamples; ++i) {
    const LanePoint at = shape.AtParameter(static_cast<double>(i) / kSamples);
    worst.crossed = worst.crossed || at.width_m() < 0.0;
    worst.narrowest_m = std::min(worst.narrowest_m, at.width_m());
    worst.widest_m = std::max(worst.widest_m, at.width_m());
    worst.steepest = std::max(worst.steepest, std::abs(at.grade));
    const double sharp = at.curvature_1pm * (at.curvature_1pm > 0.0 ? at.left_m : at.right_m);
    if (sharp <= worst.sharpest) continue;
    worst.sharpest = sharp;
    worst.sharpest_radius_m = 1.0 / std::abs(at.curvature_1pm);
  }
  return worst;
}

// What makes two borders that run against each other run alike.
std::string Turned(const Lane& lane) {
  if (lane.left.inverted == lane.right.inverted)
    return lane.left.inverted ? "one must not be inverted" : "one must be inverted";
  return fmt::format("curve {} is inverted and must not be, or curve {} must be too",
                     lane.left.inverted ? lane.left.curve : lane.right.curve,
                     lane.left.inverted ? lane.right.curve : lane.left.curve);
}

// False: the shape is no lane, so that its joints with others are not checked.
bool CheckLane(const Line<Lane>& line, const LaneShape& shape, Findings& findings) {
  const auto run = [](const Border& border) -> Eigen::Vector2d { return border.plan.p_W[3] - border.plan.p_W[0]; };
  const auto head = [](const Border& border) { return border.plan.Tangent(0.0); };
  // Borders of a hairpin may have runs of little meaning, but their beginnings point the same way.
  if (run(shape.left()).dot(run(shape.right())) < 0.0 && head(shape.left()).dot(head(shape.right())) < 0.0) {
    findings.Add(Severity::kError, line, "map.opposed_borders",
                 fmt::format("its curves {} and {} run against each other; {}", line.value.left.curve,
                             line.value.right.curve, Turned(line.value)));
    return false;
  }
  if (shape.length_m() < kMinCurve_m) {
    findings.Add(Severity::kError, line, "map.empty_lane", "it has no length");
    return false;
  }
  const Worst worst = Sample(shape);
  if (worst.widest_m < 0.0) {
    findings.Add(Severity::kError, line, "map.exchanged_borders",
                 fmt::format("its left curve {} lies to the right of its right curve {}; exchange them, or invert both",
                             line.value.left.curve, line.value.right.curve));
    return false;
  }
  if (worst.crossed) {
    findings.Add(Severity::kError, line, "map.crossed_borders", "its borders cross");
    return false;
  }
  if (worst.narrowest_m < kNarrowest_m)
    findings.Add(Severity::kWarning, line, "map.narrow_lane",
                 fmt::format("only {:.2f} m wide where it is narrowest", worst.narrowest_m));
  if (worst.widest_m > kWidest_m)
    findings.Add(Severity::kWarning, line, "map.wide_lane",
                 fmt::format("{:.1f} m wide where it is widest", worst.widest_m));
  if (worst.sharpest >= 1.0) {
    findings.Add(Severity::kWarning, line, "map.sharp_bend",
                 fmt::format("it bends with a radius of {:.2f} m, within its own half width", worst.sharpest_radius_m));
  }
  if (worst.steepest > kSteepest)
    findings.Add(Severity::kWarning, line, "map.steep_lane",
                 fmt::format("its grade reaches {:.0f} %", 100.0 * worst.steepest));
  return true;
}

void CheckJoint(const Line<Connection>& line, const LaneShape& from, const LaneShape& to, Findings& findings) {
  const LanePoint end = from.AtParameter(1.0), begin = to.AtParameter(0.0);
  const auto apart = [](const Border& before, const Border& after) {
    return (after.plan.p_W[0] - before.plan.p_W[3]).norm();
  };
  const double gap = std::max(apart(from.left(), to.left()), apart(from.right(), to.right()));
  const double kink = std::acos(std::clamp(end.tangent_W.dot(begin.tangent_W), -1.0, 1.0));
  const double step = begin.z_m - end.z_m;
  if (gap > kWidestGap_m)
    findings.Add(Severity::kError, line, "map.gap",
                 fmt::format("{:.2f} m lie between the borders of the one where it ends and those of the other where "
                             "it begins; at most {:.2f} m are closed",
                             gap, kWidestGap_m));
  if (kink > kSharpestKink_rad)
    findings.Add(Severity::kWarning, line, "map.kink",
                 fmt::format("the direction jumps by {:.1f} degrees", kink * base::kDegreesPerRadian));
  if (std::abs(step) > kHighestStep_m)
    findings.Add(Severity::kWarning, line, "map.step", fmt::format("the height jumps by {:.3f} m", step));
}

void CheckPicture(const MapFile& map, Findings& findings) {
  if (map.picture.empty()) return;
  const auto picture = ReadPictureInfo(map.picture);
  if (!picture) {
    findings.Add(Severity::kError, "map.wrong_picture",
                 fmt::format("the {} bytes behind the line 'i' are no PNG or JPEG picture", map.picture.size()));
  } else if (picture->width_px > 16384 || picture->height_px > 16384) {
    findings.Add(Severity::kError, "map.large_picture",
                 fmt::format("the picture has {} by {} pixels; up to 16384 each way can be shown", picture->width_px,
                             picture->height_px));
  } else if (!picture->ends) {
    findings.Add(Severity::kError, "map.wrong_picture",
                 fmt::format("the {} bytes behind the line 'i' end before the {} picture does", map.picture.size(),
                             picture->kind));
  } else if (!picture->fits) {
    findings.Add(Severity::kError, "map.wrong_picture",
                 fmt::format("the {} bytes behind the line 'i' are too few for a {} picture of {} by {} pixels",
                             map.picture.size(), picture->kind, picture->width_px, picture->height_px));
  }
}

}  // namespace

void CheckShapes(const MapFile& map, const Heights& heights, Findings& findings) {
  for (const auto& line : map.curves) {
    const Cubic cubic = BorderOf({}, line.value, heights).plan;
    if (cubic.PolygonLength() < kMinCurve_m)
      findings.Add(Severity::kError, line, "map.empty_curve", "it is empty: its four points coincide");
  }
  std::vector<std::optional<LaneShape>> shapes = ShapesOf(map, heights);
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    if (shapes[i] && !CheckLane(map.lanes[i], *shapes[i], findings)) shapes[i].reset();
  }
  const NumberIndex lanes(map.lanes);
  for (const auto& line : map.connections) {
    const auto from = lanes.Find(line.value.from), to = lanes.Find(line.value.to);
    if (from && to && from != to && shapes[*from] && shapes[*to])
      CheckJoint(line, *shapes[*from], *shapes[*to], findings);
  }
  CheckPicture(map, findings);
}

}  // namespace rodeira::traffic_map
