// SPDX-License-Identifier: Apache-2.0
#include "common/world/design/junction_ways.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "common/core/geometry/plane.hpp"
#include "common/world/design/cut.hpp"
#include "common/world/design/furniture_reader.hpp"
#include "common/world/design/section_reader.hpp"
#include "common/world/design/tables.hpp"

namespace rodeira::design {
namespace {

using geometry::Cubic;
using geometry::CubicTable;

constexpr double kSurfaceStep_m = 0.5;  // along a connecting road, between heights of the junction
constexpr double kSideways_mps2 = 2.5;  // at which bends of a junction are driven

// The powers of u of the cubic through four heights, evenly spread over a width; constant where there is hardly any.
std::array<double, 4> CubicThrough(const std::array<double, 4>& z, double width_m) {
  if (width_m < 1e-3) return {z[0], 0.0, 0.0, 0.0};
  const double first = z[1] - z[0], second = z[2] - 2.0 * z[1] + z[0], third = z[3] - 3.0 * z[2] + 3.0 * z[1] - z[0];
  const double h = width_m / 3.0;  // Newton's form, multiplied out
  return {z[0], (first - second / 2.0 + third / 3.0) / h, (second / 2.0 - third / 2.0) / (h * h),
          third / 6.0 / (h * h * h)};
}

// Cubics through evenly spaced values, with the slopes of the values beside them.
CubicTable Followed(const std::vector<double>& s, const std::vector<double>& value) {
  const std::size_t last = s.size() - 1;
  const auto slope = [&](std::size_t i) {
    if (i == 0) return (value[1] - value[0]) / (s[1] - s[0]);
    if (i == last) return (value[last] - value[last - 1]) / (s[last] - s[last - 1]);
    return (value[i + 1] - value[i - 1]) / (s[i + 1] - s[i - 1]);
  };
  std::vector<Cubic> records;
  for (std::size_t i = 0; i < last; ++i) {
    const double h = s[i + 1] - s[i], mean = (value[i + 1] - value[i]) / h, g0 = slope(i), g1 = slope(i + 1);
    records.push_back({s[i], value[i], g0, (3.0 * mean - 2.0 * g0 - g1) / h, (g0 + g1 - 2.0 * mean) / (h * h)});
  }
  return CubicTable(std::move(records));
}

// The heights of the junction's surface as the road's own: along its axis as cubics with the surface's slopes, across
// each lane as a cubic through its edges and two points between them.
void FitToSurface(const JunctionSurface& surface, const geometry::PlanAxis& axis, network::RoadSpec& spec) {
  network::LaneSection& section = spec.sections[0];
  const int steps = std::max(2, static_cast<int>(std::ceil(axis.length_m() / kSurfaceStep_m)));
  std::vector<double> stations;
  for (int i = 0; i <= steps; ++i) stations.push_back(axis.length_m() * i / steps);
  const auto height = [&](double s, double t) {
    const geometry::PlanPoint at = axis.Evaluate(s);
    return surface.At(at.p_W + t * at.left_W());
  };
  std::vector<Cubic> z;
  std::vector<std::pair<double, double>> values;  // height and slope along the axis
  for (const double s : stations) {
    const JunctionHeight at = height(s, 0.0);
    values.emplace_back(at.z_m, axis.Evaluate(s).tangent_W.dot(Eigen::Vector2d(at.slope_x, at.slope_y)));
  }
  for (std::size_t i = 0; i + 1 < stations.size(); ++i) {
    const double h = stations[i + 1] - stations[i], mean = (values[i + 1].first - values[i].first) / h;
    const double g0 = values[i].second, g1 = values[i + 1].second;
    z.push_back({stations[i], values[i].first, g0, (3.0 * mean - 2.0 * g0 - g1) / h, (g0 + g1 - 2.0 * mean) / (h * h)});
  }
  spec.elevation = CubicTable(std::move(z));
  spec.superelevation = {};
  spec.lateral = {};
  spec.lateral.surface.t_offset = spec.lane_offset;
  // Strips carry their lanes' edges: the innermost ones also how far the lanes' middle lies from the axis.
  for (const bool left : {true, false}) {
    std::vector<network::Lane>& lanes = left ? section.left : section.right;
    for (network::Lane& lane : lanes) {
      lane.heights.clear();
      network::SurfaceStrip strip;
      strip.relative = false;
      strip.has_width = true;
      strip.width = lane.width;
      const CubicTable outer = EdgeOf(spec, lane.id), inner = EdgeOf(spec, left ? lane.id - 1 : lane.id + 1);
      std::array<std::vector<double>, 4> across;  // by power of u, at each station
      for (const double s : stations) {
        const double axis_z = height(s, 0.0).z_m, from = inner.Value(s), to = outer.Value(s);
        std::array<double, 4> z_at;
        for (std::size_t k = 0; k < 4; ++k)
          z_at[k] = height(s, from + (to - from) * static_cast<double>(k) / 3.0).z_m - axis_z;
        const std::array<double, 4> powers = CubicThrough(z_at, std::fabs(to - from));
        for (std::size_t n = 0; n < 4; ++n) across[n].push_back(powers[n]);
      }
      for (std::size_t n = 0; n < 4; ++n) strip.coefficients[n] = Followed(stations, across[n]);
      (left ? spec.lateral.surface.left : spec.lateral.surface.right).push_back(std::move(strip));
    }
  }
}

}  // namespace

network::Road WayAlong(const network::Road& whole, double from_s_m, double to_s_m, const std::string& id,
                       const std::string& junction, const JunctionSurface& surface) {
  const network::Road part = Cut(whole, from_s_m, to_s_m, id);
  network::RoadSpec spec = part.spec();
  spec.junction = junction;
  spec.earthwork.reset();
  spec.signals.clear();
  std::erase_if(spec.objects, [](const network::Object& object) { return object.type != "roadSurface"; });
  for (auto* side : {&spec.sections[0].left, &spec.sections[0].right}) {
    while (!side->empty() && !network::IsDrivable(side->back().type)) side->pop_back();
  }
  FitToSurface(surface, part.axis(), spec);
  return network::Road(std::move(spec), part.axis());
}

std::optional<network::Road> WayBetween(const ArmLane& from, const Eigen::Vector2d& inward_W, const ArmLane& to,
                                        const Eigen::Vector2d& outward_W, const std::string& id,
                                        const std::string& junction, const JunctionSurface& surface,
                                        const network::Road& like) {
  const Eigen::Vector2d chord = to.left_W - from.left_W;
  const double turn = std::atan2(geometry::Cross(inward_W, outward_W), inward_W.dot(outward_W));
  // Handles as long as those of the arc that turns by this much over this chord.
  const double quarter = std::cos(0.25 * turn);
  const double handle = chord.norm() / (3.0 * quarter * quarter);
  geometry::PlanElement element;
  element.kind = geometry::PlanElement::Kind::kCubic;
  element.start_W = from.left_W;
  element.heading_rad = std::atan2(inward_W.y(), inward_W.x());
  const auto local = [&](const Eigen::Vector2d& v) {
    return Eigen::Vector2d(v.dot(inward_W), geometry::Cross(inward_W, v));
  };
  const Eigen::Vector2d end = local(chord), p1(handle, 0.0), p2 = end - handle * local(outward_W);
  for (int axis = 0; axis < 2; ++axis) {
    auto& a = axis == 0 ? element.u : element.v;
    a = {0.0, 3.0 * p1[axis], 3.0 * (p2[axis] - 2.0 * p1[axis]), end[axis] - 3.0 * p2[axis] + 3.0 * p1[axis]};
  }
  element.length_m = geometry::CubicLength(element, 1.0);
  auto axis = geometry::PlanAxis::Make({element});
  if (!axis) return std::nullopt;
  const double length = axis->length_m();
  network::RoadSpec spec;
  spec.id = spec.name = id;
  spec.junction = junction;
  spec.length_m = length;
  spec.left_hand = like.spec().left_hand;
  spec.types = {{0.0, "rural", "", std::nullopt}};
  double sharpest = 0.0;
  for (int i = 0; i <= 20; ++i)
    sharpest = std::max(sharpest, std::fabs(axis->Evaluate(length * i / 20.0).curvature_1pm));
  spec.types[0].speed_mps = std::sqrt(kSideways_mps2 / std::max(sharpest, 1e-3));
  if (!like.spec().types.empty() && like.spec().types[0].speed_mps) {
    spec.types[0].speed_mps = std::min(*spec.types[0].speed_mps, *like.spec().types[0].speed_mps);
  }
  network::Lane lane;
  lane.id = -1;
  lane.type = network::LaneType::kDriving;
  lane.width = Eased({{0.0, from.width_m}, {length, to.width_m}});
  lane.direction = 1;
  const network::Lane* model = like.spec().sections[0].Find(from.id);
  if (model != nullptr) lane.materials = model->materials;
  lane.predecessors = {from.id};
  lane.successors = {to.id};
  network::LaneSection section;
  section.right.push_back(std::move(lane));
  spec.sections.push_back(std::move(section));
  FitToSurface(surface, *axis, spec);
  return network::Road(std::move(spec), std::move(*axis));
}

void MarkArm(network::RoadSpec& spec, network::End end, Control control, bool major) {
  const bool starts = end == network::End::kStart;
  const int incoming = starts ? -1 : 1;
  const bool right_side = spec.left_hand ? starts : !starts;  // where oncoming traffic stands
  const auto& section = spec.sections[0];
  const int outermost = right_side ? -static_cast<int>(section.right.size()) : static_cast<int>(section.left.size());
  const auto put = [&](const char* name, double away_m) {
    if (away_m > 0.6 * spec.length_m) return;
    network::Signal signal = MakeSign(*FindSign(name), std::nullopt);
    signal.id = fmt::format("{}-{}-{}", spec.id, starts ? "start" : "end", name);
    signal.s_m = starts ? away_m : spec.length_m - away_m;
    signal.t_m = EdgeOf(spec, outermost).Value(signal.s_m) + (right_side ? 0.4 : -0.4);
    signal.z_offset_m = 2.0;
    signal.orientation.assign(1, starts ? '-' : '+');
    spec.signals.push_back(std::move(signal));
  };
  if (control == Control::kNone || control == Control::kLights) return;
  if (major) return put("priority", 100.0);
  put(control == Control::kStop ? "stop" : "give_way", 1.5);
  const double length = control == Control::kStop ? 0.5 : 0.4;
  const double from = starts ? 0.3 : spec.length_m - 0.3 - length;
  for (const auto* side : {&section.left, &section.right}) {
    for (const network::Lane& lane : *side) {
      if (!network::IsDrivable(lane.type) || lane.direction == -incoming) continue;
      const double inner = EdgeOf(spec, lane.id > 0 ? lane.id - 1 : lane.id + 1).Value(from),
                   outer = EdgeOf(spec, lane.id).Value(from);
      const double width = std::fabs(outer - inner);
      // Stop: one bar over the lane. Give way: strokes of 0.5 m across it with gaps of 0.3 m.
      const double stroke = control == Control::kStop ? width - 0.2 : 0.5, gap = 0.3;
      const double count = control == Control::kStop ? 1.0 : std::floor((width - 0.2 + gap) / (stroke + gap));
      for (double i = 0.0; i < count; i += 1.0) {
        const double t = 0.5 * (inner + outer) + (i - 0.5 * (count - 1.0)) * (stroke + gap);
        spec.lines.push_back({from, from + length, Constant(t), stroke, 0.0, 0.0, "white"});
      }
    }
  }
}

}  // namespace rodeira::design
