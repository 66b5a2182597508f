// SPDX-License-Identifier: Apache-2.0
// What a scenario asks of single vehicles, and how soon the traffic answers to the driver's car: from the published
// samples.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>

#include "common/core/base/files.hpp"
#include "common/runtime/launch/launch.hpp"
#include "common/runtime/lockstep/in_process.hpp"
#include "idl/codec.hpp"
#include "idl/messages.hpp"
#include "idl/topics.hpp"
#include "launch/rodeira/run/local_nodes.hpp"
#include "tests/launch/rodeira/temporary_folder.hpp"
#include "tests/names.hpp"
#include "tests/tree.hpp"

namespace rodeira {
namespace {

using lockstep::Step;
namespace topics = idl::topics;

struct Driven {
  bool ok = false;
  std::string fault;
  std::map<Step, std::map<std::uint32_t, msg::TrafficAgent>> traffic;
  std::map<Step, msg::VehicleState> car;
};

class ScriptedTraffic : public testing::Test {
 protected:
  // On the level straight: the driver's car, the traffic, a scenario of these events.
  base::Result<launch::Launch> LaunchOf(const std::string& traffic, const std::string& events) {
    EXPECT_TRUE(base::WriteWhole(folder_.path() / "story.yaml", "rodeira: scenario/1\nevents:\n" + events).ok());
    const std::string text =
        "rodeira: launch/1\nworld: level.yaml\nseed: 5\nnodes:\n  road: {kind: road}\n"
        "  driver: {kind: input, config: {source: script, script: standing.csv}}\n  ego: {kind: vehicle, config: "
        "{vehicle: ../../configs/vehicles/default.yaml}}\n"
        "  others: {kind: traffic, config: " +
        traffic + "}\n  story: {kind: scenario, config: {scenario: \"" + (folder_.path() / "story.yaml").string() +
        "\"}}\n";
    return launch::Launch::Parse(text, std::filesystem::path(SourceDir()) / "tests/data/scripted_test.yaml");
  }
  Driven Drive(const std::string& traffic, const std::string& events, Step last) {
    Driven run;
    auto launch = LaunchOf(traffic, events);
    EXPECT_TRUE(launch.ok()) << launch.error().Text();
    if (!launch) return run;
    auto nodes = cli::LocalNodes::Make(launch.value());
    EXPECT_TRUE(nodes.ok()) << nodes.error().Text();
    if (!nodes) return run;
    lockstep::InProcessSettings settings;
    settings.last_step = last;
    settings.on_sample = [&](const lockstep::Sample& sample) {
      const auto& topic = launch.value().roster().source(sample.source()).topic;
      if (topic == topics::kVehicleState)
        run.car[sample.valid()] = idl::Decode<msg::VehicleState>(*sample.payload).value();
      if (topic != topics::kTrafficState) return;
      auto& agents = run.traffic[sample.valid()];
      const auto state = idl::Decode<msg::TrafficState>(*sample.payload).value();
      for (const msg::TrafficAgent& agent : state.agents()) agents[agent.id()] = agent;
    };
    const auto outcome = lockstep::RunThreaded(launch.value().roster(), nodes.value().nodes(), settings);
    run.ok = outcome.ok, run.fault = outcome.fault;
    return run;
  }
  const cli::TemporaryFolder folder_;
};

// Two appear at their steps, one behind the other; the second is told to overtake and does, back on its lane before the
// first.
TEST_F(ScriptedTraffic, AppearsAndOvertakesAsTheScenarioSays) {
  const Driven run =
      Drive("{vehicles: 0, scripted: [lorry, car], lane_changes: {overtaking: false}}",
            "  - {at_s: 0.02, name: vehicle.place, place: \"ego 500 300\", heading_deg: 0}\n"
            "  - {at_s: 1, name: traffic.appear, agent: 0, at: {lane: \"main:-1\", s_m: 150}, speed_mps: 10}\n"
            "  - {at_s: 1, name: traffic.appear, agent: 1, at: {lane: \"main:-1\", s_m: 110}, speed_mps: 10}\n"
            "  - {at_s: 1, name: traffic.speed, agent: 0, speed_mps: 10}\n"
            "  - {at_s: 3, name: traffic.overtake, agent: 1}\n",
            45'000);
  ASSERT_TRUE(run.ok) << run.fault;
  EXPECT_TRUE(run.traffic.at(1000).empty());
  ASSERT_EQ(run.traffic.at(1010).size(), 2u);  // the event of 1 s acts in the step from then on
  EXPECT_NEAR(run.traffic.at(1010).at(0).position_x_m(), 150.0, 1e-6);
  EXPECT_NEAR(run.traffic.at(1010).at(0).position_y_m(), -1.6, 1e-6);
  EXPECT_EQ(run.traffic.at(1010).at(0).speed_mps(), 10.0);
  EXPECT_EQ(run.traffic.at(1010).at(0).kind(), 2u);
  EXPECT_EQ(run.traffic.at(1010).at(1).kind(), 0u);
  bool over = false;
  std::optional<Step> past;
  for (const auto& [step, agents] : run.traffic) {
    if (agents.size() < 2) continue;
    if (step <= 3000) {
      EXPECT_LT(agents.at(1).position_y_m(), -1.5) << step;
    }
    over = over || agents.at(1).position_y_m() > 1.0;
    if (!past && agents.at(1).position_x_m() > agents.at(0).position_x_m() + 12.0) past = step;
  }
  EXPECT_TRUE(over);
  ASSERT_TRUE(past.has_value());
  EXPECT_LT(*past, 30'000);
}

// The example: all three appear, the car passes the lorry, the bus stands, and the lorry is on the other lane.
TEST_F(ScriptedTraffic, TheExampleDoesWhatItSays) {
  auto launch = launch::Launch::Load(std::filesystem::path(SourceDir()) / "launch/scripted.yaml",
                                     {{"nodes.recorder.kind", "none"}});
  ASSERT_TRUE(launch.ok()) << launch.error().Text();
  auto nodes = cli::LocalNodes::Make(launch.value());
  ASSERT_TRUE(nodes.ok()) << nodes.error().Text();
  std::map<std::uint32_t, double> last_x, least_mps;
  bool passed = false;
  lockstep::InProcessSettings settings;
  settings.last_step = 40'000;
  settings.on_sample = [&](const lockstep::Sample& sample) {
    if (launch.value().roster().source(sample.source()).topic != topics::kTrafficState) return;
    const auto state = idl::Decode<msg::TrafficState>(*sample.payload).value();
    for (const msg::TrafficAgent& agent : state.agents()) {
      if (agent.id() < 30) continue;
      last_x[agent.id()] = agent.position_x_m();
      least_mps[agent.id()] =
          least_mps.contains(agent.id()) ? std::min(least_mps[agent.id()], agent.speed_mps()) : agent.speed_mps();
    }
    passed = passed || (last_x.contains(30) && last_x[31] > last_x[30] + 10.0);
  };
  const auto outcome = lockstep::RunThreaded(launch.value().roster(), nodes.value().nodes(), settings);
  ASSERT_TRUE(outcome.ok) << outcome.fault;
  ASSERT_EQ(last_x.size(), 3u);
  EXPECT_TRUE(passed);
  EXPECT_EQ(least_mps[32], 0.0);
  EXPECT_GT(last_x[30], last_x[32]) << "the lorry is past the bus";
  EXPECT_GT(least_mps[30], 10.0);
}

// What the traffic can never do is wrong input before the first step, with its line in the scenario, however late it
// would act.
TEST_F(ScriptedTraffic, WhatCannotBeObeyedIsNamedBeforeTheRun) {
  const auto refused = [&](const std::string& event) -> std::string {
    auto launch = LaunchOf("{vehicles: 3, scripted: [car]}",
                           "  - {at_s: 1, name: traffic.release, agent: all}\n  - {" + event + "}\n");
    EXPECT_TRUE(launch.ok()) << launch.error().Text();
    const auto nodes = cli::LocalNodes::Make(launch.value());
    if (nodes.ok()) return "";
    EXPECT_EQ(nodes.error().code, base::ErrorCode::kWrongInput);
    return nodes.error().Text();
  };
  const std::string line = "node 'others': " + (folder_.path() / "story.yaml").string() + ":4: ";
  EXPECT_THAT(refused("at_s: 7200, name: traffic.appear, agent: 1, at: {lane: \"main:-1\", s_m: 500}, speed_mps: 3"),
              Names(line + "'traffic.appear': agent 1 … 'scripted' … 3 to 3"));
  EXPECT_NE(refused("at_s: 7200, name: traffic.appear, agent: 3, at: {lane: \"main:-2\", s_m: 500}, speed_mps: 3")
                .find("'main:-2' was found"),
            std::string::npos);
  EXPECT_THAT(refused("at_s: 7200, name: traffic.appear, agent: 3, at: {lane: \"main:-1\", s_m: 5e6}, speed_mps: 3"),
              Names("station 5000000 m … lane 'main:-1'"));
  EXPECT_EQ(refused("at_s: 7200, name: traffic.overtake, agent: 9"),
            line + "'traffic.overtake': there is no agent 9; there are 4, from 0 on");
  EXPECT_NE(refused("when: {road: main, passes_m: 200}, name: traffic.overtake, agent: 9").find("there is no agent 9"),
            std::string::npos);
  EXPECT_NE(refused("at_s: 7200, name: traffic.brake, agent: next, at: {road: mian, s_m: 200}, deceleration_mps2: 3")
                .find("did you mean 'main'?"),
            std::string::npos);
  EXPECT_NE(
      refused("at_s: 7200, name: traffic.pedestrian, crossing: main 200").find("the traffic has no people on foot"),
      std::string::npos);
  EXPECT_EQ(refused("at_s: 7200, name: traffic.appear, agent: 3, at: {lane: \"main:-1\", s_m: 500}, speed_mps: 3"), "");
}

// The driver's car is placed before a car of the traffic. That is in the sample of the step behind the event; the
// traffic sees it when it is next activated, and the sample of one period later says that the car brakes. Until then,
// to the bit, nothing is other than where it is not placed.
TEST_F(ScriptedTraffic, AnswersToTheDriversCarWithinOnePeriod) {
  constexpr Step kPeriod = 10;
  const std::string away =
      "  - {at_s: 0.02, name: vehicle.place, place: \"ego 500 300\", heading_deg: 0}\n"
      "  - {at_s: 0.5, name: traffic.appear, agent: 0, at: {lane: \"main:-1\", s_m: 150}, speed_mps: 17}\n";
  const Driven without = Drive("{vehicles: 0, scripted: [car]}", away, 6000);
  const Driven with =
      Drive("{vehicles: 0, scripted: [car]}",
            away + "  - {at_s: 4, name: vehicle.place, place: \"ego 255 -1.6\", heading_deg: 0}\n", 6000);
  ASSERT_TRUE(without.ok && with.ok) << without.fault << with.fault;
  Step placed = 0;
  for (const auto& [step, car] : with.car) {
    if (car.position_w_m().x() != without.car.at(step).position_w_m().x()) {
      placed = step;
      break;
    }
  }
  ASSERT_GT(placed, 4000);
  ASSERT_LE(placed, 4001);
  const Step answers = (placed + kPeriod - 1) / kPeriod * kPeriod + kPeriod;
  for (const auto& [step, agents] : with.traffic) {
    if (!agents.contains(0)) continue;
    const msg::TrafficAgent &one = agents.at(0), &other = without.traffic.at(step).at(0);
    if (step < answers) {
      ASSERT_EQ(one.position_x_m(), other.position_x_m()) << step;
      ASSERT_EQ(one.acceleration_mps2(), other.acceleration_mps2()) << step;
    } else {
      ASSERT_LT(one.acceleration_mps2(), other.acceleration_mps2() - 0.02F) << step;
      if (step > answers + 1000) break;
    }
  }
  ASSERT_TRUE(with.traffic.contains(answers));
}

}  // namespace
}  // namespace rodeira
