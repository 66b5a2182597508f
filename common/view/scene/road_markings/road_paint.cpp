// SPDX-License-Identifier: Apache-2.0
#include "common/view/scene/road_markings/road_paint.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/base/constants.hpp"
#include "common/view/scene/mesh/solids.hpp"
#include "common/view/scene/road_furniture/static_objects.hpp"
#include "common/view/scene/road_markings/object_marks.hpp"
#include "common/view/scene/road_markings/object_shapes.hpp"
#include "common/view/scene/road_markings/spot.hpp"
#include "common/view/scene/road_markings/stencils.hpp"

namespace rodeira::scene {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kCrossing_m = 4.0;
constexpr double kParkingLine_m = 0.12;

void Lay(const std::vector<Polygon2>& shape, const Spot& spot, TilePaint& paint, Colour colour = PaintColour("white")) {
  for (const Polygon2& polygon : shape) {
    // In quadrangles from its first corner; the last may be a triangle, with its third corner twice.
    for (std::size_t i = 1; i + 1 < polygon.size(); i += 2) {
      const std::size_t last = std::min(i + 2, polygon.size() - 1);
      AddPaint({{spot.ToWorld(polygon[0]), spot.ToWorld(polygon[i]), spot.ToWorld(polygon[i + 1]),
                 spot.ToWorld(polygon[last])},
                colour},
               paint);
    }
  }
}

Polygon2 Rectangle(double length_m, double right_m, double left_m) {
  return {{-0.5 * length_m, right_m}, {0.5 * length_m, right_m}, {0.5 * length_m, left_m}, {-0.5 * length_m, left_m}};
}

// The edges of the lanes that are driven on at s, from right to left; those of `sign` alone where that is not 0.
std::vector<std::pair<double, double>> Driven(const network::Road& road, double s_m, int sign) {
  std::vector<std::pair<double, double>> spans;
  const network::LaneSection& section = road.SectionAt(s_m);
  for (const auto* side : {&section.right, &section.left}) {
    for (const network::Lane& lane : *side) {
      if (!network::IsDrivable(lane.type) || lane.id * sign < 0) continue;
      const auto span = road.SpanAt(road.SectionIndex(s_m), lane.id, s_m);
      if (span)
        spans.emplace_back(std::min(span->inner_t_m, span->outer_t_m), std::max(span->inner_t_m, span->outer_t_m));
    }
  }
  return spans;
}

void PaintCrossing(const network::Road& road, const network::Placed& placed, TilePaint& paint) {
  const network::Signal& signal = *placed.signal;
  const double length = std::min(
      signal.value.value_or(kCrossing_m) > 0.0 ? signal.value.value_or(kCrossing_m) : kCrossing_m, road.length_m());
  const double s = std::clamp(placed.s_m, 0.5 * length, road.length_m() - 0.5 * length);
  double right = 1e9, left = -1e9;
  for (const auto& [low, high] : Driven(road, s, 0)) right = std::min(right, low), left = std::max(left, high);
  if (signal.width_m > 0.0)
    right = std::max(right, placed.t_m - 0.5 * signal.width_m),
    left = std::min(left, placed.t_m + 0.5 * signal.width_m);
  if (!(left > right)) return;
  const double middle = 0.5 * (left + right), half = 0.5 * (left - right);
  Lay(ZebraShape(Rectangle(length, -half, half)), Spot::At(road, s, middle, road.axis().Evaluate(s).heading_rad),
      paint);
}

bool IsLineAcross(const network::Signal& signal) { return signal.type == "294" || signal.type == "341"; }

void PaintLineAcross(const network::Road& road, const network::Placed& placed, TilePaint& paint) {
  const network::Signal& signal = *placed.signal;
  const bool against = signal.orientation == "-";
  const bool on_left = against != road.spec().left_hand;  // of the axis: where its traffic drives
  const auto lanes = Driven(road, placed.s_m, on_left ? 1 : -1);
  double width = signal.width_m, from = placed.t_m, to = placed.t_m;
  if (!(width > 0.0)) {
    for (const auto& [low, high] : lanes) from = std::min(from, low), to = std::max(to, high);
  } else {
    const auto covered = [&](double low, double high) {
      double sum = 0.0;
      for (const auto& [right, left] : lanes) sum += std::max(0.0, std::min(high, left) - std::max(low, right));
      return sum;
    };
    const double aside = against ? placed.t_m : placed.t_m - width;  // to the right of its readers
    const bool about = covered(placed.t_m - 0.5 * width, placed.t_m + 0.5 * width) >= covered(aside, aside + width);
    from = about ? placed.t_m - 0.5 * width : aside;
    to = from + width;
  }
  if (!(to > from)) return;
  const double middle = 0.5 * (from + to);
  const auto shape =
      signal.type == "294" ? StopLineShape(from - middle, to - middle) : GiveWayShape(from - middle, to - middle);
  Lay(shape, Spot::At(road, placed.s_m, middle, road.axis().Evaluate(placed.s_m).heading_rad), paint);
}

void PaintArrow(const network::Road& road, const network::Placed& placed, const ArrowWays& ways, double heading_rad,
                double length_m, TilePaint& paint, Colour colour = PaintColour("white")) {
  const double usual = ways.left || ways.right ? 1.0 : 0.45;
  Lay(ArrowShape(ways, length_m > 0.0 ? length_m : kArrow_m, placed.width_m > 0.0 ? placed.width_m : usual),
      Spot::At(road, placed.s_m, placed.t_m, heading_rad), paint, colour);
}

// Where a signal that is an arrow points.
ArrowWays ArrowOf(const network::Signal& signal) {
  ArrowWays ways = WaysOf(signal.name);
  if (signal.type == "297" && !ways.any()) ways.straight = true;
  if (signal.type != "297" && signal.height_m > kFlatSign_m) return {};
  return ways;
}

bool IsCrossing(const network::Signal& signal) { return signal.type == "293" || signal.type == "1000003"; }

void PaintSignal(const network::Road& road, const network::Placed& placed, TilePaint& paint) {
  const network::Signal& signal = *placed.signal;
  if (!IsPaint(signal) || placed.s_m < 0.0 || placed.s_m > road.length_m()) return;
  if (IsCrossing(signal)) return PaintCrossing(road, placed, paint);
  if (IsLineAcross(signal)) return PaintLineAcross(road, placed, paint);
  const ArrowWays ways = ArrowOf(signal);
  PaintArrow(road, placed, ways, placed.heading_rad + base::kPi, 0.0, paint);
}

// The corners of an outline of an object, or of the rectangle that it says where there is none, as seen from `along`.
Polygon2 OutlineCorners(const network::Road& road, const network::Placed& placed, const network::Outline* outline,
                        const Spot& along) {
  const Spot own = Spot::At(road, placed.s_m, placed.t_m, placed.heading_rad);
  Polygon2 corners;
  const auto add = [&](const Vector2d& local) { corners.push_back(along.ToLocal(own.ToWorld(local).head<2>())); };
  if (outline == nullptr) {
    for (const Vector2d& p : Rectangle(placed.length_m, -0.5 * placed.width_m, 0.5 * placed.width_m)) add(p);
    return corners;
  }
  for (const network::Corner& corner : outline->corners) {
    if (corner.local)
      add({corner.first_m, corner.second_m});
    else
      corners.push_back(along.ToLocal(road.Surface(corner.first_m, corner.second_m).p_W.head<2>()));
  }
  return corners;
}

// In the road's direction at its place.
Polygon2 OutlineOf(const network::Road& road, const network::Placed& placed, const Spot& along) {
  const auto& outlines = placed.object->outlines;
  return HullOf(OutlineCorners(road, placed, outlines.empty() ? nullptr : &outlines.front(), along));
}

double Around(const Polygon2& corners) {
  double length = 0.0;
  for (std::size_t i = 0; i < corners.size(); ++i) length += (corners[(i + 1) % corners.size()] - corners[i]).norm();
  return length;
}

void LayFrame(const Polygon2& corners, bool closed, std::span<const std::size_t> along, double width_m, Colour colour,
              const Spot& spot, TilePaint& paint) {
  for (const FramePiece& piece : FrameOf(corners, closed, along, width_m))
    Lay({Polygon2(piece.corners.begin(), piece.corners.end())}, spot, paint, colour);
}

// White lines along the edges of a parking place without marks in its file.
void PaintParkingPlace(const network::Road& road, const network::Placed& placed, TilePaint& paint) {
  const network::Object& object = *placed.object;
  const Spot own = Spot::At(road, placed.s_m, placed.t_m, placed.heading_rad);
  const network::Outline* outline = object.outlines.empty() ? nullptr : &object.outlines.front();
  if (outline == nullptr && !(placed.length_m > 0.0 && placed.width_m > 0.0)) return;
  const Polygon2 corners = OutlineCorners(road, placed, outline, own);
  if (Around(corners) <= kMaxPaintLength_m)
    LayFrame(corners, outline == nullptr || outline->closed, {}, kParkingLine_m, PaintColour(object.material.colour),
             own, paint);
}

// What fills an outline that lies flat, and the frames within it.
void PaintFlatOutlines(const network::Road& road, const network::Placed& placed, TilePaint& paint) {
  const network::Object& object = *placed.object;
  const Spot own = Spot::At(road, placed.s_m, placed.t_m, placed.heading_rad);
  for (std::size_t i = 0; i < object.outlines.size(); ++i) {
    const network::Outline& outline = object.outlines[i];
    const bool stands = !network::IsFlat(object) &&
                        (placed.height_m > kFlatThing_m ||
                         std::any_of(outline.corners.begin(), outline.corners.end(),
                                     [](const network::Corner& corner) { return corner.height_m > kFlatThing_m; }));
    Polygon2 corners = OutlineCorners(road, placed, &outline, own);
    if (stands || !(Around(corners) <= kMaxPaintLength_m)) continue;
    bool framed = false;
    for (const network::ObjectBorder& border : object.borders) {
      if (border.outline != i) continue;
      const std::vector<std::size_t> along = CornersOf(object, border);
      LayFrame(corners, outline.closed, along, border.width_m, BorderColour(border.type), own, paint);
      framed = framed || along.empty();
      if (!framed) continue;
      // What it fills ends at its frame.
      Polygon2 inner;
      for (const FramePiece& piece : FrameOf(corners, outline.closed, {}, border.width_m))
        inner.push_back(piece.corners[3]);
      if (outline.closed) corners = inner;
    }
    const auto fill = FillColour(outline.fill);
    if (!fill || !outline.closed || corners.size() < 3) continue;
    std::vector<Vector3d> flat;
    for (const Vector2d& p : corners) flat.emplace_back(p.x(), p.y(), 0.0);
    double area = 0.0;
    for (std::size_t k = 1; k + 1 < flat.size(); ++k) area += (flat[k] - flat[0]).cross(flat[k + 1] - flat[0]).z();
    if (area < 0.0) std::reverse(flat.begin(), flat.end());
    for (const auto& ear : Ears(flat))
      Lay({Polygon2{flat[ear[0]].head<2>(), flat[ear[1]].head<2>(), flat[ear[2]].head<2>()}}, own, paint, *fill);
  }
}

void PaintObject(const network::Road& road, const network::Placed& placed, TilePaint& paint) {
  const network::Object& object = *placed.object;
  if (placed.s_m < 0.0 || placed.s_m > road.length_m()) return;
  PaintFlatOutlines(road, placed, paint);
  PaintMarks(road, placed, paint);
  const double along = road.axis().Evaluate(placed.s_m).heading_rad;
  const Colour colour = PaintColour(object.material.colour);
  if (object.type == "crosswalk" && object.subtype != "virtual") {
    const Spot spot = Spot::At(road, placed.s_m, placed.t_m, along);
    Lay(ZebraShape(OutlineOf(road, placed, spot)), spot, paint, colour);
  } else if (object.type == "roadMark") {
    const ArrowWays ways = WaysOf(object.subtype.empty() ? object.name : object.subtype);
    const bool turned = object.hdg_rad == 0.0 && object.orientation == "-";
    if (ways.any())
      PaintArrow(road, placed, ways, placed.heading_rad + (turned ? base::kPi : 0.0), placed.length_m, paint, colour);
  } else if (object.type == "parkingSpace" && object.marks.empty()) {
    PaintParkingPlace(road, placed, paint);
  }
}

}  // namespace

bool IsPaint(const network::Signal& signal) {
  return !signal.dynamic && (IsCrossing(signal) || IsLineAcross(signal) || ArrowOf(signal).any());
}

bool IsPaint(const network::Object& object) { return object.type == "crosswalk" || object.type == "roadMark"; }

void PaintThing(const network::Network& network, const network::Placed& placed, TilePaint& paint) {
  const network::Road& road = network.roads()[placed.road];
  if (placed.signal != nullptr)
    PaintSignal(road, placed, paint);
  else
    PaintObject(road, placed, paint);
}

}  // namespace rodeira::scene
