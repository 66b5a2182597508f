// SPDX-License-Identifier: Apache-2.0
// What a node outside asks of vehicles while a run goes: done as asked, or refused with a reason and nothing changed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "common/traffic/traffic_requests.hpp"
#include "common/world/road/world.hpp"
#include "tests/common/driving/driver/test_road.hpp"
#include "tests/common/traffic/demand_road.hpp"
#include "tests/common/traffic/digest_of.hpp"
#include "tests/common/traffic/scripted.hpp"
#include "tests/common/world/lanes/lane_networks.hpp"
#include "tests/tree.hpp"

namespace rodeira::traffic {
namespace {

TrafficRequest Asks(const std::string& name, std::uint32_t agent) {
  TrafficRequest request;
  request.name = name, request.agent = agent;
  return request;
}
TrafficRequest Speed(std::uint32_t agent, double speed_mps) {
  TrafficRequest request = Asks("speed", agent);
  request.speed_mps = speed_mps;
  return request;
}
TrafficRequest Lane(std::uint32_t agent, const std::string& lane) {
  TrafficRequest request = Asks("change_lane", agent);
  request.lane = lane;
  return request;
}
TrafficRequest Roads(std::uint32_t agent, const std::vector<std::string>& roads) {
  TrafficRequest request = Asks("route", agent);
  request.roads = roads;
  return request;
}
TrafficRequest Car(const std::string& lane, double station_m, double speed_mps,
                   const std::vector<std::string>& roads = {}) {
  TrafficRequest request = Asks("add", 0);
  request.choice = "car", request.lane = lane, request.station_m = station_m, request.speed_mps = speed_mps;
  request.roads = roads;
  return request;
}

TrafficAnswer Done(TrafficModel& model, const TrafficRequest& request) {
  TrafficAnswer answer = Answer(model, request);
  EXPECT_FALSE(answer.refusal) << answer.refusal->message;
  return answer;
}

// The id of a refusal that has left the model's state as it was.
std::string Refusal(TrafficModel& model, const TrafficRequest& request) {
  const base::Digest before = DigestOf(model);
  const TrafficAnswer answer = Answer(model, request);
  EXPECT_EQ(DigestOf(model), before) << request.name;
  if (!answer.refusal) return "";
  EXPECT_TRUE(answer.refusal->message.starts_with("request '" + request.name + "': ")) << answer.refusal->message;
  return std::string(answer.refusal->id.text());
}

// Lanes of road 1, -1 on the left, go on into roads 2 and 3. Vehicles change lanes of themselves for their routes.
TrafficModel OnExit(std::size_t cars, bool changes_lanes = true) {
  TrafficSettings settings = OnlyScripted(std::vector<VehicleKind>(cars, kCar));
  settings.changes_lanes = changes_lanes;
  return TrafficModel::Make(settings, Exit(1000.0), {}).value();
}
std::string RoadOf(const TrafficModel& model, std::uint32_t id) {
  const AgentPose* pose = PoseOf(model, id);
  return pose == nullptr ? "" : model.graph().network().roads()[static_cast<std::size_t>(pose->road)].id();
}

TEST(TrafficRequests, ASpeedIsHeldUntilItIsReleased) {
  TrafficModel model = TrafficModel::Make(OnlyScripted({kCar}), driver::StraightWorld(4000.0, 20.0), {}).value();
  const std::uint32_t id = Done(model, Car("test:-1", 300.0, 15.0)).agent;
  Step(model, 500);
  EXPECT_GT(PoseOf(model, id)->speed_mps, 15.0);
  Done(model, Speed(id, 9.0));
  Step(model, 1500);
  EXPECT_NEAR(PoseOf(model, id)->speed_mps, 9.0, 0.05);
  Done(model, Speed(id, 0.0));
  Step(model, 1000);
  const Eigen::Vector3d rest = PoseOf(model, id)->p_WB_W;
  Step(model, 500);
  EXPECT_EQ((PoseOf(model, id)->p_WB_W - rest).norm(), 0.0);
  Done(model, Speed(id, 6.0));  // it goes on
  Step(model, 1500);
  EXPECT_NEAR(PoseOf(model, id)->speed_mps, 6.0, 0.05);
  Done(model, Asks("release", id));
  Step(model, 1500);
  EXPECT_NEAR(PoseOf(model, id)->speed_mps, 20.0, 0.5);
}

TEST(TrafficRequests, ALaneIsChangedToASideOrToItsNumber) {
  TrafficModel model = OnExit(1, false);
  const std::uint32_t id = Done(model, Car("1:-1", 100.0, 15.0)).agent;
  Step(model);
  EXPECT_EQ(Refusal(model, Lane(id, "left")), "traffic.no_lane_beside");
  EXPECT_EQ(Refusal(model, Lane(id, "-3")), "traffic.no_lane_beside");
  EXPECT_EQ(Refusal(model, Lane(id, "middle")), "traffic.wrong_request");
  EXPECT_EQ(Refusal(model, Lane(id, "-1")), "") << "it is there";
  Done(model, Lane(id, "right"));
  Step(model, 500);
  EXPECT_EQ(PoseOf(model, id)->lane, -2);
  Done(model, Lane(id, "-1"));
  Step(model, 500);
  EXPECT_EQ(PoseOf(model, id)->lane, -1);
}

// Both roads, from both lanes; the roads that are ahead are said, before and after.
TEST(TrafficRequests, ARouteIsDriven) {
  for (const std::string lane : {"1:-1", "1:-2"}) {
    for (const std::string to : {"2", "3"}) {
      TrafficModel model = OnExit(1);
      const std::uint32_t id = Done(model, Car(lane, 100.0, 15.0)).agent;
      Step(model);
      const TrafficAnswer before = Done(model, Asks("ask", id));
      EXPECT_EQ(before.lane, lane);
      EXPECT_NEAR(before.station_m, 100.0, 1e-6);
      EXPECT_EQ(before.roads, (std::vector<std::string>{"1", lane == "1:-1" ? "2" : "3"}));
      Done(model, Roads(id, {to}));
      EXPECT_EQ(Done(model, Asks("ask", id)).roads, (std::vector<std::string>{"1", to}));
      std::set<std::string> driven;
      for (int i = 0; i < 6000 && model.on_road() > 0; ++i) {
        Step(model);
        driven.insert(RoadOf(model, id));
      }
      driven.erase("");
      EXPECT_EQ(driven, (std::set<std::string>{"1", to})) << lane;
      ASSERT_EQ(model.leavers().size(), 1u);
      EXPECT_EQ(model.leavers()[0].reason, LeaveReason::kRouteEnd);
    }
  }
}

TEST(TrafficRequests, AVehicleIsAddedWithARouteWhileOneIsLeft) {
  TrafficModel model = OnExit(2);
  EXPECT_EQ(Refusal(model, Car("2:-1", 100.0, 10.0, {"3"})), "traffic.no_way");
  EXPECT_EQ(Refusal(model, Car("2:-1", 100.0, 10.0, {"nowhere"})), "world.unknown_lane");
  EXPECT_EQ(Refusal(model, Car("2:-1", 1e4, 10.0)), "traffic.off_the_lane");
  EXPECT_EQ(Refusal(model, Car("2:-1", 0.5, 10.0)), "traffic.no_room");
  EXPECT_EQ(Refusal(model, Car("2:-1", 100.0, -1.0)), "traffic.wrong_request");
  TrafficRequest bus = Car("2:-1", 100.0, 10.0);
  bus.choice = "bus";
  EXPECT_EQ(Refusal(model, bus), "traffic.not_scripted");
  bus.choice = "tram";
  EXPECT_EQ(Refusal(model, bus), "traffic.wrong_request");
  EXPECT_EQ(Done(model, Car("1:-1", 100.0, 10.0, {"3"})).agent, 0u);
  EXPECT_EQ(Done(model, Car("1:-1", 200.0, 12.0, {"2"})).agent, 1u);
  EXPECT_EQ(Refusal(model, Car("1:-1", 300.0, 12.0)), "traffic.not_scripted");
  Step(model);
  ASSERT_EQ(model.on_road(), 2u);
  EXPECT_NEAR(PoseOf(model, 0)->p_WB_W.x(), 100.0, 1e-6);
  EXPECT_EQ(PoseOf(model, 0)->speed_mps, 10.0);
  EXPECT_EQ(PoseOf(model, 1)->speed_mps, 12.0);
  std::map<std::uint32_t, std::string> last;
  for (int i = 0; i < 6000 && model.on_road() > 0; ++i) {
    Step(model);
    for (const AgentPose& pose : model.poses()) last[pose.id] = RoadOf(model, pose.id);
  }
  EXPECT_EQ(last, (std::map<std::uint32_t, std::string>{{0, "3"}, {1, "2"}}));
  EXPECT_EQ(Done(model, Car("1:-1", 300.0, 12.0)).agent, 0u) << "it has left, and is there to be added again";
}

// Of a closed population one leaves by its own reason and never comes back; the others stay.
TEST(TrafficRequests, ARemovedVehicleIsGone) {
  TrafficSettings settings;
  settings.vehicles = 20;
  TrafficModel model = TrafficModel::Make(settings, lanes::MapNetwork("town"), {}).value();
  Step(model, 100);
  const std::size_t there = model.on_road();
  const std::uint32_t id = model.poses()[3].id;
  Done(model, Asks("remove", id));
  Step(model);
  ASSERT_EQ(model.leavers().size(), 1u);
  EXPECT_EQ(model.leavers()[0].id, id);
  EXPECT_EQ(model.leavers()[0].reason, LeaveReason::kRemoved);
  EXPECT_EQ(PoseOf(model, id), nullptr);
  EXPECT_EQ(model.on_road() + model.waiting(), 19u);
  EXPECT_GE(model.on_road() + 1, there);
  EXPECT_EQ(model.ended(), 0u);
  EXPECT_EQ(Refusal(model, Asks("remove", id)), "traffic.not_on_road");
  EXPECT_EQ(Refusal(model, Speed(id, 3.0)), "traffic.not_on_road");
  for (int i = 0; i < 50 * 200; ++i) {
    Step(model);
    ASSERT_EQ(PoseOf(model, id), nullptr);
    ASSERT_EQ(model.on_road() + model.waiting(), 19u);
  }
  EXPECT_GT(model.ended(), 10u) << "the others go on";
}

TEST(TrafficRequests, AWreckAndAVehicleThatWaitsToAppearAreRemoved) {
  TrafficModel model = TrafficModel::Make(OnlyScripted({kCar, kCar}), driver::StraightWorld(2000.0, 20.0), {}).value();
  Done(model, Car("test:-1", 500.0, 0.0));
  Step(model);
  model.Strike(0, {0.0, 500.0}, PoseOf(model, 0)->p_WB_W.head<2>());
  Done(model, Car("test:-1", 503.0, 0.0));
  Step(model);
  ASSERT_TRUE(model.agent(0).is_crashed);
  ASSERT_TRUE(model.IsSpawning(1));
  EXPECT_EQ(Refusal(model, Speed(0, 5.0)), "traffic.not_on_road");
  Done(model, Asks("remove", 1));
  Step(model);
  EXPECT_FALSE(model.IsSpawning(1));
  EXPECT_TRUE(model.leavers().empty()) << "it has never been on the road";
  Done(model, Asks("remove", 0));
  Done(model, Asks("remove", 0));
  Step(model);
  EXPECT_EQ(model.on_road(), 0u);
  ASSERT_EQ(model.leavers().size(), 1u);
  EXPECT_EQ(model.leavers()[0].reason, LeaveReason::kRemoved);
}

// In a town, over and over: vehicles that have reserved their way keep to it, others go where they are told. No vehicle
// touches another, and each that was told comes to its road.
TEST(TrafficRequests, RoutesAtJunctionsAreDrivenOrRefusedAndNoVehicleIsTouched) {
  TrafficSettings settings;
  settings.vehicles = 30;
  settings.changes_lanes = settings.overtaking.allowed = false;
  TrafficModel model = TrafficModel::Make(settings, lanes::MapNetwork("town"), {}).value();
  std::map<std::uint32_t, std::pair<std::uint32_t, std::string>> told;  // trip and road
  int done = 0, not_now = 0, driven = 0, missed = 0;
  for (int i = 0; i < 50 * 120; ++i) {
    for (std::uint32_t id = static_cast<std::uint32_t>(i % 7); id < settings.vehicles; id += 7) {
      const Agent& agent = model.agent(id);
      if (!agent.on_road || told.contains(id)) continue;
      const auto& links = model.graph()[agent.path.back().track].next;
      if (links.size() < 2) continue;
      const std::uint32_t track = links[static_cast<std::size_t>(i) % links.size()].to;
      const std::uint32_t beyond = model.graph()[track].next.empty() ? track : model.graph()[track].next[0].to;
      const std::string to = model.graph().network().roads()[model.graph()[beyond].lane.road].id();
      TrafficModel fresh = model;
      const TrafficAnswer answer = Answer(fresh, Roads(id, {to}));
      if (answer.refusal) {
        EXPECT_EQ(answer.refusal->id.text(), "traffic.not_now") << answer.refusal->message;
        EXPECT_EQ(DigestOf(fresh), DigestOf(model));
        ++not_now;
        continue;
      }
      Done(model, Roads(id, {to}));
      told[id] = {agent.trip, to};
      ++done;
    }
    Step(model);
    for (auto at = told.begin(); at != told.end();) {
      const Agent& agent = model.agent(at->first);
      if (!agent.on_road || agent.trip != at->second.first) {
        ++missed;
        at = told.erase(at);
      } else if (RoadOf(model, at->first) == at->second.second) {
        ++driven;
        at = told.erase(at);
      } else {
        ++at;
      }
    }
    for (std::size_t a = 0; a < model.poses().size(); ++a) {
      for (std::size_t b = a + 1; b < model.poses().size(); ++b) {
        const AgentPose &one = model.poses()[a], &other = model.poses()[b];
        if ((one.p_WB_W - other.p_WB_W).norm() > 12.0) continue;
        ASSERT_FALSE(
            driver::Overlap(FootprintOf(one, model.traits(one.id)), FootprintOf(other, model.traits(other.id))))
            << one.id << " and " << other.id << " at " << i * kStep_s;
      }
    }
  }
  EXPECT_GT(done, 50);
  EXPECT_GT(not_now, 10);
  EXPECT_EQ(missed, 0);
  EXPECT_GT(driven, 40);
}

TEST(TrafficRequests, WhatCannotBeIsRefusedAndChangesNothing) {
  TrafficModel model = OnExit(2);
  const std::uint32_t id = Done(model, Car("1:-1", 100.0, 15.0)).agent;
  Step(model, 50);
  TrafficModel without = model;
  EXPECT_EQ(Refusal(model, Asks("sped", id)), "traffic.unknown_request");
  EXPECT_NE(Answer(model, Asks("sped", id)).refusal->message.find("did you mean 'speed'?"), std::string::npos);
  EXPECT_EQ(Refusal(model, Asks("ask", 99)), "traffic.unknown_agent");
  EXPECT_EQ(Refusal(model, Asks("remove", 99)), "traffic.unknown_agent");
  EXPECT_EQ(Refusal(model, Asks("ask", 1)), "traffic.not_on_road");
  EXPECT_EQ(Refusal(model, Speed(id, -1.0)), "traffic.wrong_request");
  EXPECT_EQ(Refusal(model, Speed(id, std::nan(""))), "traffic.wrong_request");
  EXPECT_EQ(Refusal(model, Roads(id, {})), "traffic.wrong_request");
  EXPECT_EQ(Refusal(model, Roads(id, std::vector<std::string>(101, "2"))), "traffic.wrong_request");
  EXPECT_EQ(Refusal(model, Roads(id, {"22"})), "world.unknown_lane");
  EXPECT_EQ(Refusal(model, Roads(id, {"3", "2"})), "traffic.no_way");
  EXPECT_EQ(Refusal(model, Asks("light", 0)), "traffic.wrong_request");
  for (int i = 0; i < 1000; ++i) {
    Step(model), Step(without);
    ASSERT_EQ(DigestOf(model), DigestOf(without)) << i;
  }
}

// Held speeds, routes of vehicles on the road and of one that waits to appear, a change of lanes that has not begun,
// after a removal.
TEST(TrafficRequests, RestoredInTheMiddleOfRequestsItGoesOnWithTheSameBits) {
  const auto made = [] { return OnExit(6); };
  TrafficModel model = made();
  Done(model, Car("1:-1", 500.0, 0.0));
  Step(model);
  Done(model, Speed(0, 0.0));
  Done(model, Car("1:-1", 502.0, 0.0, {"3"}));  // waits for room
  Done(model, Car("1:-2", 300.0, 15.0, {"2"}));
  Done(model, Car("1:-2", 200.0, 15.0));
  Done(model, Car("1:-1", 600.0, 15.0));
  Step(model);
  Done(model, Roads(4, {"1:-2", "3"}));
  Done(model, Speed(3, 8.0));
  Done(model, Car("1:-1", 150.0, 5.0));
  Step(model);
  Done(model, Asks("remove", 5));
  Done(model, Lane(3, "left"));
  Step(model, 20);
  ASSERT_TRUE(model.IsSpawning(1));
  base::StateWriter out;
  model.Save(out);
  TrafficModel restored = made();
  base::StateReader in(out.bytes());
  restored.Restore(in);
  ASSERT_TRUE(in.Finish().ok());
  std::map<std::uint32_t, std::string> last;
  for (int i = 0; i < 8000; ++i) {
    if (i == 500) Done(model, Asks("release", 0)), Done(restored, Asks("release", 0));
    Step(model), Step(restored);
    ASSERT_EQ(DigestOf(model), DigestOf(restored)) << i;
    for (const AgentPose& pose : model.poses()) last[pose.id] = RoadOf(model, pose.id);
  }
  EXPECT_EQ(last.at(1), "3");
  EXPECT_EQ(last.at(2), "2");
  EXPECT_EQ(last.at(4), "3");
}

}  // namespace
}  // namespace rodeira::traffic
