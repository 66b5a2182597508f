// SPDX-License-Identifier: Apache-2.0
#include "common/view/scene/road_markings/object_marks.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "common/view/scene/road_markings/spot.hpp"

namespace rodeira::scene {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kMaxStrokes = 1e4;
constexpr double kMaxPaintWidth_m = 10.0;  // a wider one is no line of paint

const network::Corner& CornerOf(const network::Object& object, const std::string& id) {
  const auto& corners = object.outlines.front().corners;
  return *std::find_if(corners.begin(), corners.end(), [&](const network::Corner& corner) { return corner.id == id; });
}

// From its beginning to its end, in the object's own plane.
std::vector<Vector2d> LineOf(const network::Road& road, const network::Object& object, const network::Placed& placed,
                             const network::ObjectMark& mark, const Spot& own) {
  std::vector<Vector2d> line;
  for (const std::string& id : mark.corners) {
    const network::Corner& corner = CornerOf(object, id);
    line.push_back(corner.local ? Vector2d(corner.first_m, corner.second_m)
                                : own.ToLocal(road.Surface(corner.first_m, corner.second_m).p_W.head<2>()));
  }
  if (!line.empty()) return line;
  const double ahead = 0.5 * placed.length_m, left = 0.5 * placed.width_m;
  if (mark.side == "left") return {{-ahead, left}, {ahead, left}};
  if (mark.side == "right") return {{-ahead, -left}, {ahead, -left}};
  if (mark.side == "front") return {{ahead, -left}, {ahead, left}};
  return {{-ahead, -left}, {-ahead, left}};
}

// What of the line lies between two ways along it.
void PaintStroke(const std::vector<Vector2d>& line, double from_m, double to_m, double width_m, Colour colour,
                 const Spot& own, TilePaint& paint) {
  double begin = 0.0;
  for (std::size_t i = 1; i < line.size(); ++i) {
    const Vector2d way = line[i] - line[i - 1];
    const double length = way.norm(), low = std::max(from_m - begin, 0.0), high = std::min(to_m - begin, length);
    begin += length;
    if (!(high > low)) continue;
    const Vector2d along = way / length, half = 0.5 * width_m * Vector2d(-along.y(), along.x());
    const Vector2d a = line[i - 1] + low * along, b = line[i - 1] + high * along;
    AddPaint({{own.ToWorld(a - half), own.ToWorld(b - half), own.ToWorld(b + half), own.ToWorld(a + half)}, colour},
             paint);
  }
}

}  // namespace

void PaintMarks(const network::Road& road, const network::Placed& placed, TilePaint& paint) {
  const network::Object& object = *placed.object;
  if (object.marks.empty()) return;
  const Spot own = Spot::At(road, placed.s_m, placed.t_m, placed.heading_rad);
  for (const network::ObjectMark& mark : object.marks) {
    if (!(mark.width_m <= kMaxPaintWidth_m)) continue;
    const std::vector<Vector2d> line = LineOf(road, object, placed, mark, own);
    double length = 0.0;
    for (std::size_t i = 1; i < line.size(); ++i) length += (line[i] - line[i - 1]).norm();
    if (!(length <= kMaxPaintLength_m)) continue;
    const double end = length - mark.stop_offset_m;
    const bool broken = mark.gap_m > 0.0 && mark.stroke_m > 0.0 && length / (mark.stroke_m + mark.gap_m) < kMaxStrokes;
    const double stroke = broken ? mark.stroke_m : length, period = broken ? mark.stroke_m + mark.gap_m : length + 1.0;
    for (double k = 0.0; mark.start_offset_m + k * period < end; k += 1.0) {
      const double from = mark.start_offset_m + k * period;
      PaintStroke(line, from, std::min(from + stroke, end), mark.width_m, PaintColour(mark.colour), own, paint);
    }
  }
}

}  // namespace rodeira::scene
