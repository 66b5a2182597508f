// SPDX-License-Identifier: Apache-2.0
// The first drive: clock, road server, vehicle, scripted driver and recorder as processes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <thread>

#include "common/core/base/files.hpp"
#include "common/data/record/mcap_reader.hpp"
#include "idl/codec.hpp"
#include "idl/messages.hpp"
#include "idl/topics.hpp"
#include "tests/long_form.hpp"
#include "tests/names.hpp"
#include "tests/system/command.hpp"
#include "tests/system/recording.hpp"
#include "tests/tree.hpp"

namespace rodeira::system_test {
namespace {

using namespace std::chrono_literals;

class Drive : public ::testing::Test {
 protected:
  Drive() { std::filesystem::create_directories(folder_); }
  ~Drive() override { std::filesystem::remove_all(folder_); }
  std::string Path(const std::string& name) const { return (folder_ / name).string(); }
  static std::vector<std::string> Command(std::vector<std::string> more) {
    more.insert(more.begin(), {Bin("rodeira"), "run", LaunchFile("first_drive.yaml")});
    return more;
  }
  const std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("rodeira-drive-" + std::to_string(::getpid()));
};

std::string Bytes(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST_F(Drive, RecordsTheSameSamplesEveryTimeAndInOneProcessToo) {
  const auto first = RunCommand(Command({"--for", "8", "--record", Path("a.mcap")}));
  ASSERT_EQ(first.status, 0) << first.out;
  ASSERT_EQ(RunCommand(Command({"--for", "8", "--record", Path("b.mcap")})).status, 0);
  ASSERT_EQ(RunCommand(Command({"--for", "8", "--record", Path("c.mcap"), "--in-process"})).status, 0);
  EXPECT_GT(Bytes(Path("a.mcap")).size(), 100'000u);
  // Wall times are in the file too, on channels of their own: what is the same is every sample.
  const auto samples = SamplesOf(Path("a.mcap"));
  EXPECT_GT(samples.size(), 8000u);
  EXPECT_EQ(FirstDifference(samples, SamplesOf(Path("b.mcap"))), "");
  EXPECT_EQ(FirstDifference(samples, SamplesOf(Path("c.mcap"))), "");
}

TEST_F(Drive, WithoutANameTheRecordingGoesToTheDataFolderWhichIsMade) {
  const auto run = RunCommand(
      {"XDG_DATA_HOME=" + Path("fresh"), Bin("rodeira"), "run", LaunchFile("first_drive.yaml"), "--for", "0.1"});
  ASSERT_EQ(run.status, 0) << run.out;
  int recordings = 0;
  for (const auto& entry : std::filesystem::directory_iterator(Path("fresh") + "/rodeira")) {
    EXPECT_TRUE(entry.path().filename().string().starts_with("first_drive-")) << entry.path();
    ++recordings;
  }
  EXPECT_EQ(recordings, 1);
}

// However short the run is: what failed has not finished.
TEST_F(Drive, ARecorderThatCannotWriteFailsTheRun) {
  for (int i = 0; i < BriefOrLong(4, 10); ++i) {
    const auto run = RunCommand(Command({"--for", "0.05", "--record", Path("no/such/folder/a.mcap")}));
    ASSERT_NE(run.status, 0) << run.out;
    EXPECT_NE(run.out.find("node 'recorder' failed at step 0: " + Path("no/such/folder/a.mcap") +
                           ": the recording cannot be created"),
              std::string::npos)
        << run.out;
  }
}

TEST_F(Drive, TheRecordingHoldsEverySampleOnceAndTheCarHasDriven) {
  ASSERT_EQ(RunCommand(Command({"--for", "8", "--record", Path("a.mcap")})).status, 0);
  const auto reader = record::McapReader::Open(Path("a.mcap"));
  ASSERT_TRUE(reader.ok()) << reader.error().Text();
  EXPECT_TRUE(reader.value().condition().whole);
  EXPECT_TRUE(reader.value().Verify().empty());
  const auto channels = reader.value().ChannelsOf(idl::topics::kVehicleState);
  ASSERT_EQ(channels.size(), 1u);
  EXPECT_EQ(reader.value().statistics().messages_by_channel.at(channels[0]), 8001u);
  EXPECT_EQ(reader.value().statistics().messages_by_channel.at(reader.value().ChannelsOf(idl::topics::kControls)[0]),
            801u);
  record::Query query;
  query.channels = std::set<record::ChannelId>{channels[0]};
  auto cursor = reader.value().Messages(query);
  std::int64_t expected = 0;
  msg::VehicleState last;
  for (;;) {
    const auto message = cursor.Next();
    ASSERT_TRUE(message.ok());
    if (!message.value()) break;
    const auto state = idl::Decode<msg::VehicleState>(message.value()->data);
    ASSERT_TRUE(state.ok());
    ASSERT_EQ(state.value().header().step(), expected++);
    last = state.value();
  }
  EXPECT_EQ(expected, 8001);
  EXPECT_GT(last.position_w_m().x(), 20.0) << "seven seconds of half throttle move a car";
  EXPECT_EQ(last.inside_world(), 1u);
}

TEST_F(Drive, AutopilotAndTrafficOnN222GiveTheSameDigestHoweverTheyRun) {
  const std::string launch = SourceDir() + "/tests/data/n222_traffic.yaml";
  const auto digest = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {Bin("rodeira"), "run", launch, "--no-record", "--for", "10"});
    const Ended ended = RunCommand(more);
    EXPECT_EQ(ended.status, 0) << ended.out;
    return DigestIn(ended.out);
  };
  const std::string first = digest({});
  EXPECT_EQ(first.size(), 16u);
  std::atomic<bool> busy = true;
  std::thread load([&busy] {
    while (busy) {
    }
  });
  EXPECT_EQ(digest({}), first) << "under load";
  busy = false;
  load.join();
  EXPECT_EQ(digest({"--in-process"}), first);
  EXPECT_NE(digest({"--seed", "6"}), first);
}

// A world file of version 2, with a network of roads: autopilot, traffic and car drive on it, as processes and in
// one.
TEST_F(Drive, AutopilotAndTrafficDriveOnHaste) {
  const auto run = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {Bin("rodeira"), "run", LaunchFile("haste.yaml"), "--headless", "--for", "20"});
    const Ended ended = RunCommand(more);
    EXPECT_EQ(ended.status, 0) << ended.out;
    return DigestIn(ended.out);
  };
  const std::string digest = run({"--record", Path("haste.mcap")});
  EXPECT_EQ(digest.size(), 16u);
  EXPECT_EQ(run({"--record", Path("one.mcap"), "--in-process"}), digest);
  double furthest_m = 0.0;
  for (const auto& state : MessagesOf<msg::VehicleState>(Path("haste.mcap"), idl::topics::kVehicleState)) {
    furthest_m = state.odometer_m();
    ASSERT_EQ(state.inside_world(), 1u) << state.header().step();
  }
  EXPECT_GT(furthest_m, 200.0);
}

// SUELO asked of the road server at each step, over DDS, and answered in the vehicle's own process: the same bits.
TEST_F(Drive, TheGroundIsTheSameHereAndThere) {
  const auto samples = [&](const std::string& ground, std::int64_t& asked) {
    const std::string file = Path(ground + ".mcap");
    const Ended ended = RunCommand({Bin("rodeira"), "run", SourceDir() + "/tests/data/n222_traffic.yaml", "--for", "5",
                                    "--record", file, "--set", "nodes.ego.config.ground=" + ground});
    EXPECT_EQ(ended.status, 0) << ended.out;
    const auto line = ended.out.find("\nego ");
    EXPECT_NE(line, std::string::npos) << ended.out;
    const std::string row = ended.out.substr(line + 1, ended.out.find('\n', line + 1) - line - 1);
    asked = std::stoll(row.substr(row.find_last_of(' ')));
    return SamplesOf(file);
  };
  std::int64_t asked_here = -1, asked_there = -1;
  const auto here = samples("local", asked_here);
  const auto there = samples("remote", asked_there);
  EXPECT_GT(here.size(), 5000u);
  EXPECT_EQ(FirstDifference(here, there), "");
  EXPECT_EQ(asked_here, 0);
  EXPECT_GE(asked_there, 5001) << "once a step";
}

TEST_F(Drive, OfAKilledRecorderTheFileIsReadable) {
  Started run(Command({"--for", "1000", "--pace", "real", "--record", Path("cut.mcap"), "--run", "cut-recorder"}));
  const auto messages = [&] {
    const auto reader = record::McapReader::Open(Path("cut.mcap"));
    return reader.ok() ? reader.value().statistics().messages : 0;
  };
  const auto until = std::chrono::steady_clock::now() + 30s;
  while (messages() <= 500 && std::chrono::steady_clock::now() < until) std::this_thread::sleep_for(20ms);
  const auto victims = ProcessesWith("--run cut-recorder", "--node recorder");
  ASSERT_EQ(victims.size(), 1u);
  ::kill(victims[0], SIGKILL);
  EXPECT_GE(run.WaitForLine("node 'recorder' … signal 9", 2s), 0ms);
  EXPECT_EQ(run.Wait(10s).status, 1);
  const Ended info = RunCommand({Bin("rodeira"), "info", Path("cut.mcap")});
  EXPECT_EQ(info.status, 1) << info.out;
  EXPECT_NE(info.out.find("not whole"), std::string::npos) << info.out;
  EXPECT_NE(info.out.find("what to do: rodeira repair " + Path("cut.mcap") + " --out "), std::string::npos) << info.out;
  const auto reader = record::McapReader::Open(Path("cut.mcap"));
  ASSERT_TRUE(reader.ok());
  EXPECT_GT(reader.value().statistics().messages, 500u);
}

TEST_F(Drive, OfAKilledCarTheRecordingIsClosedProperly) {
  Started run(Command({"--for", "1000", "--pace", "real", "--record", Path("closed.mcap"), "--run", "killed-car"}));
  ASSERT_TRUE(Runs("killed-car"));
  for (const pid_t victim : ProcessesWith("--run killed-car", "--node ego")) ::kill(victim, SIGKILL);
  EXPECT_GE(run.WaitForLine("node 'ego' … signal 9", 2s), 0ms);
  EXPECT_EQ(run.Wait(10s).status, 1);
  const auto reader = record::McapReader::Open(Path("closed.mcap"));
  ASSERT_TRUE(reader.ok()) << reader.error().Text();
  EXPECT_TRUE(reader.value().condition().whole);
  const auto end = reader.value().FindMetadata("rodeira.end");
  ASSERT_TRUE(end.ok() && end.value());
  EXPECT_EQ(end.value()->entries.at("complete"), "false");
}

TEST_F(Drive, AStoppedRoadServerIsNamedAndNotTheCarThatWaitsForIt) {
  Started run(Command({"--for", "1000", "--pace", "real", "--record", Path("x.mcap"), "--run", "stopped-road", "--set",
                       "nodes.ego.config.ground=remote"}));
  ASSERT_TRUE(Runs("stopped-road"));
  for (const pid_t victim : ProcessesWith("--run stopped-road", "--node road")) ::kill(victim, SIGSTOP);
  EXPECT_GE(run.WaitFor("node 'road' was stopped", 2s), 0ms);
  EXPECT_EQ(run.Wait(10s).status, 1);
}

TEST_F(Drive, WrongFilesAreRefusedInOneSentence) {
  const auto refuses = [this](std::vector<std::string> more, const std::string& text) {
    more.insert(more.end(), {"--record", Path("never.mcap")});
    const Ended ended = RunCommand(Command(more));
    EXPECT_EQ(ended.status, 2) << ended.out;
    EXPECT_THAT(ended.out, HasLine(text));
    EXPECT_FALSE(std::filesystem::exists(Path("never.mcap")) && std::filesystem::file_size(Path("never.mcap")) == 0);
    std::filesystem::remove(Path("never.mcap"));
  };
  const auto write = [this](const std::string& name, const std::string& text) {
    EXPECT_TRUE(base::WriteWhole(Path(name), std::string_view(text)).ok());
  };
  refuses({"--set", "world=/no/world.yaml"}, "/no/world.yaml: there is no such file");
  write("world.yaml", "rodeira: world/1\nname: x\nground: {kind: plane, z_cm: 5}\n");
  refuses({"--set", "world=" + Path("world.yaml")}, "world.yaml:3: unknown key 'ground.z_cm' … 'z_m'");
  refuses({"--set", "nodes.ego.config.vehicle=/no/car.yaml"}, "/no/car.yaml: there is no such file");
  auto car = base::ReadText(SourceDir() + "/configs/vehicles/default.yaml").value();
  car.replace(car.find("model: bicycle"), 14, "model: bycicle");
  write("car.yaml", car);
  refuses({"--set", "nodes.ego.config.vehicle=" + Path("car.yaml")}, "did you mean 'bicycle'?");
  write("script.csv", "time_s,throtle\n0,1\n");
  refuses({"--set", "nodes.driver.config.script=" + Path("script.csv")},
          "script.csv:1: unknown column 'throtle'; did you mean 'throttle'?");
  write("script.csv", "time_s,throttle\n0,1\n1,1.5\n");
  refuses({"--set", "nodes.driver.config.script=" + Path("script.csv")},
          "script.csv:3: 'throttle' is '1.5'; a number from 0 to 1 was expected");
  refuses({"--set", "nodes.driver.config.source=scirpt"}, "did you mean 'script'?");
}

TEST_F(Drive, ARecordingIsNeverOverwritten) {
  ASSERT_TRUE(base::WriteWhole(Path("old.mcap"), std::string_view("precious")).ok());
  const Ended ended = RunCommand(Command({"--record", Path("old.mcap")}));
  EXPECT_EQ(ended.status, 2);
  EXPECT_NE(ended.out.find("a recording is never overwritten"), std::string::npos) << ended.out;
  EXPECT_EQ(Bytes(Path("old.mcap")), "precious");
}

TEST_F(Drive, AFullDiskStopsTheRunWithASentence) {
  const Ended ended = RunCommand(Command({"--set", "nodes.recorder.config.file=/dev/full"}));
  EXPECT_NE(ended.status, 0);
  EXPECT_NE(ended.out.find("node 'recorder' failed"), std::string::npos) << ended.out;
}

// MCAP's reference reader and the IDL parser that robotics viewers use.
TEST_F(Drive, TheReferenceReaderDecodesEveryTopic) {
  const std::string npm = SourceDir() + "/tests/record-npm";
  if (!std::filesystem::exists(npm + "/node_modules"))
    GTEST_SKIP() << "npm's packages are not installed (npm ci in tests/record-npm)";
  ASSERT_EQ(RunCommand(Command({"--for", "2", "--record", Path("npm.mcap")})).status, 0);
  const Ended check = RunCommand({"/usr/bin/env", "node", npm + "/check.mjs", Path("npm.mcap")});
  EXPECT_EQ(check.status, 0) << check.out;
  EXPECT_NE(check.out.find("rodeira/vehicle_state (rodeira::msg::VehicleState): 2001 messages"), std::string::npos)
      << check.out;
}

}  // namespace
}  // namespace rodeira::system_test
