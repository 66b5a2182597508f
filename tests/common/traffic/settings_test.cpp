// SPDX-License-Identifier: Apache-2.0
// The keys of traffic files: each with its type, its bounds and its default, and the setting that it becomes.
#include "common/traffic/state/traffic_settings.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <string>

#include "common/traffic/state/traffic_schema.hpp"
#include "tests/common/core/config/every_key.hpp"

namespace rodeira::traffic {
namespace {

const std::map<std::string, std::function<double(const TrafficSettings&)>> kNumbers{
    {"vehicles", [](const TrafficSettings& t) { return t.vehicles; }},
    {"threads", [](const TrafficSettings& t) { return t.threads; }},
    {"variety", [](const TrafficSettings& t) { return t.variety; }},
    {"speed_factor_low", [](const TrafficSettings& t) { return t.speed_factor_low; }},
    {"speed_factor_high", [](const TrafficSettings& t) { return t.speed_factor_high; }},
    {"decide_s", [](const TrafficSettings& t) { return t.decide_s; }},
    {"reaction_s", [](const TrafficSettings& t) { return t.reaction_s; }},
    {"side_margin_m", [](const TrafficSettings& t) { return t.side_margin_m; }},
    {"sight_m", [](const TrafficSettings& t) { return t.sight_m; }},
    {"following.time_gap_s", [](const TrafficSettings& t) { return t.idm.time_gap_s; }},
    {"following.min_gap_m", [](const TrafficSettings& t) { return t.idm.min_gap_m; }},
    {"following.acceleration_mps2", [](const TrafficSettings& t) { return t.idm.acceleration_mps2; }},
    {"following.braking_mps2", [](const TrafficSettings& t) { return t.idm.braking_mps2; }},
    {"following.max_deceleration_mps2", [](const TrafficSettings& t) { return t.idm.max_deceleration_mps2; }},
    {"comfort.lateral_mps2", [](const TrafficSettings& t) { return t.speed.lateral_mps2; }},
    {"comfort.vertical_mps2", [](const TrafficSettings& t) { return t.speed.vertical_mps2; }},
    {"comfort.braking_mps2", [](const TrafficSettings& t) { return t.speed.braking_mps2; }},
    {"comfort.steep_grade", [](const TrafficSettings& t) { return t.speed.steep_grade; }},
    {"comfort.steep_factor", [](const TrafficSettings& t) { return t.speed.steep_factor; }},
    {"comfort.jerk_mps3", [](const TrafficSettings& t) { return t.smooth.planned_mps3; }},
    {"comfort.emergency_jerk_mps3", [](const TrafficSettings& t) { return t.smooth.emergency_mps3; }},
    {"entering.free_m", [](const TrafficSettings& t) { return t.free_m; }},
    {"lane_changes.politeness", [](const TrafficSettings& t) { return t.lane_changes.politeness; }},
    {"lane_changes.threshold_mps2", [](const TrafficSettings& t) { return t.lane_changes.threshold_mps2; }},
    {"lane_changes.bias_mps2", [](const TrafficSettings& t) { return t.lane_changes.bias_mps2; }},
    {"lane_changes.safe_mps2", [](const TrafficSettings& t) { return t.lane_changes.safe_mps2; }},
    {"lane_changes.overtaking_sight_m", [](const TrafficSettings& t) { return t.overtaking.sight_m; }},
    {"lane_changes.overtaking_margin_s", [](const TrafficSettings& t) { return t.overtaking.margin_s; }},
};
const std::map<std::string, std::function<std::string(const TrafficSettings&)>> kWords{
    {"physics", [](const TrafficSettings& t) { return t.physics == Physics::kPlanar ? "planar" : "full"; }},
    {"driver", [](const TrafficSettings& t) { return t.driver == DriverKind::kStandard ? "standard" : "motors"; }},
    {"entering.rule", [](const TrafficSettings& t) { return t.enters == EnterRule::kSafe ? "safe" : "free"; }},
    {"lane_changes.allowed", [](const TrafficSettings& t) { return t.changes_lanes ? "true" : "false"; }},
    {"lane_changes.overtaking", [](const TrafficSettings& t) { return t.overtaking.allowed ? "true" : "false"; }},
};
// Keys that a key fits together with: a highest value is not below the lowest; a mix has a vehicle; a flow has a rate.
const config::Companions kCompanions{
    {"driver=motors", {{"physics", "full"}}},
    {"speed_factor_low", {{"speed_factor_high", "2"}}},
    {"speed_factor_high", {{"speed_factor_low", "0.2"}}},
    {"comfort.jerk_mps3", {{"comfort.emergency_jerk_mps3", "1000000"}}},
    {"comfort.emergency_jerk_mps3", {{"comfort.jerk_mps3", "0.5"}}},
    {"pedestrians.slowest_mps", {{"pedestrians.fastest_mps", "3"}}},
    {"pedestrians.fastest_mps", {{"pedestrians.slowest_mps", "0.3"}}},
    {"mix.car", {{"mix.van", "1"}}},
    {"mix.van", {{"mix.car", "1"}}},
    {"mix.lorry", {{"mix.car", "1"}}},
    {"mix.bus", {{"mix.car", "1"}}},
    {"flows[].lane", {{"flows[].vehicles_per_h", "1"}}},
    {"flows[].route", {{"flows[].vehicles_per_h", "1"}}},
    {"flows[].arrivals", {{"flows[].vehicles_per_h", "1"}}},
    {"flows[].from_s", {{"flows[].vehicles_per_h", "1"}}},
    {"flows[].to_s", {{"flows[].vehicles_per_h", "1"}}},
    {"flows[].mix", {{"flows[].vehicles_per_h", "1"}}},
    {"flows[].mix.car", {{"flows[].vehicles_per_h", "1"}, {"flows[].mix.van", "1"}}},
    {"flows[].mix.van", {{"flows[].vehicles_per_h", "1"}, {"flows[].mix.car", "1"}}},
    {"flows[].mix.lorry", {{"flows[].vehicles_per_h", "1"}, {"flows[].mix.car", "1"}}},
    {"flows[].mix.bus", {{"flows[].vehicles_per_h", "1"}, {"flows[].mix.car", "1"}}},
    {"turns[].lane", {{"turns[].shares", "{b: 1}"}}},
};

base::Result<TrafficSettings> Read(const std::string& text) {
  const auto file = config::File::Parse(text, "traffic.yaml");
  if (!file) return file.error();
  (void)file.value().root().Text("rodeira", "");
  const TrafficSettings settings = ReadTraffic(file.value().root(), 1);
  if (const auto status = file.value().Finish(); !status) return status.error();
  return settings;
}

const config::PlacedKey* Declared(const std::string& path) {
  static const std::vector<config::PlacedKey> all = config::ValuesOf(TrafficSchema());
  const auto found = std::ranges::find(all, path, &config::PlacedKey::path);
  return found == all.end() ? nullptr : &*found;
}

TEST(TrafficFile, EveryDeclaredKeyKeepsItsTypeAndBounds) {
  const auto problem = [](const std::string& text) -> std::string {
    const auto file = config::File::Parse(text, "traffic.yaml");
    if (!file) return file.error().Text();
    (void)file.value().root().Choice("rodeira", {"traffic/1"});
    (void)ReadTraffic(file.value().root(), 1);
    const auto status = file.value().Finish();
    return status ? "" : status.error().Text();
  };
  config::ExpectEveryKey(TrafficSchema(), problem, kCompanions);
}

TEST(TrafficFile, AnAbsentKeyIsItsDeclaredDefault) {
  const TrafficSettings usual = Read("{rodeira: traffic/1}").value();
  for (const auto& [path, of] : kNumbers) {
    const config::PlacedKey* key = Declared(path);
    ASSERT_NE(key, nullptr) << path;
    const std::string text = config::DefaultCell(*key);
    EXPECT_NEAR(of(usual), std::stod(text), 1e-6) << path;
  }
  for (const auto& [path, of] : kWords) {
    const config::PlacedKey* key = Declared(path);
    ASSERT_NE(key, nullptr) << path;
    EXPECT_EQ(of(usual), config::DefaultCell(*key)) << path;
  }
}

TEST(TrafficFile, AKeyBecomesItsSetting) {
  for (const auto& [path, of] : kNumbers) {
    const config::PlacedKey* key = Declared(path);
    ASSERT_NE(key, nullptr) << path;
    for (const double bound : {key->key->range.low, key->key->range.high}) {
      config::Values values;
      if (const auto others = kCompanions.find(path); others != kCompanions.end()) values = others->second;
      values[path] = fmt::format("{}", bound);
      const auto settings = Read(config::SampleFile(TrafficSchema(), values).text());
      ASSERT_TRUE(settings.ok()) << path << ": " << settings.error().Text();
      EXPECT_EQ(of(settings.value()), bound) << path;
    }
  }
}

}  // namespace
}  // namespace rodeira::traffic
