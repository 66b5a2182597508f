// SPDX-License-Identifier: Apache-2.0
// What a person gives wrongly, one of each kind, in a whole run of the demo: one sentence with its place and what was
// expected, status 2, and nothing left: no recording, no process, nothing in /dev/shm.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "common/core/base/files.hpp"
#include "launch/rodeira/run/shared_memory.hpp"
#include "tests/launch/rodeira/temporary_folder.hpp"
#include "tests/names.hpp"
#include "tests/system/command.hpp"
#include "tests/tree.hpp"

namespace rodeira::system_test {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

const fs::path kRoot = SourceDir();

class Refusal : public ::testing::Test {
 protected:
  // The one line that a run with these words says.
  std::string Of(std::vector<std::string> more, const std::string& launch = LaunchFile("demo.yaml")) const {
    const auto before = cli::SharedMemoryFiles();
    const std::string run_name = "refusal-" + folder_.path().filename().string();
    const fs::path recording = folder_.path() / "never.mcap";
    more.insert(more.begin(), {"/usr/bin/env", "-u", "DISPLAY", "-u", "WAYLAND_DISPLAY", Bin("rodeira"), "run", launch,
                               "--for", "0.1", "--run", run_name, "--record", recording.string()});
    if (launch == LaunchFile("demo.yaml"))
      more.insert(more.end(),
                  {"--set", "nodes.view.config.frames={times_s: [], folder: " + folder_.path().string() + "}"});
    const Ended ended = RunCommand(more);
    EXPECT_EQ(ended.status, 2) << ended.out;
    EXPECT_TRUE(ProcessesWith("--run " + run_name).empty());
    EXPECT_FALSE(fs::exists(recording)) << "a recording of nothing";
    std::set<std::string> left;
    std::ranges::set_difference(cli::SharedMemoryFiles(), before, std::inserter(left, left.end()));
    EXPECT_TRUE(left.empty()) << *left.begin() << " and " << left.size() - 1 << " more stay in /dev/shm";
    EXPECT_EQ(std::ranges::count(ended.out, '\n'), 1) << "one sentence was expected:\n" << ended.out;
    return ended.out;
  }
  std::string Set(const std::string& key, const std::string& value) const { return Of({"--set", key + "=" + value}); }
  std::string Write(const std::string& name, const std::string& text) const {
    return folder_.Write(name, text).string();
  }
  // A file of the project with one piece of its text replaced.
  std::string Changed(const std::string& file, const std::string& old_text, const std::string& new_text) const {
    std::string text = base::ReadText(kRoot / file).value();
    const auto at = text.find(old_text);
    EXPECT_NE(at, std::string::npos) << old_text;
    return Write("changed.yaml", text.replace(at, old_text.size(), new_text));
  }
  std::string World(const std::string& old_text, const std::string& new_text) const {
    return Set("world", Changed("configs/worlds/n222.yaml", old_text, new_text));
  }
  std::string Vehicle(const std::string& old_text, const std::string& new_text) const {
    return Set("nodes.ego.config.vehicle", Changed("configs/vehicles/default.yaml", old_text, new_text));
  }
  const cli::TemporaryFolder folder_;
};

TEST_F(Refusal, LaunchFiles) {
  EXPECT_THAT(Of({}, "/no/such.yaml"), HasSubstr("/no/such.yaml: there is no such file"));
  EXPECT_THAT(Of({}, Write("broken.yaml", "rodeira: launch/1\nnodes: {road: {kind: road}\n")),
              HasSubstr("broken.yaml:3: this is no YAML"));
  EXPECT_THAT(Set("sede", "4"), HasSubstr("unknown key 'sede'; did you mean 'seed'?"));
  EXPECT_THAT(Set("limits.silence_ms", "600"), HasLine("unknown key 'limits.silence_ms' … 'silence_s'"));
  EXPECT_THAT(Set("base_step_s", "2"), HasSubstr("'base_step_s' is 2; a number from 1e-06 to 1 was expected"));
  EXPECT_THAT(Set("nodes.ego.kind", "vehicel"), HasSubstr("'nodes.ego.kind' is 'vehicel'; did you mean 'vehicle'?"));
}

TEST_F(Refusal, WhatANodeIsTold) {
  EXPECT_THAT(Set("nodes.traffic.config.vehicles", "-3"),
              HasLine("'nodes.traffic.config.vehicles' is -3; … from 0 to 100000"));
  EXPECT_THAT(Set("nodes.traffic.config.vehicels", "3"),
              HasSubstr("unknown key 'nodes.traffic.config.vehicels'; did you mean 'vehicles'?"));
  EXPECT_THAT(Set("nodes.driver.config.driver", "/no/driver.yaml"),
              HasSubstr("/no/driver.yaml: there is no such file"));
}

TEST_F(Refusal, Worlds) {
  EXPECT_THAT(Set("world", "/no/world.yaml"), HasSubstr("/no/world.yaml: there is no such file"));
  EXPECT_THAT(Set("world", Write("broken.yaml", "rodeira: world/1\nname: [\n")),
              HasSubstr("broken.yaml:3: this is no YAML"));
  EXPECT_THAT(World("spacing_m: 10", "spacin_m: 10"), HasSubstr("did you mean 'spacing_m'?"));
  EXPECT_THAT(World("spacing_m: 10", "spacing_km: 0.01"), HasSubstr("the unit is part of the name: 'spacing_m'"));
  EXPECT_THAT(World("asphalt: 1.0", "asphalt: 7"),
              HasSubstr("'friction.asphalt' is 7; a number from 0.01 to 2 was expected"));
}

TEST_F(Refusal, Vehicles) {
  EXPECT_THAT(Set("nodes.ego.config.vehicle", "/no/car.yaml"), HasSubstr("/no/car.yaml: there is no such file"));
  EXPECT_THAT(Set("nodes.ego.config.vehicle", Write("broken.yaml", "model: bicycle\n\tmass_kg: 1\n")),
              HasSubstr("broken.yaml:2: this is no YAML"));
  EXPECT_THAT(Vehicle("mass_kg:", "mas_kg:"), HasSubstr("did you mean 'mass_kg'?"));
  EXPECT_THAT(Vehicle("mass_kg:", "mass_t:"), HasSubstr("the unit is part of the name: 'mass_kg'"));
  EXPECT_THAT(Vehicle("mass_kg:", "mass_kg: -1 #"), HasSubstr("mass_kg' is -1; a number "));
}

TEST_F(Refusal, AnElevationFileCutShort) {
  const auto world = Write("hills.yaml",
                           "rodeira: world/1\nname: hills\nterrain:\n  surface: grass\n  generate: {seed: 1, columns: "
                           "33, rows: 33, spacing_m: 10, west_m: 0, south_m: 0, "
                           "relief: [{wavelength_m: 80, amplitude_m: 9}]}\n");
  ASSERT_EQ(RunCommand({Bin("rodeira"), "world", "build", world, "--out", (folder_.path() / "built").string()}).status,
            0);
  fs::path elevation;
  for (const auto& file : fs::directory_iterator(folder_.path() / "built")) {
    if (file.path().extension() == ".bt") elevation = file.path();
  }
  ASSERT_FALSE(elevation.empty());
  const auto whole =
      Write("cut.yaml", "rodeira: world/1\nname: cut\nterrain: {file: " + elevation.string() + ", surface: grass}\n");
  ASSERT_EQ(RunCommand({Bin("rodeira"), "world", "check", whole}).status, 0) << "as long as it is whole";
  fs::resize_file(elevation, 256 + 33 * 33 * 4 - 2);
  EXPECT_THAT(Of({"--set", "world=" + whole}, LaunchFile("first_drive.yaml")),
              HasLine(elevation.filename().string() + ": … 4610 bytes … 33 x 33 … 4612"));
}

TEST_F(Refusal, ANodeToBeStartedAgainThatCannotSaveItsState) {
  EXPECT_THAT(Of({"--set", "recovery=restart", "--set", "nodes.c.config.saves=false"}, LaunchFile("empty.yaml")),
              HasLine("node 'c' … state … 'stop' … 'pause' … nodes.c.recovery"));
}

TEST_F(Refusal, AWindowWithoutADisplay) {
  const std::string said = Set("nodes.view.config.window", "always");
  EXPECT_THAT(said, HasLine("window … DISPLAY … --headless"));
}

TEST(Refused, TheStartWindowWithoutADisplay) {
  const Ended ended = RunCommand({"/usr/bin/env", "-u", "DISPLAY", "-u", "WAYLAND_DISPLAY", Bin("rodeira")});
  EXPECT_EQ(ended.status, 2);
  EXPECT_EQ(ended.out,
            "rodeira: without a command a window opens to choose one, but there is no display; set DISPLAY, or name a "
            "command (`rodeira --help` lists them)\n");
}

TEST_F(Refusal, InOneProcessToo) {
  EXPECT_THAT(Of({"--in-process", "--set", "nodes.view.config.window=always"}), HasLine("window … DISPLAY"));
  EXPECT_THAT(Of({"--in-process", "--set", "world=/no/world.yaml"}),
              HasSubstr("/no/world.yaml: there is no such file"));
}

}  // namespace
}  // namespace rodeira::system_test
