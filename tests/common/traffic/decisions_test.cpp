// SPDX-License-Identifier: Apache-2.0
// Drivers that decide every `decide_s` and not in every step.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "common/traffic/results/study.hpp"
#include "common/traffic/traffic_model.hpp"
#include "tests/common/traffic/demand_road.hpp"
#include "tests/common/traffic/digest_of.hpp"
#include "tests/common/traffic/identical.hpp"
#include "tests/common/traffic/ring.hpp"
#include "tests/common/world/lanes/lane_networks.hpp"
#include "tests/common/world/opendrive/sample.hpp"

namespace rodeira::traffic {
namespace {

TrafficModel One(double decide_s) {
  TrafficSettings settings = Identical(1, 1.4);
  settings.decide_s = decide_s;
  return TrafficModel::Make(settings, Ring(600.0), {}).value();
}

// With the period of the steps, or less, the model is the one that decides in every step, to the bit.
TEST(Decisions, InEveryStepAreTheModelWithoutThem) {
  constexpr double kStep_s = 0.05;
  for (const char* map : {"lights", "town", "ramp"}) {
    const auto network = lanes::MapNetwork(map);
    TrafficSettings settings;
    settings.vehicles = 60;
    TrafficModel plain = TrafficModel::Make(settings, network, {}).value();
    settings.decide_s = kStep_s;
    TrafficModel decides = TrafficModel::Make(settings, network, {}).value();
    for (int i = 0; i < 2400; ++i) {
      plain.Step(kStep_s, {}), decides.Step(kStep_s, {});
      ASSERT_EQ(plain.poses().size(), decides.poses().size());
      for (std::size_t k = 0; k < plain.poses().size(); ++k) {
        const AgentPose &a = plain.poses()[k], &b = decides.poses()[k];
        ASSERT_EQ(a.p_WB_W, b.p_WB_W) << map << ": " << i;
        ASSERT_EQ(std::tie(a.id, a.trip, a.speed_mps, a.acceleration_mps2),
                  std::tie(b.id, b.trip, b.speed_mps, b.acceleration_mps2))
            << map << ": " << i;
      }
    }
  }
}

// Alone on a road, a driver that accelerates wants another acceleration in every step; with `decide_s` in every tenth.
TEST(Decisions, AreKeptMeanwhile) {
  const auto changes = [](double decide_s) {
    TrafficModel model = One(decide_s);
    model.Brake(0, 2.0);
    for (int i = 0; i < 600; ++i) model.Step(0.01, {});
    model.Release(0);
    for (int i = 0; i < 200; ++i) model.Step(0.01, {});
    int changed = 0;
    for (int i = 0; i < 1000; ++i) {
      const double before = model.poses()[0].acceleration_mps2;
      model.Step(0.01, {});
      changed += std::fabs(model.poses()[0].acceleration_mps2 - before) > 1e-9 ? 1 : 0;
    }
    return changed;
  };
  EXPECT_GT(changes(0.0), 900);
  const int kept = changes(0.1);
  EXPECT_GE(kept, 90);
  EXPECT_LE(kept, 150);
}

// A vehicle that stands, comes against it or brakes on its way is answered in the step in which it is seen first, and
// so is a command, at every moment between two decisions.
TEST(Decisions, EmergenciesDoNotWait) {
  constexpr double kStep_s = 0.01;
  TrafficModel model = One(1.0);
  for (int i = 0; i < 3000; ++i) model.Step(kStep_s, {});
  for (int moment = 0; moment < 100; moment += 7) {
    for (int i = 0; i < 7; ++i) model.Step(kStep_s, {});
    const Agent& agent = model.agent(0);
    const double d = agent.o_m - agent.path.back().zero_m + 30.0, length = model.graph()[0].length_m();
    const lanes::CurvePoint at = model.graph()[0].curve.At(d < length ? d : d - length);
    const double heading = std::atan2(at.ahead_W.y(), at.ahead_W.x());
    TrafficModel without = model;
    without.Step(kStep_s, {});
    const double plain = without.poses()[0].acceleration_mps2;
    for (const auto& [turned, speed] : {std::pair{0.0, 0.0}, std::pair{std::numbers::pi, 8.0}}) {
      TrafficModel with = model;
      const driver::Footprint other{9999, at.p_W.x(), at.p_W.y(), heading + turned, speed, 4.5, 1.8};
      with.Step(kStep_s, {&other, 1});
      EXPECT_LT(with.poses()[0].acceleration_mps2, plain - 0.02) << moment;
    }
    TrafficModel told = model;
    told.Brake(0, 3.0);
    told.Step(kStep_s, {});
    EXPECT_LT(told.poses()[0].acceleration_mps2, plain - 0.02) << moment;
    TrafficModel slower = model;
    slower.CapSpeed(0, 5.0);
    slower.Step(kStep_s, {});
    EXPECT_LT(slower.poses()[0].acceleration_mps2, plain - 0.02) << moment;
  }
}

// Two cars that follow each other: the first one brakes hard. Decided twice a second, the second one keeps as far from
// it as one that decides in every step, within a metre.
TEST(Decisions, ALeaderThatBrakesHardIsAnsweredAtOnce) {
  const auto least_gap = [](double decide_s) {
    TrafficSettings settings = Identical(2, 1.4);
    settings.decide_s = decide_s;
    TrafficModel model = TrafficModel::Make(settings, Ring(300.0), {}).value();
    for (int i = 0; i < 6000; ++i) model.Step(0.01, {});
    const std::uint32_t first = model.GapAhead(0) < model.GapAhead(1) ? 1 : 0;
    model.Brake(first, 7.5);
    double least = 1e9;
    for (int i = 0; i < 1500; ++i) {
      model.Step(0.01, {});
      least = std::min(least, model.GapAhead(1 - first));
    }
    return least;
  };
  const double in_every_step = least_gap(0.0);
  EXPECT_GT(in_every_step, 1.0);
  for (const double decide_s : {0.1, 0.5}) EXPECT_GT(least_gap(decide_s), in_every_step - 1.0) << decide_s;
}

// What is looked for every tenth of a second alone is part of the state, whenever it is saved between, and no number of
// threads changes it.
TEST(Decisions, GoOnBetweenTwoLooksWithTheSameBits) {
  constexpr double kStep_s = 0.01;
  for (const char* map : {"lights", "ramp"}) {
    const auto network = lanes::MapNetwork(map);
    TrafficSettings settings;
    settings.vehicles = 40, settings.decide_s = 0.1;
    TrafficModel whole = TrafficModel::Make(settings, network, {}).value();
    settings.threads = 2;
    TrafficModel other = TrafficModel::Make(settings, network, {}).value();
    for (int i = 0; i < 6000; ++i) {
      if (i % 777 == 776) {
        base::StateWriter writer;
        whole.Save(writer);
        base::StateReader reader(writer.bytes());
        other.Restore(reader);
        ASSERT_TRUE(reader.Finish().ok());
      }
      whole.Step(kStep_s, {}), other.Step(kStep_s, {});
      ASSERT_EQ(DigestOf(whole), DigestOf(other)) << map << ": " << i;
    }
  }
}

// A light that turns to amber between two looks takes back reservations before the next one, of those that can stop.
TEST(Decisions, LightsDoNotWait) {
  constexpr double kStep_s = 0.01;
  TrafficSettings settings;
  settings.vehicles = 40, settings.decide_s = 0.1;
  TrafficModel model = TrafficModel::Make(settings, lanes::MapNetwork("lights"), {}).value();
  int obeyed = 0, brake = 0;
  for (int i = 1; i <= 12000; ++i) {
    model.Step(kStep_s, {});
    if (i % 100 != 2) continue;  // the next look is in the ninth step from now
    for (const network::Controller& controller : model.graph().network().controllers()) {
      TrafficModel held = model, free = model;
      if (!held.HoldLight(controller.id, network::LightColour::kRed, 30.0)) continue;
      for (int k = 0; k < 3; ++k) held.Step(kStep_s, {}), free.Step(kStep_s, {});
      for (const AgentPose& pose : model.poses()) {
        if (held.agent(pose.id).granted_m >= free.agent(pose.id).granted_m) continue;
        ++obeyed;
        brake += held.agent(pose.id).desired_mps2 < free.agent(pose.id).desired_mps2 ? 1 : 0;
      }
    }
  }
  EXPECT_GT(obeyed, 3);
  EXPECT_GT(brake, 3);
}

// Nothing is hit and no red is crossed, and as much is driven as with decisions in every step.
TEST(Decisions, HitNothingAndPassNoRed) {
  std::map<double, double> driven_km;  // on all maps, by decide_s
  for (const char* map : {"lights", "town", "roundabout", "ramp"}) {
    const auto network = lanes::MapNetwork(map);
    for (const double decide_s : {0.0, 0.1, 0.5}) {
      StudySettings study;
      study.traffic.vehicles = 40, study.traffic.decide_s = decide_s;
      study.duration_s = 300.0, study.step_s = 0.02;
      const StudyResult result = RunStudy(study, network).value();
      EXPECT_EQ(result.collisions, 0) << map << ", " << decide_s;
      EXPECT_EQ(result.reds, 0) << map << ", " << decide_s;
      EXPECT_EQ(result.wheels_off, 0) << map << ", " << decide_s;
      if (decide_s <= 0.1) {
        EXPECT_LT(result.max_deceleration_mps2, 4.0) << map << ", " << decide_s;
      }
      driven_km[decide_s] += result.driven_km;
    }
  }
  for (const auto& [decide_s, way_km] : driven_km)
    EXPECT_NEAR(way_km, driven_km[0.0], 0.03 * driven_km[0.0]) << decide_s;
}

// The times of decisions depend on a flow's own vehicles alone: a road far away with traffic of its own changes
// nothing.
TEST(Decisions, OfOneRoadDependOnNoOther) {
  opendrive::RoadText far;
  far.id = "5000";
  far.length = 400.0;
  far.geometry = "<geometry s=\"0\" x=\"5000\" y=\"5000\" hdg=\"1\" length=\"400\"><line/></geometry>";
  const std::string alone =
      "decide_s: 0.3\nreaction_s: 0.2\nlane_changes: {allowed: false}\nflows:\n"
      "  - {lane: '1:-1', vehicles_per_h: 900}\n";
  TrafficModel a = TrafficModel::Make(Settings(alone), Exit(500.0), {}).value(),
               b = TrafficModel::Make(Settings(alone + "  - {lane: '5000:-1', vehicles_per_h: 1200}\n"),
                                      Exit(500.0, far.Text()), {})
                       .value();
  using Place = std::tuple<double, double, double, double>;
  const auto places = [](const TrafficModel& model) {
    std::map<std::uint32_t, Place> of_first;  // by arrival
    for (const AgentPose& pose : model.poses()) {
      if (model.agent(pose.id).flow == 0)
        of_first[model.agent(pose.id).arrival] = {pose.p_WB_W.x(), pose.p_WB_W.y(), pose.speed_mps,
                                                  pose.acceleration_mps2};
    }
    return of_first;
  };
  std::size_t others = 0;
  for (int i = 0; i < 8000; ++i) {
    a.Step(0.05, {}), b.Step(0.05, {});
    ASSERT_EQ(places(a), places(b)) << i;
    others += b.poses().size() - a.poses().size();
  }
  EXPECT_GT(a.ended(), 40u);
  EXPECT_GT(others, 8000u);
}

}  // namespace
}  // namespace rodeira::traffic
