// SPDX-License-Identifier: Apache-2.0
#include "common/editor/lane_tools.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/core/base/constants.hpp"
#include "common/editor/offset.hpp"

namespace rodeira::editor {
namespace {

constexpr double kGap_m = 0.3;
constexpr double kNarrowest_m = 0.5, kWidest_m = 50.0;
const double kCosKink = std::cos(15.0 * base::kPi / 180.0);

struct Ends {
  std::int32_t lane = 0;
  Eigen::Vector2d begin_W, end_W, head_W, tail_W;
};

std::vector<Ends> EndsOf(const Document& document) {
  const traffic_map::NumberIndex curves(document.map.curves);
  std::vector<Ends> all;
  for (const auto& line : document.map.lanes) {
    if (!curves.Find(line.value.left.curve) || !curves.Find(line.value.right.curve)) continue;
    const traffic_map::Cubic middle = BordersOf(document, line.value)->Middle();
    all.push_back({line.value.id, middle.p_W[0], middle.p_W[3], middle.Tangent(0.0), middle.Tangent(1.0)});
  }
  return all;
}

bool Meet(const Ends& from, const Ends& to) {
  return from.lane != to.lane && (to.begin_W - from.end_W).norm() <= kGap_m && from.tail_W.dot(to.head_W) >= kCosKink;
}

}  // namespace

base::Result<Edit> LaneAlong(Document& document, const Points& middle_W, const LaneLook& look) {
  if (!(look.width_m >= kNarrowest_m && look.width_m <= kWidest_m))
    return base::WrongInput("edit.out_of_range", fmt::format("the lane is {} m wide; {} to {} was expected",
                                                             look.width_m, kNarrowest_m, kWidest_m));
  const traffic_map::Cubic middle{middle_W};
  if (middle.PolygonLength() < 0.1)
    return base::WrongInput("edit.too_short", "the lane has no length; a line of 0.1 m or more was expected");
  const std::int32_t first = NextNumber(document.map.curves);
  if (first > INT32_MAX - 2)
    return base::WrongInput("edit.no_numbers_left", "there are no numbers left for two curves");
  const auto left = CurveOf(first, Beside(middle, 0.5 * look.width_m).p_W),
             right = CurveOf(first + 1, Beside(middle, -0.5 * look.width_m).p_W);
  if (!left) return left.error();
  if (!right) return right.error();
  const traffic_map::Lane lane{
      NextNumber(document.map.lanes), {first, false, look.left}, {first + 1, false, look.right}, look.mode};
  Recorder recorder(document);
  recorder.Add(left.value());
  recorder.Add(right.value());
  recorder.Add(lane);
  return std::move(recorder).Finish(fmt::format("lane {} made", lane.id));
}

base::Result<Edit> LaneBeside(Document& document, std::int32_t number, bool on_left, bool same_way) {
  const auto at = Find(document.map.lanes, number);
  const auto borders = at ? BordersOf(document, document.map.lanes[*at].value) : std::nullopt;
  if (!borders)
    return base::WrongInput("edit.unknown_element",
                            fmt::format("lane {} does not exist with both of its curves", number));
  traffic_map::Lane old = document.map.lanes[*at].value;
  const double width_m = (borders->left.p_W[0] - borders->right.p_W[0]).norm();
  const traffic_map::Cubic& shared = on_left ? borders->left : borders->right;
  const auto outer = CurveOf(NextNumber(document.map.curves), Beside(shared, on_left ? width_m : -width_m).p_W);
  if (!outer) return outer.error();
  traffic_map::LaneSide& between = on_left ? old.left : old.right;
  const traffic_map::BorderType outside = between.type;
  between.type = same_way ? traffic_map::BorderType::kDashedSame : traffic_map::BorderType::kSingle;
  traffic_map::LaneSide inner_side = between, outer_side{outer.value().id, false, outside};
  if (!same_way) inner_side.inverted = !inner_side.inverted, outer_side.inverted = true;
  // Driven the same way, a lane on the left has the shared border on its right; driven against it, on its left.
  const bool inner_is_right = on_left == same_way;
  traffic_map::LaneMode mode = old.mode;
  if (!same_way && mode != traffic_map::LaneMode::kNone)
    mode = mode == traffic_map::LaneMode::kStart ? traffic_map::LaneMode::kEnd : traffic_map::LaneMode::kStart;
  const traffic_map::Lane lane{NextNumber(document.map.lanes), inner_is_right ? outer_side : inner_side,
                               inner_is_right ? inner_side : outer_side, mode};
  Recorder recorder(document);
  recorder.Add(outer.value());
  recorder.SetLane(*at, old);
  recorder.Add(lane);
  return std::move(recorder).Finish(fmt::format("lane {} made beside lane {}", lane.id, number));
}

Points CurveBetween(const Eigen::Vector2d& from_W, double from_rad, const Eigen::Vector2d& to_W, double to_rad) {
  const double turn = std::remainder(to_rad - from_rad, 2.0 * base::kPi), chord = (to_W - from_W).norm();
  double handle_m = chord / 3.0;
  if (std::abs(turn) > 1e-6 && std::abs(turn) < 0.9 * base::kPi)
    handle_m = 4.0 / 3.0 * std::tan(std::abs(turn) / 4.0) * chord / (2.0 * std::sin(std::abs(turn) / 2.0));
  const Eigen::Vector2d head(std::cos(from_rad), std::sin(from_rad)), tail(std::cos(to_rad), std::sin(to_rad));
  return {from_W, from_W + handle_m * head, to_W - handle_m * tail, to_W};
}

std::optional<LaneEnd> LaneEndNear(const Document& document, bool beginning, const Eigen::Vector2d& p_W,
                                   double radius_m) {
  std::optional<LaneEnd> found;
  double nearest = radius_m;
  for (const Ends& ends : EndsOf(document)) {
    const Eigen::Vector2d& p = beginning ? ends.begin_W : ends.end_W;
    const Eigen::Vector2d& along = beginning ? ends.head_W : ends.tail_W;
    const double distance = (p - p_W).norm();
    if (distance > nearest) continue;
    nearest = distance;
    found = LaneEnd{p, std::atan2(along.y(), along.x())};
  }
  return found;
}

Points MiddleBetween(const Document& document, const Eigen::Vector2d& from_W, const Eigen::Vector2d& to_W,
                     double radius_m) {
  const auto from = LaneEndNear(document, false, from_W, radius_m), to = LaneEndNear(document, true, to_W, radius_m);
  const Eigen::Vector2d a = from ? from->p_W : from_W, b = to ? to->p_W : to_W;
  const double chord_rad = std::atan2(b.y() - a.y(), b.x() - a.x());
  // An arc turns by the same angle from its beginning to the chord as from the chord to its end.
  const double head = from ? from->heading_rad : to ? 2.0 * chord_rad - to->heading_rad : chord_rad;
  const double tail = to ? to->heading_rad : 2.0 * chord_rad - head;
  return CurveBetween(a, head, b, tail);
}

std::vector<std::pair<std::int32_t, std::int32_t>> MissingConnections(const Document& document) {
  std::vector<Ends> by_begin = EndsOf(document);
  const std::vector<Ends> all = by_begin;
  std::sort(by_begin.begin(), by_begin.end(),
            [](const Ends& a, const Ends& b) { return a.begin_W.x() < b.begin_W.x(); });
  std::set<std::pair<std::int32_t, std::int32_t>> missing;
  for (const Ends& from : all) {
    auto to = std::lower_bound(by_begin.begin(), by_begin.end(), from.end_W.x() - kGap_m,
                               [](const Ends& a, double x) { return a.begin_W.x() < x; });
    for (; to != by_begin.end() && to->begin_W.x() <= from.end_W.x() + kGap_m; ++to) {
      if (Meet(from, *to)) missing.insert({from.lane, to->lane});
    }
  }
  for (const auto& line : document.map.connections) missing.erase({line.value.from, line.value.to});
  return {missing.begin(), missing.end()};
}

std::vector<std::pair<std::int32_t, std::int32_t>> MissingConnections(const Document& document, std::int32_t lane) {
  auto missing = MissingConnections(document);
  std::erase_if(missing, [lane](const auto& pair) { return pair.first != lane && pair.second != lane; });
  return missing;
}

base::Result<Edit> Connect(Document& document, const std::vector<std::pair<std::int32_t, std::int32_t>>& connections) {
  for (const auto& [from, to] : connections) {
    if (from == to || !Find(document.map.lanes, from) || !Find(document.map.lanes, to) ||
        Find(document.map.connections, from, to))
      return base::WrongInput("edit.wrong_connection", fmt::format("lane {} cannot be connected to lane {}", from, to));
  }
  if (connections.empty())
    return base::WrongInput("edit.wrong_connection", "no two lanes meet that are not connected yet");
  Recorder recorder(document);
  for (const auto& [from, to] : connections) recorder.Add(traffic_map::Connection{from, to, false, {}});
  return std::move(recorder).Finish(
      connections.size() == 1 ? fmt::format("connection {} to {} made", connections[0].first, connections[0].second)
                              : fmt::format("{} connections made", connections.size()));
}

}  // namespace rodeira::editor
