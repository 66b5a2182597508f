// SPDX-License-Identifier: Apache-2.0
// A recording is a fact: computed again it is the same to the bit, and whatever is not is found and named.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <fstream>
#include <functional>
#include <map>
#include <thread>

#include "common/core/base/files.hpp"
#include "common/core/base/version.hpp"
#include "common/data/record/mcap_reader.hpp"
#include "common/data/record/mcap_writer.hpp"
#include "idl/codec.hpp"
#include "idl/messages.hpp"
#include "idl/topics.hpp"
#include "launch/rodeira/replay/branch.hpp"
#include "launch/rodeira/replay/verify.hpp"
#include "tests/launch/rodeira/replay/replay_fixture.hpp"
#include "tests/system/recording.hpp"
#include "tests/tree.hpp"

namespace rodeira::cli {
namespace {

using ::testing::HasSubstr;

TEST_F(ReplayTest, ComputedAgainIsTheSame) {
  const std::string file = Drive();
  const auto whole = VerifyFile(file);
  ASSERT_TRUE(whole.ok()) << whole.error().Text();
  EXPECT_FALSE(whole.value().difference.has_value()) << whole.value().difference->Text();
  EXPECT_EQ(whole.value().nodes, 2u);
  EXPECT_EQ(whole.value().samples, 2u * 3001u + 301u + 2u * 4u)
      << "the car's state and what it hits, the controls, snapshots";
  EXPECT_EQ(whole.value().snapshots, 8u);
  const auto late = VerifyFile(file, 2500);
  ASSERT_TRUE(late.ok()) << late.error().Text();
  EXPECT_EQ(late.value().first_step, 2000);
  EXPECT_FALSE(late.value().difference.has_value()) << late.value().difference->Text();
  EXPECT_EQ(late.value().samples, 2u * 1001u + 101u + 2u * 2u);
}

TEST_F(ReplayTest, ATurnedBitIsFound) {
  const std::string file = WithABitTurned(Drive(), "rodeira/vehicle_state", 1234, 100);
  const auto verdict = VerifyFile(file);
  ASSERT_TRUE(verdict.ok()) << verdict.error().Text();
  ASSERT_TRUE(verdict.value().difference.has_value());
  EXPECT_EQ(verdict.value().difference->step, 1234);
  EXPECT_EQ(verdict.value().difference->node, "ego");
  EXPECT_EQ(verdict.value().difference->topic, "rodeira/vehicle_state");
  EXPECT_THAT(verdict.value().difference->field, HasSubstr("_w"));  // a component of a vector, in the world's axes
  EXPECT_NE(verdict.value().difference->recorded, verdict.value().difference->computed);
}

TEST_F(ReplayTest, ATurnedBitOfAStateIsFoundAndTheFieldNamed) {
  const std::string file = Drive();
  // Behind the snapshot's head (some 100 bytes): in the node's state.
  const std::string turned = WithABitTurned(file, "rodeira/snapshot", 3, 150);
  const auto verdict = VerifyFile(turned);
  ASSERT_TRUE(verdict.ok()) << verdict.error().Text();
  ASSERT_TRUE(verdict.value().difference.has_value());
  EXPECT_EQ(verdict.value().difference->step, 1000);
  EXPECT_EQ(verdict.value().difference->topic, "rodeira/snapshot");
  EXPECT_THAT(verdict.value().difference->field, ::testing::StartsWith("state."));
}

// Outputs and states are digested separately: a state that differs is found at its step, though the output is the same.
TEST_F(ReplayTest, AChangedStateDigestIsFoundThoughTheOutputIsTheSame) {
  constexpr std::size_t kStateDigestAt =
      lockstep::SampleHeader::kEncapsulation + lockstep::SampleHeader::kSize - sizeof(base::Digest);
  const std::string file = Drive();
  const auto original = replay::RecordedRun::Open(file),
             changed = replay::RecordedRun::Open(WithABitTurned(file, "rodeira/vehicle_state", 777, kStateDigestAt));
  EXPECT_EQ(CarAt(original.value(), 777).header().state_digest() ^ 1u,
            CarAt(changed.value(), 777).header().state_digest());
  EXPECT_EQ(CarAt(original.value(), 777).position_w_m().x(), CarAt(changed.value(), 777).position_w_m().x());
  const auto verdict = Verify(changed.value(), 0);
  ASSERT_TRUE(verdict.ok()) << verdict.error().Text();
  ASSERT_TRUE(verdict.value().difference.has_value());
  EXPECT_EQ(verdict.value().difference->step, 777);
  EXPECT_EQ(verdict.value().difference->node, "ego");
  EXPECT_EQ(verdict.value().difference->field, "header.state_digest");
  EXPECT_NE(verdict.value().difference->recorded, verdict.value().difference->computed);
}

// What a person reads, with the numbers of the law: steps, nodes that compute, samples of all sources, snapshots of
// both nodes.
TEST_F(ReplayTest, WhatIsIdenticalIsSaidInNumbers) {
  const std::string file = Drive();
  const auto whole = RunCommand({Bin("rodeira"), "replay", file, "--verify"});
  EXPECT_EQ(whole.status, 0) << whole.out;
  EXPECT_THAT(whole.out,
              ::testing::StartsWith("identical: 3000 steps, 2 nodes (6311 samples, 8 snapshots; from 0.000 s; "));
  const auto late = RunCommand({Bin("rodeira"), "replay", file, "--verify", "--from", "2.5"});
  EXPECT_EQ(late.status, 0) << late.out;
  EXPECT_THAT(late.out,
              ::testing::StartsWith("identical: 1000 steps, 2 nodes (2107 samples, 4 snapshots; from 2.000 s; "));
}

TEST_F(ReplayTest, AChangedConstantIsFound) {
  const std::string file = Drive();
  const auto verdict = VerifyFile(file, 0, {{"nodes.ego.config.start.speed_mps", "0.001"}});
  ASSERT_TRUE(verdict.ok()) << verdict.error().Text();
  ASSERT_TRUE(verdict.value().difference.has_value());
  EXPECT_EQ(verdict.value().difference->step, 0);
  EXPECT_EQ(verdict.value().difference->node, "ego");
}

TEST_F(ReplayTest, ABrokenNodeIsFoundAndNamed) {
  for (const char* broken : {"clock", "order"}) {
    const std::string file = Record(
        std::string(broken) + ".mcap", LaunchFile("empty.yaml"),
        {"--for", "1.5", "--set", std::string("nodes.c.config.broken=") + broken, "--set", "snapshot_every_s=0.5"});
    const auto run = RunCommand({Bin("rodeira"), "replay", file, "--verify"});  // in another process: other addresses
    EXPECT_EQ(run.status, 1) << run.out;
    EXPECT_THAT(run.out, HasSubstr("first difference at step 1: node 'c', topic rodeira/pulse, field 'value'"))
        << run.out;
  }
}

// What is left of a recording is a run again: up to its last whole step it is verified and may be branched from.
TEST_F(ReplayTest, ARepairedFileIsARunUpToWhereItIsWhole) {
  const std::string file = Drive();
  const std::string cut = (folder_.path() / "cut.mcap").string(), good = (folder_.path() / "good.mcap").string();
  std::filesystem::copy_file(file, cut);
  std::filesystem::resize_file(cut, std::filesystem::file_size(file) * 6 / 10);
  const auto repair = RunCommand({Bin("rodeira"), "repair", cut, "--out", good});
  ASSERT_EQ(repair.status, 1) << "what is lost is no success: " << repair.out;
  const auto run = replay::RecordedRun::Open(good);
  ASSERT_TRUE(run.ok()) << run.error().Text();
  EXPECT_FALSE(run.value().complete());
  EXPECT_GT(run.value().last_step(), 700);
  EXPECT_LT(run.value().last_step(), 3000);
  const auto verdict = VerifyFile(good);
  ASSERT_TRUE(verdict.ok()) << verdict.error().Text();
  EXPECT_FALSE(verdict.value().difference.has_value()) << verdict.value().difference->Text();
  EXPECT_EQ(verdict.value().last_step, run.value().last_step());
  EXPECT_GE(verdict.value().samples, static_cast<std::uint64_t>(run.value().last_step()));
  EXPECT_TRUE(Branch({good, 500, {{"seed", "2"}}, std::nullopt, (folder_.path() / "branch.mcap").string()}).ok());
}

// A byte anywhere behind the first bytes, also where it is not read otherwise: metadata, embedded files.
TEST_F(ReplayTest, AChangedByteOutsideOfTheSamplesIsFoundToo) {
  const std::string file =
      Record("drive.mcap", LaunchFile("first_drive.yaml"), {"--for", "1", "--meta", "participant=P07"});
  const auto original = base::ReadText(file).value();
  for (const auto& [from, to] : {std::pair<std::string, std::string>{"P07", "P06"},
                                 {"last_step", "last_stop"},
                                 {"1000", "0999"},
                                 {"rodeira.end", "rodeira.eno"}}) {
    std::string text = original;
    const auto at = text.rfind(from);
    ASSERT_NE(at, std::string::npos) << from;
    const std::string changed = folder_.Write("changed.mcap", text.replace(at, from.size(), to)).string();
    const auto verify = RunCommand({Bin("rodeira"), "replay", changed, "--verify"});
    EXPECT_EQ(verify.status, 2) << from << ": " << verify.out;
    const auto info = RunCommand({Bin("rodeira"), "info", changed});
    EXPECT_NE(info.status, 0) << from << ": " << info.out;
    EXPECT_THAT(info.out, testing::AnyOf(HasSubstr("damage"), HasSubstr("rodeira: "))) << from;
  }
}

// The demo with another model of its car: a word on the command line, the same nodes, recorded and computed again.
TEST_F(ReplayTest, TheDemoMayBeDrivenByAnyModel) {
  std::map<std::string, double> driven_m;
  for (const std::string model : {"bicycle", "multibody", "ode"}) {
    const std::string file =
        Record(model + ".mcap", LaunchFile("demo.yaml"),
               {"--for", "3", "--headless", "--set", "nodes.view.config.frames=~", "--set", "vehicle.model=" + model});
    const auto verdict = VerifyFile(file);
    ASSERT_TRUE(verdict.ok()) << verdict.error().Text();
    EXPECT_FALSE(verdict.value().difference.has_value()) << model << ": " << verdict.value().difference->Text();
    const auto run = replay::RecordedRun::Open(file);
    ASSERT_TRUE(run.ok()) << run.error().Text();
    driven_m[model] = CarAt(run.value(), 3000).odometer_m();
    EXPECT_GT(driven_m[model], 1.0) << model;
  }
  EXPECT_NE(driven_m["ode"], driven_m["bicycle"]);
  EXPECT_NE(driven_m["multibody"], driven_m["bicycle"]);
  const auto unknown = RunCommand({Bin("rodeira"), "run", LaunchFile("demo.yaml"), "--in-process", "--headless",
                                   "--no-record", "--set", "vehicle.model=bycicle"});
  EXPECT_EQ(unknown.status, 2);
  EXPECT_THAT(unknown.out, HasSubstr("this car is wanted as model 'bycicle'; did you mean 'bicycle'?"));
}

// What cannot save its state is computed from the first step, wherever one asks it to begin.
TEST_F(ReplayTest, ANodeWithoutAStateIsComputedFromTheStart) {
  const std::string file =
      Record("without.mcap", LaunchFile("empty.yaml"),
             {"--for", "1.5", "--set", "nodes.c.config.saves=false", "--set", "snapshot_every_s=0.5"});
  const auto late = VerifyFile(file, 1200);
  ASSERT_TRUE(late.ok()) << late.error().Text();
  EXPECT_FALSE(late.value().difference.has_value()) << late.value().difference->Text();
  EXPECT_EQ(late.value().first_step, 0);
  EXPECT_EQ(late.value().without_state, std::vector<std::string>{"c"});
  EXPECT_EQ(late.value().samples, 4u * 1501u + 4u * 4u);
  const auto said = RunCommand({Bin("rodeira"), "replay", file, "--verify", "--from", "1.2"});
  EXPECT_EQ(said.status, 0) << said.out;
  EXPECT_THAT(
      said.out,
      HasSubstr("node 'c' cannot save its state: all is computed again from step 0\nidentical: 1500 steps, 4 nodes"));
  EXPECT_THAT(RunCommand({Bin("rodeira"), "info", file}).out,
              HasSubstr("state   node 'c' cannot save its state: replayed from the first step"));
  // Its digests are compared like all others: a change of another node reaches it.
  const auto changed = VerifyFile(file, 1200, {{"nodes.c.config.broken", "clock"}});
  ASSERT_TRUE(changed.ok()) << changed.error().Text();
  ASSERT_TRUE(changed.value().difference.has_value());
  EXPECT_EQ(changed.value().difference->node, "c");
  EXPECT_EQ(changed.value().difference->step, 1);
}

// Embedded files are unpacked to be read; what is wrong with one is said by its name in the recording, not by where it
// was unpacked.
TEST_F(ReplayTest, AnEmbeddedFileIsNamedAsItIsEmbedded) {
  const std::string file = Drive(1.0);
  const auto all = [](const std::string&, const record::Message&, base::Bytes&) { return true; };
  const auto nothing = [](const std::string&, record::TextMap&) {};
  const auto without = [&](const std::string& name) {
    const std::string copy = Copied(file, nothing, all, [&](const std::string& other) { return other != name; });
    const auto verdict = VerifyFile(copy);
    EXPECT_FALSE(verdict.ok()) << name;
    if (verdict.ok()) return std::string();
    EXPECT_EQ(verdict.error().exit_status(), 2) << name;
    EXPECT_THAT(verdict.error().Text(), ::testing::StartsWith(copy + ": ")) << name;
    EXPECT_THAT(verdict.error().Text(), ::testing::Not(HasSubstr("rodeira-replay"))) << name;
    return verdict.error().Text().substr(copy.size() + 2);
  };
  EXPECT_EQ(without("launch.yaml"),
            "the embedded file 'launch.yaml' is missing; without it nobody knows who took part");
  EXPECT_THAT(without("files/../configs/vehicles/default.yaml"),
              HasSubstr("../configs/vehicles/default.yaml: there is no such file"));
  EXPECT_THAT(without("files/../configs/worlds/plane.yaml"),
              HasSubstr("../configs/worlds/plane.yaml: there is no such file"));
  const auto wrong_change =
      Branch({file, 500, {{"nodes.ego.config.vehicel", "2"}}, std::nullopt, (folder_.path() / "branch.mcap").string()});
  ASSERT_FALSE(wrong_change.ok());
  EXPECT_THAT(wrong_change.error().Text(), ::testing::StartsWith(file + ": "));
  EXPECT_THAT(wrong_change.error().Text(), HasSubstr(": first_drive.yaml: unknown key 'nodes.ego.config.vehicel'"));
}

// What was repaired in a world is said again where its nodes are computed again, with the file's recorded name.
TEST_F(ReplayTest, RepairsOfTheWorldAreSaidAsByTheRun) {
  folder_.Write("broken.xodr",
                "<OpenDRIVE><header revMajor=\"1\" revMinor=\"7\"/><road id=\"1\" length=\"300\" junction=\"-1\">"
                "<link><successor elementType=\"road\" elementId=\"7\" contactPoint=\"start\"/></link><planView>"
                "<geometry s=\"0\" x=\"0\" y=\"0\" hdg=\"0\" length=\"300\"><line/></geometry></planView><lanes>"
                "<laneSection s=\"0\"><center><lane id=\"0\" type=\"none\"/></center><right><lane id=\"-1\" "
                "type=\"driving\"><width sOffset=\"0\" a=\"3.5\" b=\"0\" c=\"0\" d=\"0\"/></lane></right>"
                "</laneSection></lanes></road></OpenDRIVE>");
  const std::string root = SourceDir();
  const auto launch = folder_.Write("broken.yaml",
                                    "rodeira: launch/1\nworld: broken.xodr\nnodes:\n  road: {kind: road}\n"
                                    "  driver: {kind: input, config: {source: script, script: " +
                                        root +
                                        "/tests/data/standing.csv}}\n  ego: {kind: vehicle, "
                                        "config: {vehicle: " +
                                        root +
                                        "/configs/vehicles/default.yaml}}\n"
                                        "  recorder: {kind: recorder}\n");
  const std::string file = Record("broken.mcap", launch.string(), {"--for", "1"});
  const std::string branch = (folder_.path() / "branch.mcap").string();
  const auto said = [](const system_test::Ended& ended) {
    EXPECT_EQ(ended.status, 0) << ended.out;
    const std::size_t at = ended.out.find("broken.xodr:1: road.linkage.id: road 1, s 300: ");
    return at == std::string::npos ? std::string() : ended.out.substr(at, ended.out.find('\n', at) - at);
  };
  const std::string by_run = said(RunCommand({Bin("rodeira"), "run", launch.string(), "--in-process", "--for", "0.1"}));
  ASSERT_NE(by_run, "");
  const auto verified = RunCommand({Bin("rodeira"), "replay", file, "--verify"});
  EXPECT_EQ(said(verified), by_run);
  EXPECT_EQ(verified.out.find("/rodeira-replay"), std::string::npos) << "no name of a temporary folder";
  const auto branched =
      RunCommand({Bin("rodeira"), "replay", file, "--branch", "seed=7", "--from", "0.5", "--record", branch});
  EXPECT_EQ(said(branched), by_run);
}

// What counts is the file as it was, wherever the launch file says that it lies.
TEST_F(ReplayTest, AFileNamedByItsWholePathIsTheEmbeddedOne) {
  const std::string root = SourceDir();
  const auto vehicle = folder_.Write("car.yaml", base::ReadText(root + "/configs/vehicles/default.yaml").value());
  const auto launch =
      folder_.Write("launch/whole.yaml", "rodeira: launch/1\nworld: " + root +
                                             "/configs/worlds/plane.yaml\nnodes:\n  road: {kind: road}\n"
                                             "  driver: {kind: input, config: {source: script, script: " +
                                             root +
                                             "/tests/data/standing.csv}}\n"
                                             "  ego: {kind: vehicle, config: {vehicle: \"" +
                                             vehicle.string() + "\"}}\n  recorder: {kind: recorder}\n");
  const std::string file = Record("whole.mcap", launch.string(), {"--for", "1"});
  ASSERT_TRUE(base::WriteWhole(vehicle, std::string_view("another car")).ok());
  const auto verdict = VerifyFile(file);
  ASSERT_TRUE(verdict.ok()) << verdict.error().Text();
  EXPECT_FALSE(verdict.value().difference) << verdict.value().difference->Text();
  // And of a branch, which is laid out again.
  const std::string branch = (folder_.path() / "branch.mcap").string();
  const auto made = Branch({file, 500, {{"seed", "7"}}, std::nullopt, branch});
  ASSERT_TRUE(made.ok()) << made.error().Text();
  const auto again = VerifyFile(branch, 600);
  ASSERT_TRUE(again.ok()) << again.error().Text();
  EXPECT_FALSE(again.value().difference) << again.value().difference->Text();
}

TEST_F(ReplayTest, ADifferenceIsSaidWithTheProgramThatRecorded) {
  const std::string file = Drive(1.0);
  const auto default_value = [](const std::string& topic, const record::Message& message, base::Bytes& data) {
    if (topic == "rodeira/vehicle_state" && message.log_time_ns == 500'000'000) data[100] ^= std::byte{1};
    return true;
  };
  const auto verify = [](const std::string& recording) {
    const auto ended = RunCommand({Bin("rodeira"), "replay", recording, "--verify"});
    EXPECT_EQ(ended.status, 1) << ended.out;
    EXPECT_THAT(ended.out, HasSubstr("first difference at step 500"));
    return ended.out;
  };
  EXPECT_THAT(verify(Copied(
                  file, [](const std::string&, record::TextMap&) {}, default_value)),
              ::testing::Not(HasSubstr("recorded by another program")));
  const auto by_another = [](const std::string& name, record::TextMap& entries) {
    if (name == "rodeira") entries["commit"] = "0123456";
  };
  EXPECT_THAT(verify(Copied(file, by_another, default_value)),
              HasSubstr(fmt::format(
                  "recorded by another program (version {0}, commit 0123456; this one is version {0}, commit ",
                  base::Version())));
}

// A recording of another program is computed again as long as its types are this program's.
TEST_F(ReplayTest, OtherTypesAreNamedWithTheProgramThatRecorded) {
  const std::string file = Drive(1.0);
  const auto of_another = [](const std::string& name, record::TextMap& entries) {
    if (name != "rodeira") return;
    entries["protocol_hash"] = "0123456789abcdef";
    entries["commit"] = "0123456";
  };
  const auto with_idl = [&](const std::vector<std::array<std::string, 3>>& changes) {
    const std::string copy = (folder_.path() / "other.mcap").string();
    CopyRecording(
        file, copy, of_another, [](const std::string&, const record::Message&, base::Bytes&) { return true; },
        [](const std::string&) { return true; }, {},
        [&](const std::string& type, std::string& text) {
          for (const auto& [of, before, after] : changes) {
            if (type == of) text.replace(text.find(before), before.size(), after);
          }
        });
    return copy;
  };
  const auto same =
      VerifyFile(with_idl({{"rodeira::msg::Controls", "// positive to the left", "// left is positive"}}));
  ASSERT_TRUE(same.ok()) << same.error().Text();
  EXPECT_FALSE(same.value().difference) << same.value().difference->Text();

  const std::string other = with_idl({{"rodeira::msg::Controls", "double throttle", "double accelerator"},
                                      {"rodeira::msg::VehicleState", "double odometer_m", "float odometer_m"}});
  const std::string sentence =
      "the recording's types are not this program's: topic rodeira/controls: rodeira::msg::Controls, member 3: found "
      "'double accelerator', expected 'double throttle'; topic rodeira/vehicle_state: rodeira::msg::VehicleState, "
      "member 9: found 'float odometer_m', expected 'double odometer_m'; it was recorded by version 0.1.0, commit "
      "0123456: use that version";
  const auto verify = RunCommand({Bin("rodeira"), "replay", other, "--verify"});
  EXPECT_EQ(verify.status, 2) << verify.out;
  EXPECT_THAT(verify.out, HasSubstr(sentence));
  const auto branch = Branch({other, 500, {}, std::nullopt, (folder_.path() / "branch.mcap").string()});
  ASSERT_FALSE(branch.ok());
  EXPECT_THAT(branch.error().Text(), HasSubstr(sentence));

  const auto info = RunCommand({Bin("rodeira"), "info", other});
  EXPECT_EQ(info.status, 0) << info.out;
  EXPECT_THAT(info.out,
              HasSubstr("type      topic rodeira/controls differs from this program's: rodeira::msg::Controls"));
  EXPECT_THAT(info.out, HasSubstr("lossless"));
  const std::string tables = (folder_.path() / "tables").string();
  const auto exported = RunCommand({Bin("rodeira"), "export", "--csv", tables,
                                    with_idl({{"rodeira::msg::Controls", "double throttle", "double accelerator"}})});
  EXPECT_EQ(exported.status, 0) << exported.out;
  EXPECT_THAT(base::ReadText(tables + "/controls.csv").value(), HasSubstr("steering_wheel_rad,accelerator,brake"));
}

// Topics, types and members had other names.
TEST_F(ReplayTest, ARecordingWithFormerNamesIsDescribedAndExportedWithTodays) {
  const std::string file = SourceDir() + "/tests/data/recordings/scripted_2c2fa2f4.mcap";
  const auto info = RunCommand({Bin("rodeira"), "info", file});
  EXPECT_EQ(info.status, 0) << info.out;
  EXPECT_THAT(info.out, HasSubstr("lossless: each source's samples are there once, from step 0 to step 200"));
  EXPECT_THAT(info.out, HasSubstr("rodeira/wall "));
  EXPECT_THAT(info.out, ::testing::Not(HasSubstr("differs from this program's")));
  EXPECT_THAT(info.out, ::testing::Not(HasSubstr("wall times of")));
  const std::string tables = (folder_.path() / "tables").string();
  const auto exported = RunCommand({Bin("rodeira"), "export", "--csv", tables, file});
  ASSERT_EQ(exported.status, 0) << exported.out;
  const auto columns = [&](const std::string& table) {
    const auto text = base::ReadText(tables + "/" + table);
    EXPECT_TRUE(text.ok()) << table;
    return text.ok() ? text.value().substr(0, text.value().find('\n')) : std::string();
  };
  EXPECT_THAT(columns("vehicle_state.csv"), HasSubstr(",fuel_used_kg,odometer_m,"));
  EXPECT_THAT(columns("vehicle_state.csv"), ::testing::EndsWith(",state_digest"));
  EXPECT_THAT(columns("collisions.csv"), HasSubstr("contacts.impulse_x_newton_s"));
  EXPECT_THAT(columns("wall_time.csv"), HasSubstr("through_step"));
}

TEST_F(ReplayTest, AMissingSnapshotIsNamed) {
  const std::string file = Drive(2.0);
  const auto nothing = [](const std::string&, record::TextMap&) {};
  const std::string lacking =
      Copied(file, nothing, [](const std::string& topic, const record::Message& message, base::Bytes&) {
        return topic != idl::topics::kSnapshot || message.log_time_ns != 1'000'000'000;
      });
  const auto branch = Branch({lacking, 1500, {}, std::nullopt, (folder_.path() / "branch.mcap").string()});
  ASSERT_FALSE(branch.ok());
  EXPECT_EQ(branch.error().exit_status(), 2);
  EXPECT_THAT(branch.error().Text(),
              testing::MatchesRegex(".*the snapshot of node '[a-z]+' at step 1000 is missing.*"));
}

// Other programs read the file by its IDL, people by what it says of itself: neither may say anything else than the
// run.
TEST_F(ReplayTest, WhatTheFileSaysOfItselfMustBeTrue) {
  const std::string file = Drive(2.0);
  const auto all = [](const std::string&, const record::Message&, base::Bytes&) { return true; };
  const auto refusal = [&](const std::string& copy) {
    const auto verdict = VerifyFile(copy);
    EXPECT_FALSE(verdict.ok());
    if (verdict.ok()) return std::string();
    EXPECT_EQ(verdict.error().exit_status(), 2);
    return verdict.error().Text();
  };
  const std::string copy = (folder_.path() / "idl.mcap").string();
  CopyRecording(
      file, copy, [](const std::string&, record::TextMap&) {}, all, [](const std::string&) { return true; }, {},
      [](const std::string& type, std::string& text) {
        if (type == "rodeira::msg::Controls") text.replace(text.find("throttle"), 8, "thrattle");
      });
  EXPECT_THAT(refusal(copy), HasSubstr("topic rodeira/controls: rodeira::msg::Controls, member 3: found 'double "
                                       "thrattle', expected 'double throttle'"));
  for (const auto& [key, value] : std::vector<std::pair<std::string, std::string>>{
           {"seed", "7"}, {"base_step_ns", "ten"}, {"world_hash", "0123456789abcdef"}}) {
    const auto changed = [&key = key, &value = value](const std::string& name, record::TextMap& entries) {
      if (name == "rodeira") entries[key] = value;
    };
    EXPECT_THAT(refusal(Copied(file, changed, all)),
                testing::AllOf(HasSubstr("the recording says " + key + " " + value)))
        << key;
  }
  const std::string no_snapshot = Copied(
      file, [](const std::string&, record::TextMap&) {},
      [](const std::string& topic, const record::Message& message, base::Bytes&) {
        return topic != idl::topics::kSnapshot || message.log_time_ns != 1'000'000'000;
      });
  EXPECT_THAT(refusal(no_snapshot), testing::MatchesRegex(".*the snapshot of node '[a-z]+' at step 1000 is missing.*"));
  for (const char* last_step : {"-5", "600"}) {
    const std::string shorter = Copied(
        file,
        [&](const std::string& name, record::TextMap& entries) {
          if (name == "rodeira.end") entries["last_step"] = last_step;
        },
        all);
    const auto info = RunCommand({Bin("rodeira"), "info", shorter});
    EXPECT_EQ(info.status, 1) << info.out;
    EXPECT_THAT(info.out, HasSubstr(std::string("its last words say that the run ended at step ") + last_step));
  }
}

// Ctrl-C while what was recorded is unpacked and while it is computed: a sentence, status 1, and no folder is left.
TEST_F(ReplayTest, CtrlCEndsInOrderAndLeavesNothing) {
  const std::string file = Drive(100.0);
  const std::filesystem::path unpacked = folder_.path() / "tmp";
  const std::filesystem::path branch = folder_.path() / "branch.mcap";
  std::filesystem::create_directory(unpacked);
  const std::vector<std::string> verify{"TMPDIR=" + unpacked.string(), Bin("rodeira"), "replay", file, "--verify"};
  std::vector<std::string> to_branch{verify.begin(), verify.end() - 1};
  to_branch.insert(to_branch.end(), {"--from", "0.5", "--branch", "seed=2", "--record", branch.string()});
  for (const auto& [command, number, wait_ms] :
       {std::tuple(verify, SIGINT, 0), std::tuple(verify, SIGTERM, 200), std::tuple(to_branch, SIGINT, 0),
        std::tuple(to_branch, SIGTERM, 200)}) {
    system_test::Started replay(command);
    for (int i = 0; i < 2000 && std::filesystem::is_empty(unpacked); ++i) ::usleep(5000);
    ASSERT_FALSE(std::filesystem::is_empty(unpacked));
    std::this_thread::sleep_for(std::chrono::milliseconds(wait_ms));
    ASSERT_EQ(::kill(replay.pid(), number), 0);
    const auto ended = replay.Wait();
    EXPECT_EQ(ended.status, 1) << ended.out;
    EXPECT_THAT(ended.out, HasSubstr("interrupted at step ")) << wait_ms;
    EXPECT_EQ(std::count(ended.out.begin(), ended.out.end(), '\n'), 1) << ended.out;
    EXPECT_TRUE(std::filesystem::is_empty(unpacked)) << command.back();
    EXPECT_FALSE(std::filesystem::exists(branch));
  }
}

TEST_F(ReplayTest, WhatCannotBeReplayedIsRefusedInOneSentence) {
  const std::string file = Drive(1.0);
  const auto complaint = [&](std::vector<std::string> arguments) {
    std::vector<std::string> command{Bin("rodeira"), "replay"};
    command.insert(command.end(), arguments.begin(), arguments.end());
    const auto ended = RunCommand(command);
    EXPECT_EQ(ended.status, 2) << ended.out;
    EXPECT_EQ(std::count(ended.out.begin(), ended.out.end(), '\n'), 1) << ended.out;
    return ended.out;
  };
  EXPECT_THAT(complaint({file}),
              HasSubstr("nothing to do was named; --view, --frames, --verify or --branch was expected"));
  EXPECT_THAT(complaint({file, "--verify", "--record", "x.mcap"}), HasSubstr("--record is of a branch"));
  EXPECT_THAT(complaint({file, "--verify", "--from", "7"}), HasSubstr("the run ends at 1.000 s"));
  EXPECT_THAT(complaint({file, "--verify", "--from", "-1"}),
              HasSubstr("--from -1 s was found; a time from 0 s to the run's end was expected"));
  EXPECT_THAT(complaint({file, "--branch", "seed=2", "--from", "nan", "--record", "x.mcap"}),
              HasSubstr("--from nan s was found"));
  EXPECT_THAT(
      complaint({file, "--branch", "nodes.ego.config.vehicle=nonesuch.yaml", "--from", "0.5", "--record", "x.mcap"}),
      HasSubstr("nonesuch.yaml"));
  EXPECT_THAT(complaint({file, "--branch", "seed=2", "--from", "7", "--record", "x.mcap"}),
              HasSubstr("the run ends at 1.000 s"));
  EXPECT_THAT(complaint({file, "--branch", "seed=2", "--from", "0.503", "--record", "x.mcap"}),
              HasSubstr("the nearest such time is 0.500 s"));
  EXPECT_THAT(complaint({file, "--branch", "seed=2", "--from", "0.5"}), HasSubstr("--record is missing"));
  EXPECT_THAT(complaint({file, "--branch", "seed=2", "--from", "0.5004", "--record", "x.mcap"}),
              HasSubstr("--from 0.5004 s was found; a multiple of the base step of 0.001 s"));
  EXPECT_THAT(complaint({file, "--branch", "duration_s=0.25", "--from", "0.5", "--record", "x.mcap"}),
              HasSubstr("duration_s = 0.25 was found; the branch begins at 0.500 s"));
  EXPECT_THAT(complaint({file, "--branch", "nodes.another.kind=empty", "--from", "0.5", "--record", "x.mcap"}),
              HasSubstr("another roster"));
  EXPECT_THAT(complaint({file, "--branch", "seed=2", "--from", "0.5", "--record", "/nonexistent/x.mcap"}),
              HasSubstr("/nonexistent/x.mcap: "));
  EXPECT_THAT(complaint({file, "--branch", "nodes.ego.config.vehicel=2", "--from", "0.5", "--record", "x.mcap"}),
              HasSubstr("unknown key 'nodes.ego.config.vehicel'"));
  EXPECT_THAT(complaint({file, "--branch", "nodes.ego.period_s=0.002", "--from", "0.5", "--record", "x.mcap"}),
              HasSubstr("another roster"));
  EXPECT_THAT(complaint({(folder_.path() / "none.mcap").string(), "--verify"}), HasSubstr("none.mcap"));
  std::ofstream(folder_.path() / "text.mcap") << "hello";
  EXPECT_THAT(complaint({(folder_.path() / "text.mcap").string(), "--verify"}), HasSubstr("text.mcap"));
  std::filesystem::resize_file(file, std::filesystem::file_size(file) / 2);
  EXPECT_THAT(complaint({file, "--verify"}), HasSubstr("the recording is not whole"));
}

}  // namespace
}  // namespace rodeira::cli
