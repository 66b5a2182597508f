// SPDX-License-Identifier: Apache-2.0
// docs/reference/traffic-settings.md tells of every setting of the traffic: its key, what it is otherwise, and from
// where to where it goes.
#include "common/traffic/state/traffic_settings.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>

#include "common/core/base/files.hpp"
#include "tests/launch/rodeira/temporary_folder.hpp"
#include "tests/tree.hpp"

namespace rodeira::traffic {
namespace {

struct Row {
  std::string default_value, low, high;  // the last two empty for a word or a flag
};

// The table's rows by key, "following.time_gap_s".
std::map<std::string, Row> Told() {
  std::map<std::string, Row> rows;
  std::istringstream document(base::ReadText(SourceDir() + "/docs/reference/traffic-settings.md").value());
  const std::regex row(R"re(\| `([a-z_0-9.]+)` \| ([^|]+) \| (?:([0-9.e]+) to ([0-9.e]+)|[^|]*) \|.*)re");
  std::smatch parts;
  for (std::string line; std::getline(document, line);) {
    if (std::regex_match(line, parts, row)) rows[parts[1]] = {parts[2], parts[3], parts[4]};
  }
  return rows;
}

// The keys that the reader asks for, as they stand in the program, but for those that have tables of their own in
// docs/reference/traffic-files.md.
std::set<std::string> Asked() {
  const std::map<std::string, std::string> prefixes{{"map", ""},
                                                    {"follow", "following."},
                                                    {"comfort", "comfort."},
                                                    {"enter", "entering."},
                                                    {"change", "lane_changes."}};
  const std::string text = base::ReadText(SourceDir() + "/common/traffic/state/traffic_settings.cpp").value();
  const std::regex asked(R"re((\w+)\.(?:Number|Integer|Flag|Choice)\(\s*"([a-z_0-9]+)")re");
  std::set<std::string> keys;
  for (std::sregex_iterator i(text.begin(), text.end(), asked), end; i != end; ++i) {
    const auto prefix = prefixes.find((*i)[1]);
    if (prefix != prefixes.end()) keys.insert(prefix->second + std::string((*i)[2]));
  }
  return keys;
}

const std::map<std::string, std::function<double(const TrafficSettings&)>> kNumbers{
    {"vehicles", [](const TrafficSettings& t) { return t.vehicles; }},
    {"threads", [](const TrafficSettings& t) { return t.threads; }},
    {"variety", [](const TrafficSettings& t) { return t.variety; }},
    {"speed_factor_low", [](const TrafficSettings& t) { return t.speed_factor_low; }},
    {"speed_factor_high", [](const TrafficSettings& t) { return t.speed_factor_high; }},
    {"side_margin_m", [](const TrafficSettings& t) { return t.side_margin_m; }},
    {"sight_m", [](const TrafficSettings& t) { return t.sight_m; }},
    {"following.time_gap_s", [](const TrafficSettings& t) { return t.idm.time_gap_s; }},
    {"following.standing_gap_m", [](const TrafficSettings& t) { return t.idm.standing_gap_m; }},
    {"following.acceleration_mps2", [](const TrafficSettings& t) { return t.idm.acceleration_mps2; }},
    {"following.braking_mps2", [](const TrafficSettings& t) { return t.idm.braking_mps2; }},
    {"following.hardest_mps2", [](const TrafficSettings& t) { return t.idm.hardest_mps2; }},
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
// Of two that must not descend: both are said.
const std::map<std::string, std::string> kTogether{{"speed_factor_low", "speed_factor_high"},
                                                   {"speed_factor_high", "speed_factor_low"},
                                                   {"comfort.jerk_mps3", "emergency_jerk_mps3"},
                                                   {"comfort.emergency_jerk_mps3", "jerk_mps3"}};

class TrafficSettingsFile : public testing::Test {
 protected:
  base::Result<TrafficSettings> Load(const std::string& text) {
    const std::filesystem::path file = folder_.path() / "settings.yaml";
    EXPECT_TRUE(base::WriteWhole(file, "rodeira: traffic/1\n" + text).ok());
    return LoadTraffic(file, 1);
  }
  base::Result<TrafficSettings> LoadOne(const std::string& key, const std::string& value) {
    const auto dot = key.find('.');
    const auto together = kTogether.find(key);
    const std::string other = together == kTogether.end() ? "" : fmt::format(", {}: {}", together->second, value);
    if (dot == std::string::npos)
      return Load(fmt::format("{}: {}\n", key, value) + (other.empty() ? "" : other.substr(2) + "\n"));
    return Load(fmt::format("{}: {{{}: {}{}}}\n", key.substr(0, dot), key.substr(dot + 1), value, other));
  }
  const cli::TemporaryFolder folder_;
};

TEST_F(TrafficSettingsFile, TheDocumentTellsOfEveryKey) {
  const auto told = Told();
  const std::set<std::string> asked = Asked();
  EXPECT_EQ(asked.size(), kNumbers.size() + kWords.size());
  for (const std::string& key : asked)
    EXPECT_TRUE(told.contains(key)) << "docs/reference/traffic-settings.md has no row for " << key;
  for (const auto& [key, row] : told)
    EXPECT_TRUE(asked.contains(key)) << "docs/reference/traffic-settings.md tells of " << key
                                     << ", which no reader asks for";
}

TEST_F(TrafficSettingsFile, WhatASettingIsOtherwiseIsWhatTheDocumentSays) {
  const TrafficSettings usual = Load("").value();
  const auto told = Told();
  for (const auto& [key, of] : kNumbers) {
    ASSERT_TRUE(told.contains(key)) << key;
    EXPECT_NEAR(of(usual), std::stod(told.at(key).default_value), 1e-12) << key;
  }
  for (const auto& [key, of] : kWords) {
    ASSERT_TRUE(told.contains(key)) << key;
    EXPECT_EQ("`" + of(usual) + "`", told.at(key).default_value) << key;
  }
}

TEST_F(TrafficSettingsFile, ARangeIsWhatTheDocumentSays) {
  const auto told = Told();
  for (const auto& [key, of] : kNumbers) {
    ASSERT_TRUE(told.contains(key)) << key;
    const Row& row = told.at(key);
    for (const std::string& bound : {row.low, row.high}) {
      const auto at = LoadOne(key, bound);
      ASSERT_TRUE(at.ok()) << key << " " << bound << ": " << at.error().Text();
      EXPECT_NEAR(of(at.value()), std::stod(bound), 1e-12) << key;
    }
    const bool whole = key == "vehicles" || key == "threads";
    const std::string below =
        whole ? std::to_string(std::stoi(row.low) - 1) : fmt::format("{}", std::stod(row.low) - 1e-6);
    const std::string above =
        whole ? std::to_string(std::stoi(row.high) + 1) : fmt::format("{}", std::stod(row.high) * (1.0 + 1e-9) + 1e-9);
    for (const std::string& beyond : {below, above}) EXPECT_FALSE(LoadOne(key, beyond).ok()) << key << " " << beyond;
  }
}

}  // namespace
}  // namespace rodeira::traffic
