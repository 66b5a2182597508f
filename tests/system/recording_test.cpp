// SPDX-License-Identifier: Apache-2.0
// What becomes of a run: recorded unless told otherwise, asked by `info`, written as tables by `export`, mended by
// `repair`.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <thread>

#include "common/core/base/files.hpp"
#include "common/data/record/mcap_writer.hpp"
#include "idl/messages.hpp"
#include "idl/topics.hpp"
#include "tests/launch/rodeira/temporary_folder.hpp"
#include "tests/names.hpp"
#include "tests/system/command.hpp"
#include "tests/system/recording.hpp"

namespace rodeira::system_test {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

class Recordings : public ::testing::Test {
 protected:
  std::string Path(const std::string& name) const { return (folder_.path() / name).string(); }
  // A run with this test's folder of recordings.
  Ended Run(std::vector<std::string> more) const {
    more.insert(more.begin(), {"XDG_DATA_HOME=" + Path("data"), Bin("rodeira"), "run"});
    return RunCommand(more);
  }
  std::vector<fs::path> Recorded() const {
    std::vector<fs::path> files;
    std::error_code problem;
    for (const auto& entry : fs::directory_iterator(folder_.path() / "data/rodeira", problem))
      files.push_back(entry.path());
    return files;
  }
  Ended Query(std::vector<std::string> words) const {
    words.insert(words.begin(), Bin("rodeira"));
    return RunCommand(words);
  }
  base::Bytes Bytes(const std::string& name) const { return base::ReadBytes(Path(name)).value(); }
  const cli::TemporaryFolder folder_;
};

TEST_F(Recordings, ARunWithoutARecorderIsRecordedInTheUsersDataFolder) {
  const Ended run = Run({LaunchFile("empty.yaml"), "--for", "0.2"});
  ASSERT_EQ(run.status, 0) << run.out;
  ASSERT_EQ(Recorded().size(), 1u) << run.out;
  const std::string file = Recorded()[0].string();
  EXPECT_TRUE(fs::path(file).filename().string().starts_with("empty-")) << file;
  EXPECT_THAT(run.out, HasSubstr(file));
  EXPECT_THAT(run.out, HasSubstr("audit   lossless: 808 samples of 8 sources"));
  const Ended info = Query({"info", file});
  EXPECT_EQ(info.status, 0) << info.out;
  EXPECT_THAT(info.out, HasLine("lossless: … from step 0 to step 200"));
  EXPECT_THAT(info.out, HasSubstr("1000 Hz"));
  EXPECT_THAT(info.out, HasSubstr("embedded  launch.yaml"));
}

// The name of a file is a value, never a part of another text: nodes get it through YAML and a command line.
TEST_F(Recordings, AFileMayHaveAnyName) {
  const std::string folder = Path("any");
  for (const char* process : {"--in-process", "--quiet"}) {
    for (const std::string name :
         {"it's.mcap", "a \"b\".mcap", "c\\d.mcap", "e\nf.mcap", "g\th.mcap", "i: [j], {k} #l.mcap", "*m.mcap"}) {
      if (process == std::string("--quiet") && name.find('"') == std::string::npos) continue;  // one is enough
      fs::create_directory(folder);
      const Ended run = Run({LaunchFile("empty.yaml"), "--for", "0.02", process, "--record", folder + "/" + name});
      ASSERT_EQ(run.status, 0) << name << run.out;
      std::vector<fs::path> files;
      for (const auto& entry : fs::directory_iterator(folder)) files.push_back(entry.path().filename());
      EXPECT_EQ(files, std::vector<fs::path>{name});
      EXPECT_EQ(Query({"info", folder + "/" + name}).status, 0) << name;
      fs::remove_all(folder);
    }
  }
}

TEST_F(Recordings, InOneProcessTooAndTwoRunsOfOneSecondDoNotMeet) {
  for (int i = 0; i < 2; ++i) ASSERT_EQ(Run({LaunchFile("empty.yaml"), "--for", "0.05", "--in-process"}).status, 0);
  EXPECT_EQ(Recorded().size(), 2u);
}

TEST_F(Recordings, NoRecordLeavesNothing) {
  for (const char* launch : {"empty.yaml", "first_drive.yaml"}) {
    const Ended run = Run({LaunchFile(launch), "--for", "0.1", "--no-record"});
    EXPECT_EQ(run.status, 0) << run.out;
    EXPECT_EQ(run.out.find(".mcap"), std::string::npos) << run.out;
  }
  EXPECT_EQ(Run({LaunchFile("first_drive.yaml"), "--for", "0.1", "--no-record", "--in-process"}).status, 0);
  EXPECT_FALSE(fs::exists(Path("data")));
  const Ended both = Run({LaunchFile("empty.yaml"), "--no-record", "--record", Path("a.mcap")});
  EXPECT_EQ(both.status, 2) << both.out;
}

TEST_F(Recordings, OfARefusedRunNoneIsLeft) {
  EXPECT_EQ(Run({LaunchFile("empty.yaml"), "--set", "nodes.a.config.fail_at_stp=3"}).status, 2);
  EXPECT_EQ(Run({LaunchFile("first_drive.yaml"), "--set", "world=/no/world.yaml"}).status, 2);
  EXPECT_EQ(Run({LaunchFile("first_drive.yaml"), "--set", "world=/no/world.yaml", "--in-process"}).status, 2);
  EXPECT_EQ(Recorded(), std::vector<fs::path>{});
}

TEST_F(Recordings, TablesHoldEverySampleOfTheDrive) {
  ASSERT_EQ(Run({LaunchFile("first_drive.yaml"), "--for", "3", "--record", Path("a.mcap")}).status, 0);
  const Ended done = Query({"export", "--csv", Path("tables"), Path("a.mcap")});
  ASSERT_EQ(done.status, 0) << done.out;
  EXPECT_THAT(done.out, HasSubstr("vehicle_state.csv"));
  std::ifstream table(Path("tables/vehicle_state.csv"));
  std::string header;
  std::getline(table, header);
  EXPECT_TRUE(header.starts_with("time_s,step,source,position_w_m.x,position_w_m.y,")) << header;
  const auto states = MessagesOf<msg::VehicleState>(Path("a.mcap"), idl::topics::kVehicleState);
  ASSERT_EQ(states.size(), 3001u);
  std::size_t rows = 0;
  for (std::string line; std::getline(table, line); ++rows) {
    ASSERT_LT(rows, states.size());
    ASSERT_EQ(std::ranges::count(line, ','), std::ranges::count(header, ','));
    std::vector<std::string> cells;
    std::istringstream in(line);
    for (std::string cell; std::getline(in, cell, ',');) cells.push_back(cell);
    ASSERT_EQ(cells[1], std::to_string(rows));
    ASSERT_EQ(cells[2], "ego");
    ASSERT_EQ(std::strtod(cells[3].c_str(), nullptr), states[rows].position_w_m().x());
    ASSERT_EQ(std::strtod(cells[4].c_str(), nullptr), states[rows].position_w_m().y());
  }
  EXPECT_EQ(rows, states.size());
  for (const char* name : {"tables/wall_time.csv",
                           "tables/remarks.csv"}) {  // what the clock says is no sample, and has a source all the same
    const std::string clocks = base::ReadText(Path(name)).value();
    EXPECT_THAT(clocks, HasSubstr(",clock,"));
    EXPECT_THAT(clocks, testing::Not(HasSubstr("channel")));
  }
  const Ended again = Query({"export", "--csv", Path("tables"), Path("a.mcap")});
  EXPECT_EQ(again.status, 2);
  EXPECT_THAT(again.out, HasLine(Path("tables") + ": … already"));
}

TEST_F(Recordings, AnExportOntoAFullDiskIsOneSentenceAndLeavesNothing) {
  ASSERT_EQ(Run({LaunchFile("first_drive.yaml"), "--for", "1", "--record", Path("a.mcap")}).status, 0);
  const std::string command =
      "ulimit -f 64; exec " + Bin("rodeira") + " export --csv " + Path("tables") + " " + Path("a.mcap");
  const Ended done = RunCommand({"/bin/bash", "-c", command});
  EXPECT_EQ(done.status, 1) << done.out;
  EXPECT_THAT(done.out, HasSubstr("vehicle_state.csv: the table cannot be written: File too large"));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_.path()), fs::directory_iterator()), 1)
      << "the recording alone";
}

TEST_F(Recordings, ACutFileIsNamedExportedAndMended) {
  ASSERT_EQ(Run({LaunchFile("first_drive.yaml"), "--for", "4", "--record", Path("a.mcap")}).status, 0);
  fs::copy_file(Path("a.mcap"), Path("cut.mcap"));
  fs::resize_file(Path("cut.mcap"), fs::file_size(Path("a.mcap")) / 2);
  const Ended info = Query({"info", Path("cut.mcap")});
  EXPECT_EQ(info.status, 1) << info.out;
  EXPECT_THAT(info.out, HasSubstr("not whole"));
  EXPECT_THAT(info.out, HasSubstr("what to do: rodeira repair " + Path("cut.mcap") + " --out "));
  const Ended tables = Query({"export", "--csv", Path("tables"), Path("cut.mcap")});
  EXPECT_EQ(tables.status, 1) << tables.out;
  EXPECT_THAT(tables.out, HasSubstr("is not whole: the tables in "));
  EXPECT_TRUE(fs::exists(Path("tables/vehicle_state.csv")));

  const Ended repair = Query({"repair", Path("cut.mcap"), "--out", Path("good.mcap")});
  EXPECT_EQ(repair.status, 1) << "what is lost is no success: " << repair.out;
  EXPECT_THAT(repair.out, HasSubstr("everything is lost"));
  EXPECT_THAT(repair.out, HasSubstr("kept: "));
  const Ended good = Query({"info", Path("good.mcap")});
  EXPECT_EQ(good.status, 0) << good.out;
  EXPECT_THAT(good.out, HasSubstr("repaired:"));
  EXPECT_THAT(good.out, HasSubstr("no gaps; the run was cancelled at step "));
  EXPECT_EQ(Query({"repair", Path("cut.mcap"), "--out", Path("good.mcap")}).status, 2) << "never overwritten";
  EXPECT_EQ(Query({"repair", Path("none.mcap"), "--out", Path("new.mcap")}).status, 2);
  EXPECT_FALSE(fs::exists(Path("new.mcap")));
}

TEST_F(Recordings, AMissingSampleIsNamed) {
  ASSERT_EQ(Run({LaunchFile("first_drive.yaml"), "--for", "1", "--record", Path("a.mcap")}).status, 0);
  // The same recording without the car's sample of step 417.
  const auto reader = record::McapReader::Open(Path("a.mcap"));
  const auto ego = reader.value().ChannelsOf(idl::topics::kVehicleState)[0];
  auto writer = record::McapWriter::Open(Path("gap.mcap"));
  ASSERT_TRUE(writer.ok());
  std::map<record::ChannelId, record::ChannelId> ids;
  for (const auto& [id, channel] : reader.value().channels()) {
    const auto& schema = reader.value().schemas().at(channel.schema);
    const auto schema_id = writer.value().AddSchema(schema.name, schema.encoding, schema.text);
    ids[id] =
        writer.value().AddChannel(channel.topic, schema_id.value(), channel.message_encoding, channel.metadata).value();
  }
  auto cursor = reader.value().Messages();
  for (;;) {
    const auto message = cursor.Next();
    ASSERT_TRUE(message.ok());
    if (!message.value()) break;
    const auto& m = *message.value();
    if (m.channel == ego && m.log_time_ns == 417'000'000) continue;
    ASSERT_TRUE(writer.value().Write(ids.at(m.channel), m.sequence, m.log_time_ns, m.publish_time_ns, m.data).ok());
  }
  ASSERT_TRUE(writer.value().Close().ok());
  const Ended info = Query({"info", Path("gap.mcap")});
  EXPECT_EQ(info.status, 1) << info.out;
  EXPECT_THAT(info.out, HasSubstr("1 missing, the first behind step 416"));
  EXPECT_THAT(info.out, HasSubstr("not lossless"));
}

TEST_F(Recordings, WhatIsNoRecordingIsRefused) {
  const std::string text = folder_.Write("text.mcap", "this is a text").string();
  EXPECT_EQ(Query({"info", text}).status, 2);
  EXPECT_EQ(Query({"export", "--csv", Path("tables"), text}).status, 2);
  EXPECT_EQ(Query({"export", text}).status, 2) << "--csv is required";
  EXPECT_EQ(Query({"repair", text}).status, 2) << "--out is required";
  EXPECT_EQ(Query({"repair", text, "--out", Path("new.mcap")}).status, 2);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_.path()), fs::directory_iterator()), 1);
}

TEST_F(Recordings, ADiskThatIsFullStopsTheRunAndTheFileIsReadable) {
  const std::string words =
      " run " + LaunchFile("first_drive.yaml") + " --for 20 --in-process --record " + Path("a.mcap");
  const std::string command = "ulimit -f 400; exec " + Bin("rodeira") + words;
  const Ended run = RunCommand({"/bin/bash", "-c", command});
  EXPECT_EQ(run.status, 1) << run.out;
  EXPECT_THAT(run.out, HasLine("a.mcap: … File too large"));
  EXPECT_EQ(Query({"info", Path("a.mcap")}).status, 1);
  EXPECT_EQ(Query({"repair", Path("a.mcap"), "--out", Path("b.mcap")}).status, 0);
  EXPECT_GT(SamplesOf(Path("b.mcap")).size(), 100u);
}

// A disk that takes 1 MiB a second, by a pipe: the run waits for it, no sample is lost, and the bytes are those of a
// fast one.
// A recorder that is started again needs their samples.
TEST_F(Recordings, NodesThatHaveFinishedStayUntilTheRecorderHasWrittenAll) {
  ASSERT_EQ(Run({LaunchFile("empty.yaml"), "--for", "0.6", "--record", Path("calm.mcap")}).status, 0);
  ASSERT_EQ(::mkfifo(Path("held").c_str(), 0600), 0);
  const int held = ::open(Path("held").c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  ASSERT_GE(held, 0);
  ASSERT_GT(::fcntl(held, F_SETPIPE_SZ, 4096), 0);
  const std::string name = "finished-" + std::to_string(::getpid());
  Started run({Bin("rodeira"), "run", LaunchFile("empty.yaml"), "--for", "0.6", "--run", name, "--set",
               "nodes.recorder.kind=recorder", "--set", "nodes.recorder.config.file=" + Path("held")});
  // Its last bytes are not read: what the recorder still writes, it writes when all others have finished.
  std::vector<char> piece(4096);
  auto rest = static_cast<std::int64_t>(fs::file_size(Path("calm.mcap"))) - 8000;
  const auto begin = std::chrono::steady_clock::now();
  const auto ends = [&] {
    return Query({"ctl", "state", "--run", name}).out.find("is ending at step 600") != std::string::npos;
  };
  while ((rest > 0 || !ends()) && std::chrono::steady_clock::now() - begin < 60s) {
    const auto wanted = static_cast<std::size_t>(std::clamp<std::int64_t>(rest, 0, std::ssize(piece)));
    const ssize_t got = wanted == 0 ? 0 : ::read(held, piece.data(), wanted);
    if (got > 0) rest -= got;
    if (got <= 0) ::usleep(5000);
  }
  ASSERT_TRUE(ends());
  for (const auto ended = std::chrono::steady_clock::now(); std::chrono::steady_clock::now() - ended < 4500ms;) {
    for (const char* node : {"a", "b", "c", "d"})
      ASSERT_EQ(ProcessesWith("--run " + name, std::string("--node ") + node).size(), 1u) << node;
    ::usleep(50'000);
  }
  std::jthread disk([&] {
    pollfd waiting{held, POLLIN, 0};
    while (::poll(&waiting, 1, 20'000) > 0 && ::read(held, piece.data(), piece.size()) > 0) {
    }
  });
  const Ended ended = run.Wait(30s);
  EXPECT_EQ(ended.status, 0) << ended.out;
  EXPECT_TRUE(ProcessesWith("--run " + name).empty());
  disk.join();
  ::close(held);
}

TEST_F(Recordings, ASlowDiskSlowsTime) {
  const std::vector<std::string> drive = {
      LaunchFile("first_drive.yaml"), "--for", "4", "--set", "limits.step_s=30", "--set", "limits.silence_s=30"};
  const auto with = [&drive](const std::vector<std::string>& more) {
    auto words = drive;
    words.insert(words.end(), more.begin(), more.end());
    return words;
  };
  ASSERT_EQ(Run(with({"--record", Path("fast.mcap")})).status, 0);
  ASSERT_EQ(::mkfifo(Path("slow").c_str(), 0600), 0);
  base::Bytes slow;
  std::chrono::steady_clock::duration took{};
  std::thread disk([&] {
    std::ifstream in(Path("slow"), std::ios::binary);
    const auto begin = std::chrono::steady_clock::now();
    std::vector<char> piece(16384);
    while (in.read(piece.data(), static_cast<std::streamsize>(piece.size())) || in.gcount() > 0) {
      const auto bytes = std::as_bytes(std::span(piece).first(static_cast<std::size_t>(in.gcount())));
      slow.insert(slow.end(), bytes.begin(), bytes.end());
      std::this_thread::sleep_for(16ms);
    }
    took = std::chrono::steady_clock::now() - begin;
  });
  const Ended run = Run(with({"--set", "nodes.recorder.config.file=" + Path("slow")}));
  const int end = ::open(Path("slow").c_str(), O_WRONLY | O_NONBLOCK);  // lets the reader go where no recorder came
  if (end >= 0) ::close(end);
  disk.join();
  EXPECT_EQ(run.status, 0) << run.out;
  EXPECT_GT(took, 16ms * static_cast<int>(slow.size() / 16384));
  ASSERT_TRUE(base::WriteWhole(Path("slow.mcap"), std::span<const std::byte>(slow)).ok());
  const auto samples = SamplesOf(Path("fast.mcap"));
  EXPECT_GT(samples.size(), 1000u);
  EXPECT_EQ(FirstDifference(samples, SamplesOf(Path("slow.mcap"))), "");
}

}  // namespace
}  // namespace rodeira::system_test
