// SPDX-License-Identifier: Apache-2.0
#include "common/driving/scenario/scenario_file.hpp"

#include <gtest/gtest.h>

#include "common/driving/scenario/scenario_schema.hpp"
#include "tests/common/core/config/every_key.hpp"

namespace rodeira::scenario {
namespace {

const Timing kTiming{1'000'000, 10, 20};  // samples valid at 20, 30 … ms

base::Result<Scenario> Read(const std::string& events, const Timing& timing = kTiming) {
  auto file = config::File::Parse("rodeira: scenario/1\nevents:\n" + events, "scenario.yaml");
  if (!file) return file.error();
  Scenario scenario = ReadScenario(file.value().root(), timing);
  if (const auto status = file.value().Finish(); !status) return status.error();
  return scenario;
}

std::string Complaint(const std::string& events, const Timing& timing = kTiming) {
  const auto read = Read(events, timing);
  if (read.ok()) return {};
  EXPECT_EQ(read.error().exit_status(), 2);
  return read.error().Text();
}

TEST(ScenarioFile, HoldsExactStepsInOrder) {
  const auto read = Read(
      "  - {at_s: 0.02, name: mark, text: begin}\n"
      "  - {at_s: 1.1, name: traffic.brake, agent: 7, deceleration_mps2: 3.5}\n"
      "  - {at_s: 1.1, name: traffic.speed, agent: ahead, speed_mps: 12}\n"
      "  - {when: {road: main, passes_m: 350}, name: mark, text: half way}\n"
      "  - {at_s: 4.03, name: traffic.release, agent: all}\n");
  ASSERT_TRUE(read.ok()) << read.error().Text();
  const auto& scheduled = read.value().scheduled;
  ASSERT_EQ(scheduled.size(), 4u);
  EXPECT_EQ(scheduled[0].step, 20);
  EXPECT_EQ(scheduled[1].step, 1100);
  EXPECT_EQ(scheduled[2].step, 1100);
  EXPECT_EQ(scheduled[3].step, 4030);
  EXPECT_EQ(scheduled[1].event.argument, "7");
  EXPECT_EQ(scheduled[1].event.value, 3.5);
  EXPECT_EQ(scheduled[2].event.name, "traffic.speed");
  ASSERT_EQ(read.value().conditional.size(), 1u);
  EXPECT_EQ(read.value().conditional[0].passes_m, 350.0);
  EXPECT_EQ(read.value().conditional[0].place, "scenario.yaml:6");
}

TEST(ScenarioFile, AnAgentMayBeToldAtAPlace) {
  const auto read = Read(
      "  - {at_s: 1, name: traffic.brake, agent: next, at: {road: main, s_m: 350.5}, deceleration_mps2: 3.5}\n"
      "  - {when: {passes_m: 30}, name: traffic.release, agent: all, at: {road: side road, s_m: 4}}\n");
  ASSERT_TRUE(read.ok()) << read.error().Text();
  EXPECT_EQ(read.value().scheduled.at(0).event.argument, "next at main 350.5");
  EXPECT_EQ(read.value().conditional.at(0).event.argument, "all at side road 4");
  EXPECT_NE(Complaint("  - {at_s: 1, name: traffic.release, agent: next}\n").find("'next' needs a place"),
            std::string::npos);
  EXPECT_NE(Complaint("  - {at_s: 1, name: traffic.release, agent: 1, at: {s_m: 3}}\n").find("road' is missing"),
            std::string::npos);
  EXPECT_NE(Complaint("  - {at_s: 1, name: traffic.release, agent: 1, at: {road: main, s_m: -3}}\n").find("s_m' is -3"),
            std::string::npos);
  EXPECT_NE(Complaint("  - {at_s: 1, name: mark, text: x, at: {road: main, s_m: 3}}\n").find("at"), std::string::npos);
}

TEST(ScenarioFile, VehiclesAreToldToOvertakeToChangeLanesAndToAppear) {
  const auto read = Read(
      "  - {at_s: 1, name: traffic.overtake, agent: ahead}\n"
      "  - {at_s: 1, name: traffic.change_lane, agent: 3, side: right}\n"
      "  - {at_s: 1, name: traffic.change_lane, agent: next, at: {road: main, s_m: 30}, side: left}\n"
      "  - {at_s: 1, name: traffic.appear, agent: 20, at: {lane: \"main:-1\", s_m: 350.5}, speed_mps: 12}\n");
  ASSERT_TRUE(read.ok()) << read.error().Text();
  const auto& events = read.value().scheduled;
  EXPECT_EQ(events.at(0).event.argument, "ahead");
  EXPECT_EQ(events.at(0).event.value, 0.0);
  EXPECT_EQ(events.at(1).event.argument, "3");
  EXPECT_EQ(events.at(1).event.value, -1.0);
  EXPECT_EQ(events.at(2).event.argument, "next at main 30");
  EXPECT_EQ(events.at(2).event.value, 1.0);
  EXPECT_EQ(events.at(3).event.argument, "20 at main:-1 350.5");
  EXPECT_EQ(events.at(3).event.value, 12.0);
  EXPECT_NE(Complaint("  - {at_s: 1, name: traffic.change_lane, agent: 3, side: lft}\n").find("did you mean 'left'?"),
            std::string::npos);
  EXPECT_NE(Complaint("  - {at_s: 1, name: traffic.change_lane, agent: 3}\n").find("side"), std::string::npos);
  EXPECT_NE(Complaint("  - {at_s: 1, name: traffic.appear, agent: 20, speed_mps: 3}\n").find("at' is missing"),
            std::string::npos);
  EXPECT_NE(
      Complaint("  - {at_s: 1, name: traffic.appear, agent: all, at: {lane: \"main:-1\", s_m: 3}, speed_mps: 3}\n")
          .find("is no agent on a lane"),
      std::string::npos);
  EXPECT_NE(Complaint("  - {at_s: 1, name: traffic.appear, agent: 2, at: {lane: main, s_m: 3}, speed_mps: 3}\n")
                .find("is no agent on a lane"),
            std::string::npos);
  EXPECT_NE(Complaint("  - {at_s: 1, name: traffic.appear, agent: 2, at: {lane: \"main:-1\", s_m: 3}, speed_mps: -1}\n")
                .find("speed_mps' is -1"),
            std::string::npos);
}

// 0.1 has no exact binary form: every multiple must still be the step that it names.
TEST(ScenarioFile, EveryMultipleOfThePeriodIsItsStep) {
  for (const std::int64_t tenths : {1, 3, 7, 1001, 99999, 123456}) {
    const auto read = Read("  - {at_s: " + std::to_string(tenths / 10) + "." + std::to_string(tenths % 10) +
                           ", name: mark, text: x}\n");
    ASSERT_TRUE(read.ok()) << read.error().Text();
    EXPECT_EQ(read.value().scheduled.at(0).step, tenths * 100);
  }
}

TEST(ScenarioFile, WrongOnesAreRefusedWithTheirPlace) {
  EXPECT_EQ(Complaint("  - {at_s: 1.005, name: mark, text: x}\n"),
            "scenario.yaml:3: 'at_s' is 1.005; a multiple of the scenario's period of 0.01 s was expected, 1 or 1.01");
  EXPECT_EQ(
      Complaint("  - {at_s: 0, name: mark, text: x}\n"),
      "scenario.yaml:3: 'at_s' is 0; the first time at which an event can act was expected, 0.02 s, or a later one");
  EXPECT_EQ(Complaint("  - {at_s: 0.01, name: mark, text: x}\n", {1'000'000, 10, 10}), "");
  for (const char* far :
       {"1e300", "-5e15", "2000000.0005"}) {  // as steps more than a number holds: one sentence, about the range
    const std::string said = Complaint(std::string("  - {at_s: ") + far + ", name: mark, text: x}\n");
    EXPECT_NE(said.find("at_s' is"), std::string::npos) << said;
    EXPECT_EQ(said.find("a multiple"), std::string::npos) << said;
    EXPECT_EQ(said.find("first time"), std::string::npos) << said;
  }
  EXPECT_EQ(Complaint("  - {at_s: 2, name: mark, text: x}\n  - {at_s: 1, name: mark, text: y}\n"),
            "scenario.yaml:4: 'at_s' is 1 and follows 2; times that do not descend were expected");
  EXPECT_NE(Complaint("  - {at_s: 1, name: trafic.brake, agent: 1, deceleration_mps2: 2}\n")
                .find("did you mean 'traffic.brake'?"),
            std::string::npos);
  EXPECT_EQ(Complaint("  - {at_s: 1, name: traffic.brake, agent: first, deceleration_mps2: 2}\n"),
            "scenario.yaml:3: 'first' is no agent; its number, all or ahead was expected");
  EXPECT_NE(Complaint("  - {at_s: 1, name: traffic.brake, agent: 1, deceleration_mps2: 30}\n")
                .find("'events[0].deceleration_mps2' is 30; a number from 0.1 to 10"),
            std::string::npos)
      << Complaint("  - {at_s: 1, name: traffic.brake, agent: 1, deceleration_mps2: 30}\n");
  EXPECT_NE(Complaint("  - {at_s: 1, name: traffic.brake, agent: 1}\n").find("deceleration_mps2' is missing"),
            std::string::npos);
  EXPECT_NE(Complaint("  - {at_s: 1, name: mark, text: x, agent: 3}\n").find("unknown key"), std::string::npos);
  EXPECT_EQ(Complaint("  - {at_s: 1, when: {passes_m: 3}, name: mark, text: x}\n"),
            "scenario.yaml:3: an event has 'at_s' and 'when'; one of them was expected");
  EXPECT_NE(Complaint("  - {name: mark, text: x}\n").find("at_s' is missing"), std::string::npos);
  EXPECT_NE(Complaint("  - {at_ms: 5, name: mark, text: x}\n").find("at_s"), std::string::npos);
}

// A generated file for each declared key. Each kind of event has keys of its own.
TEST(ScenarioFile, EveryDeclaredKeyKeepsItsTypeAndBounds) {
  const auto event = [](const std::string& name, const std::map<std::string, std::string>& more) {
    config::Values values{{"events[].name", name}, {"events[].at_s", "1"}};
    for (const auto& [key, value] : more) values["events[]." + key] = value;
    return values;
  };
  const config::Values brake = event("traffic.brake", {{"agent", "1"}, {"deceleration_mps2", "1"}}),
                       release = event("traffic.release", {{"agent", "1"}}),
                       appear =
                           event("traffic.appear", {{"agent", "1"}, {"at", "{lane: a:1, s_m: 1}"}, {"speed_mps", "1"}}),
                       place = event("vehicle.place", {{"place", "ego 1 2"}, {"heading_deg", "0"}}),
                       gust = event("vehicle.gust", {{"gust", "ego 90 1"}, {"speed_mps", "1"}}),
                       tyre = event("vehicle.tyre_pressure", {{"tyre", "ego front_left 1"}, {"pressure_share", "0"}}),
                       weather = event("weather", {{"becomes", "rain"}, {"over_s", "0"}}),
                       side = event("traffic.change_lane", {{"agent", "1"}, {"side", "left"}});
  config::Values at = release, lane = event("traffic.appear", {{"agent", "1"}, {"speed_mps", "1"}, {"at.s_m", "1"}}),
                 when = event("mark", {{"text", "x"}});
  at["events[].at.road"] = "main";
  when.erase("events[].at_s");
  when["events[].when.passes_m"] = "1";
  config::ExpectEveryKey(ScenarioSchema(),
                         [](const std::string& text) -> std::string {
                           const auto file = config::File::Parse(text, "scenario.yaml");
                           if (!file) return file.error().Text();
                           (void)ReadScenario(file.value().root(), {1'000'000, 10, 0});
                           const auto status = file.value().Finish();
                           return status ? "" : status.error().Text();
                         },
                         {{"rodeira", {{"events", "[]"}}},
                          {"rodeira=scenario/1", {{"events", "[]"}}},
                          {"name", {{"events", "[]"}}},
                          {"events[].at_s", event("mark", {{"text", "x"}})},
                          {"events[].when", {{"events[].name", "mark"}, {"events[].text", "x"}}},
                          {"events[].when.road", when},
                          {"events[].when.passes_m", when},
                          {"events[].name", {{"events[].at_s", "1"}}},
                          {"events[].name=mark", event("mark", {{"text", "x"}})},
                          {"events[].name=traffic.brake", brake},
                          {"events[].name=traffic.speed", event("traffic.speed", {{"agent", "1"}, {"speed_mps", "1"}})},
                          {"events[].name=traffic.release", release},
                          {"events[].name=traffic.overtake", event("traffic.overtake", {{"agent", "1"}})},
                          {"events[].name=traffic.change_lane", side},
                          {"events[].name=traffic.appear", appear},
                          {"events[].name=traffic.pedestrian", event("traffic.pedestrian", {{"crossing", "main 1"}})},
                          {"events[].name=vehicle.place", place},
                          {"events[].name=vehicle.gust", gust},
                          {"events[].name=vehicle.tyre_pressure", tyre},
                          {"events[].name=weather", weather},
                          {"events[].text", event("mark", {})},
                          {"events[].agent", release},
                          {"events[].at", release},
                          {"events[].at.road", at},
                          {"events[].at.s_m", at},
                          {"events[].at.lane", lane},
                          {"events[].crossing", event("traffic.pedestrian", {})},
                          {"events[].place", place},
                          {"events[].gust", gust},
                          {"events[].tyre", tyre},
                          {"events[].pressure_share", tyre},
                          {"events[].becomes", weather},
                          {"events[].deceleration_mps2", brake},
                          {"events[].speed_mps", appear},
                          {"events[].side", side},
                          {"events[].heading_deg", place},
                          {"events[].over_s", weather}});
}

}  // namespace
}  // namespace rodeira::scenario
