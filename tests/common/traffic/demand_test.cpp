// SPDX-License-Identifier: Apache-2.0
// Flows, routes, turning shares and mixes on whole networks.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string>

#include "common/traffic/results/study.hpp"
#include "tests/common/traffic/demand_road.hpp"
#include "tests/common/world/lanes/lane_networks.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kStep_s = 0.05;

std::string RefusedBy(const std::string& map, const std::string& yaml) {
  const auto model = TrafficModel::Make(Settings(yaml), lanes::MapNetwork(map), {});
  if (model.ok()) return "not refused";
  EXPECT_EQ(model.error().exit_status(), 2);
  return model.error().Text();
}

// A road that a map's lane goes on into.
std::string WayOnFrom(const std::string& map, const std::string& road) {
  const auto network = lanes::MapNetwork(map);
  const lanes::Graph graph(*network);
  const auto& next = graph[*graph.Find({*network->FindRoad(road), 0, -1})].next;
  return network->roads()[graph[next.front().to].lane.road].id();
}

std::string RefusedSettings(const std::string& yaml) {
  auto file = config::File::Parse(yaml, "t.yaml").value();
  (void)ReadTraffic(file.root(), 1);
  const auto status = file.Finish();
  return status.ok() ? "not refused" : status.error().Text();
}

std::string RoadOf(const TrafficModel& model, const AgentPose& pose) {
  return model.graph().network().roads()[static_cast<std::size_t>(pose.road)].id();
}

// At every step all that were given a vehicle wait, drive, or have ended; an arrival without one finds none
// free.
TEST(Demand, VehiclesAreConserved) {
  const TrafficSettings settings = Settings(
      "vehicles: 30\nflows:\n  - {every_s: [3, 8]}\n  - {lane: \"1:-1\", vehicles_per_h: 600}\n  - {lane: \"3:-1\", "
      "by_hour: [500], arrivals: even, to_s: 200}\n",
      4);
  TrafficModel model = TrafficModel::Make(settings, lanes::MapNetwork("town"), {}).value();
  EXPECT_EQ(model.on_road() + model.waiting(), 0u);
  std::set<std::size_t> busy;
  for (int i = 0; i < 12000; ++i) {
    model.Step(kStep_s, {});
    std::uint64_t arrived = 0, given = 0;
    for (const TrafficModel::FlowCount& flow : model.flows()) arrived += flow.arrived, given += flow.given;
    ASSERT_EQ(given, model.waiting() + model.on_road() + model.ended()) << i;
    ASSERT_LE(given, arrived);
    if (given < arrived) {
      ASSERT_EQ(model.waiting() + model.on_road(), 30u) << i;
    }
    busy.insert(model.on_road());
  }
  EXPECT_GT(model.ended(), 100u);
  EXPECT_EQ(model.flows()[2].arrived, 28u);  // 200 s · 500/h, the first after half a gap
  EXPECT_GT(busy.size(), 10u);
}

// One that enters a free road enters when it arrives, and enough of them: Poisson's number of them within four
// deviations.
TEST(Demand, ComesAsTheFlowSays) {
  TrafficModel model =
      TrafficModel::Make(Settings("flows:\n  - {lane: \"1:-1\", vehicles_per_h: 400}\n"), lanes::MapNetwork("ramp"), {})
          .value();
  for (int i = 0; i < 36000; ++i) model.Step(kStep_s, {});
  EXPECT_NEAR(static_cast<double>(model.flows()[0].arrived), 200.0, 4.0 * std::sqrt(200.0));
  EXPECT_EQ(model.flows()[0].given, model.flows()[0].arrived);
  EXPECT_LE(model.waiting(), 2u);
  EXPECT_GT(model.ended(), 150u);
}

// Every vehicle of a flow with a route is last seen on the route's last road, and has passed the one between.
TEST(Demand, RoutesAreDriven) {
  const auto network = lanes::MapNetwork("town");
  const lanes::Graph graph(*network);
  std::uint32_t from = 0;
  while (!graph[from].entry) ++from;
  std::vector<std::uint32_t> open{from};  // every track that can be reached, nearest first
  for (std::size_t i = 0; i < open.size(); ++i) {
    for (const lanes::Link& on : graph[open[i]].next) {
      if (std::find(open.begin(), open.end(), on.to) == open.end()) open.push_back(on.to);
    }
  }
  const auto name = [&](std::uint32_t track) { return network->roads()[graph[track].lane.road].id(); };
  const std::string via = name(open[open.size() / 2]);
  std::string to;
  for (const std::uint32_t track : open) {
    if (graph[track].next.empty()) to = name(track);
  }
  const std::string yaml = fmt::format(
      "routes: {{far: [\"{}\", \"{}\"]}}\nflows:\n  - {{lane: \"{}:{}\", vehicles_per_h: 300, route: far}}\n", via, to,
      name(from), graph[from].lane.lane);
  TrafficModel model = TrafficModel::Make(Settings(yaml), network, {}).value();
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::string>> seen;
  for (int i = 0; i < 12000; ++i) {
    model.Step(kStep_s, {});
    for (const AgentPose& pose : model.poses()) {
      auto& roads = seen[{pose.id, pose.trip}];
      if (roads.empty() || roads.back() != RoadOf(model, pose)) roads.push_back(RoadOf(model, pose));
    }
  }
  int ended = 0;
  for (const auto& [key, roads] : seen) {
    const auto& agent = model.agent(key.first);
    if (agent.on_road && agent.trip == key.second) continue;
    EXPECT_EQ(roads.back(), to);
    EXPECT_NE(std::find(roads.begin(), roads.end(), via), roads.end());
    ++ended;
  }
  EXPECT_EQ(static_cast<std::uint64_t>(ended), model.ended());
  EXPECT_GT(ended, 20);
  EXPECT_EQ(model.missed(), 0u);
}

// Of those without a route so many turn as the shares say, within four deviations.
TEST(Demand, TurnsHaveTheirShares) {
  const auto network = lanes::MapNetwork("crossing");
  const lanes::Graph graph(*network);
  std::uint32_t from = 0;
  while (!graph[from].entry || graph[from].next.size() != 3) ++from;
  const auto name = [&](std::uint32_t track) { return network->roads()[graph[track].lane.road].id(); };
  const auto& next = graph[from].next;
  const std::string lane = fmt::format("{}:{}", name(from), graph[from].lane.lane);
  const std::string yaml = fmt::format(
      "flows:\n  - {{lane: \"{0}\", vehicles_per_h: 700}}\nturns:\n  - {{lane: \"{0}\", shares: {{\"{1}\": 6, \"{2}\": "
      "3, \"{3}\": 1}}}}\n",
      lane, name(next[0].to), name(next[1].to), name(next[2].to));
  TrafficModel model = TrafficModel::Make(Settings(yaml), network, {}).value();
  std::map<std::string, std::set<std::pair<std::uint32_t, std::uint32_t>>> taken;
  for (int i = 0; i < 60000; ++i) {
    model.Step(kStep_s, {});
    for (const AgentPose& pose : model.poses()) taken[RoadOf(model, pose)].insert({pose.id, pose.trip});
  }
  double all = 0.0;
  for (const lanes::Link& on : next) all += static_cast<double>(taken[name(on.to)].size());
  EXPECT_GT(all, 300.0);
  const double shares[] = {0.6, 0.3, 0.1};
  for (std::size_t i = 0; i < 3; ++i) {
    const double share = shares[i];
    EXPECT_NEAR(static_cast<double>(taken[name(next[i].to)].size()), share * all,
                4.0 * std::sqrt(all * share * (1.0 - share)))
        << i;
  }
}

// Both lanes full of drivers of whom half want over to the other lane before it parts: nearly all get there, who does
// not is counted, and no vehicle touches another.
TEST(Demand, LanesAreChangedForARoute) {
  const auto network = Exit(900.0);
  StudySettings study;
  study.traffic = Settings(
      "routes: {on: [\"2\"], off: [\"3\"]}\nflows:\n"
      "  - {lane: \"1:-1\", vehicles_per_h: 350, route: off}\n  - {lane: \"1:-1\", vehicles_per_h: 350, route: on}\n"
      "  - {lane: \"1:-2\", vehicles_per_h: 350, route: on}\n  - {lane: \"1:-2\", vehicles_per_h: 350, route: off}\n",
      2);
  study.duration_s = 900.0;
  study.step_s = 0.05;
  std::uint64_t ended = 0, missed = 0;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::pair<std::int32_t, std::string>> last;
  const StudyResult r = RunStudy(study, network, [&](const StudyMoment& moment) {
                          ended = moment.model.ended(), missed = moment.model.missed();
                          for (const AgentPose& pose : moment.model.poses())
                            last[{pose.id, pose.trip}] = {moment.model.agent(pose.id).flow, RoadOf(moment.model, pose)};
                        }).value();
  int right = 0, wrong = 0;
  for (const auto& [key, way] : last) {
    if (way.second == "1") continue;
    const bool off = way.first == 0 || way.first == 3;
    ++(way.second == (off ? "3" : "2") ? right : wrong);
  }
  RecordProperty("missed", static_cast<int>(missed));
  RecordProperty("ended", static_cast<int>(ended));
  EXPECT_EQ(static_cast<std::uint64_t>(wrong), missed);
  EXPECT_GT(right, 250);
  EXPECT_LT(wrong, 0.03 * (right + wrong));
  EXPECT_EQ(r.collisions, 0);
  EXPECT_EQ(r.off_lane, 0);
  EXPECT_LE(r.max_deceleration_mps2, 3.0) << (r.incidents.empty() ? "" : r.incidents.front());
}

// Every kind as often as the mix says, within four deviations, each with its own size; lorries obey their own limit.
TEST(Demand, TheMixIsWhatItSays) {
  const TrafficSettings settings = Settings("vehicles: 4000\nmix: {car: 70, van: 10, lorry: 15, bus: 5}\n");
  std::map<VehicleKind, double> count;
  for (std::uint32_t id = 0; id < settings.vehicles; ++id) {
    const AgentTraits traits = TraitsOf(settings, id);
    count[traits.kind] += 1.0;
    EXPECT_EQ(traits.length_m > 6.0, traits.kind == VehicleKind::kLorry || traits.kind == VehicleKind::kBus);
    if (traits.kind == VehicleKind::kLorry) {
      EXPECT_LT(traits.idm.acceleration_mps2, 1.0);
    }
  }
  for (const auto& [kind, share] : std::map<VehicleKind, double>{{VehicleKind::kCar, 0.7},
                                                                 {VehicleKind::kVan, 0.1},
                                                                 {VehicleKind::kLorry, 0.15},
                                                                 {VehicleKind::kBus, 0.05}}) {
    EXPECT_NEAR(count[kind], 4000.0 * share, 4.0 * std::sqrt(4000.0 * share * (1.0 - share)));
  }
}

// Lorries and buses turn through crossings and a roundabout among cars without touching another or making another brake
// hard.
TEST(Demand, LongVehiclesDriveTheMaps) {
  for (const std::string map : {"crossing", "roundabout", "town", "ramp", "overpass"}) {
    StudySettings study;
    study.traffic = Settings("vehicles: 25\nmix: {car: 50, lorry: 30, bus: 20}\n", 6);
    study.duration_s = 180.0;
    study.step_s = 0.02;
    const StudyResult r = RunStudy(study, lanes::MapNetwork(map)).value();
    std::string told;
    for (const std::string& incident : r.incidents) told += "\n  " + incident;
    EXPECT_EQ(r.collisions, 0) << map << told;
    EXPECT_EQ(r.off_lane, 0) << map << told;
    EXPECT_LE(r.max_deceleration_mps2, 3.0) << map << told;
    EXPECT_GT(r.arrivals, 10) << map;
  }
}

TEST(Demand, RestoredItGoesOnWithTheSameBits) {
  const TrafficSettings settings = Settings(
      "vehicles: 40\nmix: {car: 80, lorry: 20}\nflows:\n  - {every_s: [1, 3]}\n  - {lane: \"1:-1\", vehicles_per_h: "
      "300, mix: {bus: 1}}\n",
      8);
  TrafficModel a = TrafficModel::Make(settings, lanes::MapNetwork("town"), {}).value();
  for (int i = 0; i < 3000; ++i) a.Step(kStep_s, {});
  base::StateWriter writer;
  a.Save(writer);
  TrafficModel b = TrafficModel::Make(settings, lanes::MapNetwork("town"), {}).value();
  base::StateReader reader(writer.bytes());
  b.Restore(reader);
  ASSERT_TRUE(reader.Finish().ok());
  for (int i = 0; i < 2000; ++i) {
    a.Step(kStep_s, {});
    b.Step(kStep_s, {});
  }
  base::StateWriter one, other;
  a.Save(one);
  b.Save(other);
  EXPECT_EQ(one.digest(), other.digest());
  for (const AgentPose& pose : a.poses()) EXPECT_EQ(a.traits(pose.id).length_m, b.traits(pose.id).length_m);
}

TEST(Demand, WhatIsWrongIsSaid) {
  const auto flow = [](const std::string& lane, const std::string& more = "") {
    return "flows:\n  - {lane: \"" + lane + "\", vehicles_per_h: 100" + more + "}\n";
  };
  EXPECT_NE(RefusedBy("town", flow("999:-1")).find("t.yaml:3: '999:-1' was found; a drivable lane as ROAD:LANE"),
            std::string::npos)
      << RefusedBy("town", flow("999:-1"));
  EXPECT_NE(RefusedBy("town", flow("1:-1", ", route: west")).find("t.yaml:3: the route 'west' does not exist"),
            std::string::npos)
      << RefusedBy("town", flow("1:-1", ", route: west"));
  EXPECT_NE(
      RefusedBy("town", "routes: {west: [\"nowhere\"]}\n" + flow("1:-1", ", route: west")).find("'nowhere' was found"),
      std::string::npos);
  EXPECT_NE(RefusedBy("ramp", "turns:\n  - {lane: \"1:-1\", shares: {\"1\": 1}}\n" + flow("1:-1"))
                .find("does not go on into '1'"),
            std::string::npos);
  // Where traffic enters none comes from elsewhere.
  const auto network = lanes::MapNetwork("town");
  const lanes::Graph graph(*network);
  std::vector<std::string> starts;
  for (const lanes::Track& track : graph.tracks()) {
    if (track.before.empty()) starts.push_back(network->roads()[track.lane.road].id());
  }
  ASSERT_GE(starts.size(), 2u);
  const std::string there = "routes: {back: [\"" + starts[1] + "\"]}\n" + flow(starts[0] + ":-1", ", route: back");
  EXPECT_NE(RefusedBy("town", there).find("no way leads from there to '" + starts[1] + "'"), std::string::npos)
      << RefusedBy("town", there);
  const std::string between =
      "routes: {back: [\"" + starts[0] + "\", \"" + starts[1] + "\"]}\n" + flow(starts[0] + ":-1", ", route: back");
  EXPECT_NE(RefusedBy("town", between).find("no way leads from '" + starts[0] + "' on to '" + starts[1] + "'"),
            std::string::npos)
      << RefusedBy("town", between);
  const std::string way = WayOnFrom("ramp", "1");
  const auto twice = [&](const std::string& second) {
    return RefusedBy("ramp", "turns:\n  - {lane: \"1:-1\", shares: {\"" + way + "\": 1}}\n  - {lane: \"" + second +
                                 "\", shares: {\"" + way + "\": 1}}\n" + flow("1:-1"));
  };
  for (const std::string second : {"1:-1", "1"})
    EXPECT_EQ(twice(second), "t.yaml:4: the lane '" + second +
                                 "' has turns already, as '1:-1' in t.yaml:3; one item a lane was expected");
  const std::string one_of = "one of 'vehicles_per_h', 'by_hour' and 'every_s' was expected";
  EXPECT_EQ(RefusedSettings("flows:\n  - {lane: a}\n"), "t.yaml:2: 'lane' was found; " + one_of);
  EXPECT_EQ(RefusedSettings("flows:\n  - {lane: a, rate: 4}\n"), "t.yaml:2: 'lane' and 'rate' were found; " + one_of);
  EXPECT_EQ(RefusedSettings("flows:\n  - lane: a\n    vehicles_per_hour: 400\n"),
            "t.yaml:3: 'vehicles_per_hour' was found; " + one_of + "; did you mean 'vehicles_per_h'?");
  EXPECT_EQ(RefusedSettings("flows:\n  - lane: a\n    vehicles_per_h: 400\n    by_hour: [4]\n"),
            "t.yaml:4: 'vehicles_per_h' and 'by_hour' were found; " + one_of);
  EXPECT_EQ(RefusedSettings("flows:\n  - {every_s: [3, 8], by_hour: [4], vehicles_per_h: 1}\n"),
            "t.yaml:2: 'vehicles_per_h', 'by_hour' and 'every_s' were found; " + one_of);
  EXPECT_EQ(RefusedSettings("flows:\n  - {lane: a, every_s: [8, 3]}\n"),
            "t.yaml:2: 'every_s' is [8, 3]; the shortest and the longest gap, as [3, 8], were expected");
  EXPECT_EQ(RefusedSettings("vehicles: 3\nspeed_factor_low: 1.5\n"),
            "t.yaml:2: 'speed_factor_high' is 1, below 'speed_factor_low', which is 1.5");
  EXPECT_EQ(RefusedSettings("speed_factor_low: 0.9\nspeed_factor_high: 0.8\n"),
            "t.yaml:2: 'speed_factor_high' is 0.8, below 'speed_factor_low', which is 0.9");
  EXPECT_EQ(RefusedSettings("pedestrians:\n  per_hour: 3\n  slowest_mps: 2\n"),
            "t.yaml:3: 'fastest_mps' is 1.5, below 'slowest_mps', which is 2");
  const std::string nowhere = RefusedBy("ramp", "vehicles: 3\npedestrians: {per_hour: 60}\n");
  EXPECT_EQ(nowhere.find("t.yaml:3: the network '"), 0u) << nowhere;
  EXPECT_NE(RefusedSettings("flows:\n  - {lane: a, vehicles_per_h: -3}\n").find("t.yaml:2"), std::string::npos);
  EXPECT_NE(RefusedSettings("flows:\n  - {lane: a, vehicles_per_h: 3, rout: b}\n").find("rout"), std::string::npos);
  EXPECT_NE(RefusedSettings("mix: {car: 0}\n").find("no kind of vehicle"), std::string::npos);
}

// A car a second wants to come onto a lane. By MOTORS' rule each is let in in the first step in which the first five
// metres, or its own length and 0.4 m, are free of every vehicle's rear, told from the poses; otherwise later, when it
// need not brake.
TEST(Demand, BySourcesRuleAWaitingVehicleEntersWhereFiveMetresAreFree) {
  opendrive::RoadText road;
  road.length = 800.0;
  road.geometry = "<geometry s=\"0\" x=\"0\" y=\"0\" hdg=\"0\" length=\"800\"><line/></geometry>";
  road.left = "";
  road.right =
      "<lane id=\"-1\" type=\"driving\"><width sOffset=\"0\" a=\"3.5\" b=\"0\" c=\"0\" d=\"0\"/><speed sOffset=\"0\" "
      "max=\"8\" unit=\"m/s\"/></lane>";
  const auto network = opendrive::MustRead(opendrive::Document(road.Text()));
  const std::string flows =
      "vehicles: 300\nmix: {car: 2, van: 1, lorry: 1}\nflows:\n  - {lane: \"1:-1\", vehicles_per_h: 3600, arrivals: "
      "even}\n";
  std::map<std::string, int> entered;
  std::map<std::string, double> closest_m;  // to the leader, when a vehicle enters
  for (const auto& [rule, free_m] : {std::pair{"safe", 0.0}, {"free", 5.0}, {"free, free_m: 9", 9.0}}) {
    TrafficModel model = TrafficModel::Make(Settings(flows + "entering: {rule: " + rule + "}\n"), network, {}).value();
    std::set<std::uint32_t> before;
    int refused = 0;
    for (int i = 0; i < 4000; ++i) {
      // The longest waiting: of all that have come the one with the least number.
      std::optional<std::uint32_t> first;
      for (std::uint32_t id = 0; id < model.vehicles(); ++id) {
        const Agent& agent = model.agent(id);
        if (agent.flow >= 0 && !agent.on_road && (!first || agent.arrival < model.agent(*first).arrival)) first = id;
      }
      model.Step(kStep_s, {});
      std::set<std::uint32_t> now;
      double nearest = 1e9;
      std::optional<std::uint32_t> came;
      for (const AgentPose& pose : model.poses()) {
        now.insert(pose.id);
        if (!before.contains(pose.id))
          came = pose.id;
        else
          nearest = std::min(nearest, pose.p_WB_W.x() - 0.5 * model.traits(pose.id).length_m);
      }
      before = now;
      if (came) {
        ++entered[rule];
        const double gap_m = nearest - model.traits(*came).length_m;
        closest_m[rule] = closest_m.contains(rule) ? std::min(closest_m[rule], gap_m) : gap_m;
      }
      if (free_m == 0.0) continue;
      const auto needs = [&](std::uint32_t id) { return std::max(free_m, model.traits(id).length_m + 0.4); };
      if (came) {
        EXPECT_GE(nearest, needs(*came) - 1e-9) << i;
      }
      if (!came && first) {
        EXPECT_LT(nearest, needs(*first)) << i;
        ++refused;
      }
    }
    if (free_m > 0.0) {
      EXPECT_GT(refused, 200);
    }
  }
  for (const auto& [rule, count] : entered) EXPECT_GT(count, 30) << rule;
  EXPECT_LT(closest_m["free"], 1.0);
  EXPECT_GE(closest_m["safe"], 4.0);  // two standing gaps
}

}  // namespace
}  // namespace rodeira::traffic
