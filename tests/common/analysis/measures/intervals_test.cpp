// SPDX-License-Identifier: Apache-2.0
#include "common/analysis/measures/intervals.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "common/analysis/measures/table.hpp"
#include "common/core/base/files.hpp"
#include "common/core/base/temporary_folder.hpp"
#include "tests/tree.hpp"

namespace rodeira::measures {
namespace {

using Kind = DriveEvent::Kind;
const std::vector<DriveEvent> kEvents{{Kind::kMark, 2.0, "begin", ""},
                                      {Kind::kScenario, 5.25, "traffic.brake", "lorry"},
                                      {Kind::kScenario, 7.5, "traffic.brake", "bus"},
                                      {Kind::kMark, 8.0, "begin", ""}};

Interval Found(const char* text) {
  const auto spec = ParseInterval(text);
  EXPECT_TRUE(spec.ok()) << text;
  return FindInterval(spec.value(), kEvents, 10.0);
}

TEST(Intervals, PointsAreFoundInTheRecording) {
  EXPECT_EQ(Found("a=start..end").to_s, 10.0);
  EXPECT_EQ(Found("a=1.5..+4").to_s, 5.5);
  const Interval brake = Found("b=event:traffic.brake..+20");
  EXPECT_EQ(brake.from_s, 5.25);
  EXPECT_EQ(brake.to_s, 10.0) << "it ends with the recording";
  EXPECT_EQ(Found("b=event:traffic.brake:bus..end").from_s, 7.5);
  EXPECT_EQ(Found("b=event:traffic.brake#2..end").from_s, 7.5);
  EXPECT_EQ(Found("m=mark:begin..mark:begin#2").to_s, 8.0);
}

// Half-open: neighbours have all samples once.
TEST(Intervals, NeighboursAddUp) {
  std::size_t next = 0;
  for (const char* text :
       {"a=start..0.07", "b=0.07..2.345", "c=2.345..event:traffic.brake", "d=event:traffic.brake..end"}) {
    const auto [from, to] = SamplesOf(Found(text), 100.0, 1000);
    EXPECT_EQ(from, next) << text;
    next = to;
  }
  EXPECT_EQ(next, 1000u);
}

TEST(Intervals, WhatIsNotThereHasAReason) {
  const Interval wrong = Found("a=mark:begim..end");
  EXPECT_TRUE(wrong.unknown);
  EXPECT_EQ(wrong.reason, "the recording has no mark 'begim'; did you mean 'begin'?");
  const Interval none = FindInterval(ParseInterval("a=event:x..end").value(), {}, 10.0);
  EXPECT_EQ(none.reason, "the recording has no event 'x'; it has no events of a scenario");
  const Interval third = Found("a=mark:begin#3..end");
  EXPECT_FALSE(third.unknown);
  EXPECT_EQ(third.reason, "the recording has no mark 'begin' number 3");
  EXPECT_EQ(Found("a=20..30").reason, "it begins at 20 s, but the recording ends at 10 s");
  EXPECT_EQ(Found("a=mark:begin#2..mark:begin").reason, "it is empty: from 8 s to 2 s");
  EXPECT_EQ(SamplesOf(third, 100.0, 1000), (std::pair<std::size_t, std::size_t>{0, 0}));
}

TEST(Intervals, WrongTextsAreRefused) {
  for (const char* text :
       {"", "a", "a=1", "=1..2", "a=2..1", "a=1..1", "a=1..+0", "a=1..+x", "a=one..2", "a=mark:..end", "a=-1..2",
        "a=end..end", "a=1..start", "a=nan..2", "a#2=1..2", "a#2=while speed_mps > 20"}) {
    const auto spec = ParseInterval(text);
    ASSERT_FALSE(spec.ok()) << text;
    EXPECT_EQ(spec.error().exit_status(), 2) << text;
    EXPECT_FALSE(spec.error().message.empty());
  }
}

// "bend#2" is the second time that the condition of "bend" holds, and nothing else.
TEST(Intervals, ANumberBehindAHashIsNoPartOfAName) {
  EXPECT_EQ(ParseInterval("bend#2=1..2").error().id.text(), "measure.wrong_interval");
  EXPECT_TRUE(ParseInterval("bend#=1..2").ok());
  EXPECT_TRUE(ParseInterval("#a=1..2").ok());
  EXPECT_TRUE(ParseInterval("a=mark:x#2..end").ok()) << "the second mark";
}

class MeasuresFile : public ::testing::Test {
 protected:
  base::Result<MeasuresSpec> Read(const std::string& text) {
    const auto path = folder_.value().path() / "m.yaml";
    EXPECT_TRUE(base::WriteWhole(path, std::string_view(text)).ok());
    return ReadSpec(path);
  }
  std::string Problem(const std::string& text) {
    const auto spec = Read("rodeira: measures/1\n" + text);
    return spec.ok() ? "" : spec.error().Text();
  }
  base::Result<base::TemporaryFolder> folder_ = base::TemporaryFolder::Make("measures-test");
};

TEST_F(MeasuresFile, ItsSidecarReadsBackTheSame) {
  const auto spec = Read(
      "rodeira: measures/1\nsubject: ego\nbaseline: quiet\nmeasures: [sdlp_m, tet_s, speed_max_mps]\n"
      "intervals:\n  - {name: quiet, from: start, to: 7.5}\n  - {name: task, from: 'mark:begin#2', for_s: 3}\n"
      "  - {name: bus, from: 'event:traffic.brake:bus', to: end}\n"
      "  - {name: fast, from: 2, while: 'speed_mps > 20 and junction == 0', min_s: 1.5}\n"
      "options:\n  tet_s: {threshold_s: 1.5}\n  sdlp_m: {ddof: 0}\n");
  ASSERT_TRUE(spec.ok()) << spec.error().Text();
  ASSERT_EQ(spec.value().measures.size(), 3u);
  EXPECT_EQ(spec.value().options.at("tet_s").at("threshold_s"), 1.5);
  const std::string first = SidecarText(spec.value(), {}, {});
  const auto again = Read(first);
  ASSERT_TRUE(again.ok()) << again.error().Text() << first;
  EXPECT_EQ(SidecarText(again.value(), {}, {}), first);
  EXPECT_NE(
      first.find("tet_s: {max_gap_m: 150, max_time_gap_s: 6, near_gap_m: 20, min_speed_mps: 0.1, threshold_s: 1.5}"),
      std::string::npos)
      << first;
}

TEST_F(MeasuresFile, WrongNamesAndNumbersAreSaidWithTheirPlace) {
  EXPECT_NE(Problem("measures: [sdlp]\n").find("m.yaml:2"), std::string::npos);
  EXPECT_NE(Problem("measures: [sdlp]\n").find("did you mean 'sdlp_m'?"), std::string::npos);
  EXPECT_NE(Problem("options: {tet_s: {treshold_s: 1}}\n").find("did you mean 'threshold_s'"), std::string::npos);
  EXPECT_NE(Problem("options: {tet_s: {threshold_s: -1}}\n"), "");
  EXPECT_NE(Problem("options: {tet: {threshold_s: 1}}\n"), "");
  EXPECT_NE(Problem("baseline: quiet\n").find("there is no interval 'quiet'"), std::string::npos);
  EXPECT_NE(Problem("intervals: [{name: a, from: 3, to: 2}]\n").find("is empty"), std::string::npos);
  EXPECT_NE(Problem("intervals: [{name: a, from: 1, to: 2}, {name: a, from: 1, to: 2}]\n").find("same name"),
            std::string::npos);
  EXPECT_NE(Problem("intervals: [{name: a, while: 'sped_mps > 2'}]\n").find("m.yaml:2"), std::string::npos);
  EXPECT_NE(Problem("intervals: [{name: a, while: 'sped_mps > 2'}]\n").find("did you mean 'speed_mps'?"),
            std::string::npos);
  EXPECT_NE(Problem("intervals: [{name: a, from: 1, to: 2, min_s: 1}]\n").find("min_s"), std::string::npos);
  EXPECT_NE(Problem("intervals: [{name: a, while: 'speed_mps > 2', min_s: 0}]\n").find("min_s"), std::string::npos);
  EXPECT_NE(Problem("baseline: a\nintervals: [{name: a, while: 'speed_mps > 2'}]\n").find("has a condition"),
            std::string::npos);
  EXPECT_NE(Problem("interval: []\n").find("interval"), std::string::npos);
  EXPECT_EQ(Problem(""), "");
}

// What the how-to shows is a measures file.
TEST_F(MeasuresFile, TheOneOfTheHowToIsRead) {
  const auto page = base::ReadText(std::filesystem::path(SourceDir()) / "docs/how-to/measures.md");
  ASSERT_TRUE(page.ok());
  const auto begin = page.value().find("```yaml\n") + 8, end = page.value().find("```", begin);
  ASSERT_NE(end, std::string::npos);
  const auto spec = Read(page.value().substr(begin, end - begin));
  ASSERT_TRUE(spec.ok()) << spec.error().Text();
  EXPECT_EQ(spec.value().intervals.size(), 3u);
  EXPECT_EQ(spec.value().options.at("tet_s").at("threshold_s"), 1.5);
}

// Every measure says what it is, with options within their own bounds, under one name.
TEST(Catalogue, EveryMeasureIsExplained) {
  std::set<std::string> names;
  ASSERT_FALSE(Catalogue().empty());
  for (const MeasureInfo& info : Catalogue()) {
    EXPECT_TRUE(names.insert(info.name).second) << info.name;
    for (const char* text : {info.family, info.definition, info.equation, info.traps, info.source})
      EXPECT_STRNE(text, "") << info.name;
    for (const OptionInfo& option : info.options) {
      EXPECT_LE(option.low, option.default_value) << info.name << option.name;
      EXPECT_GE(option.high, option.default_value) << info.name << option.name;
      EXPECT_NE(ExplainText(info).find(option.meaning), std::string::npos);
    }
    EXPECT_NE(ListText().find(info.definition), std::string::npos);
  }
  // The reference lists them, with the same definitions.
  const auto page = base::ReadText(std::filesystem::path(SourceDir()) / "docs/reference/measures.md");
  ASSERT_TRUE(page.ok());
  for (const MeasureInfo& info : Catalogue()) {
    const std::string row = std::string("| `") + info.name + "` | " + info.definition + " | " + info.source + " |";
    EXPECT_NE(page.value().find(row), std::string::npos) << row;
  }
  EXPECT_GE(names.size(), 50u);
  EXPECT_NE(FindMeasure("sdlpm").error().message.find("did you mean 'sdlp_m'?"), std::string::npos);
  EXPECT_NE(FindMeasure("sdpl").error().message.find("did you mean 'sdlp_m'?"), std::string::npos) << "without a unit";
  EXPECT_NE(FindMeasure("qwerty").error().message.find("--list"), std::string::npos);
}

// The names that highD's files have for the same measures, also in a measures file and its options.
TEST(Catalogue, NamesOfHighD) {
  for (const auto& [theirs, own] : {std::pair{"minDHW", "gap_min_m"},
                                    {"minTHW", "time_gap_min_s"},
                                    {"minTTC", "ttc_min_s"},
                                    {"maxXVelocity", "speed_max_mps"},
                                    {"meanXVelocity", "speed_mean_mps"},
                                    {"numLaneChanges", "lane_changes_n"},
                                    {"traveledDistance", "distance_m"}}) {
    ASSERT_TRUE(FindMeasure(theirs).ok()) << theirs;
    EXPECT_EQ(FindMeasure(theirs).value(), FindMeasure(own).value());
    EXPECT_NE(ExplainText(*FindMeasure(own).value()).find(theirs), std::string::npos) << own;
    EXPECT_NE(ListText().find(own), std::string::npos);
  }
}

TEST_F(MeasuresFile, NamesOfHighDAreUnderstood) {
  const auto spec = Read("rodeira: measures/1\nmeasures: [minTTC, ttc_min_s]\noptions: {minTTC: {max_gap_m: 200}}\n");
  ASSERT_TRUE(spec.ok()) << spec.error().Text();
  ASSERT_EQ(spec.value().measures.size(), 1u);
  EXPECT_EQ(spec.value().options.at("ttc_min_s").at("max_gap_m"), 200.0);
}

}  // namespace
}  // namespace rodeira::measures
