// SPDX-License-Identifier: Apache-2.0
#include "common/world/design/cut.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/base/assert.hpp"
#include "common/core/geometry/plane.hpp"
#include "common/world/design/tables.hpp"
#include "common/world/network/strokes.hpp"

namespace rodeira::design {
namespace {

using geometry::PlanElement;

constexpr double kBeyond_m =
    1.0;  // how far a surface that goes on reaches over a part's end: over this length one that ends there fades

// p of a cubic where the given part of its length is passed.
double ParameterAt(const PlanElement& element, double part) {
  const double whole = geometry::CubicLength(element, element.p_end);
  double low = 0.0, high = element.p_end;
  for (int i = 0; i < 80 && high - low > 1e-15 * element.p_end; ++i) {
    const double middle = 0.5 * (low + high);
    (geometry::CubicLength(element, middle) < part * whole ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

// The same cubic from p on, in the frame of its new start.
PlanElement CubicFrom(const PlanElement& element, double p, double p_end) {
  const Eigen::Vector2d ahead(std::cos(element.heading_rad), std::sin(element.heading_rad));
  const auto shifted = [p](const std::array<double, 4>& a) {
    return std::array<double, 4>{a[0] + p * (a[1] + p * (a[2] + p * a[3])), a[1] + p * (2.0 * a[2] + 3.0 * p * a[3]),
                                 a[2] + 3.0 * p * a[3], a[3]};
  };
  const std::array<double, 4> u = shifted(element.u), v = shifted(element.v);
  PlanElement part = element;
  part.start_W = element.start_W + u[0] * ahead + v[0] * geometry::Left(ahead);
  const double turn = std::atan2(v[1], u[1]);
  part.heading_rad = element.heading_rad + turn;
  const double c = std::cos(turn), s = std::sin(turn);
  for (std::size_t n = 0; n < 4; ++n) {
    part.u[n] = n == 0 ? 0.0 : c * u[n] + s * v[n];
    part.v[n] = n == 0 ? 0.0 : c * v[n] - s * u[n];
  }
  part.p_end = p_end - p;
  return part;
}

std::vector<PlanElement> CutElements(const std::vector<PlanElement>& elements, double from_m, double to_m) {
  std::vector<PlanElement> parts;
  for (const PlanElement& element : elements) {
    const double begin = std::max(from_m - element.s_m, 0.0), end = std::min(to_m - element.s_m, element.length_m);
    if (end - begin <= 1e-9) continue;
    PlanElement part = element;
    if (element.kind == PlanElement::Kind::kCubic) {
      const double p0 = begin > 0.0 ? ParameterAt(element, begin / element.length_m) : 0.0;
      const double p1 = end < element.length_m ? ParameterAt(element, end / element.length_m) : element.p_end;
      part = CubicFrom(element, p0, p1);
    } else {
      const double rate = (element.curvature_end_1pm - element.curvature_start_1pm) / element.length_m;
      PlanElement passed = element;
      passed.length_m = begin;
      passed.curvature_end_1pm = element.curvature_start_1pm + rate * begin;
      if (begin > 0.0) {
        const geometry::PlanPoint at = geometry::PlanAxis::End(passed);
        part.start_W = at.p_W;
        part.heading_rad = at.heading_rad;
      }
      part.curvature_start_1pm = passed.curvature_end_1pm;
      part.curvature_end_1pm = element.curvature_start_1pm + rate * end;
      if (begin == 0.0) part.curvature_start_1pm = element.curvature_start_1pm;
    }
    part.s_m = element.s_m + begin - from_m;
    part.length_m = end - begin;
    parts.push_back(part);
  }
  if (!parts.empty()) parts.front().s_m = 0.0;
  return parts;
}

// Records that hold until the next one.
template <class T>
std::vector<T> CutRecords(const std::vector<T>& records, double from_m, double length_m) {
  std::vector<T> parts;
  for (T record : records) {
    record.s_m -= from_m;
    if (record.s_m >= length_m) break;
    if (record.s_m <= 0.0) {
      record.s_m = 0.0;
      parts.clear();
    }
    parts.push_back(std::move(record));
  }
  return parts;
}

network::Lane CutLane(network::Lane lane, double from_m, double length_m) {
  lane.width = Part(lane.width, from_m, length_m);
  lane.heights = CutRecords(lane.heights, from_m, length_m);
  lane.speeds = CutRecords(lane.speeds, from_m, length_m);
  lane.materials = CutRecords(lane.materials, from_m, length_m);
  return lane;
}

void CutFurniture(const network::RoadSpec& whole, double from_m, double length_m, network::RoadSpec& part) {
  const auto within = [&](double s) { return s >= from_m && s < from_m + length_m; };
  part.signals.clear();
  for (network::Signal signal : whole.signals) {
    if (!within(signal.s_m)) continue;
    signal.s_m -= from_m;
    part.signals.push_back(std::move(signal));
  }
  part.objects.clear();
  for (network::Object object : whole.objects) {
    if (object.type == "roadSurface") {  // lies on a stretch about its place
      const double begin = std::max(object.s_m - 0.5 * object.length_m, from_m),
                   end = std::min(object.s_m + 0.5 * object.length_m, from_m + length_m);
      if (!(end > begin)) continue;
      if (end - begin < object.length_m) object.id += "@" + part.id;
      object.s_m = 0.5 * (begin + end) - from_m;
      object.length_m = end - begin;
    } else if (object.repeats.empty()) {
      if (!within(object.s_m)) continue;
      object.s_m -= from_m;
    } else {
      std::vector<network::Repeat> kept;
      for (network::Repeat repeat : object.repeats) {
        double begin = repeat.s_m;
        if (repeat.distance_m > 0.0)
          begin += std::max(0.0, std::ceil((from_m - begin) / repeat.distance_m)) * repeat.distance_m;
        begin = std::max(begin, from_m);
        const double end = std::min(repeat.s_m + repeat.length_m, from_m + length_m);
        if (end < begin) continue;
        const double slope = repeat.length_m > 0.0 ? (repeat.t_end_m - repeat.t_start_m) / repeat.length_m : 0.0;
        const double t_start = repeat.t_start_m;
        repeat.t_start_m = t_start + slope * (begin - repeat.s_m);
        repeat.t_end_m = t_start + slope * (end - repeat.s_m);
        repeat.length_m = end - begin;
        repeat.s_m = begin - from_m;
        kept.push_back(repeat);
      }
      if (kept.empty()) continue;
      object.repeats = std::move(kept);
      object.s_m = object.repeats[0].s_m;
      object.id += "@" + part.id;
    }
    part.objects.push_back(std::move(object));
  }
  const auto stretch = [&](double& begin, double& length) {
    const double end = std::min(begin + length, from_m + length_m) - from_m;
    begin = std::max(begin - from_m, 0.0);
    length = end - begin;
    return length > 0.0;
  };
  part.structures.clear();
  for (network::Structure structure : whole.structures) {
    if (stretch(structure.s_m, structure.length_m)) part.structures.push_back(std::move(structure));
  }
  // What goes on beyond the part reaches over its ends, so that it is not faded there.
  const auto reach = [&](double& begin, double& end) {
    begin = std::max(begin - from_m, -kBeyond_m);
    end = std::min(end - from_m, length_m + kBeyond_m);
    return begin < length_m && end > 0.0;
  };
  part.crg.clear();
  for (network::CrgSurface crg : whole.crg) {
    const double begin = crg.s_start_m;
    if (!reach(crg.s_start_m, crg.s_end_m)) continue;
    crg.s_offset_m += crg.s_start_m + from_m - begin;
    part.crg.push_back(std::move(crg));
  }
  part.unevenness.clear();
  for (network::Unevenness uneven : whole.unevenness) {
    if (!reach(uneven.s_start_m, uneven.s_end_m)) continue;
    uneven.s_offset_m += from_m;
    part.unevenness.push_back(uneven);
  }
}

// A dashed line goes on as the strokes that it has there, one line each that is cut; else it keeps its own dashes from
// the first whole stroke on.
void CutLines(const network::Road& road, double from_m, double length_m, network::RoadSpec& part) {
  part.lines.clear();
  for (const network::PaintedLine& line : road.spec().lines) {
    if (line.to_s_m <= from_m || line.from_s_m >= from_m + length_m) continue;
    network::PaintedLine cut = line;
    cut.t = Part(line.t, from_m, length_m);
    cut.from_s_m = std::max(line.from_s_m - from_m, 0.0);
    cut.to_s_m = std::min(line.to_s_m - from_m, length_m);
    if (line.gap_m > 0.0 && line.from_s_m < from_m) {
      double next = cut.to_s_m;
      for (const network::Stroke& stroke : network::Strokes(road, line)) {
        if (stroke.from_s_m >= from_m) {
          next = std::min(next, stroke.from_s_m - from_m);
          break;
        }
        if (stroke.to_s_m <= from_m) continue;
        network::PaintedLine rest = cut;  // the stroke that the cut goes through
        rest.gap_m = rest.stroke_m = 0.0;
        rest.to_s_m = std::min(stroke.to_s_m - from_m, length_m);
        part.lines.push_back(std::move(rest));
      }
      cut.from_s_m = next;
    }
    if (cut.from_s_m < cut.to_s_m) part.lines.push_back(std::move(cut));
  }
}

}  // namespace

network::Road Cut(const network::Road& road, double from_m, double to_m, std::string id) {
  const network::RoadSpec& whole = road.spec();
  RODEIRA_ASSERT(whole.sections.size() == 1 && from_m < to_m);
  auto axis = geometry::PlanAxis::Make(CutElements(road.axis().elements(), from_m, to_m));
  RODEIRA_ASSERT(axis.has_value());
  const double length = axis->length_m();
  network::RoadSpec part = whole;
  part.id = std::move(id);
  part.length_m = length;
  part.types = CutRecords(whole.types, from_m, length);
  part.elevation = Part(whole.elevation, from_m, length);
  part.superelevation = Part(whole.superelevation, from_m, length);
  part.lane_offset = Part(whole.lane_offset, from_m, length);
  network::CrossSectionSurface& surface = part.lateral.surface;
  surface.t_offset = Part(surface.t_offset, from_m, length);
  for (auto* side : {&surface.left, &surface.right}) {
    for (network::SurfaceStrip& strip : *side) {
      strip.width = Part(strip.width, from_m, length);
      for (geometry::CubicTable& table : strip.coefficients) table = Part(table, from_m, length);
    }
  }
  for (auto* side : {&part.sections[0].left, &part.sections[0].right}) {
    for (network::Lane& lane : *side) lane = CutLane(std::move(lane), from_m, length);
  }
  CutFurniture(whole, from_m, length, part);
  CutLines(road, from_m, length, part);
  return network::Road(std::move(part), std::move(*axis));
}

}  // namespace rodeira::design
