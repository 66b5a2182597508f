// SPDX-License-Identifier: Apache-2.0
// The table of docs/reference/ends.md: each part of a run ended by each cause under each policy. RODEIRA_ENDS says how
// many of its cells are run (12), spread over the table; 1000 runs all.
//
// RODEIRA_DRAWN_ENDS says how many cells are drawn, and run at a drawn instant (4), RODEIRA_DRAWN_ENDS_SEED the number
// of the first one. RODEIRA_DRAWN_ENDS_FILE names a file that keeps the number of the next one, for a sequence that was
// cancelled.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <future>
#include <map>
#include <memory>
#include <random>
#include <sstream>
#include <thread>
#include <vector>

#include "tests/launch/rodeira/temporary_folder.hpp"
#include "tests/setting.hpp"
#include "tests/system/command.hpp"
#include "tests/system/command_line.hpp"
#include "tests/system/ends_table.hpp"
#include "tests/system/recording.hpp"
#include "tests/tree.hpp"

namespace rodeira::system_test {
namespace {

using namespace std::chrono_literals;

constexpr std::array kPolicies = {"stop", "pause", "restart"};

// Shared processes of the table, with their nodes.
const std::map<std::string, std::vector<std::string>> kProcesses{{"cars", {"driver", "ego"}},
                                                                 {"all", {"road", "driver", "ego", "recorder"}}};

constexpr const char* kObserver = "an observer";
// Parts that first_drive.yaml does not have: the node, and what is set for it.
struct OtherPart {
  std::string node, set;
};
const std::map<std::string, OtherPart> kOtherParts{
    {"driver, keyboard",
     {"driver", "nodes.driver.config={source: keyboard, keyboard: ../configs/drivers/keyboard.yaml}"}},
    {"view",
     {"view",
      "nodes.view={kind: view, config: {width_px: 160, height_px: 90, camera: chase, frames: {times_s: [3]}}}"}}};

std::vector<std::string> SettingsOf(const std::string& part) {
  std::vector<std::string> words;
  if (const auto group = kProcesses.find(part); group != kProcesses.end()) {
    for (const std::string& node : group->second)
      words.insert(words.end(), {"--set", fmt::format("nodes.{}.process={}", node, part)});
  }
  if (const auto other = kOtherParts.find(part); other != kOtherParts.end())
    words.insert(words.end(), {"--headless", "--set", other->second.set});
  return words;
}

struct Cell {
  std::string part, cause, message, policy, outcome;
  std::string Name() const { return part + ", " + cause + ", " + policy; }
};

std::vector<Cell> ReadTable() {
  std::vector<Cell> cells;
  for (const std::vector<std::string>& columns : EndsTableLines()) {
    if (columns.size() != 7 || !columns[2].starts_with("SIG")) continue;
    for (std::size_t p = 0; p < kPolicies.size(); ++p)
      cells.push_back({columns[1], columns[2], columns[3], kPolicies[p], columns[4 + p]});
  }
  return cells;
}

int SignalOf(const std::string& name) {
  for (int number = 1; number < 32; ++number) {
    const char* known = ::sigabbrev_np(number);
    if (known != nullptr && name == std::string("SIG") + known) return number;
  }
  return 0;
}

// One cell of the table with real processes, lost `at` after the run began. What is not as the table says; empty: all
// is.
class CellRun {
 public:
  CellRun(const Cell& cell, std::chrono::milliseconds at, const std::string& undisturbed,
          const std::filesystem::path& folder, std::size_t number)
      : cell_(cell),
        at_(at),
        undisturbed_(undisturbed),
        name_(fmt::format("ends-{}-{}", ::getpid(), number)),
        recording_((folder / (name_ + ".mcap")).string()) {}

  std::string Differences() {
    const bool to_its_end = cell_.outcome == "goes on";
    std::vector<std::string> command{Bin("rodeira"),
                                     "run",
                                     LaunchFile("first_drive.yaml"),
                                     "--run",
                                     name_,
                                     "--pace",
                                     "real",
                                     "--for",
                                     to_its_end ? "4" : "100",
                                     "--record",
                                     recording_,
                                     "--set",
                                     "recovery=" + cell_.policy};
    const auto settings = SettingsOf(cell_.part);
    command.insert(command.end(), settings.begin(), settings.end());
    Started run(command);
    if (!Runs(name_)) return "the run did not begin: " + run.Wait(10s).out;
    if (cell_.part == kObserver && !StartObserver()) return "the observer heard nothing";
    const pid_t victim = Victim(run);
    if (victim <= 0) return cell_.Name() + ": the part was not found\n" + run.Wait(0s).out;
    std::this_thread::sleep_for(at_);
    ::kill(victim, SignalOf(cell_.cause));
    const auto struck = std::chrono::steady_clock::now();
    if (cell_.outcome == "waits") {
      if (run.WaitFor("the run waits", 10s) < 0ms) Add("it does not wait");
      ::kill(run.pid(), SIGTERM);
    }
    const Ended ended = run.Wait(40s);
    const auto lasted = std::chrono::steady_clock::now() - struck;
    const bool fails = cell_.outcome == "ends" || cell_.outcome == "waits";
    if (ended.status != (fails ? 1 : 0)) Add(fmt::format("exit status {}", ended.status));
    if (!cell_.message.empty() && ended.out.find(cell_.message) == std::string::npos) Add("the message is missing");
    if (cell_.message.empty() && ended.out.find("faults  none") == std::string::npos) Add("a fault is named");
    if (cell_.outcome == "goes on" && DigestIn(ended.out) != undisturbed_) Add("another digest");
    if ((cell_.outcome == "ends" || cell_.outcome == "in order") && lasted > 3500ms)
      Add(fmt::format("it took {:.1f} s", std::chrono::duration<double>(lasted).count()));
    observer_.reset();
    if (!ProcessesWith("--run " + name_).empty()) Add("processes are left");
    CheckRecording();
    return differences_.empty() ? "" : cell_.Name() + ": " + differences_ + "\n" + ended.out;
  }

 private:
  // The clock answers before each node's process has its own command line.
  pid_t Victim(const Started& run) const {
    if (cell_.part == "rodeira run") return run.pid();
    if (cell_.part == kObserver) return observer_->pid();
    if (kProcesses.contains(cell_.part)) return ProcessWith("--run " + name_ + " ", "--process " + cell_.part);
    const auto other = kOtherParts.find(cell_.part);
    const std::string& node = other == kOtherParts.end() ? cell_.part : other->second.node;
    return ProcessWith("--run " + name_ + " ", cell_.part == "clock" ? "/rodeira-clock" : "--node " + node);
  }
  bool StartObserver() {
    const auto clocks = ProcessesWith("--run " + name_ + " ", "/rodeira-clock");
    if (clocks.size() != 1) return false;
    observer_ = std::make_unique<Started>(std::vector<std::string>{
        Bin("rodeira-test-observer"), "--launch", LaunchFile("first_drive.yaml"), "--run", name_, "--domain",
        OptionOf(clocks.front(), "--domain"), "--node", "ego", "--set", "recovery=" + cell_.policy});
    return observer_->WaitFor("heard much", 10s) >= 0ms;
  }
  // A recorder that was killed or stopped leaves a file without an end; every other one is closed.
  void CheckRecording() {
    const bool is_recorder = cell_.part == "recorder" || cell_.part == "all";
    const bool had_no_time = is_recorder && cell_.cause != "SIGTERM" && cell_.outcome != "goes on";
    const Ended info = RunCommand({Bin("rodeira"), "info", recording_});
    if (info.status != 0 && !had_no_time) Add("the recording is not closed: " + info.out);
  }
  void Add(const std::string& difference) { differences_ += (differences_.empty() ? "" : "; ") + difference; }

  const Cell& cell_;
  const std::chrono::milliseconds at_;
  const std::string& undisturbed_;
  const std::string name_, recording_;
  std::unique_ptr<Started> observer_;
  std::string differences_;
};

class Ends : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_GT(table_.size(), 120u) << "docs/reference/ends.md";
    for (const Cell& cell : table_) ASSERT_NE(SignalOf(cell.cause), 0) << cell.cause;
  }
  std::future<std::string> Start(const Cell& cell, std::chrono::milliseconds at, std::size_t number) {
    const std::string& undisturbed = UndisturbedDigest(cell.part);
    return std::async(std::launch::async, [this, &cell, at, &undisturbed, number] {
      return CellRun(cell, at, undisturbed, folder_.path(), number).Differences();
    });
  }

  const std::vector<Cell> table_ = ReadTable();

 private:
  // Of a run of one process with the parts of this cell. Shared processes change no digest.
  const std::string& UndisturbedDigest(const std::string& part) {
    std::string& digest = undisturbed_[kOtherParts.contains(part) ? part : ""];
    if (!digest.empty()) return digest;
    std::vector<std::string> command{Bin("rodeira"),
                                     "run",
                                     LaunchFile("first_drive.yaml"),
                                     "--for",
                                     "4",
                                     "--in-process",
                                     "--record",
                                     (folder_.path() / fmt::format("calm-{}.mcap", undisturbed_.size())).string()};
    const auto settings = kOtherParts.contains(part) ? SettingsOf(part) : std::vector<std::string>();
    command.insert(command.end(), settings.begin(), settings.end());
    const Ended calm = RunCommand(command);
    EXPECT_EQ(calm.status, 0) << calm.out;
    digest = DigestIn(calm.out);
    return digest;
  }
  const cli::TemporaryFolder folder_;
  std::map<std::string, std::string> undisturbed_;
};

constexpr std::uint64_t kAtATime = 4;  // runs: they mostly wait

TEST_F(Ends, AreThoseOfTheTable) {
  const auto wanted = std::min<std::uint64_t>(Setting("RODEIRA_ENDS", 12), table_.size());
  for (std::uint64_t first = 0; first < wanted; first += kAtATime) {
    std::vector<std::future<std::string>> runs;
    for (std::uint64_t i = first; i < std::min(first + kAtATime, wanted); ++i)
      runs.push_back(Start(table_[i * table_.size() / wanted], 0ms, i));
    for (auto& run : runs) EXPECT_EQ(run.get(), "");
  }
}

TEST_F(Ends, DrawnOnesAreThoseOfTheTable) {
  const char* file = std::getenv("RODEIRA_DRAWN_ENDS_FILE");
  std::uint64_t first = Setting("RODEIRA_DRAWN_ENDS_SEED", 1);
  if (file != nullptr) std::ifstream(file) >> first;
  const std::uint64_t end = first + Setting("RODEIRA_DRAWN_ENDS", 4);
  for (; first < end; first += kAtATime) {
    std::vector<std::pair<std::string, std::future<std::string>>> runs;
    for (std::uint64_t number = first; number < std::min(first + kAtATime, end); ++number) {
      std::mt19937_64 rng(number);
      const Cell& cell = table_[rng() % table_.size()];
      const std::chrono::milliseconds at(rng() % 3000);
      runs.emplace_back(fmt::format("RODEIRA_DRAWN_ENDS_SEED={}: {} at {} ms", number, cell.Name(), at.count()),
                        Start(cell, at, number));
    }
    for (auto& [what, run] : runs) EXPECT_EQ(run.get(), "") << what;
    if (file != nullptr) std::ofstream(file) << std::min(first + kAtATime, end) << "\n";
  }
}

}  // namespace
}  // namespace rodeira::system_test
