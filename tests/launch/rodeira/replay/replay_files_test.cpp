// SPDX-License-Identifier: Apache-2.0
// What a recording embeds and says of itself: files, types, names and the program that recorded; what is refused.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <fstream>

#include "common/core/base/files.hpp"
#include "common/core/base/version.hpp"
#include "idl/topics.hpp"
#include "launch/rodeira/replay/branch.hpp"
#include "launch/rodeira/replay/verify.hpp"
#include "tests/launch/rodeira/replay/replay_fixture.hpp"
#include "tests/system/recording.hpp"
#include "tests/tree.hpp"

namespace rodeira::cli {
namespace {

using ::testing::HasSubstr;

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
  EXPECT_EQ(without("launch.yaml"), "the embedded file 'launch.yaml' is missing; it names the nodes of the run");
  EXPECT_THAT(without("files/../configs/vehicles/default.yaml"),
              HasSubstr("../configs/vehicles/default.yaml: there is no such file"));
  EXPECT_THAT(without("files/../configs/worlds/plane.yaml"),
              HasSubstr("../configs/worlds/plane.yaml: there is no such file"));
  const auto wrong_change =
      Branch({file, 500, {{"nodes.ego.config.vehicel", "2"}}, std::nullopt, (folder_.path() / "branch.mcap").string()});
  ASSERT_FALSE(wrong_change.ok());
  EXPECT_THAT(wrong_change.error().Text(), ::testing::StartsWith(file + ": "));
  EXPECT_THAT(wrong_change.error().Text(), HasSubstr(": unknown key 'nodes.ego.config.vehicel'"));
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
