#include "nodes/editor/map_painter.hpp"

#include <SDL_opengl.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "common/editor/lane_tools.hpp"

namespace rodeira::desk {
namespace {

using map::BorderType;

constexpr int kMostPieces = 24;
constexpr double kPiece_px = 12.0;
constexpr Colour kStart = {70, 190, 90, 110}, kEnd = {210, 80, 70, 110}, kPlain = {90, 130, 190, 100};
constexpr Colour kLine = {245, 245, 245, 255}, kUnused = {255, 170, 60, 255}, kHandle = {255, 220, 90, 255}, kArm = {255, 220, 90, 120};
constexpr Colour kLink = {120, 220, 255, 200}, kStop = {235, 40, 40, 255}, kGiveWay = {255, 255, 255, 255}, kLight = {80, 230, 110, 255};
constexpr Colour kChosen = {255, 235, 60, 255}, kProposed = {255, 120, 255, 255};

const Colour& ColourOf(map::LaneMode mode) {
  if (mode == map::LaneMode::kStart) return kStart;
  return mode == map::LaneMode::kEnd ? kEnd : kPlain;
}

bool IsDashed(BorderType type) { return type != BorderType::kNone && type != BorderType::kBoundary && type != BorderType::kSingle; }

}  // namespace

void MapPainter::Begin(const editor::Viewport& view, int left_px, int below_px) {
  view_ = view;
  // Far from the origin a float would show steps: what is drawn is counted from near the middle of the view.
  if ((view.middle_W - origin_W_).cwiseAbs().maxCoeff() > 1e5 * view.metres_per_px) origin_W_ = view.middle_W, built_.reset();
  glViewport(left_px, below_px, static_cast<int>(view.width_px), static_cast<int>(view.height_px));
  const double half_x = 0.5 * view.width_m(), half_y = 0.5 * view.height_px * view.metres_per_px;
  const Eigen::Vector2d middle = view.middle_W - origin_W_;
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

int MapPainter::PiecesOf(const map::Cubic& cubic) const {
  return std::clamp(static_cast<int>(cubic.PolygonLength() / view_.metres_per_px / kPiece_px), 2, kMostPieces);
}

MapPainter::Vertex MapPainter::At(const Eigen::Vector2d& p_W, const Colour& colour) const {
  return {static_cast<float>(p_W.x() - origin_W_.x()), static_cast<float>(p_W.y() - origin_W_.y()), colour};
}

void MapPainter::AddLine(Vertices& lines, const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Colour& colour) const {
  lines.push_back(At(a, colour));
  lines.push_back(At(b, colour));
}

void MapPainter::AddGround(Vertices& triangles, const editor::Borders& borders, const Colour& colour) const {
  const int pieces = std::max(PiecesOf(borders.left), PiecesOf(borders.right));
  Eigen::Vector2d left = borders.left.At(0.0), right = borders.right.At(0.0);
  for (int i = 1; i <= pieces; ++i) {
    const double t = static_cast<double>(i) / pieces;
    const Eigen::Vector2d next_left = borders.left.At(t), next_right = borders.right.At(t);
    for (const auto& p : {left, right, next_right, left, next_right, next_left}) triangles.push_back(At(p, colour));
    left = next_left, right = next_right;
  }
}

void MapPainter::AddCurve(Vertices& lines, const map::Cubic& cubic, const Colour& colour, bool dashed) const {
  const int pieces = dashed ? kMostPieces : PiecesOf(cubic);
  Eigen::Vector2d before = cubic.At(0.0);
  for (int i = 1; i <= pieces; ++i) {
    const Eigen::Vector2d next = cubic.At(static_cast<double>(i) / pieces);
    if (!dashed || i % 2 == 1) AddLine(lines, before, next, colour);
    before = next;
  }
}

void MapPainter::AddLink(Vertices& lines, const map::Cubic& from, const map::Cubic& to, const Colour& colour) const {
  const Eigen::Vector2d a = from.At(0.85), b = from.At(1.0), c = to.At(0.0), d = to.At(0.15);
  AddLine(lines, a, b, colour);
  AddLine(lines, b, c, colour);
  AddLine(lines, c, d, colour);
  const Eigen::Vector2d ahead = (d - c).norm() > 0.0 ? Eigen::Vector2d((d - c).normalized()) : Eigen::Vector2d::UnitX();
  const Eigen::Vector2d across(-ahead.y(), ahead.x());
  AddLine(lines, d, d - 1.2 * ahead + 0.6 * across, colour);
  AddLine(lines, d, d - 1.2 * ahead - 0.6 * across, colour);
}

void MapPainter::AddRectangle(Vertices& triangles, const Eigen::Vector2d& middle, const Eigen::Vector2d& ahead, double half_length_m, double half_width_m, const Colour& colour) const {
  const Eigen::Vector2d along = half_length_m * ahead, across = half_width_m * Eigen::Vector2d(-ahead.y(), ahead.x());
  const Eigen::Vector2d a = middle + along + across, b = middle + along - across, c = middle - along - across, d = middle - along + across;
  for (const auto& p : {a, b, c, a, c, d}) triangles.push_back(At(p, colour));
}

void MapPainter::Build(const editor::Document& document) {
  for (Vertices* vertices : {&grounds_, &curves_, &links_, &bars_, &handle_lines_, &handles_}) vertices->clear();
  const map::NumberIndex curves(document.map.curves), lanes(document.map.lanes);
  std::vector<bool> used(document.map.curves.size(), false), dashed(document.map.curves.size(), false);
  std::vector<std::optional<map::Cubic>> middles(document.map.lanes.size());
  for (std::size_t i = 0; i < document.map.lanes.size(); ++i) {
    const map::Lane& lane = document.map.lanes[i].value;
    const auto left = curves.Find(lane.left.curve), right = curves.Find(lane.right.curve);
    if (left) used[*left] = true, dashed[*left] = IsDashed(lane.left.type);
    if (right) used[*right] = true, dashed[*right] = IsDashed(lane.right.type);
    if (!left || !right) continue;
    const editor::Borders borders{map::BorderOf(lane.left, document.map.curves[*left].value, {}).plan, map::BorderOf(lane.right, document.map.curves[*right].value, {}).plan};
    middles[i] = borders.Middle();
    AddGround(grounds_, borders, ColourOf(lane.mode));
  }
  for (std::size_t i = 0; i < document.map.curves.size(); ++i) {
    const map::Cubic cubic = editor::CubicOf(document.map.curves[i].value);
    AddCurve(curves_, cubic, used[i] ? kLine : kUnused, dashed[i]);
    AddLine(handle_lines_, cubic.p_W[0], cubic.p_W[1], kArm);
    AddLine(handle_lines_, cubic.p_W[3], cubic.p_W[2], kArm);
    for (const auto& p : cubic.p_W) handles_.push_back(At(p, kHandle));
  }
  for (const auto& line : document.map.connections) {
    const auto from = lanes.Find(line.value.from), to = lanes.Find(line.value.to);
    if (!from || !to || !middles[*from] || !middles[*to]) continue;
    AddLink(links_, *middles[*from], *middles[*to], line.value.stop ? kStop : kLink);
  }
  AddBars(document, lanes);
}

// Lines at the ends of lanes: where a STOP or give-way sign stands, or a light.
void MapPainter::AddBars(const editor::Document& document, const map::NumberIndex& lanes) {
  const auto add = [&](std::int32_t number, const Colour& colour) {
    const auto at = lanes.Find(number);
    const auto borders = at ? editor::BordersOf(document, document.map.lanes[*at].value) : std::nullopt;
    if (borders) AddLine(bars_, borders->left.p_W[3], borders->right.p_W[3], colour);
  };
  for (const auto& line : document.map.connections) {
    if (line.value.stop) add(line.value.from, kStop);
  }
  for (const map::LaneSign& sign : document.companion.signs) {
    if (sign.kind == map::SignKind::kStop) add(sign.lane, kStop);
    if (sign.kind == map::SignKind::kGiveWay) add(sign.lane, kGiveWay);
  }
  for (const lights::LightPlan& plan : document.companion.lights) {
    for (const std::string& name : plan.Names()) {
      std::int32_t number = 0;
      if (std::from_chars(name.data(), name.data() + name.size(), number).ec == std::errc()) add(number, kLight);
    }
  }
}

void MapPainter::Draw(const Vertices& vertices, unsigned mode) {
  if (vertices.empty()) return;
  glEnableClientState(GL_VERTEX_ARRAY);
  glEnableClientState(GL_COLOR_ARRAY);
  glVertexPointer(2, GL_FLOAT, sizeof(Vertex), &vertices[0].x);
  glColorPointer(4, GL_UNSIGNED_BYTE, sizeof(Vertex), vertices[0].colour.data());
  glDrawArrays(mode, 0, static_cast<GLsizei>(vertices.size()));
  glDisableClientState(GL_COLOR_ARRAY);
  glDisableClientState(GL_VERTEX_ARRAY);
}

void MapPainter::DrawMap(const editor::Document& document, std::uint64_t state, bool handles) {
  const std::pair wanted(state, static_cast<int>(std::floor(std::log2(view_.metres_per_px))));
  if (built_ != wanted) Build(document);
  built_ = wanted;
  Draw(grounds_, GL_TRIANGLES);
  glLineWidth(1.0f);
  Draw(curves_, GL_LINES);
  Draw(links_, GL_LINES);
  glLineWidth(3.0f);
  Draw(bars_, GL_LINES);
  glLineWidth(1.0f);
  if (!handles) return;
  Draw(handle_lines_, GL_LINES);
  glPointSize(view_.metres_per_px < 0.5 ? 7.0f : 3.0f);
  Draw(handles_, GL_POINTS);
}

void MapPainter::DrawChosen(const editor::Document& document, const editor::Selection& selection) {
  Vertices lines, points;
  for (const std::int32_t number : selection.curves) {
    if (const auto at = editor::Find(document.map.curves, number)) AddCurve(lines, editor::CubicOf(document.map.curves[*at].value), kChosen);
  }
  for (const std::int32_t number : selection.lanes) {
    const auto at = editor::Find(document.map.lanes, number);
    const auto borders = at ? editor::BordersOf(document, document.map.lanes[*at].value) : std::nullopt;
    if (borders) AddCurve(lines, borders->left, kChosen), AddCurve(lines, borders->right, kChosen);
  }
  for (const auto& [from, to] : selection.connections) {
    const auto a = editor::Find(document.map.lanes, from), b = editor::Find(document.map.lanes, to);
    const auto from_borders = a ? editor::BordersOf(document, document.map.lanes[*a].value) : std::nullopt;
    const auto to_borders = b ? editor::BordersOf(document, document.map.lanes[*b].value) : std::nullopt;
    if (from_borders && to_borders) AddLink(lines, from_borders->Middle(), to_borders->Middle(), kChosen);
  }
  for (const editor::Handle& handle : selection.handles) {
    if (const auto at = editor::Find(document.map.curves, handle.curve))
      points.push_back(At(editor::CubicOf(document.map.curves[*at].value).p_W[static_cast<std::size_t>(handle.index)], kChosen));
  }
  glLineWidth(3.0f);
  Draw(lines, GL_LINES);
  glLineWidth(1.0f);
  glPointSize(9.0f);
  Draw(points, GL_POINTS);
}

void MapPainter::DrawProposals(const editor::Document& document, std::uint64_t state) {
  if (proposed_state_ != state) proposals_ = editor::MissingConnections(document);
  proposed_state_ = state;
  Vertices lines;
  for (const auto& [from, to] : proposals_) {
    const auto a = editor::Find(document.map.lanes, from), b = editor::Find(document.map.lanes, to);
    AddLink(lines, editor::BordersOf(document, document.map.lanes[*a].value)->Middle(), editor::BordersOf(document, document.map.lanes[*b].value)->Middle(), kProposed);
  }
  Draw(lines, GL_LINES);
}

void MapPainter::DrawHeat(const std::vector<editor::HeatPatch>& patches) {
  constexpr std::uint8_t kOpacity = 178;  // 70 parts of 100 over 30 of the ground
  Vertices triangles;
  for (const editor::HeatPatch& patch : patches) {
    const auto rgb = editor::Preview::ColourOf(patch.share);
    AddRectangle(triangles, patch.p_W, patch.ahead_W, 0.5 * patch.length_m, 0.5 * patch.width_m, {rgb[0], rgb[1], rgb[2], kOpacity});
  }
  Draw(triangles, GL_TRIANGLES);
}

void MapPainter::DrawVehicles(const traffic::TrafficModel& model) {
  Vertices triangles;
  for (const traffic::AgentPose& pose : model.poses()) {
    const traffic::AgentTraits& traits = model.traits(pose.id);
    const Eigen::Vector2d ahead = (pose.q_WB * Eigen::Vector3d::UnitX()).head<2>().normalized(), middle = pose.p_WB_W.head<2>();
    const Colour paint = {static_cast<std::uint8_t>(traits.colour_rgb >> 16), static_cast<std::uint8_t>(traits.colour_rgb >> 8), static_cast<std::uint8_t>(traits.colour_rgb), 255};
    AddRectangle(triangles, middle, ahead, 0.5 * traits.length_m + 0.15, 0.5 * traits.width_m + 0.15, {10, 10, 10, 255});
    AddRectangle(triangles, middle, ahead, 0.5 * traits.length_m, 0.5 * traits.width_m, paint);
    AddRectangle(triangles, middle + 0.15 * traits.length_m * ahead, ahead, 0.12 * traits.length_m, 0.4 * traits.width_m, {30, 40, 50, 255});
  }
  Draw(triangles, GL_TRIANGLES);
}

}  // namespace rodeira::desk
