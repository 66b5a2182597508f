// SPDX-License-Identifier: Apache-2.0
#include "nodes/editor/map_painter.hpp"

#include <SDL_opengl.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "common/editor/lane_tools.hpp"
#include "common/view/scene/road_markings/stencils.hpp"
#include "common/world/traffic_map/border_paint.hpp"
#include "common/world/traffic_map/lane_shape.hpp"

namespace rodeira::nodes {
namespace {

using traffic_map::BorderType;

constexpr Colour kStart = {70, 190, 90, 110}, kEnd = {210, 80, 70, 110}, kPlain = {90, 130, 190, 100};
constexpr Colour kLine = {245, 245, 245, 255}, kUnused = {255, 170, 60, 255}, kHandle = {255, 220, 90, 255},
                 kArm = {255, 220, 90, 120};
constexpr Colour kLink = {120, 220, 255, 200}, kStop = {235, 40, 40, 255}, kGiveWay = {255, 150, 40, 255},
                 kPaint = {255, 255, 255, 255}, kLight = {80, 230, 110, 255};
constexpr Colour kChosen = {255, 235, 60, 255}, kProposed = {255, 120, 255, 255};

const Colour& ColourOf(traffic_map::LaneMode mode) {
  if (mode == traffic_map::LaneMode::kStart) return kStart;
  return mode == traffic_map::LaneMode::kEnd ? kEnd : kPlain;
}

bool IsDashed(BorderType type) {
  return type != BorderType::kNone && type != BorderType::kBoundary && type != BorderType::kSingle;
}

}  // namespace

void MapPainter::Begin(const editor::Viewport& view, int left_px, int below_px) {
  shapes_.metres_per_px = view.metres_per_px;
  // Far from the origin a float would show steps: what is drawn is counted from near the middle of the view.
  if ((view.middle_W - shapes_.origin_W).cwiseAbs().maxCoeff() > 1e5 * view.metres_per_px)
    shapes_.origin_W = view.middle_W, built_.reset();
  glViewport(left_px, below_px, static_cast<int>(view.width_px), static_cast<int>(view.height_px));
  const double half_x = 0.5 * view.width_m(), half_y = 0.5 * view.height_px * view.metres_per_px;
  const Eigen::Vector2d middle = view.middle_W - shapes_.origin_W;
  glMatrixMode(GL_PROJECTION);
  glLoadIdentity();
  glOrtho(middle.x() - half_x, middle.x() + half_x, middle.y() - half_y, middle.y() + half_y, -1.0, 1.0);
  glMatrixMode(GL_MODELVIEW);
  glLoadIdentity();
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_TEXTURE_2D);
  glEnable(GL_BLEND);
  glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
}

void MapPainter::Build(const editor::Document& document) {
  for (Vertices* vertices : {&grounds_, &paint_, &curves_, &links_, &bars_, &handle_lines_, &handles_})
    vertices->clear();
  const traffic_map::NumberIndex curves(document.map.curves), lanes(document.map.lanes);
  std::vector<bool> used(document.map.curves.size(), false), dashed(document.map.curves.size(), false);
  std::vector<std::optional<traffic_map::Cubic>> middles(document.map.lanes.size());
  for (std::size_t i = 0; i < document.map.lanes.size(); ++i) {
    const traffic_map::Lane& lane = document.map.lanes[i].value;
    const auto left = curves.Find(lane.left.curve), right = curves.Find(lane.right.curve);
    if (left) used[*left] = true, dashed[*left] = IsDashed(lane.left.type);
    if (right) used[*right] = true, dashed[*right] = IsDashed(lane.right.type);
    if (!left || !right) continue;
    const editor::Borders borders{traffic_map::BorderOf(lane.left, document.map.curves[*left].value, {}).plan,
                                  traffic_map::BorderOf(lane.right, document.map.curves[*right].value, {}).plan};
    middles[i] = borders.Middle();
    shapes_.AddGround(grounds_, borders, ColourOf(lane.mode));
  }
  for (std::size_t i = 0; i < document.map.curves.size(); ++i) {
    const traffic_map::Cubic cubic = editor::CubicOf(document.map.curves[i].value);
    shapes_.AddCurve(curves_, cubic, used[i] ? kLine : kUnused, dashed[i]);
    shapes_.AddLine(handle_lines_, cubic.p_W[0], cubic.p_W[1], kArm);
    shapes_.AddLine(handle_lines_, cubic.p_W[3], cubic.p_W[2], kArm);
    for (const auto& p : cubic.p_W) handles_.push_back(shapes_.At(p, kHandle));
  }
  for (const auto& line : document.map.connections) {
    const auto from = lanes.Find(line.value.from), to = lanes.Find(line.value.to);
    if (!from || !to || !middles[*from] || !middles[*to]) continue;
    shapes_.AddLink(links_, *middles[*from], *middles[*to], line.value.stop ? kStop : kLink);
  }
  AddBars(document, lanes);
  AddLinesAcross(document, lanes);
}

// The white paint where one stops or gives way, as large as it is on the road and as the view draws it.
void MapPainter::AddLinesAcross(const editor::Document& document, const traffic_map::NumberIndex& lanes) {
  const auto add = [&](std::int32_t number, double before_end_m, bool stops) {
    const auto at = lanes.Find(number);
    const auto borders = at ? editor::BordersOf(document, document.map.lanes[*at].value) : std::nullopt;
    if (!borders) return;
    const traffic_map::LaneShape lane({borders->left, {}}, {borders->right, {}});
    const traffic_map::LanePoint place = lane.At(lane.length_m() - before_end_m - traffic_map::kLineBefore_m);
    for (const auto& polygon :
         stops ? scene::StopLineShape(place.right_m, place.left_m) : scene::GiveWayShape(place.right_m, place.left_m))
      shapes_.AddPolygon(paint_, polygon, place.p_W, place.tangent_W, kPaint);
  };
  for (const auto& line : document.map.connections) {
    if (line.value.stop) add(line.value.from, 0.0, true);
  }
  for (const traffic_map::LaneSign& sign : document.companion.signs) {
    if (sign.kind == traffic_map::SignKind::kStop || sign.kind == traffic_map::SignKind::kGiveWay)
      add(sign.lane, sign.before_end_m, sign.kind == traffic_map::SignKind::kStop);
  }
  for (const lights::LightPlan& plan : document.companion.lights) {
    for (const std::string& name : plan.Names()) {
      std::int32_t number = 0;
      if (std::from_chars(name.data(), name.data() + name.size(), number).ec == std::errc()) add(number, 0.0, true);
    }
  }
}

// Lines at the ends of lanes: where a STOP or give-way sign stands, or a light.
void MapPainter::AddBars(const editor::Document& document, const traffic_map::NumberIndex& lanes) {
  const auto add = [&](std::int32_t number, const Colour& colour) {
    const auto at = lanes.Find(number);
    const auto borders = at ? editor::BordersOf(document, document.map.lanes[*at].value) : std::nullopt;
    if (borders) shapes_.AddLine(bars_, borders->left.p_W[3], borders->right.p_W[3], colour);
  };
  for (const auto& line : document.map.connections) {
    if (line.value.stop) add(line.value.from, kStop);
  }
  for (const traffic_map::LaneSign& sign : document.companion.signs) {
    if (sign.kind == traffic_map::SignKind::kStop) add(sign.lane, kStop);
    if (sign.kind == traffic_map::SignKind::kGiveWay) add(sign.lane, kGiveWay);
  }
  for (const lights::LightPlan& plan : document.companion.lights) {
    for (const std::string& name : plan.Names()) {
      std::int32_t number = 0;
      if (std::from_chars(name.data(), name.data() + name.size(), number).ec == std::errc()) add(number, kLight);
    }
  }
}

void MapPainter::DrawMap(const editor::Document& document, std::uint64_t state, bool handles) {
  const std::pair wanted(state, static_cast<int>(std::floor(std::log2(shapes_.metres_per_px))));
  if (built_ != wanted) Build(document);
  built_ = wanted;
  DrawVertices(grounds_, GL_TRIANGLES);
  DrawVertices(paint_, GL_TRIANGLES);
  glLineWidth(1.0f);
  DrawVertices(curves_, GL_LINES);
  DrawVertices(links_, GL_LINES);
  glLineWidth(3.0f);
  DrawVertices(bars_, GL_LINES);
  glLineWidth(1.0f);
  if (!handles) return;
  DrawVertices(handle_lines_, GL_LINES);
  glPointSize(shapes_.metres_per_px < 0.5 ? 7.0f : 3.0f);
  DrawVertices(handles_, GL_POINTS);
}

void MapPainter::DrawChosen(const editor::Document& document, const editor::Selection& selection) {
  Vertices lines, points;
  for (const std::int32_t number : selection.curves) {
    if (const auto at = editor::Find(document.map.curves, number))
      shapes_.AddCurve(lines, editor::CubicOf(document.map.curves[*at].value), kChosen);
  }
  for (const std::int32_t number : selection.lanes) {
    const auto at = editor::Find(document.map.lanes, number);
    const auto borders = at ? editor::BordersOf(document, document.map.lanes[*at].value) : std::nullopt;
    if (borders) shapes_.AddCurve(lines, borders->left, kChosen), shapes_.AddCurve(lines, borders->right, kChosen);
  }
  for (const auto& [from, to] : selection.connections) {
    const auto a = editor::Find(document.map.lanes, from), b = editor::Find(document.map.lanes, to);
    const auto from_borders = a ? editor::BordersOf(document, document.map.lanes[*a].value) : std::nullopt;
    const auto to_borders = b ? editor::BordersOf(document, document.map.lanes[*b].value) : std::nullopt;
    if (from_borders && to_borders) shapes_.AddLink(lines, from_borders->Middle(), to_borders->Middle(), kChosen);
  }
  for (const editor::Handle& handle : selection.handles) {
    if (const auto at = editor::Find(document.map.curves, handle.curve))
      points.push_back(shapes_.At(
          editor::CubicOf(document.map.curves[*at].value).p_W[static_cast<std::size_t>(handle.index)], kChosen));
  }
  glLineWidth(3.0f);
  DrawVertices(lines, GL_LINES);
  glLineWidth(1.0f);
  glPointSize(9.0f);
  DrawVertices(points, GL_POINTS);
}

void MapPainter::DrawProposals(const editor::Document& document, std::uint64_t state) {
  if (proposed_state_ != state) proposals_ = editor::MissingConnections(document);
  proposed_state_ = state;
  Vertices lines;
  for (const auto& [from, to] : proposals_) {
    const auto a = editor::Find(document.map.lanes, from), b = editor::Find(document.map.lanes, to);
    shapes_.AddLink(lines, editor::BordersOf(document, document.map.lanes[*a].value)->Middle(),
                    editor::BordersOf(document, document.map.lanes[*b].value)->Middle(), kProposed);
  }
  DrawVertices(lines, GL_LINES);
}

}  // namespace rodeira::nodes
