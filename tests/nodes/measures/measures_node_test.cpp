// SPDX-License-Identifier: Apache-2.0
// The measures of a run, against those that `rodeira measures` finds in its recording.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <string>
#include <tuple>
#include <utility>

#include "common/analysis/measures/series.hpp"
#include "common/core/base/files.hpp"
#include "common/core/base/temporary_folder.hpp"
#include "common/runtime/launch/launch.hpp"
#include "common/runtime/lockstep/in_process.hpp"
#include "common/runtime/replay/recorded_run.hpp"
#include "idl/codec.hpp"
#include "idl/messages.hpp"
#include "idl/topics.hpp"
#include "launch/rodeira/commands/measured_recording.hpp"
#include "launch/rodeira/replay/verify.hpp"
#include "launch/rodeira/run/local_nodes.hpp"
#include "tests/n222.hpp"

namespace rodeira {
namespace {

using lockstep::Step;
namespace topics = idl::topics;

struct Driven {
  std::map<Step, msg::Measures> measures;                                     // by the step at which they are valid
  std::map<std::tuple<std::string, std::string, Step>, base::Digest> others;  // payloads by node, topic and step
};

class MeasuresNode : public testing::Test {
 protected:
  static std::string Configs() { return SourceDir() + "/configs"; }
  static std::string Car(const std::string& more = "") {
    return "{kind: vehicle, config: {vehicle: " + Configs() + "/vehicles/default.yaml" + more + "}";
  }
  static std::string Autopilot() {
    return "{kind: input, config: {source: autopilot, driver: " + Configs() +
           "/drivers/default.yaml, vehicle: " + Configs() + "/vehicles/default.yaml}";
  }
  static std::string Script() {
    return "{kind: input, config: {source: script, script: " + Configs() + "/scenarios/first_drive.csv}";
  }
  // An autopilot's drive, on the plane a script's; `nodes` are further nodes.
  launch::Launch LaunchOf(const std::string& world, const std::string& nodes) const {
    const std::string text =
        "rodeira: launch/1\nseed: 5\n" + (world.empty() ? "" : "world: " + Configs() + "/worlds/" + world + "\n") +
        "nodes:\n  road: {kind: road}\n  driver: " + (world == "plane.yaml" ? Script() : Autopilot()) +
        ", inputs: {vehicle_state: [ego]}}\n  ego: " + Car() +
        ", inputs: {controls: [driver]}}\n  recorder: {kind: recorder, config: {file: \"" + File() + "\"}}\n" + nodes;
    const auto path = folder_.path() / "run.yaml";  // the recorder embeds it
    EXPECT_TRUE(base::WriteWhole(path, std::string_view(text)).ok());
    auto launch = launch::Launch::Load(path);
    EXPECT_TRUE(launch.ok()) << launch.error().Text();
    return std::move(launch).value();
  }
  std::string File() const { return (folder_.path() / "run.mcap").string(); }

  Driven Drive(const launch::Launch& launch, Step last) const {
    std::filesystem::remove(File());
    launch::RunLogBoard log;
    auto nodes = cli::LocalNodes::Make(launch, {}, &log);
    EXPECT_TRUE(nodes.ok()) << nodes.error().Text();
    Driven run;
    lockstep::InProcessSettings settings;
    settings.last_step = last;
    settings.on_log = [&log](const lockstep::LogBatch& batch) { log.Say(batch); };
    settings.on_sample = [&](const lockstep::Sample& sample) {
      const auto& source = launch.roster().source(sample.source());
      if (source.topic == topics::kMeasures)
        run.measures[sample.valid()] = idl::Decode<msg::Measures>(*sample.payload).value();
      else if (source.topic != topics::kSnapshot)  // their sources' numbers are behind all others'
        run.others[{launch.roster().node(source.node).name, source.topic, sample.valid()}] =
            base::Hash(std::span<const std::byte>(*sample.payload));
    };
    const auto outcome = lockstep::RunThreaded(launch.roster(), nodes.value().nodes(), settings);
    EXPECT_TRUE(outcome.ok) << outcome.fault;
    return run;
  }

  // Both missing, or the same bits.
  static void ExpectSame(double live, double recorded, const std::string& what) {
    EXPECT_EQ(std::isnan(live), std::isnan(recorded)) << what;
    if (std::isnan(live) || std::isnan(recorded)) return;
    EXPECT_EQ(live, recorded) << what;
  }
  struct Compared {
    int samples = 0, in_lane = 0, with_leader = 0, in_junction = 0;
    double leader_id = 0.0;
  };
  // Each sample of the run with the kinematics of its recording. with_leaders: also what is of the leader.
  Compared Compare(const Driven& run, bool with_leaders = true) const {
    const auto recorded = cli::ReadMeasured(File(), "ego", nullptr);
    EXPECT_TRUE(recorded.ok()) << recorded.error().Text();
    const measures::Drive& drive = recorded.value().reading.drive;
    const auto column = [&](const char* name, std::size_t k) {
      return measures::SeriesValue(drive, measures::FindSeries(name).value(), k);
    };
    Compared compared;
    for (const auto& [valid, m] : run.measures) {
      if (m.state_step() < 0) continue;
      EXPECT_EQ(m.state_step() % 10, 0) << "the recording's kinematics are at 100 Hz";
      const auto k = static_cast<std::size_t>(m.state_step() / 10);
      const std::string at = " at step " + std::to_string(m.state_step());
      ++compared.samples;
      const std::map<const char*, double> own{{"s_m", m.s_m()},
                                              {"t_m", m.t_m()},
                                              {"lane_position_m", m.lane_position_m()},
                                              {"lane_width_m", m.lane_width_m()},
                                              {"heading_error_rad", m.heading_error_rad()},
                                              {"left_line_m", m.left_line_m()},
                                              {"right_line_m", m.right_line_m()},
                                              {"speed_mps", m.speed_mps()},
                                              {"speed_limit_mps", m.speed_limit_mps()},
                                              {"tlc_s", m.tlc_s()}};
      for (const auto& [name, value] : own) ExpectSame(value, column(name, k), name + at);
      EXPECT_EQ((m.valid() & 1) != 0, !std::isnan(column("road", k))) << at;
      EXPECT_EQ((m.valid() & 2) != 0, !std::isnan(column("lane_position_m", k))) << at;
      EXPECT_EQ((m.valid() & 4) != 0, !std::isnan(column("speed_limit_mps", k))) << at;
      EXPECT_EQ((m.valid() & 32) != 0, !std::isnan(column("tlc_s", k))) << at;
      if ((m.valid() & 1) != 0) {
        EXPECT_EQ(m.road(), column("road", k)) << at;
        EXPECT_EQ(m.lane(), column("lane", k)) << at;
        EXPECT_EQ(m.junction(), column("junction", k)) << at;
      }
      if ((m.valid() & 2) != 0) ++compared.in_lane;
      if (m.junction() == 1) ++compared.in_junction;
      if (!with_leaders) continue;
      const std::map<const char*, double> leader{{"leader_gap_m", m.leader_gap_m()},
                                                 {"leader_speed_mps", m.leader_speed_mps()},
                                                 {"time_gap_s", m.time_gap_s()},
                                                 {"ttc_s", m.ttc_s()}};
      for (const auto& [name, value] : leader) ExpectSame(value, column(name, k), name + at);
      EXPECT_EQ((m.valid() & 8) != 0, !std::isnan(column("leader_id", k))) << at;
      EXPECT_EQ((m.valid() & 16) != 0, !std::isnan(column("ttc_s", k))) << at;
      if ((m.valid() & 8) == 0) continue;
      ++compared.with_leader;
      compared.leader_id = static_cast<double>(m.leader_id());
      EXPECT_EQ(compared.leader_id, column("leader_id", k)) << at;
    }
    return compared;
  }
  base::TemporaryFolder folder_ = base::TemporaryFolder::Make("measures-node").value();
};

const char* const kTraffic = "  others: {kind: traffic, config: {vehicles: 40}}\n";

// On one road among traffic: every value is that of the recording to the bit, 20 times a second; the run is computed
// again to the bit, also from the middle; and all other samples are those of the run without the node.
TEST_F(MeasuresNode, SaysWhatTheRecordingHasAndChangesNothing) {
  const Driven run = Drive(LaunchOf("n222.yaml", kTraffic + std::string("  gauge: {kind: measures}\n")), 15000);
  ASSERT_TRUE(run.measures.contains(0));
  EXPECT_EQ(run.measures.at(0).valid(), 0u);
  EXPECT_TRUE(std::isnan(run.measures.at(0).speed_mps())) << "nothing is known before the first sample";
  const Compared compared = Compare(run);
  EXPECT_GE(compared.samples, 299);
  EXPECT_EQ(compared.in_lane, compared.samples);
  EXPECT_GT(compared.with_leader, compared.samples / 2);
  const auto recorded = replay::RecordedRun::Open(File());
  ASSERT_TRUE(recorded.ok()) << recorded.error().Text();
  for (const Step from : {Step{0}, Step{7333}}) {
    const auto verdict = cli::Verify(recorded.value(), from);
    ASSERT_TRUE(verdict.ok()) << verdict.error().Text();
    EXPECT_FALSE(verdict.value().difference.has_value()) << verdict.value().difference->Text();
    EXPECT_TRUE(verdict.value().substituted.empty());
  }
  const Driven without = Drive(LaunchOf("n222.yaml", kTraffic), 15000);
  EXPECT_TRUE(without.measures.empty());
  ASSERT_GT(without.others.size(), 30000u);
  EXPECT_EQ(run.others, without.others);
}

// A second driven vehicle ahead is the leader, by minus its number; of two vehicles the named one is measured.
TEST_F(MeasuresNode, ADrivenVehicleAheadIsTheLeader) {
  const Version1Road& road = N222Road();
  const Eigen::Vector3d place = road.Position(100.0, road.LaneCentre(-1));
  const double heading_deg = road.Evaluate(100.0).heading_rad * 180.0 / 3.14159265358979323846;
  const std::string start = ", start: {x_m: " + std::to_string(place.x()) + ", y_m: " + std::to_string(place.y()) +
                            ", heading_deg: " + std::to_string(heading_deg) + "}";
  const Driven run = Drive(LaunchOf("n222.yaml", "  driver2: " + Autopilot() + ", inputs: {vehicle_state: [lead]}}\n" +
                                                     "  lead: " + Car(start) + ", inputs: {controls: [driver2]}}\n" +
                                                     "  gauge: {kind: measures, config: {vehicle: ego}}\n"),
                           4000);
  const Compared compared = Compare(run);
  EXPECT_GE(compared.with_leader, 75);
  EXPECT_EQ(compared.leader_id, -2.0);
}

// In a network with junctions, where the driver's later way is not known: all that is of the own lane is the
// recording's.
TEST_F(MeasuresNode, LanesAreTheRecordingsAlsoInJunctions) {
  const Driven run =
      Drive(LaunchOf("example/world.yaml", kTraffic + std::string("  gauge: {kind: measures}\n")), 30000);
  const Compared compared = Compare(run, false);
  EXPECT_GT(compared.in_junction, 5);
  EXPECT_GT(compared.in_lane, 300);
}

TEST_F(MeasuresNode, WithoutRoadsOnlyTheSpeedIsThere) {
  const Driven run = Drive(LaunchOf("plane.yaml", "  gauge: {kind: measures}\n"), 1000);
  ASSERT_TRUE(run.measures.contains(1000));
  EXPECT_EQ(run.measures.at(1000).valid(), 0u);
  EXPECT_FALSE(std::isnan(run.measures.at(1000).speed_mps()));
  EXPECT_EQ(run.measures.at(1000).road(), -1);
  EXPECT_EQ(Compare(run).with_leader, 0);
}

TEST_F(MeasuresNode, AWrongVehicleOrKeyIsRefused) {
  const auto refused = [&](const std::string& world, const std::string& config) {
    launch::RunLogBoard log;
    const launch::Launch launch = LaunchOf(world, "  gauge: {kind: measures" + config + "}\n");
    const auto nodes = cli::LocalNodes::Make(launch, {}, &log);
    EXPECT_FALSE(nodes.ok());
    return nodes.ok() ? std::pair<std::string, std::string>()
                      : std::pair(std::string(nodes.error().id.text()), nodes.error().message);
  };
  const auto unknown = refused("n222.yaml", ", config: {vehicle: eggo}");
  EXPECT_EQ(unknown.first, "launch.not_wired");
  EXPECT_THAT(unknown.second, testing::HasSubstr("did you mean 'ego'?"));
  EXPECT_EQ(refused("n222.yaml", ", config: {vehicel: ego}").first, "config.unknown_key");
}

}  // namespace
}  // namespace rodeira
