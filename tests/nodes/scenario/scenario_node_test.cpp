// SPDX-License-Identifier: Apache-2.0
// Scenario events in runs of one process: at their exact step, to all nodes, with what the traffic makes of them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <map>
#include <optional>

#include "common/core/base/files.hpp"
#include "common/runtime/launch/launch.hpp"
#include "common/runtime/lockstep/in_process.hpp"
#include "common/world/road/world.hpp"
#include "idl/codec.hpp"
#include "idl/messages.hpp"
#include "idl/topics.hpp"
#include "launch/rodeira/run/local_nodes.hpp"
#include "tests/n222.hpp"
#include "tests/names.hpp"

namespace rodeira {
namespace {

using lockstep::Step;
namespace topics = idl::topics;

struct Driven {
  lockstep::RunOutcome outcome;
  std::map<Step, std::vector<msg::ScenarioEvent>> events;  // of each sample that holds some
  std::map<Step, msg::TrafficState> traffic;
  std::map<Step, msg::VehicleState> car;  // each 10 steps
  std::vector<lockstep::Snapshot> snapshots;
};

class Scenario : public testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string File(const std::string& events) const {
    const auto path = folder_ / "scenario.yaml";
    EXPECT_TRUE(base::WriteWhole(path, std::string_view("rodeira: scenario/1\nevents:\n" + events)).ok());
    return path.string();
  }
  // N222 with the autopilot and traffic; `traffic` and `scenario` are further keys of the nodes.
  static std::string Text(const std::string& scenario_file, const std::string& traffic = "",
                          const std::string& scenario = "") {
    return "rodeira: launch/1\nworld: ../configs/worlds/n222.yaml\nseed: 5\nnodes:\n  road: {kind: road}\n"
           "  driver: {kind: input, config: {source: autopilot, driver: ../configs/drivers/default.yaml, vehicle: "
           "../configs/vehicles/default.yaml}}\n"
           "  ego: {kind: vehicle, config: {vehicle: ../configs/vehicles/default.yaml}}\n"
           "  others: {kind: traffic, config: {vehicles: 20}" +
           traffic +
           "}\n"
           "  story: {kind: scenario, config: {scenario: " +
           scenario_file + "}" + scenario + "}\n";
  }
  static launch::Launch LaunchOf(const std::string& text) {
    auto launch = launch::Launch::Parse(text, std::filesystem::path(SourceDir()) / "launch/story.yaml");
    EXPECT_TRUE(launch.ok()) << launch.error().Text();
    return std::move(launch).value();
  }
  static Driven Drive(const launch::Launch& launch, Step last, Step snapshot_every = 0) {
    auto nodes = cli::LocalNodes::Make(launch);
    EXPECT_TRUE(nodes.ok()) << nodes.error().Text();
    Driven run;
    lockstep::InProcessSettings settings;
    settings.last_step = last;
    settings.snapshot_every = snapshot_every;
    run.snapshots.resize(launch.roster().nodes().size());
    settings.on_snapshot = [&](const lockstep::Snapshot& snapshot) {
      if (snapshot.at == snapshot_every) run.snapshots[snapshot.node] = snapshot;
    };
    settings.on_sample = [&](const lockstep::Sample& sample) {
      const auto& topic = launch.roster().source(sample.source()).topic;
      if (topic == topics::kScenarioEvents) {
        const auto events = idl::Decode<msg::ScenarioEvents>(*sample.payload).value();
        if (!events.events().empty()) run.events[sample.valid()] = events.events();
      } else if (topic == topics::kTrafficState) {
        run.traffic[sample.valid()] = idl::Decode<msg::TrafficState>(*sample.payload).value();
      } else if (topic == topics::kVehicleState && sample.valid() % 10 == 0) {
        run.car[sample.valid()] = idl::Decode<msg::VehicleState>(*sample.payload).value();
      }
    };
    run.outcome = lockstep::RunThreaded(launch.roster(), nodes.value().nodes(), settings);
    return run;
  }
  static std::optional<msg::TrafficAgent> Agent(const Driven& run, Step step, std::uint32_t id) {
    for (const msg::TrafficAgent& agent : run.traffic.at(step).agents()) {
      if (agent.id() == id) return agent;
    }
    return std::nullopt;
  }
  static std::string Complaint(const std::string& text) {
    const launch::Launch launch = LaunchOf(text);
    const auto nodes = cli::LocalNodes::Make(launch);
    if (nodes.ok()) return {};
    EXPECT_EQ(nodes.error().exit_status(), 2);
    return nodes.error().Text();
  }
  // An agent that drives far from anything that could disturb it, at `step` of an undisturbed run.
  static std::uint32_t SomeAgent(const Driven& run, Step step) {
    for (const msg::TrafficAgent& agent : run.traffic.at(step).agents()) {
      if (agent.speed_mps() > 12.0 && std::fabs(agent.acceleration_mps2()) < 1.0F) return agent.id();
    }
    ADD_FAILURE() << "nobody drives";
    return 0;
  }

  const std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("rodeira-scenario-" + std::to_string(::getpid()));
};

// Valid at exactly 2 s; the traffic's activation at 2 s sees it, and its sample of 2.01 s brakes: v(t) = v0 - a t to
// rest.
TEST_F(Scenario, AnAgentBrakesFromExactlyItsStepToRestAndDrivesOn) {
  const Driven calm = Drive(LaunchOf(Text(File("  - {at_s: 0.5, name: mark, text: nothing}\n"))), 2100);
  ASSERT_TRUE(calm.outcome.ok) << calm.outcome.fault;
  const std::uint32_t id = SomeAgent(calm, 2000);
  const std::string agent = std::to_string(id);
  const Driven run = Drive(
      LaunchOf(Text(File("  - {at_s: 2, name: traffic.brake, agent: " + agent +
                         ", deceleration_mps2: 5}\n  - {at_s: 8, name: traffic.release, agent: " + agent + "}\n"))),
      12000);
  ASSERT_TRUE(run.outcome.ok) << run.outcome.fault;
  ASSERT_EQ(run.events.size(), 2u);
  ASSERT_TRUE(run.events.contains(2000) && run.events.contains(8000));
  EXPECT_EQ(run.events.at(2000)[0].name(), "traffic.brake");
  for (Step step = 0; step <= 2000; step += 10) {
    EXPECT_EQ(Agent(run, step, id)->speed_mps(), Agent(calm, step, id)->speed_mps()) << "not before its time: " << step;
  }
  const double v0 = Agent(run, 2000, id)->speed_mps();
  for (Step step = 2010; step <= 8000; step += 10) {
    const double t = static_cast<double>(step - 2000) * 1e-3;
    ASSERT_NEAR(Agent(run, step, id)->speed_mps(), std::max(0.0, v0 - 5.0 * t), 1e-9) << step;
  }
  EXPECT_EQ(Agent(run, 8000, id)->speed_mps(), 0.0);
  EXPECT_GT(Agent(run, 8010, id)->speed_mps(), 0.0);
  EXPECT_GT(Agent(run, 12000, id)->speed_mps(), 2.0);
}

// A traffic of 0.1 s behind a scenario of 0.01 s: ten samples between two activations, every event counts, in order.
TEST_F(Scenario, ASlowConsumerLosesNoEvent) {
  const Driven calm =
      Drive(LaunchOf(Text(File("  - {at_s: 0.5, name: mark, text: nothing}\n"), ", period_s: 0.1")), 1100);
  const std::uint32_t id = SomeAgent(calm, 1000);
  const std::string agent = std::to_string(id);
  const auto last_speed = [&](const std::string& events) {
    const Driven run = Drive(LaunchOf(Text(File(events), ", period_s: 0.1")), 3000);
    EXPECT_TRUE(run.outcome.ok) << run.outcome.fault;
    return Agent(run, 3000, id)->speed_mps();
  };
  const std::string brake = ", name: traffic.brake, agent: " + agent + ", deceleration_mps2: 6}\n";
  const std::string release = ", name: traffic.release, agent: " + agent + "}\n";
  const double v0 = Agent(calm, 1000, id)->speed_mps();
  // Valid in (0.9, 1.0]: the activation of 1.0 s sees them.
  EXPECT_NEAR(last_speed("  - {at_s: 0.93" + brake), std::max(0.0, v0 - 6.0 * 2.0), 1e-9);
  EXPECT_NEAR(last_speed("  - {at_s: 0.91" + release + "  - {at_s: 0.99" + brake), std::max(0.0, v0 - 6.0 * 2.0), 1e-9);
  EXPECT_GT(last_speed("  - {at_s: 0.91" + brake + "  - {at_s: 0.99" + release), 10.0) << "the later one wins";
  EXPECT_GT(last_speed("  - {at_s: 0.95" + brake + "  - {at_s: 0.95" + release), 10.0)
      << "of one moment: the one that stands later in the file";
}

TEST_F(Scenario, AConditionalEventComesOnePeriodAfterTheCarHasPassed) {
  const launch::Launch launch = LaunchOf(
      Text(File("  - {when: {road: n222, passes_m: 45}, name: mark, text: passed}\n  - {when: {passes_m: 5000}, name: "
                "mark, text: never}\n")));
  const Driven run = Drive(launch, 9000);
  ASSERT_TRUE(run.outcome.ok) << run.outcome.fault;
  ASSERT_EQ(run.events.size(), 1u) << "once, and only the one";
  const auto station = [&](Step step) {
    const auto& p = run.car.at(step).position_w_m();
    return N222Road().Locate(p.x(), p.y())->s_m;
  };
  const Step valid = run.events.begin()->first;
  EXPECT_GE(station(valid - 10), 45.0) << "seen by the activation of " << valid - 10;
  EXPECT_LT(station(valid - 20), 45.0) << "and not by the one before";
}

// On a world file of version 1 at the same step as on the same road in version 2, which has other hills.
TEST_F(Scenario, AStationIsPassedOnARoadOfVersion1Too) {
  const std::string text = Text(File("  - {when: {road: n222, passes_m: 45}, name: mark, text: passed}\n"));
  std::string older = text;
  older.replace(older.find("../configs/worlds/n222.yaml"), 27, "../tests/data/n222_version1.yaml");
  const Driven now = Drive(LaunchOf(text), 7000), before = Drive(LaunchOf(older), 7000);
  ASSERT_TRUE(before.outcome.ok) << before.outcome.fault;
  ASSERT_EQ(before.events.size(), 1u);
  EXPECT_NEAR(static_cast<double>(before.events.begin()->first), static_cast<double>(now.events.begin()->first), 20.0)
      << "the formulas of the axis differ by rounding, the hills beside it are others";
}

// A straight road to the east, from x = 0 on, that crosses another one at 60 m and passes below a third at 100 m: its
// stations go on through the junction.
TEST_F(Scenario, StationsGoOnThroughAJunction) {
  const auto world = folder_ / "cross.yaml";
  ASSERT_TRUE(
      base::WriteWhole(
          world, std::string_view("rodeira: world/2\nname: cross\nground: {kind: plane, z_m: 0}\nstart: {road: main, "
                                  "lane: -1, s_m: 12}\nroads:\n"
                                  "  - {id: main, axis: [line: {length_m: 300}], z_m: 0, section: {template: rural}}\n"
                                  "  - {id: side, place: {road: main, s_m: 60, turn_deg: 90, own_s_m: 80}, axis: "
                                  "[line: {length_m: 160}], section: {template: rural}}\n"
                                  "  - {id: over, start: {x_m: 100, y_m: -80, heading_deg: 90}, axis: [line: "
                                  "{length_m: 160}], z_m: 8, section: {template: rural}, "
                                  "bridges: [{from_s_m: 60, to_s_m: 100}]}\n"
                                  "junctions:\n  - {id: j, roads: [{road: main, s_m: 60}, {road: side, s_m: 80}]}\n"))
          .ok());
  std::string text =
      Text(File("  - {when: {road: main/1, passes_m: 30}, name: mark, text: part}\n  - {when: {road: main, passes_m: "
                "60}, name: mark, text: in}\n  - {when: {road: main, passes_m: 100}, name: mark, text: below}\n"
                "  - {when: {road: over, passes_m: 80}, name: mark, text: never}\n"));
  text.replace(text.find("../configs/worlds/n222.yaml"), 27, world.string());
  text.replace(text.find("vehicles: 20"), 12, "vehicles: 0");
  const Driven run = Drive(LaunchOf(text), 16000);
  ASSERT_TRUE(run.outcome.ok) << run.outcome.fault;
  ASSERT_EQ(run.events.size(), 3u);
  std::vector<double> stations_m{30.0, 60.0, 100.0};
  for (const auto& [valid, events] : run.events) {
    EXPECT_GE(run.car.at(valid - 10).position_w_m().x(), stations_m.front()) << events.front().argument();
    EXPECT_LT(run.car.at(valid - 20).position_w_m().x(), stations_m.front()) << events.front().argument();
    stations_m.erase(stations_m.begin());
  }
  text = Text(File("  - {when: {road: main/1, passes_m: 60}, name: mark, text: where}\n"));
  text.replace(text.find("../configs/worlds/n222.yaml"), 27, world.string());
  EXPECT_NE(Complaint(text).find("road 'main/1' is "), std::string::npos) << Complaint(text);
  text = Text(File("  - {when: {passes_m: 60}, name: mark, text: where}\n"));
  text.replace(text.find("../configs/worlds/n222.yaml"), 27, world.string());
  EXPECT_NE(Complaint(text).find(
                "'passes_m' is on no road that is named, and the world has 3; 'road' was expected beside it"),
            std::string::npos)
      << Complaint(text);
}

// The car in front is found a second time here, by the road's own coordinates: lane -1 lies right of the axis and goes
// along it.
TEST_F(Scenario, TheOneAheadIsTheOneInFrontOfTheDriver) {
  std::string text = Text(File("  - {at_s: 6, name: traffic.brake, agent: ahead, deceleration_mps2: 9}\n"));
  text.replace(text.find("vehicles: 20"), 12, "vehicles: 120");
  const launch::Launch launch = LaunchOf(text);
  const Driven run = Drive(launch, 6100);
  ASSERT_TRUE(run.outcome.ok) << run.outcome.fault;
  const auto place = [&](double x, double y) { return *N222Road().Locate(x, y); };
  const auto& car = run.car.at(6000);
  const double own_s = place(car.position_w_m().x(), car.position_w_m().y()).s_m;
  std::optional<std::uint32_t> ahead;
  double nearest_m = 200.0;
  for (const msg::TrafficAgent& agent : run.traffic.at(6000).agents()) {
    const auto at = place(agent.position_x_m(), agent.position_y_m());
    if (at.t_m > 0.0 || at.s_m <= own_s || at.s_m - own_s > nearest_m) continue;
    nearest_m = at.s_m - own_s;
    ahead = agent.id();
  }
  ASSERT_TRUE(ahead.has_value());
  for (const msg::TrafficAgent& agent : run.traffic.at(6010).agents()) {
    if (agent.id() == *ahead)
      EXPECT_NEAR(agent.acceleration_mps2(), -9.0, 1e-9);
    else
      EXPECT_GT(agent.acceleration_mps2(), -8.5) << agent.id();
  }
}

TEST_F(Scenario, RestoredAnywhereItGoesOnWithTheSameDigest) {
  const launch::Launch launch = LaunchOf(
      Text(File("  - {at_s: 1, name: traffic.speed, agent: all, speed_mps: 9}\n  - {when: {passes_m: 40}, name: "
                "traffic.brake, agent: 3, deceleration_mps2: 4}\n"
                "  - {when: {passes_m: 60}, name: traffic.release, agent: all}\n  - {at_s: 7.77, name: traffic.brake, "
                "agent: all, deceleration_mps2: 2}\n  - {at_s: 8, name: traffic.speed, agent: all, at: {road: n222, "
                "s_m: 500}, speed_mps: 7}\n")));
  for (const Step at : {1003, 5555, 7771}) {
    const Driven whole = Drive(launch, 9000, at);
    ASSERT_TRUE(whole.outcome.ok) << whole.outcome.fault;
    EXPECT_GE(whole.events.size(), 3u);
    auto nodes = cli::LocalNodes::Make(launch);
    ASSERT_TRUE(nodes.ok());
    lockstep::InProcessSettings settings;
    settings.last_step = 9000;
    settings.first_step = at;
    settings.resume = whole.snapshots;
    EXPECT_EQ(lockstep::RunThreaded(launch.roster(), nodes.value().nodes(), settings).digest, whole.outcome.digest)
        << "from " << at;
  }
}

TEST_F(Scenario, WhatCannotBeIsRefusedAtTheStart) {
  EXPECT_NE(Complaint(Text("no.yaml")).find("there is no such file"), std::string::npos);
  EXPECT_THAT(Complaint(Text(File("  - {at_s: 1.001, name: mark, text: x}\n"))),
              Names("scenario.yaml:3: 'at_s' is 1.001; … 0.01 s"));
  EXPECT_EQ(Complaint(Text(File("  - {at_s: 1.001, name: mark, text: x}\n"), "", ", period_s: 0.001")), "")
      << "with that period it can";
  EXPECT_THAT(Complaint(Text(File("  - {when: {road: n22, passes_m: 3}, name: mark, text: x}\n"))),
              Names("road 'n22' … 'n222'"));
  EXPECT_NE(Complaint(Text(File("  - {when: {passes_m: 99999}, name: mark, text: x}\n"))).find("road 'n222' is "),
            std::string::npos);
  const std::string brake = File("  - {at_s: 1, name: traffic.brake, agent: 1, deceleration_mps2: 3}\n");
  EXPECT_NE(Complaint(Text(brake, ", inputs: {scenario_events: []}"))
                .find("no node of kind 'traffic' is wired to this scenario"),
            std::string::npos);
}

TEST_F(Scenario, AnAgentThatIsNotThereIsRefusedWithItsLine) {
  const auto refused = [this](const std::string& event) {
    const auto nodes = cli::LocalNodes::Make(LaunchOf(Text(File("  - " + event + "\n"))));
    EXPECT_FALSE(nodes.ok());
    return nodes.ok() ? "" : nodes.error().Text();
  };
  const std::string place = "node 'others': " + (folder_ / "scenario.yaml").string() + ":3: 'traffic.brake':";
  EXPECT_THAT(refused("{at_s: 1, name: traffic.brake, agent: 20, deceleration_mps2: 3}"),
              Names(place + " … agent 20; … 20, from 0"));
  EXPECT_THAT(refused("{at_s: 1, name: traffic.brake, agent: next, at: {road: n22, s_m: 3}, deceleration_mps2: 3}"),
              Names(place + " … road 'n22' … 'n222'"));
}

}  // namespace
}  // namespace rodeira
