// SPDX-License-Identifier: Apache-2.0
// What stands in the companion file: heights, signs, flows, lights.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "common/editor/commands.hpp"

namespace rodeira::editor {
namespace {

constexpr double kMaxHeight_m = 1e4;

base::Error NoLane(std::string_view number) {
  return base::WrongInput("edit.unknown_element", fmt::format("lane {} does not exist", number));
}

}  // namespace

base::Result<Edit> SetHeights(Document& document, std::int32_t curve, const std::array<double, 4>& z_m) {
  if (!Find(document.map.curves, curve))
    return base::WrongInput("edit.unknown_element", fmt::format("curve {} does not exist", curve));
  for (const double z : z_m) {
    if (!(std::abs(z) <= kMaxHeight_m))
      return base::WrongInput("edit.out_of_range",
                              fmt::format("the height is {} m; one from -10000 to 10000 was expected", z));
  }
  Recorder recorder(document);
  auto& curves = recorder.companion().curves;
  const auto at =
      std::lower_bound(curves.begin(), curves.end(), curve,
                       [](const traffic_map::CurveHeights& one, std::int32_t number) { return one.curve < number; });
  const bool there = at != curves.end() && at->curve == curve, flat = z_m == std::array<double, 4>{};
  if (there && flat)
    curves.erase(at);
  else if (there)
    at->z_m = z_m;
  else if (!flat)
    curves.insert(at, {curve, z_m, 0});
  return std::move(recorder).Finish(fmt::format("heights of curve {} changed", curve));
}

base::Result<Edit> SetSigns(Document& document, const std::vector<traffic_map::LaneSign>& signs) {
  for (const traffic_map::LaneSign& sign : signs) {
    if (!Find(document.map.lanes, sign.lane)) return NoLane(fmt::format("{}", sign.lane));
    if (!(sign.before_end_m >= 0.0) || sign.before_end_m > 1e5)
      return base::WrongInput(
          "edit.out_of_range",
          fmt::format("the sign stands {} m before the lane's end; 0 to 100000 was expected", sign.before_end_m));
    if (sign.kind == traffic_map::SignKind::kSpeedLimit && !(sign.limit_kmh >= 5.0 && sign.limit_kmh <= 200.0))
      return base::WrongInput("edit.out_of_range",
                              fmt::format("the limit is {} km/h; 5 to 200 was expected", sign.limit_kmh));
  }
  Recorder recorder(document);
  recorder.companion().signs = signs;
  return std::move(recorder).Finish("signs changed");
}

base::Result<Edit> SetFlow(Document& document, std::int32_t lane, double vehph) {
  const auto place = Find(document.map.lanes, lane);
  if (!place) return NoLane(fmt::format("{}", lane));
  if (document.map.lanes[*place].value.mode != traffic_map::LaneMode::kStart)
    return base::WrongInput("edit.not_a_start_lane",
                            fmt::format("lane {} is no start lane: no vehicle begins there", lane));
  if (!(vehph >= 0.0 && vehph <= 10'000.0))
    return base::WrongInput("edit.out_of_range",
                            fmt::format("the flow is {} vehicles an hour; 0 to 10000 was expected", vehph));
  Recorder recorder(document);
  auto& flows = recorder.companion().flows;
  const auto at =
      std::lower_bound(flows.begin(), flows.end(), lane,
                       [](const traffic_map::LaneFlow& one, std::int32_t number) { return one.lane < number; });
  const bool there = at != flows.end() && at->lane == lane;
  if (there && vehph == 0.0)
    flows.erase(at);
  else if (there)
    at->vehph = vehph;
  else if (vehph > 0.0)
    flows.insert(at, {lane, vehph, 0});
  return std::move(recorder).Finish(fmt::format("flow of lane {} changed", lane));
}

base::Result<Edit> SetLights(Document& document, const std::vector<lights::LightPlan>& lights) {
  std::set<std::string> lit;
  for (const lights::LightPlan& plan : lights) {
    if (plan.phases.empty())
      return base::WrongInput("edit.out_of_range", "lights without a phase; one or more were expected");
    const auto within = [](double value, double low, double high) { return value >= low && value <= high; };
    if (!within(plan.offset_s, 0.0, 600.0) || !within(plan.amber_s, 1.0, 10.0) || !within(plan.all_red_s, 0.0, 60.0) ||
        !within(plan.red_amber_s, 0.0, 10.0))
      return base::WrongInput(
          "edit.out_of_range",
          "a time of the lights is out of its bounds: offset 0 to 600 s, amber 1 to 10 s, red for all 0 to 60 s, red "
          "with amber 0 to 10 s");
    if (plan.red_amber_s > plan.amber_s + plan.all_red_s)
      return base::WrongInput("edit.out_of_range", "red with amber is longer than amber and red for all together");
    for (const lights::Phase& phase : plan.phases) {
      if (!within(phase.green_s, 1.0, 600.0))
        return base::WrongInput("edit.out_of_range",
                                fmt::format("a phase is green for {} s; 1 to 600 was expected", phase.green_s));
    }
    for (const std::string& name : plan.Names()) {
      const bool there = std::any_of(document.map.lanes.begin(), document.map.lanes.end(),
                                     [&](const auto& line) { return std::to_string(line.value.id) == name; });
      if (!there) return NoLane(name);
      if (!lit.insert(name).second)
        return base::WrongInput("edit.wrong_connection", fmt::format("lane {} has other lights already", name));
    }
  }
  Recorder recorder(document);
  recorder.companion().lights = lights;
  return std::move(recorder).Finish("lights changed");
}

}  // namespace rodeira::editor
