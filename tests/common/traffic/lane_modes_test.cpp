// SPDX-License-Identifier: Apache-2.0
// Where a traffic map lets vehicles begin and end (modes of lanes), and how one begins among others.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <memory>
#include <set>
#include <string>

#include "common/core/base/files.hpp"
#include "common/traffic/results/study.hpp"
#include "common/world/traffic_map/map_network.hpp"
#include "common/world/traffic_map/open_drive.hpp"
#include "tests/common/traffic/demand_road.hpp"
#include "tests/common/traffic/digest_of.hpp"
#include "tests/common/world/lanes/lane_networks.hpp"
#include "tests/long_form.hpp"

namespace rodeira::traffic {
namespace {

using traffic_map::LaneMode;
using NetworkPointer = std::shared_ptr<const network::Network>;

// One of the project's maps with other modes.
traffic_map::LaneMap MapWith(const std::string& name, const std::map<std::int32_t, LaneMode>& modes) {
  auto file = traffic_map::LoadMap(std::filesystem::path(SourceDir()) / "configs/maps" / (name + ".motors")).value();
  for (auto& lane : file.lanes) {
    if (const auto mode = modes.find(lane.value.id); mode != modes.end()) lane.value.mode = mode->second;
  }
  auto made = traffic_map::MakeLaneMap(file, {}, name);
  EXPECT_TRUE(made.ok()) << (made.ok() ? "" : made.error().Text());
  return made.value();
}

NetworkPointer NetworkWith(const std::string& name, const std::map<std::int32_t, LaneMode>& modes) {
  return traffic_map::ToNetwork(MapWith(name, modes), name).value();
}

// On which roads trips began and were last seen, how many of each; a vehicle that is on the road at first has begun
// before.
struct Trips {
  std::map<std::string, int> began, ended;
  std::int64_t collisions = 0;
  std::string told;
};

Trips TripsOn(const NetworkPointer& network, const TrafficSettings& traffic, double duration_s, double step_s = 0.05) {
  Trips trips;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::string> on;
  bool first = true;
  StudySettings settings;
  settings.traffic = traffic, settings.duration_s = duration_s, settings.step_s = step_s,
  settings.watch_s = std::max(0.05, step_s);
  const auto result = RunStudy(settings, network, [&](const StudyMoment& moment) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::string> now;
    for (const AgentPose& pose : moment.model.poses()) {
      const std::string& road = network->roads()[static_cast<std::size_t>(pose.road)].id();
      now[{pose.id, pose.trip}] = road;
      if (!first && !on.contains({pose.id, pose.trip})) ++trips.began[road];
    }
    for (const auto& [trip, road] : on) {
      if (!now.contains(trip)) ++trips.ended[road];
    }
    const TrafficModel& model = moment.model;
    std::uint64_t given = 0;
    for (const auto& flow : model.flows()) given += flow.given;
    EXPECT_EQ(model.flows().empty() ? model.vehicles() : given - model.ended(), model.on_road() + model.waiting());
    on = std::move(now), first = false;
  });
  EXPECT_TRUE(result.ok()) << (result.ok() ? "" : result.error().Text());
  trips.collisions = result.value().collisions;
  for (const std::string& incident : result.value().incidents) trips.told += "\n  " + incident;
  return trips;
}

TrafficSettings Vehicles(std::uint32_t count, std::uint64_t seed = 1) {
  TrafficSettings settings;
  settings.vehicles = count, settings.seed = seed;
  return settings;
}

TEST(LaneModes, VehiclesBeginOnEveryStartLaneAndNowhereElse) {
  const Trips middle = TripsOn(NetworkWith("crossing", {{13, LaneMode::kStart}}), Vehicles(25), 600.0);
  EXPECT_EQ(middle.collisions, 0) << middle.told;
  std::set<std::string> begins;
  for (const auto& [road, count] : middle.began) begins.insert(road);
  EXPECT_EQ(begins, (std::set<std::string>{"1", "3", "5", "7", "13"}));
  const Trips fewer = TripsOn(NetworkWith("crossing", {{1, LaneMode::kNone}}), Vehicles(25), 600.0);
  EXPECT_EQ(fewer.collisions, 0) << fewer.told;
  begins.clear();
  for (const auto& [road, count] : fewer.began) begins.insert(road);
  EXPECT_EQ(begins, (std::set<std::string>{"3", "5", "7"}));
  for (const std::string from : {"1", "9", "10", "11"}) EXPECT_FALSE(fewer.ended.contains(from)) << from;
}

TEST(LaneModes, NoVehicleBeginsOnALaneWithoutAnEntry) {
  const auto network = NetworkWith("crossing", {{1, LaneMode::kNone}});
  const TrafficModel model = TrafficModel::Make(Vehicles(60), network, {}).value();
  EXPECT_GT(model.on_road(), 20u);
  for (const AgentPose& pose : model.poses())
    EXPECT_NE(network->roads()[static_cast<std::size_t>(pose.road)].id(), "1");
}

TEST(LaneModes, VehiclesAreGoneAtTheEndOfAnEndLaneThatGoesOn) {
  const auto network = NetworkWith("crossing", {{9, LaneMode::kEnd}});
  const lanes::Graph graph(*network);
  std::set<std::string> roads;
  for (const lanes::Track& track : graph.tracks()) {
    const std::string& road = network->roads()[track.lane.road].id();
    roads.insert(road);
    if (road == "9") {
      EXPECT_TRUE(track.next.empty());
    }
    if (road == "4") {
      EXPECT_EQ(track.before.size(), 2u);  // from 16 and 19, and no more from 9
    }
  }
  EXPECT_TRUE(roads.contains("9") && roads.contains("4"));
  const Trips trips = TripsOn(network, Vehicles(25), 600.0);
  EXPECT_EQ(trips.collisions, 0) << trips.told;
  EXPECT_GT(trips.ended.at("9"), 5);
  std::set<std::string> ends;
  for (const auto& [road, count] : trips.ended) ends.insert(road);
  EXPECT_EQ(ends, (std::set<std::string>{"2", "4", "6", "8", "9"}));
}

// Vehicles that begin and end on a ring, among those that drive round it.
TEST(LaneModes, HoldOnARing) {
  std::map<std::int32_t, LaneMode> modes{{10, LaneMode::kStart}, {13, LaneMode::kEnd}, {16, LaneMode::kStart}};
  for (const std::uint64_t seed : {1u, 2u}) {
    const Trips trips = TripsOn(NetworkWith("roundabout", modes), Vehicles(20, seed), 600.0);
    EXPECT_EQ(trips.collisions, 0) << trips.told;
    EXPECT_GT(trips.began.contains("10") ? trips.began.at("10") : 0, 3);
    EXPECT_GT(trips.began.contains("16") ? trips.began.at("16") : 0, 3);
    EXPECT_GT(trips.ended.contains("13") ? trips.ended.at("13") : 0, 3);
  }
}

// What the modes of the project's maps say is what their edges say.
TEST(LaneModes, OfTheEdgesChangeNoBit) {
  for (const std::string& name : lanes::MapNames()) {
    const auto made =
        traffic_map::LoadLaneMap(std::filesystem::path(SourceDir()) / "configs/maps" / (name + ".motors")).value();
    EXPECT_TRUE(traffic_map::BeginsAndEndsAtItsEdge(made)) << name;
    std::string xml = traffic_map::ToOpenDrive(made, name, traffic_map::Junctions::kDirect).value().xml;
    for (std::size_t at = 0; (at = xml.find("rodeira:traffic", at)) != std::string::npos;)
      xml.replace(at, 15, "somebody's");
    const auto import = opendrive::Read(xml, name).value();
    ASSERT_TRUE(import.errors.empty());
    auto told = TrafficModel::Make(Vehicles(30), traffic_map::ToNetwork(made, name).value(), {}).value();
    auto silent = TrafficModel::Make(Vehicles(30), import.network, {}).value();
    EXPECT_TRUE(told.graph().says_entries());
    EXPECT_FALSE(silent.graph().says_entries());
    for (int k = 0; k < 1200; ++k) told.Step(0.1, {}), silent.Step(0.1, {});
    EXPECT_EQ(DigestOf(told), DigestOf(silent)) << name;
  }
}

// A world that a map is converted to lets vehicles begin and end where the map does; the files of other maps say
// nothing of it.
TEST(LaneModes, GoWithAConvertedMap) {
  const traffic_map::LaneMap made =
      MapWith("crossing", {{13, LaneMode::kStart}, {9, LaneMode::kEnd}, {1, LaneMode::kNone}});
  EXPECT_FALSE(traffic_map::BeginsAndEndsAtItsEdge(made));
  const auto import = opendrive::Read(traffic_map::ToOpenDrive(made, "crossing").value().xml, "crossing.xodr").value();
  ASSERT_TRUE(import.errors.empty());
  const lanes::Graph graph(*import.network);
  std::set<std::string> begins, ends;
  for (const lanes::Track& track : graph.tracks()) {
    const std::string& road = import.network->roads()[track.lane.road].id();
    if (track.entry) begins.insert(road);
    if (import.network->Find(track.lane)->traffic_ends) {
      ends.insert(road);
      EXPECT_TRUE(track.next.empty()) << road;
    }
  }
  EXPECT_EQ(begins, (std::set<std::string>{"3", "5", "7", "13"}));
  EXPECT_EQ(ends, (std::set<std::string>{"2", "4", "6", "8", "9"}));
  EXPECT_EQ(traffic_map::ToOpenDrive(MapWith("crossing", {}), "crossing").value().xml.find("rodeira:traffic"),
            std::string::npos);
}

// A flow into the middle of a crossing, and others that come to it: from the arm from which its lane leads on, and from
// those that cross its way within its first metres. One that begins there waits until no vehicle comes and its zones
// are its own.
TEST(LaneModes, AVehicleThatBeginsWithinACrossingBlocksNoOther) {
  const auto flow = [](const std::string& lane, int per_h) {
    return "{lane: \"" + lane + ":-1\", vehicles_per_h: " + std::to_string(per_h) + "}";
  };
  for (std::uint64_t seed = 1; seed <= BriefOrLong(1u, 3u); ++seed) {
    for (const auto& [middle, others] : {std::pair<std::string, std::string>("13", flow("3", 400)),
                                         {"11", flow("3", 400) + ", " + flow("5", 500) + ", " + flow("7", 400)}}) {
      const TrafficSettings settings = Settings("flows: [" + flow(middle, 600) + ", " + others + "]\n", seed);
      const Trips trips = TripsOn(lanes::MapNetwork("crossing"), settings, 300.0, 0.01);
      EXPECT_EQ(trips.collisions, 0) << middle << trips.told;
      EXPECT_GT(trips.began.contains(middle) ? trips.began.at(middle) : 0, 3);
      EXPECT_GT(trips.began.at("3"), 15);
    }
  }
}

}  // namespace
}  // namespace rodeira::traffic
