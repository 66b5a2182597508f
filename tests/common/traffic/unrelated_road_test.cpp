// SPDX-License-Identifier: Apache-2.0
// A road far away that is added to the network changes nothing of the traffic that has nothing to do with it.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <utility>

#include "common/traffic/traffic_model.hpp"
#include "common/world/traffic_map/lane_map.hpp"
#include "common/world/traffic_map/open_drive.hpp"
#include "tests/common/traffic/demand_road.hpp"
#include "tests/common/traffic/digest_of.hpp"
#include "tests/common/world/opendrive/sample.hpp"
#include "tests/tree.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kStep_s = 0.05;

// A road of one lane each way, 7 km away.
std::string FarRoad() {
  opendrive::RoadText far;
  far.id = "5000";
  far.geometry = "<geometry s=\"0\" x=\"5000\" y=\"5000\" hdg=\"1\" length=\"100\"><line/></geometry>";
  return far.Text();
}

// The crossing as OpenDRIVE, and the same with a road far away behind or before all others.
std::shared_ptr<const network::Network> CrossingAnd(const std::string& before, const std::string& behind) {
  const auto map = traffic_map::LoadLaneMap(std::filesystem::path(SourceDir()) / "configs/maps/crossing.motors");
  std::string text = traffic_map::ToOpenDrive(map.value(), "crossing").value().xml;
  text.insert(text.find("<road "), before);
  text.insert(text.rfind("</OpenDRIVE>"), behind);
  return opendrive::MustRead(text);
}

using Lane = std::tuple<std::string, std::uint32_t, int>;  // road's id, section, lane

Lane LaneOf(const TrafficModel& model, std::uint32_t track) {
  const network::LaneKey& lane = model.graph()[track].lane;
  return {model.graph().network().roads()[lane.road].id(), lane.section, lane.lane};
}

// Flows on their lanes drive to the bit as before where a road far away is added to the network, and all that is saved
// of them is the same.
TEST(UnrelatedRoad, ChangesNothing) {
  const TrafficSettings settings = Settings(
      "routes: {off: [\"3\"]}\nflows:\n  - {lane: \"1:-1\", vehicles_per_h: 600, route: off}\n  - {lane: \"1:-2\", "
      "vehicles_per_h: 600}\n");
  TrafficModel a = TrafficModel::Make(settings, Exit(600.0), {}).value(),
               b = TrafficModel::Make(settings, Exit(600.0, FarRoad()), {}).value();
  ASSERT_LT(a.graph().tracks().size(), b.graph().tracks().size());
  for (int i = 0; i < 6000; ++i) {
    a.Step(kStep_s, {});
    b.Step(kStep_s, {});
    ASSERT_EQ(a.poses().size(), b.poses().size()) << i;
    for (std::size_t k = 0; k < a.poses().size(); ++k) {
      const AgentPose &one = a.poses()[k], &other = b.poses()[k];
      ASSERT_EQ(one.p_WB_W, other.p_WB_W) << i;
      ASSERT_EQ(one.q_WB.coeffs(), other.q_WB.coeffs()) << i;
      ASSERT_EQ(std::tie(one.id, one.trip, one.speed_mps, one.acceleration_mps2, one.steer_rad),
                std::tie(other.id, other.trip, other.speed_mps, other.acceleration_mps2, other.steer_rad))
          << i;
    }
    if (i % 100 == 0) {
      ASSERT_EQ(DigestOf(a), DigestOf(b)) << i;
    }
  }
  EXPECT_GT(a.ended(), 40u);
}

// Where so many vehicles share the whole network, or a flow comes from anywhere, a road far away, wherever it stands in
// the file, takes its share of the trips, within four deviations, and no other trip begins elsewhere than before.
TEST(UnrelatedRoad, TakesItsShareOfTheTripsAlone) {
  for (const std::string yaml : {"vehicles: 30\n", "vehicles: 30\nflows:\n  - {vehicles_per_h: 1200}\n"}) {
    const auto entries_of = [&](const std::shared_ptr<const network::Network>& network, bool by_arrival) {
      TrafficModel model = TrafficModel::Make(Settings(yaml, 4), network, {}).value();
      std::map<std::pair<std::uint32_t, std::uint32_t>, Lane> entries;  // by vehicle and trip, or by arrival
      for (int i = 0; i < 24000; ++i) {
        model.Step(kStep_s, {});
        for (std::uint32_t id = 0; id < model.vehicles(); ++id) {
          const Agent& agent = model.agent(id);
          if (by_arrival && agent.flow < 0) continue;
          entries[by_arrival ? std::pair{0u, agent.arrival} : std::pair{id, agent.trip}] = LaneOf(model, agent.entry);
        }
      }
      return entries;
    };
    const bool flows = yaml.find("flows") != std::string::npos;
    const auto alone = entries_of(CrossingAnd("", ""), flows);
    for (const auto& network : {CrossingAnd("", FarRoad()), CrossingAnd(FarRoad(), "")}) {
      double both = 0.0, far = 0.0;
      for (const auto& [trip, lane] : entries_of(network, flows)) {
        const auto found = alone.find(trip);
        if (found == alone.end()) continue;
        ++both;
        if (std::get<0>(lane) == "5000")
          ++far;
        else
          EXPECT_EQ(lane, found->second) << "vehicle " << trip.first << ", trip " << trip.second;
      }
      const double share = 2.0 / 6.0;  // of six entries
      EXPECT_GT(both, 200.0);
      EXPECT_NEAR(far, share * both, 4.0 * std::sqrt(both * share * (1.0 - share))) << yaml;
    }
  }
}

// A vehicle that meets no other drives each of its trips that still begin on the old roads as before, to the bit, from
// its first step to its last.
TEST(UnrelatedRoad, ChangesNoTripOfALoneVehicle) {
  using Step = std::tuple<double, double, double, double, double, double>;
  const auto trips_of = [](const std::shared_ptr<const network::Network>& network) {
    TrafficModel model = TrafficModel::Make(Settings("vehicles: 1\n", 2), network, {}).value();
    std::map<std::uint32_t, std::pair<Lane, std::vector<Step>>> trips;
    for (int i = 0; i < 24000; ++i) {
      model.Step(kStep_s, {});
      for (const AgentPose& pose : model.poses()) {
        auto& trip = trips[pose.trip];
        trip.first = LaneOf(model, model.agent(0).entry);
        trip.second.emplace_back(pose.p_WB_W.x(), pose.p_WB_W.y(), pose.p_WB_W.z(), pose.q_WB.z(), pose.speed_mps,
                                 pose.acceleration_mps2);
      }
    }
    trips.erase(0);  // where it begins depends on how long all lanes are together
    trips.erase(std::prev(trips.end()));
    return trips;
  };
  const auto alone = trips_of(CrossingAnd("", "")), more = trips_of(CrossingAnd("", FarRoad()));
  int same = 0;
  for (const auto& [trip, way] : more) {
    const auto found = alone.find(trip);
    if (found == alone.end() || std::get<0>(way.first) == "5000") continue;
    EXPECT_EQ(way.first, found->second.first);
    EXPECT_TRUE(way.second == found->second.second) << "trip " << trip;
    ++same;
  }
  EXPECT_GT(same, 15);
}

}  // namespace
}  // namespace rodeira::traffic
