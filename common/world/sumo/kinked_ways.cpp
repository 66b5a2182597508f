// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/core/geometry/angle.hpp"
#include "common/world/sumo/lane_joints.hpp"
#include "common/world/sumo/road_edges.hpp"
#include "common/world/sumo/signals.hpp"

namespace rodeira::sumo {
namespace {

constexpr double kKink_rad = 0.35;
constexpr double kTightest_m = 4.5;

struct Pose {
  Eigen::Vector2d p;
  double heading_rad = 0.0;

  Eigen::Vector2d ahead() const { return {std::cos(heading_rad), std::sin(heading_rad)}; }
};

std::optional<Pose> BeginOf(const pugi::xml_node& road) {
  const pugi::xml_node first = road.child("planView").child("geometry");
  if (!first) return std::nullopt;
  return Pose{{first.attribute("x").as_double(), first.attribute("y").as_double()}, first.attribute("hdg").as_double()};
}

// netconvert writes lines and normalized cubics.
std::optional<Pose> EndOf(const pugi::xml_node& road) {
  const pugi::xml_node last = road.child("planView").last_child();
  if (!last) return std::nullopt;
  const auto of = [&](const char* name) { return last.attribute(name).as_double(); };
  Pose pose{{of("x"), of("y")}, of("hdg")};
  if (last.child("line")) {
    pose.p += of("length") * pose.ahead();
    return pose;
  }
  const pugi::xml_node cubic = last.child("paramPoly3");
  if (!cubic || std::string_view(cubic.attribute("pRange").value()) != "normalized") return std::nullopt;
  const auto at = [&](const char* name) { return cubic.attribute(name).as_double(); };
  const Eigen::Vector2d ahead = pose.ahead(), left(-ahead.y(), ahead.x());
  pose.p += (at("aU") + at("bU") + at("cU") + at("dU")) * ahead + (at("aV") + at("bV") + at("cV") + at("dV")) * left;
  pose.heading_rad +=
      std::atan2(at("bV") + 2.0 * at("cV") + 3.0 * at("dV"), at("bU") + 2.0 * at("cU") + 3.0 * at("dU"));
  return pose;
}

// A cubic from pose to pose, near to the arc that turns as far.
struct Bend {
  Eigen::Vector2d c1, c2, c3;  // of p, p^2 and p^3, in the first pose's frame
  double length_m = 0.0;
  double radius_m = 0.0;  // of the arc; positive: to the left
};

Bend BendOf(const Pose& from, const Pose& to) {
  const Eigen::Vector2d way = to.p - from.p;
  const double chord_m = way.norm(), direction = std::atan2(way.y(), way.x());
  const double turn =
      geometry::WrapAngle(direction - from.heading_rad) + geometry::WrapAngle(to.heading_rad - direction);
  const double angle = std::clamp(std::fabs(turn), 1e-3, 1.9 * geometry::kPi);
  const double handle_m = 2.0 / 3.0 * std::tan(0.25 * angle) / std::sin(0.5 * angle) * chord_m;
  const Eigen::Vector2d ahead = from.ahead(), left(-ahead.y(), ahead.x());
  const auto local = [&](const Eigen::Vector2d& p) {
    return Eigen::Vector2d((p - from.p).dot(ahead), (p - from.p).dot(left));
  };
  const Eigen::Vector2d p1(handle_m, 0.0), p2 = local(to.p - handle_m * to.ahead()), p3 = local(to.p);
  Bend bend{3.0 * p1, 3.0 * (p2 - 2.0 * p1), p3 - 3.0 * p2 + 3.0 * p1};
  constexpr int kPieces = 200;  // Simpson's rule: a micrometre
  const auto speed = [&](double p) { return (bend.c1 + 2.0 * p * bend.c2 + 3.0 * p * p * bend.c3).norm(); };
  for (int i = 0; i < kPieces; ++i) {
    const double p = static_cast<double>(i) / kPieces, step = 1.0 / kPieces;
    bend.length_m += step / 6.0 * (speed(p) + 4.0 * speed(p + 0.5 * step) + speed(p + step));
  }
  bend.radius_m = std::copysign(0.5 * chord_m / std::sin(0.5 * angle), turn);
  return bend;
}

// Of the middle of the lane on which a car turns the tightest. All lanes lie to the right.
double TightestRadius(const pugi::xml_node& road, double radius_m) {
  double tightest_m = std::fabs(radius_m) + 1e3;
  for (const pugi::xml_node& lane : RightLanes(road)) {
    const double middle_m = RightEdgeOf(road, lane.attribute("id").as_int()) - 0.5 * WidthOf(lane);
    tightest_m = std::min(tightest_m, radius_m > 0.0 ? radius_m + middle_m : -radius_m - middle_m);
  }
  return tightest_m;
}

// Where the left edge of a lane of `road` lies at a pose of its reference line. Nothing: it has no such lane.
std::optional<Eigen::Vector2d> LeftEdge(const pugi::xml_node& road, const Pose& pose, int lane) {
  for (const pugi::xml_node& each : RightLanes(road)) {
    if (each.attribute("id").as_int() != lane) continue;
    const Eigen::Vector2d ahead = pose.ahead(), right(ahead.y(), -ahead.x());
    return Eigen::Vector2d(pose.p + (RightEdgeOf(road, lane) - WidthOf(each)) * right);
  }
  return std::nullopt;
}

// Whether the leftmost lane of a way begins where the linked lane ends, and ends where the next one begins.
bool Meets(const pugi::xml_node& way, const Pose& begin, const Pose& end, const pugi::xml_node& before, const Pose& in,
           const pugi::xml_node& behind, const Pose& out) {
  constexpr double kMeets_m = 0.1;
  const std::vector<pugi::xml_node> lanes = RightLanes(way);
  if (lanes.empty()) return false;
  const pugi::xml_node link = lanes.back().child("link");
  const auto from = LeftEdge(before, in, link.child("predecessor").attribute("id").as_int());
  const auto to = LeftEdge(behind, out, link.child("successor").attribute("id").as_int());
  return from && to && (*from - begin.p).norm() <= kMeets_m && (*to - end.p).norm() <= kMeets_m;
}

void Draw(pugi::xml_node road, const Pose& from, const Bend& bend) {
  pugi::xml_node plan = road.child("planView");
  while (plan.remove_child("geometry")) {
  }
  const auto text = [](double number) { return fmt::format("{:.17g}", number); };
  pugi::xml_node geometry = plan.append_child("geometry");
  const auto put = [](pugi::xml_node node, const char* name, const std::string& value) {
    node.append_attribute(name) = value.c_str();
  };
  put(geometry, "s", "0");
  put(geometry, "x", text(from.p.x()));
  put(geometry, "y", text(from.p.y()));
  put(geometry, "hdg", text(from.heading_rad));
  put(geometry, "length", text(bend.length_m));
  pugi::xml_node cubic = geometry.append_child("paramPoly3");
  const std::array<std::pair<const char*, double>, 8> numbers = {{{"aU", 0.0},
                                                                  {"bU", bend.c1.x()},
                                                                  {"cU", bend.c2.x()},
                                                                  {"dU", bend.c3.x()},
                                                                  {"aV", 0.0},
                                                                  {"bV", bend.c1.y()},
                                                                  {"cV", bend.c2.y()},
                                                                  {"dV", bend.c3.y()}}};
  for (const auto& [name, number] : numbers) put(cubic, name, text(number));
  put(cubic, "pRange", "normalized");
  road.attribute("length") = text(bend.length_m).c_str();
}

}  // namespace

std::size_t BendKinkedWays(pugi::xml_node drive) {
  std::map<std::string, pugi::xml_node> roads;
  for (const pugi::xml_node& road : drive.children("road")) roads.emplace(road.attribute("id").value(), road);
  std::size_t bent = 0;
  for (const pugi::xml_node& road : drive.children("road")) {
    if (std::string_view(road.attribute("junction").value()) == "-1") continue;
    const auto before = roads.find(road.child("link").child("predecessor").attribute("elementId").value());
    const auto behind = roads.find(road.child("link").child("successor").attribute("elementId").value());
    if (before == roads.end() || behind == roads.end()) continue;
    const auto begin = BeginOf(road), end = EndOf(road), in = EndOf(before->second), out = BeginOf(behind->second);
    if (!begin || !end || !in || !out) continue;
    const auto kink = [](const Pose& a, const Pose& b) {
      return std::fabs(geometry::WrapAngle(a.heading_rad - b.heading_rad));
    };
    if (std::max(kink(*begin, *in), kink(*end, *out)) <= kKink_rad) continue;
    if (!Meets(road, *begin, *end, before->second, *in, behind->second, *out)) continue;
    const Pose from{begin->p, in->heading_rad}, to{end->p, out->heading_rad};
    const Bend bend = BendOf(from, to);
    if (!(TightestRadius(road, bend.radius_m) >= kTightest_m)) continue;
    Draw(road, from, bend);
    ++bent;
  }
  return bent;
}

}  // namespace rodeira::sumo
