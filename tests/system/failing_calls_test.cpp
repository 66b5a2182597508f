// SPDX-License-Identifier: Apache-2.0
// Every call to the system that a command makes fails once, as on a full disk, without descriptors, memory or threads
// (failing_calls.cpp). What the command then says is held against what it has left: status 0 means all of it, anything
// else a sentence and nothing half-written.
// RODEIRA_FAILING_CALLS says how many places of each command are tried (5; 10000 are all);
// RODEIRA_FAILING_CALLS_SEED repeats a choice of them.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <future>
#include <map>
#include <random>
#include <set>
#include <sstream>
#include <vector>

#include "common/core/base/files.hpp"
#include "common/core/base/hash.hpp"
#include "tests/launch/rodeira/temporary_folder.hpp"
#include "tests/setting.hpp"
#include "tests/system/command.hpp"
#include "tests/tree.hpp"

namespace rodeira::system_test {
namespace {

using namespace std::chrono_literals;

// A command of the front door. "RUN" stands for the run's name, "OUT" for the file or folder that it writes; the
// `recording` is there.
struct Tried {
  std::string name;
  std::vector<std::string> words;
  std::string out;            // what it writes, in a folder of its own; empty: nothing
  bool is_recording = false;  // it has wall times: no two are the same bytes
  std::string claim;          // what it says where all went well
  // Refuses, with status 2, what a failure may leave of a folder that is written file by file; such a folder is whole
  // after the next try. Empty: nothing may be left.
  std::vector<std::string> check = {};
};

const std::vector<Tried> kCommands = {
    {"run", {"run", "first_drive", "--for", "0.5", "--run", "RUN", "--record", "OUT"}, "r.mcap", true, "digest"},
    {"in_process",
     {"run", "first_drive", "--for", "0.5", "--run", "RUN", "--record", "OUT", "--in-process"},
     "r.mcap",
     true,
     "digest"},
    {"verify", {"replay", "RECORDING", "--verify"}, "", false, "identical"},
    {"branch",
     {"replay", "RECORDING", "--from", "0.2", "--branch", "seed=2", "--record", "OUT"},
     "branch.mcap",
     true,
     "wrote"},
    {"frames", {"replay", "RECORDING", "--frames", "OUT", "--at", "0.2"}, "frames", false, ""},
    {"repair", {"repair", "RECORDING", "--out", "OUT"}, "whole.mcap", false, ""},
    {"tables", {"export", "RECORDING", "--csv", "OUT"}, "tables", false, ""},
    {"world_export", {"world", "export", "n222", "-o", "OUT"}, "n222.xodr", false, ""},
    {"world_build", {"world", "build", "flat", "-o", "OUT"}, "flat", false, "", {"world", "check", "OUT"}},
};

// Name and content of each file below a folder.
std::map<std::string, base::Digest> Contents(const std::filesystem::path& path) {
  std::map<std::string, base::Digest> contents;
  const auto add = [&contents](const std::filesystem::path& file, const std::string& name) {
    const auto bytes = base::ReadBytes(file);
    contents[name] = bytes.ok() ? base::Hash(std::span(bytes.value())) : 0;
  };
  if (std::filesystem::is_regular_file(path)) add(path, ".");
  if (std::filesystem::is_directory(path)) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(path))
      if (entry.is_regular_file()) add(entry.path(), std::filesystem::relative(entry.path(), path).string());
  }
  return contents;
}

void PrintTo(const Tried& tried, std::ostream* out) { *out << tried.name; }

class FailingCalls : public ::testing::TestWithParam<Tried> {
 protected:
  struct Answer {
    Ended ended;
    std::filesystem::path folder;
  };

  Answer Run(const std::string& run, const std::vector<std::string>& environment) const {
    const std::filesystem::path folder = folder_.path() / run;
    std::filesystem::create_directories(folder);
    std::vector<std::string> command = environment;
    command.push_back("LD_PRELOAD=" + Bin("failing_calls.so"));
    command.push_back("XDG_STATE_HOME=" + (folder_.path() / "state").string());
    const auto words = Command(GetParam().words, run);
    command.insert(command.end(), words.begin(), words.end());
    return {Started(command).Wait(120s), folder};
  }
  std::vector<std::string> Command(const std::vector<std::string>& words, const std::string& run) const {
    std::vector<std::string> command = {Bin("rodeira")};
    for (const std::string& word : words) {
      if (word == "RUN") {
        command.push_back(Name(run));
      } else if (word == "OUT") {
        command.push_back((folder_.path() / run / GetParam().out).string());
      } else if (word == "RECORDING") {
        command.push_back(recording_);
      } else {
        command.push_back(word);
      }
    }
    return command;
  }
  std::string Name(const std::string& run) const { return fmt::format("{}-{}-{}", GetParam().name, run, ::getpid()); }

  // The places where the command calls the system: their lines.
  std::vector<std::string> Places(const std::filesystem::path& list) const {
    std::set<std::string> places;
    std::ifstream in(list);
    for (std::string line; std::getline(in, line);) places.insert(line);
    return {places.begin(), places.end()};
  }

  // What of the answer is untrue; empty: nothing.
  std::string Untrue(const std::string& place, const std::string& run) {
    const std::filesystem::path done = folder_.path() / (run + ".done");
    const Answer answer =
        Run(run, {"FAILING_CALLS_AT=" + place.substr(0, place.find(' ')), "FAILING_CALLS_DONE=" + done.string()});
    std::string untrue;
    const auto add = [&untrue](const std::string& what) { untrue += (untrue.empty() ? "" : "; ") + what; };
    const bool all = answer.ended.status == 0;
    if (answer.ended.status < 0 || answer.ended.status > 2) add(fmt::format("exit status {}", answer.ended.status));
    if (!all && answer.ended.out.find("rodeira") == std::string::npos) add("it fails without a sentence");
    if (!all && !std::filesystem::exists(done)) add("it fails although no call has failed");
    if (all && answer.ended.out.find(GetParam().claim) == std::string::npos) add("it does not say what it has done");
    for (const char* raw : {"terminate called", "Segmentation", "what():"})
      if (answer.ended.out.find(raw) != std::string::npos) add("a raw message");
    if (!ProcessesWith(Name(run)).empty()) add("processes are left");
    GetParam().is_recording ? CompareRecording(answer, all, add) : CompareFiles(answer, all, run, add);
    for (const auto& entry : std::filesystem::directory_iterator(answer.folder)) {
      const std::string name = entry.path().filename().string();
      if (name != GetParam().out && !name.ends_with("-failure.txt")) add("left: " + name);
    }
    std::filesystem::remove_all(answer.folder);
    return untrue.empty() ? "" : place + ": " + untrue + "\n" + answer.ended.out;
  }

  using Add = std::function<void(const std::string&)>;
  void CompareFiles(const Answer& answer, bool all, const std::string& run, const Add& add) const {
    if (GetParam().out.empty()) return;
    const std::filesystem::path out = answer.folder / GetParam().out;
    const auto contents = Contents(out);
    if (all && contents != calm_) add("what is written is not what was to be written");
    if (all || contents.empty()) return;
    if (GetParam().check.empty()) return add("something half-written is left");
    const Ended checked = RunCommand(Command(GetParam().check, run));
    if (checked.status != 2) add("what is left is not refused: " + checked.out);
    const Ended again = RunCommand(Command(GetParam().words, run));
    if (again.status != 0 || Contents(out) != calm_) add("the next try does not make it whole: " + again.out);
  }
  void CompareRecording(const Answer& answer, bool all, const Add& add) const {
    const std::filesystem::path out = answer.folder / GetParam().out;
    if (all && ContentOf(answer) != content_) add("another content");
    const std::string& said = answer.ended.out;
    const bool is_lossless = said.find("audit   lossless") != std::string::npos;
    const bool is_audited = GetParam().claim == "digest";  // by the command itself
    if (all && is_audited && !is_lossless && said.find("audit   not made") == std::string::npos)
      add("it does not say that it lost");
    if (!std::filesystem::exists(out)) {
      if (all) add("no recording is left");
      return;
    }
    const Ended info = RunCommand({Bin("rodeira"), "info", out.string()});
    if (is_lossless && info.status != 0) add("the recording is not lossless: " + info.out);
    if (!all && info.status != 0 && said.find("rodeira repair") == std::string::npos)
      add("a recording is left that is not spoken of: " + info.out);
  }

  // What `info` says of the content of the recording that was written.
  std::string ContentOf(const Answer& answer) const {
    const Ended info = RunCommand({Bin("rodeira"), "info", (answer.folder / GetParam().out).string()});
    const auto at = info.out.find("\ncontent ");
    return at == std::string::npos ? "" : info.out.substr(at + 1, info.out.find('\n', at + 1) - at - 1);
  }

  // One calm run: what it writes and where it calls the system.
  void RunCalm() {
    recording_ = (folder_.path() / "recording.mcap").string();
    const Ended recorded =
        RunCommand({Bin("rodeira"), "run", "first_drive", "--for", "0.5", "--in-process", "--record", recording_});
    ASSERT_EQ(recorded.status, 0) << recorded.out;
    const std::filesystem::path list = folder_.path() / "places";
    const Answer calm = Run("calm", {"FAILING_CALLS_LIST=" + list.string()});
    ASSERT_EQ(calm.ended.status, 0) << calm.ended.out;
    if (!GetParam().out.empty()) calm_ = Contents(calm.folder / GetParam().out);
    ASSERT_EQ(calm_.empty(), GetParam().out.empty());
    if (GetParam().is_recording) {
      content_ = ContentOf(calm);
      ASSERT_NE(content_, "");
    }
    places_ = Places(list);
  }

  const cli::TemporaryFolder folder_;
  std::string recording_, content_;
  std::map<std::string, base::Digest> calm_;
  std::vector<std::string> places_;
};

TEST_P(FailingCalls, AreToldAndLeaveNothingHalfWritten) {
  const auto seed = Setting("RODEIRA_FAILING_CALLS_SEED", std::random_device()());
  fmt::print("RODEIRA_FAILING_CALLS_SEED={}\n", seed);
  ASSERT_NO_FATAL_FAILURE(RunCalm());
  ASSERT_GE(places_.size(), 4u) << "the calls of " << GetParam().name << " were not seen";
  std::mt19937_64 rng(seed);
  std::ranges::shuffle(places_, rng);
  const auto wanted = std::min(places_.size(), static_cast<std::size_t>(Setting("RODEIRA_FAILING_CALLS", 5)));
  fmt::print("{} of {} places\n", wanted, places_.size());
  // Some at a time: they mostly wait.
  constexpr std::size_t kAtATime = 3;
  for (std::size_t first = 0; first < wanted; first += kAtATime) {
    std::vector<std::future<std::string>> runs;
    for (std::size_t i = first; i < std::min(first + kAtATime, wanted); ++i)
      runs.push_back(std::async(std::launch::async, [this, i] { return Untrue(places_[i], fmt::format("f{}", i)); }));
    for (auto& run : runs) EXPECT_EQ(run.get(), "");
  }
}

INSTANTIATE_TEST_SUITE_P(Commands, FailingCalls, ::testing::ValuesIn(kCommands),
                         [](const auto& tried) { return tried.param.name; });

// Limits of the shell: of memory (kB) and of file descriptors.
class Limits : public ::testing::TestWithParam<const char*> {};

TEST_P(Limits, AreTold) {
  const cli::TemporaryFolder folder;
  for (const std::string how : {"", " --in-process"}) {
    const std::string file = (folder.path() / ("r" + how + ".mcap")).string();
    const Ended ended = Started({"/bin/sh", "-c",
                                 fmt::format("ulimit {} && exec '{}' run first_drive --for 0.2 --record '{}'{}",
                                             GetParam(), Bin("rodeira"), file, how)})
                            .Wait(90s);
    if (ended.status == 0) {
      EXPECT_NE(ended.out.find("audit   lossless"), std::string::npos) << ended.out;
      continue;
    }
    EXPECT_EQ(ended.status, 1) << ended.out;
    EXPECT_NE(ended.out.find("rodeira"), std::string::npos) << ended.out;
    EXPECT_EQ(ended.out.find("terminate called"), std::string::npos) << ended.out;
    EXPECT_EQ(ended.out.find("are still missing"), std::string::npos) << "no cause is named: " << ended.out;
    if (std::filesystem::exists(file)) {
      EXPECT_NE(ended.out.find("rodeira repair"), std::string::npos) << ended.out;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(OfTheShell, Limits,
                         ::testing::Values("-v 220000", "-v 300000", "-v 388000", "-v 392000", "-v 396000", "-v 400000",
                                           "-n 9", "-n 14"));

}  // namespace
}  // namespace rodeira::system_test
