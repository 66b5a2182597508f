// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/traffic_requests.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <string_view>

#include "common/core/base/suggest.hpp"
#include "common/traffic/results/names.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kFastest_mps = 150.0;
constexpr double kLongestHold_s = 3600.0;  // of a held light
constexpr std::size_t kMaxRoads = 100;

base::Error WrongValue(std::string_view what, std::string_view found, std::string_view expected) {
  return base::WrongInput("traffic.wrong_request", fmt::format("{} is {}; {} was expected", what, found, expected));
}

base::Status CheckSpeed(double speed_mps) {
  if (speed_mps >= 0.0 && speed_mps <= kFastest_mps) return {};
  return WrongValue("'speed_mps'", fmt::format("{}", speed_mps), "0 to 150");
}

base::Status CheckRoads(const std::vector<std::string>& roads, std::size_t least) {
  if (roads.size() >= least && roads.size() <= kMaxRoads) return {};
  return WrongValue("the number of 'roads'", fmt::format("{}", roads.size()), fmt::format("{} to 100", least));
}

base::Status CheckAgent(const TrafficModel& model, std::uint32_t id, bool drives) {
  if (id >= model.vehicles())
    return base::WrongInput("traffic.unknown_agent",
                            fmt::format("there is no agent {}; there are {}, from 0 on", id, model.vehicles()));
  const Agent& agent = model.agent(id);
  if (!drives || agent.on_road) return {};
  return base::WrongInput("traffic.not_on_road", agent.is_crashed
                                                     ? fmt::format("agent {} has crashed and drives no more", id)
                                                     : fmt::format("agent {} is not on the road", id));
}

base::Status SetSpeed(TrafficModel& model, const TrafficRequest& request) {
  if (auto status = CheckSpeed(request.speed_mps); !status) return status;
  if (request.speed_mps > 0.0)
    model.HoldSpeed(request.agent, request.speed_mps);
  else
    model.Brake(request.agent, model.traits(request.agent).idm.braking_mps2);
  return {};
}

// 1 to the left, -1 to the right, 0: it is there.
base::Result<int> SideOf(const TrafficModel& model, const TrafficRequest& request) {
  const Agent& agent = model.agent(request.agent);
  const lanes::Track& track = model.graph()[agent.path.back().track];
  const auto none = [&] {
    return base::WrongInput(
        "traffic.no_lane_beside",
        fmt::format("agent {} on lane {} of road '{}' has no lane '{}' of its direction beside it", request.agent,
                    track.lane.lane, model.graph().network().roads()[track.lane.road].id(), request.lane));
  };
  if (request.lane == "left") return track.left ? base::Result<int>(1) : none();
  if (request.lane == "right") return track.right ? base::Result<int>(-1) : none();
  int lane = 0;
  const char* end = request.lane.data() + request.lane.size();
  if (request.lane.empty() || std::from_chars(request.lane.data(), end, lane).ptr != end)
    return WrongValue("'lane'", fmt::format("'{}'", request.lane), "left, right or the number of a lane");
  if (lane == track.lane.lane) return 0;
  if (track.left && model.graph()[*track.left].lane.lane == lane) return 1;
  if (track.right && model.graph()[*track.right].lane.lane == lane) return -1;
  return none();
}

base::Status ChangeLane(TrafficModel& model, const TrafficRequest& request) {
  if (model.motors(request.agent) != nullptr)
    return base::WrongInput("traffic.not_obeyed", "drivers of MOTORS change no lanes; 'driver: standard' was expected");
  const auto side = SideOf(model, request);
  if (!side) return side.error();
  if (side.value() != 0) model.CommandLaneChange(request.agent, side.value());
  return {};
}

base::Status SetRoute(TrafficModel& model, const TrafficRequest& request) {
  if (auto status = CheckRoads(request.roads, 1); !status) return status;
  return model.SetRoute(request.agent, request.roads);
}

base::Status HoldLight(TrafficModel& model, const TrafficRequest& request) {
  using network::LightColour;
  if (request.choice == "plan") return model.HoldLight(request.light, LightColour::kRed, 0.0);
  if (request.choice != "red" && request.choice != "green")
    return WrongValue("'choice'", fmt::format("'{}'", request.choice), "red, green or plan");
  if (!(request.duration_s > 0.0 && request.duration_s <= kLongestHold_s))
    return WrongValue("'duration_s'", fmt::format("{}", request.duration_s), "a time above 0, up to 3600 s,");
  return model.HoldLight(request.light, request.choice == "red" ? LightColour::kRed : LightColour::kGreen,
                         request.duration_s);
}

base::Result<std::uint32_t> Add(TrafficModel& model, const TrafficRequest& request) {
  constexpr std::array kKinds{VehicleKind::kCar, VehicleKind::kVan, VehicleKind::kLorry, VehicleKind::kBus};
  const auto kind = std::ranges::find(kKinds, request.choice, [](VehicleKind one) { return std::string(NameOf(one)); });
  if (kind == kKinds.end())
    return WrongValue("'choice'", fmt::format("'{}'", request.choice), "car, van, lorry or bus");
  if (auto status = CheckSpeed(request.speed_mps); !status) return status.error();
  if (auto status = CheckRoads(request.roads, 0); !status) return status.error();
  return model.Add(*kind, request.lane, request.station_m, request.speed_mps, request.roads);
}

void Describe(const TrafficModel& model, TrafficAnswer& answer) {
  const Agent& agent = model.agent(answer.agent);
  const Piece& piece = PieceAt(agent.path, agent.o_m);
  const lanes::Track& track = model.graph()[piece.track];
  answer.lane = fmt::format("{}:{}", model.graph().network().roads()[track.lane.road].id(), track.lane.lane);
  answer.station_m = track.curve.StationAt(agent.o_m - piece.zero_m);
  answer.roads = model.RoadsAhead(answer.agent);
}

base::Status CarryOut(TrafficModel& model, const TrafficRequest& request, TrafficAnswer& answer) {
  const std::string& name = request.name;
  if (name == "light") return HoldLight(model, request);
  if (name == "add") {
    const auto added = Add(model, request);
    if (!added) return added.error();
    answer.agent = added.value();
    return {};
  }
  static const std::vector<std::string> kNames{"speed", "release", "change_lane", "route",
                                               "add",   "remove",  "light",       "ask"};
  if (std::ranges::find(kNames, name) == kNames.end())
    return base::WrongInput("traffic.unknown_request",
                            fmt::format("the traffic knows no such request{}", base::DidYouMean(name, kNames)));
  if (auto status = CheckAgent(model, request.agent, name != "remove"); !status) return status;
  if (name == "remove") return model.Remove(request.agent);
  if (name == "speed") return SetSpeed(model, request);
  if (name == "change_lane") return ChangeLane(model, request);
  if (name == "route") return SetRoute(model, request);
  if (name == "release") model.Release(request.agent);
  if (name == "ask") Describe(model, answer);
  return {};
}

}  // namespace

TrafficAnswer Answer(TrafficModel& model, const TrafficRequest& request) {
  TrafficAnswer answer;
  answer.agent = request.agent;
  const auto status = CarryOut(model, request, answer);
  if (!status)
    answer.refusal = status.error()
                         .WithMessage(fmt::format("request '{}': {}", request.name, status.error().Text()))
                         .WithContext("");
  return answer;
}

}  // namespace rodeira::traffic
