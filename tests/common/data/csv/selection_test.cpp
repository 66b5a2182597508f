// SPDX-License-Identifier: Apache-2.0
// Tables of a part of a recording. The oracle is the table of the whole: the same cells, without the others.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <optional>
#include <sstream>

#include "common/core/base/files.hpp"
#include "common/data/csv/export.hpp"
#include "common/data/record/mcap_writer.hpp"
#include "idl/codec.hpp"
#include "idl/messages.hpp"
#include "idl/topics.hpp"

namespace rodeira::csv {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

using Row = std::vector<std::string>;
using Rows = std::vector<Row>;

Rows RowsOf(const std::string& table) {
  Rows rows;
  std::istringstream lines(table);
  for (std::string line; std::getline(lines, line);) {
    rows.emplace_back();
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(cell);
  }
  return rows;
}

// The rows, and of them the columns, of the whole table that are expected.
Rows Part(const Rows& whole, const std::function<bool(const std::string&)>& column,
          const std::function<bool(double time_s)>& time) {
  Rows part;
  for (std::size_t i = 0; i < whole.size(); ++i) {
    if (i > 0 && !time(std::strtod(whole[i][0].c_str(), nullptr))) continue;
    part.emplace_back();
    for (std::size_t j = 0; j < whole[i].size(); ++j) {
      if (column(whole[0][j])) part.back().push_back(whole[i][j]);
    }
  }
  return part;
}

bool Always(double) { return true; }
bool AllColumns(const std::string&) { return true; }
bool IsKey(const std::string& column) { return column == "time_s" || column == "step" || column == "source"; }

// Two sources at 1 kHz, traffic at 100 Hz, two events within one millisecond of each other.
class SelectionTest : public ::testing::Test {
 protected:
  SelectionTest() {
    fs::create_directories(folder_);
    base::Bytes bytes;
    auto writer = record::McapWriter::Open(std::make_unique<record::MemorySink>(&bytes), {}).value();
    const auto channel = [&](std::string_view topic, const char* source) {
      const auto* info = idl::FindTopic(topic);
      const auto schema = writer.AddSchema(info->type, "omgidl", idl::IdlTextOf(info->subject)).value();
      return writer.AddChannel(topic, schema, "cdr", {{"source", source}}).value();
    };
    const auto put = [&](record::ChannelId to, auto message, std::int64_t step) {
      message.header().step(step);
      message.header().time_ns(step * 1'000'000);
      const auto time = static_cast<std::uint64_t>(step * 1'000'000);
      ASSERT_TRUE(writer.Write(to, 0, time, time, idl::Encode(message)).ok());
    };
    const auto ego = channel(idl::topics::kVehicleState, "ego");
    const auto other = channel(idl::topics::kVehicleState, "other");
    const auto traffic = channel(idl::topics::kTrafficState, "traffic");
    const auto story = channel(idl::topics::kScenarioEvents, "story");
    for (std::int64_t step = 0; step < 200; ++step) {
      msg::VehicleState state;
      state.position_w_m().x(0.25 * static_cast<double>(step));
      state.wheels()[3].load_n(static_cast<float>(step));
      put(ego, state, step);
      state.odometer_m(7.5);
      put(other, state, step);
      if (step % 10 == 0) {
        msg::TrafficState agents;
        agents.agents().resize(static_cast<std::size_t>(step % 3));
        for (auto& agent : agents.agents()) agent.speed_mps(static_cast<double>(step));
        put(traffic, agents, step);
      }
      msg::ScenarioEvents events;
      if (step == 41 || step == 42) events.events().resize(1);
      put(story, events, step);
    }
    EXPECT_TRUE(writer.Close().ok());
    reader_ = record::McapReader::OpenBytes(bytes).value();
    EXPECT_TRUE(ExportCsv(*reader_, folder_ / "whole").ok());
  }
  ~SelectionTest() override { fs::remove_all(folder_); }

  Rows Whole(const char* name) const { return RowsOf(base::ReadText(folder_ / "whole" / name).value()); }
  Rows Table(const char* name) const { return RowsOf(base::ReadText(folder_ / "part" / name).value()); }
  // The names of the tables, sorted.
  std::vector<std::string> Export(const Selection& selection) {
    fs::remove_all(folder_ / "part");
    const auto report = ExportCsv(*reader_, folder_ / "part", {}, {}, selection);
    EXPECT_TRUE(report.ok()) << report.error().Text();
    std::vector<std::string> names;
    for (const auto& file : fs::directory_iterator(folder_ / "part")) names.push_back(file.path().filename());
    std::ranges::sort(names);
    return names;
  }
  std::string Refusal(const Selection& selection) {
    fs::remove_all(folder_ / "part");
    const auto report = ExportCsv(*reader_, folder_ / "part", {}, {}, selection);
    EXPECT_FALSE(report.ok());
    EXPECT_FALSE(fs::exists(folder_ / "part"));
    if (report.ok()) return "";
    EXPECT_EQ(report.error().exit_status(), 2);
    return report.error().Text();
  }

  const fs::path folder_ = fs::temp_directory_path() / ("rodeira-selection-" + std::to_string(::getpid()));
  std::optional<record::McapReader> reader_;
};

TEST_F(SelectionTest, TopicsByShortOrFullName) {
  EXPECT_THAT(Export({}), ElementsAre("scenario_events.csv", "traffic_state.csv", "vehicle_state.csv"));
  Selection selection;
  selection.topics = {"traffic_state", "rodeira/scenario_events"};
  EXPECT_THAT(Export(selection), ElementsAre("scenario_events.csv", "traffic_state.csv"));
  EXPECT_EQ(Table("traffic_state.csv"), Whole("traffic_state.csv"));
}

TEST_F(SelectionTest, ColumnsAndGroupsOfThem) {
  Selection selection;
  selection.columns = {"position_w_m", "wheels.load_n", "wheels[0].slip", "odometer_m"};
  EXPECT_THAT(Export(selection), ElementsAre("vehicle_state.csv")) << "no other topic has one of these columns";
  const Rows table = Table("vehicle_state.csv");
  EXPECT_THAT(table[0], ElementsAre("time_s", "step", "source", "position_w_m.x", "position_w_m.y", "position_w_m.z",
                                    "odometer_m", "wheels[0].load_n", "wheels[0].slip", "wheels[1].load_n",
                                    "wheels[2].load_n", "wheels[3].load_n"));
  const auto wanted = [&](const std::string& name) { return std::ranges::find(table[0], name) != table[0].end(); };
  EXPECT_EQ(table, Part(Whole("vehicle_state.csv"), wanted, Always));
}

TEST_F(SelectionTest, ColumnsOfTheRowsOfASequence) {
  Selection selection;
  selection.columns = {"agents.speed_mps", "state_digest", "events.value"};
  selection.topics = {"traffic_state"};
  EXPECT_THAT(Refusal(selection), HasSubstr("--columns: unknown column 'events.value'"));
  selection.columns.pop_back();
  Export(selection);
  const auto wanted = [](const std::string& name) {
    return IsKey(name) || name == "agents.speed_mps" || name == "state_digest";
  };
  EXPECT_EQ(Table("traffic_state.csv"), Part(Whole("traffic_state.csv"), wanted, Always));
}

TEST_F(SelectionTest, TimesAreHalfOpen) {
  Selection selection;
  selection.from_s = 0.05;
  selection.to_s = 0.1;
  Export(selection);
  for (const char* name : {"vehicle_state.csv", "traffic_state.csv", "scenario_events.csv"}) {
    EXPECT_EQ(Table(name), Part(Whole(name), AllColumns, [](double s) { return s >= 0.05 && s < 0.1; })) << name;
  }
  EXPECT_EQ(Table("vehicle_state.csv").size(), 101u);
}

TEST_F(SelectionTest, TheRateThinsEachSourceAndNoEvent) {
  Selection selection;
  selection.rate_hz = 100.0;
  selection.events = {"rodeira/scenario_events"};
  Export(selection);
  EXPECT_EQ(Table("vehicle_state.csv"),
            Part(Whole("vehicle_state.csv"), AllColumns, [](double s) { return std::llround(s * 1000.0) % 10 == 0; }));
  EXPECT_EQ(Table("vehicle_state.csv").size(), 41u) << "two sources";
  EXPECT_EQ(Table("traffic_state.csv"), Whole("traffic_state.csv")) << "its own rate";
  EXPECT_EQ(Table("scenario_events.csv").size(), 3u);
}

// 1 / 30 s is no whole number of milliseconds: of each interval the first sample remains.
TEST_F(SelectionTest, ARateThatDoesNotDivideTheSamples) {
  Selection selection;
  selection.rate_hz = 30.0;
  selection.topics = {"vehicle_state"};
  Export(selection);
  std::vector<std::string> steps;
  for (const Row& row : Table("vehicle_state.csv")) {
    if (row[2] == "ego") steps.push_back(row[1]);
  }
  EXPECT_THAT(steps, ElementsAre("0", "34", "67", "100", "134", "167"));
}

// Lists before, between and behind the chosen columns are passed over.
TEST_F(SelectionTest, ListsThatAreNotChosen) {
  base::Bytes bytes;
  auto writer = record::McapWriter::Open(std::make_unique<record::MemorySink>(&bytes), {}).value();
  const char* idl =
      "struct P { long x; sequence<octet> raw; }; struct A { sequence<long> v; long n; sequence<P> a; long m; "
      "sequence<P> b; long o; };";
  const auto schema = writer.AddSchema("A", "omgidl", idl).value();
  const auto channel = writer.AddChannel("a", schema, "cdr").value();
  base::ByteWriter out;
  for (const std::uint8_t byte : {0, 1, 0, 0}) out.Put(byte);
  for (const std::uint32_t word : {2, 5, 6}) out.Put(word);        // v
  out.Put(std::uint32_t{7});                                       // n
  for (const std::uint32_t word : {2, 8, 0, 9, 0}) out.Put(word);  // a
  out.Put(std::uint32_t{10});                                      // m
  for (const std::uint32_t word : {1, 11, 0}) out.Put(word);       // b
  out.Put(std::uint32_t{12});                                      // o
  ASSERT_TRUE(writer.Write(channel, 0, 0, 0, out.bytes()).ok());
  ASSERT_TRUE(writer.Close().ok());
  reader_ = record::McapReader::OpenBytes(bytes).value();
  Selection selection;
  selection.columns = {"n", "m", "o"};
  EXPECT_THAT(Export(selection), ElementsAre("a.csv"));
  EXPECT_EQ(Table("a.csv"), (Rows{{"time_s", "source", "n", "m", "o"}, {"0", "channel 1", "7", "10", "12"}}));
  selection.columns = {"b", "m"};
  Export(selection);
  EXPECT_EQ(Table("a.csv"), (Rows{{"time_s", "source", "m", "b"}, {"0", "channel 1", "10", "[0].x=11; [0].raw="}}));
}

TEST_F(SelectionTest, WhatIsNotThereIsASentence) {
  Selection selection;
  selection.topics = {"vehicle_stat"};
  EXPECT_THAT(Refusal(selection), HasSubstr("--topics: unknown topic 'vehicle_stat'; did you mean"));
  selection = {};
  selection.columns = {"odometer_m", "position_w_m.xx"};
  EXPECT_THAT(Refusal(selection),
              HasSubstr("--columns: unknown column 'position_w_m.xx'; did you mean 'position_w_m."));
  selection.columns = {"position_w"};
  EXPECT_THAT(Refusal(selection), HasSubstr("unknown column 'position_w'"));
  selection = {};
  selection.from_s = 3.0;
  selection.to_s = 3.0;
  EXPECT_THAT(Refusal(selection), HasSubstr("--to: 3 s was found; a time after 3 s was expected"));
}

TEST_F(SelectionTest, TimesBehindTheEndAreRefused) {
  Selection selection;
  selection.from_s = 100.0;
  EXPECT_EQ(Refusal(selection), "--from: 100 s was found, but the recording ends at 0.199 s");
}

}  // namespace
}  // namespace rodeira::csv
