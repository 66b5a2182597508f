// SPDX-License-Identifier: Apache-2.0
// `rodeira measures` on short runs that are recorded here. What it says is compared with the recorded samples, decoded
// by the types that fastddsgen made.
#include "launch/rodeira/commands/measures_command.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <map>

#include "common/analysis/measures/drive_reader.hpp"
#include "idl/aliases.hpp"
#include "launch/rodeira/commands/report_command.hpp"
#include "tests/launch/rodeira/commands/measures_fixture.hpp"
#include "tests/names.hpp"

namespace rodeira::cli {
namespace {

using ::testing::HasSubstr;

TEST_F(MeasuresCommand, ATableOfTwoDrivesOnAPlane) {
  const std::string dry = Record("dry.mcap", LaunchFile("first_drive.yaml"),
                                 {"--for", "4", "--meta", "participant=P07", "--meta", "condition=dry"});
  const std::string wet = Record("wet.mcap", LaunchFile("first_drive.yaml"),
                                 {"--for", "3", "--meta", "participant=P07", "--meta", "condition=rain"});
  MeasuresOptions options;
  options.recordings = {dry, wet};
  options.intervals = {"first=0..1.5", "rest=1.5..end", "late=3.5..+9"};
  options.out = Path("table.csv");
  const Said said = Of(options);
  ASSERT_EQ(said.status, 0) << said.errors;
  const auto rows = Rows(ReadBack("table.csv"));
  ASSERT_EQ(rows.size(), 6u);
  EXPECT_EQ(rows[0].at("participant"), "P07");
  EXPECT_EQ(rows[0].at("condition"), "dry");
  EXPECT_EQ(rows[3].at("condition"), "rain");
  EXPECT_EQ(rows[5].at("speed_max_mps"), "") << "the second recording ends before: missing, and not 0";
  EXPECT_THAT(said.errors, HasLine("warning … wet.mcap … 'late' … 3.5 s"));
  EXPECT_EQ(rows[0].at("sdlp_m"), "") << "a plane has no lanes";
  EXPECT_EQ(rows[0].at("gap_mean_m"), "");

  // The same from the samples themselves: every tenth millisecond of the interval.
  const auto run = replay::RecordedRun::Open(dry);
  ASSERT_TRUE(run.ok());
  double most = 0.0, sum = 0.0, throttle = 0.0;
  int n = 0, in_motion = 0;
  auto samples = run.value().Samples();
  for (auto next = samples.Next(); next.ok() && next.value(); next = samples.Next()) {
    const auto& sample = *next.value();
    if (run.value().roster().source(sample.source()).topic != idl::topics::kVehicleState) continue;
    if (sample.valid() < 1500 || sample.valid() % 10 != 0) continue;
    const auto state = idl::Decode<msg::VehicleState>(*sample.payload).value();
    // On the level the speed along the body's x axis is that in the plane but for slip.
    const double speed = std::hypot(state.velocity_w_mps().x(), state.velocity_w_mps().y());
    most = std::max(most, speed);
    throttle += static_cast<double>(state.throttle());
    ++n;
    if (speed <= 0.1) continue;
    sum += speed;
    ++in_motion;
  }
  ASSERT_GT(in_motion, 0);
  EXPECT_NEAR(std::stod(rows[1].at("speed_max_mps")), most, 0.01 * most);
  EXPECT_NEAR(std::stod(rows[1].at("speed_mean_mps")), sum / in_motion, 0.01 * sum / in_motion);
  EXPECT_NEAR(std::stod(rows[1].at("throttle_mean")), throttle / n, 1e-9);

  // The sidecar has the digest that `rodeira info` says, and computes the same table again.
  const auto info = RunCommand({Bin("rodeira"), "info", dry});
  const auto at = info.out.find("content   ");
  ASSERT_NE(at, std::string::npos);
  const std::string sidecar = ReadBack("table.measures.yaml");
  EXPECT_THAT(sidecar, HasSubstr("content: \"" + info.out.substr(at + 10, 16) + "\""));
  EXPECT_THAT(sidecar, HasSubstr("world_hash: \"" + run.value().world_hash() + "\""));
  MeasuresOptions again;
  again.recordings = options.recordings;
  again.spec = Path("table.measures.yaml");
  again.out = Path("again.csv");
  ASSERT_EQ(Of(again).status, 0);
  EXPECT_EQ(ReadBack("again.csv"), ReadBack("table.csv"));
  again.out = Path("table.json");
  const Said replaced = Of(again);
  EXPECT_EQ(replaced.status, 2);
  EXPECT_THAT(replaced.errors, HasSubstr("would replace the measures file"));
  EXPECT_EQ(ReadBack("table.measures.yaml"), sidecar);
}

TEST_F(MeasuresCommand, ADriveAmongTrafficHasLanesAndLeaders) {
  const std::string drive = Record("drive.mcap", LaunchFile("car_ahead.yaml"), {"--for", "6"});
  MeasuresOptions options;
  options.recordings = {drive};
  options.series = Path("series.csv");
  options.out = Path("long.csv");
  options.long_format = true;
  const Said said = Of(options);
  ASSERT_EQ(said.status, 0) << said.errors;
  std::map<std::string, std::map<std::string, std::string>> values;
  for (const auto& row : Rows(ReadBack("long.csv"))) values[row.at("measure")] = row;
  const double sdlp = std::stod(values.at("sdlp_m").at("value"));
  EXPECT_GT(sdlp, 0.0);
  EXPECT_LT(sdlp, 0.5) << "the autopilot keeps its lane";
  EXPECT_LT(std::abs(std::stod(values.at("lane_position_mean_m").at("value"))), 0.6);
  EXPECT_THAT(values.at("sdlp_m").at("options"), HasSubstr("denominator=n-1"));
  EXPECT_EQ(values.at("sdlp_m").at("unit"), "m");
  EXPECT_THAT(values.at("steering_entropy_1999").at("missing"), Names("baseline"));
  EXPECT_EQ(values.at("pet_conflicts_n").at("value"), "0") << "nothing crosses its lane";
  EXPECT_THAT(values.at("pet_min_s").at("missing"), HasSubstr("crosses or joins"));
  const auto series = Rows(ReadBack("series.csv"));
  ASSERT_GE(series.size(), 600u);
  int with_leader = 0;
  for (const auto& row : series) {
    if (row.at("leader_gap_m").empty()) continue;
    ++with_leader;
    EXPECT_GT(std::stod(row.at("leader_gap_m")), 0.0);
  }
  EXPECT_NEAR(std::stod(series[600 - 1].at("time_s")), 5.99, 1e-9);
  // An agent of the same recording: it has lanes and speeds, and no pedals.
  const std::string leader = [&] {
    for (const auto& row : series) {
      if (!row.at("leader_id").empty() && row.at("leader_id")[0] != '-') return row.at("leader_id");
    }
    return std::string();
  }();
  ASSERT_FALSE(leader.empty()) << with_leader;
  MeasuresOptions agent;
  agent.recordings = {drive};
  agent.subject = "agent:" + leader;
  agent.out = Path("agent.csv");
  ASSERT_EQ(Of(agent).status, 0);
  const auto row = Rows(ReadBack("agent.csv")).at(0);
  EXPECT_NE(row.at("speed_max_mps"), "");
  EXPECT_EQ(row.at("brake_onset_s"), "");
}

// The report of the same recording has its way on the lanes and its measures, and names wrong options. Its least gap is
// that of the time series.
TEST_F(MeasuresCommand, AReportIsOnePage) {
  const std::string drive = Record("drive.mcap", LaunchFile("car_ahead.yaml"), {"--for", "6"});
  // The leader draws away: it is more than 6 s ahead.
  std::ofstream(Path("far.yaml"))
      << "rodeira: measures/1\nmeasures: [speed_max_mps, leader_share, gap_min_m, time_gap_min_s]\noptions:\n"
         "  leader_share: {max_time_gap_s: 30}\n  gap_min_m: {max_time_gap_s: 30}\n"
         "intervals: [{name: fast, while: speed_mps > 1}]\n";
  MeasuresOptions table;
  table.recordings = {drive};
  table.spec = Path("far.yaml");
  table.series = Path("series.csv");
  table.out = Path("long.csv");
  table.long_format = true;
  ASSERT_EQ(Of(table).status, 0);
  double least_m = 1e9, share = 0.0, fast = 0.0;
  for (const auto& row : Rows(ReadBack("series.csv"))) {
    if (std::stod(row.at("speed_mps")) <= 1.0) continue;
    fast += 1.0;
    if (row.at("leader_gap_m").empty() || std::stod(row.at("time_gap_s")) > 30.0) continue;
    share += 1.0;
    least_m = std::min(least_m, std::stod(row.at("leader_gap_m")));
  }
  ASSERT_GT(share, 200.0) << "two seconds with a leader";
  std::map<std::string, std::map<std::string, std::string>> values;
  for (const auto& row : Rows(ReadBack("long.csv"))) values[row.at("measure")] = row;
  EXPECT_NEAR(std::stod(values.at("gap_min_m").at("value")), least_m, 1e-9);
  EXPECT_NEAR(std::stod(values.at("leader_share").at("value")), share / fast, 1e-9);
  EXPECT_THAT(values.at("time_gap_min_s").at("missing"), HasSubstr("; the nearest is "));

  ReportOptions options;
  options.recordings = {drive};
  options.spec = Path("far.yaml");
  options.out = Path("report.html");
  const Said said = SaidBy<ReportOptions>(Report, options);
  ASSERT_EQ(said.status, 0) << said.errors;
  const std::string page = ReadBack("report.html");
  EXPECT_THAT(page, HasSubstr("Way of drive"));
  EXPECT_THAT(page, HasSubstr("<path d='M")) << "lanes";
  EXPECT_THAT(page, HasSubstr(">speed_max_mps</th><td>m/s</td><td class=\"number\">"));
  const std::string cell = ">gap_min_m</th><td>m</td><td class=\"number\">";
  ASSERT_THAT(page, HasSubstr(cell));
  EXPECT_NEAR(std::stod(page.substr(page.find(cell) + cell.size())), least_m, 0.06);
  options.out = Path("report.pdf");
  const Said pdf = SaidBy<ReportOptions>(Report, options);
  EXPECT_EQ(pdf.status, 2);
  EXPECT_THAT(pdf.errors, HasSubstr("a report is written as .html"));
  options.out = Path("other.html");
  options.spec.clear();
  options.intervals = {"fast=while sped_mps > 1"};
  const Said wrong = SaidBy<ReportOptions>(Report, options);
  EXPECT_EQ(wrong.status, 2);
  EXPECT_THAT(wrong.errors, HasSubstr("interval 'fast': there is no column 'sped_mps'; did you mean 'speed_mps'?"));
}

TEST_F(MeasuresCommand, WrongInputIsOneSentence) {
  const std::string drive = Drive(2.0);
  const auto refused = [](const MeasuresOptions& options, const char* sentence) {
    const Said said = Of(options);
    EXPECT_EQ(said.status, 2) << sentence;
    EXPECT_THAT(said.errors, Names(sentence));
    EXPECT_EQ(std::count(said.errors.begin(), said.errors.end(), '\n'), 1) << said.errors;
  };
  MeasuresOptions options;
  refused(options, "no recording is named");
  options.recordings = {Path("none.mcap")};
  refused(options, "none.mcap");
  options.recordings = {drive};
  options.subject = "eg";
  refused(options, "did you mean 'ego'?");
  options.subject = "agent:1";
  refused(options, "the recording has no traffic");
  options.subject.clear();
  options.intervals = {"a=mark:begin..end"};
  refused(options, "no mark 'begin'");
  options.intervals = {"a=2..1"};
  refused(options, "is empty");
  options.intervals = {"a=0..1", "a=1..2"};
  refused(options, "two intervals are named 'a'");
  options.intervals.clear();
  options.intervals = {"a=while speed_mps > 1"};
  options.baseline = "a";
  refused(options, "interval 'a' has a condition");
  options.intervals.clear();
  options.baseline = "quiet";
  refused(options, "there is no interval 'quiet'");
  options.baseline.clear();
  options.out = Path("table.txt");
  refused(options, "a table is written as .csv or .json");
  options.out.clear();
  options.series = Path("s.csv");
  options.recordings = {drive, drive};
  refused(options, "2 recordings are named");
  MeasuresOptions explain;
  explain.explain = "sdlp";
  refused(explain, "did you mean 'sdlp_m'?");
}

// Two seconds: each measure is a number, or missing with a reason. Intervals may overlap: two that share half
// a second have the samples of their three parts.
TEST_F(MeasuresCommand, AShortDriveAndIntervalsThatOverlap) {
  const std::string drive = Drive(2.0);
  MeasuresOptions options;
  options.recordings = {drive};
  options.intervals = {
      "all=start..end",          "early=0..1.5", "late=1..end", "first=0..1", "both=1..1.5", "last=1.5..end",
      "fast=while speed_mps > 1"};
  options.out = Path("long.csv");
  options.long_format = true;
  const Said said = Of(options);
  ASSERT_EQ(said.status, 0) << said.errors;
  std::map<std::string, int> samples;
  std::size_t found = 0, missing = 0;
  for (const auto& row : Rows(ReadBack("long.csv"))) {
    EXPECT_NE(row.at("value").empty(), row.at("missing").empty()) << row.at("interval") << " " << row.at("measure");
    (row.at("value").empty() ? missing : found) += 1;
    if (row.at("value").empty()) continue;
    EXPECT_TRUE(std::isfinite(std::stod(row.at("value")))) << row.at("measure");
    if (row.at("measure") == "speed_max_mps") samples[row.at("interval")] = std::stoi(row.at("n"));
  }
  EXPECT_GT(found, 100u);
  EXPECT_GT(missing, 100u) << "filters and lanes have too little";
  ASSERT_EQ(samples.size(), 7u);
  EXPECT_EQ(samples["early"], samples["first"] + samples["both"]);
  EXPECT_EQ(samples["late"], samples["both"] + samples["last"]);
  EXPECT_EQ(samples["early"] + samples["late"] - samples["both"], samples["all"]);
}

// On a recording with events: from an event on for some seconds, by speed, lane, stations and junction. The intervals
// are those of the time series.
TEST_F(MeasuresCommand, IntervalsOfEventsAndConditions) {
  const std::string drive = Record("drive.mcap", LaunchFile("car_ahead.yaml"), {"--for", "12"});
  const auto run = replay::RecordedRun::Open(drive);
  ASSERT_TRUE(run.ok());
  const auto events = measures::ReadEvents(run.value().reader(), idl::Aliases());
  ASSERT_TRUE(events.ok());
  const auto at = std::ranges::find(events.value(), "traffic.speed", &measures::DriveEvent::name);
  ASSERT_NE(at, events.value().end()) << "the story slows the car ahead after 6 s";
  const measures::DriveEvent& first = *at;
  MeasuresOptions options;
  options.recordings = {drive};
  options.intervals = {
      "event=event:" + first.name + "..+1.5",  "fast=while speed_mps > 5",     "lane=while lane < 0",
      "stations=while s_m >= 0 and s_m < 1e6", "junction=while junction == 1", "road=while junction == 0"};
  options.series = Path("series.csv");
  options.out = Path("table.csv");
  const Said said = Of(options);
  ASSERT_EQ(said.status, 0) << said.errors;
  const auto series = Rows(ReadBack("series.csv"));
  std::map<std::string, double> seconds;  // of all intervals of a name
  for (const auto& row : Rows(ReadBack("table.csv"))) {
    if (row.at("from_s").empty()) continue;
    const std::string name = row.at("interval").substr(0, row.at("interval").find('#'));
    if (name == "event") {
      EXPECT_NEAR(std::stod(row.at("from_s")), first.time_s, 1e-9);
    }
    seconds[name] += std::stod(row.at("to_s")) - std::stod(row.at("from_s"));
  }
  std::map<std::string, double> expected;
  for (const auto& row : series) {
    const auto number = [&](const char* column) { return row.at(column).empty() ? -1e9 : std::stod(row.at(column)); };
    if (number("speed_mps") > 5.0) expected["fast"] += 0.01;
    if (number("lane") < 0.0 && !row.at("lane").empty()) expected["lane"] += 0.01;
    if (number("s_m") >= 0.0) expected["stations"] += 0.01;
    if (number("junction") == 1.0) expected["junction"] += 0.01;
    if (number("junction") == 0.0) expected["road"] += 0.01;
  }
  EXPECT_NEAR(seconds["event"], 1.5, 1e-9);
  for (const char* name : {"fast", "lane", "stations", "junction", "road"})
    EXPECT_NEAR(seconds[name], expected[name], 1e-6) << name;
  EXPECT_GT(expected["fast"] + expected["road"], 5.0);
}

TEST_F(MeasuresCommand, ListAndExplain) {
  MeasuresOptions options;
  options.list = true;
  const Said list = Of(options);
  EXPECT_EQ(list.status, 0);
  EXPECT_THAT(list.out, HasSubstr("sdlp_m"));
  options.list = false;
  options.explain = "tet_s";
  const Said explained = Of(options);
  EXPECT_EQ(explained.status, 0);
  EXPECT_THAT(explained.out, HasSubstr("Minderhoud & Bovy 2001"));
  EXPECT_THAT(explained.out, HasSubstr("threshold_s"));
}

}  // namespace
}  // namespace rodeira::cli
