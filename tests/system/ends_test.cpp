// SPDX-License-Identifier: Apache-2.0
// The table of docs/reference/ends.md: each part of a run ended by each cause under each policy. RODEIRA_ENDS says how
// many of its cells are run (24), spread over the table; 1000 runs all.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <future>
#include <map>
#include <sstream>
#include <thread>
#include <vector>

#include "tests/launch/rodeira/temporary_folder.hpp"
#include "tests/setting.hpp"
#include "tests/system/command.hpp"
#include "tests/system/ends_table.hpp"
#include "tests/system/recording.hpp"
#include "tests/tree.hpp"

namespace rodeira::system_test {
namespace {

using namespace std::chrono_literals;

constexpr std::array kPolicies = {"stop", "pause", "restart"};

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

// One cell of the table with real processes. What is not as the table says; empty: all is.
class CellRun {
 public:
  CellRun(const Cell& cell, const std::string& undisturbed, const std::filesystem::path& folder, std::size_t number)
      : cell_(cell),
        undisturbed_(undisturbed),
        name_(fmt::format("ends-{}-{}", ::getpid(), number)),
        recording_((folder / (name_ + ".mcap")).string()) {}

  std::string Differences() {
    const bool to_its_end = cell_.outcome == "goes on";
    Started run({Bin("rodeira"), "run", LaunchFile("first_drive.yaml"), "--run", name_, "--pace", "real", "--for",
                 to_its_end ? "4" : "100", "--record", recording_, "--set", "recovery=" + cell_.policy});
    if (!Runs(name_)) return "the run did not begin: " + run.Wait(10s).out;
    const pid_t victim = Victim(run);
    if (victim <= 0) return "the part was not found";
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
    if (!ProcessesWith("--run " + name_).empty()) Add("processes are left");
    CheckRecording();
    return differences_.empty() ? "" : cell_.Name() + ": " + differences_ + "\n" + ended.out;
  }

 private:
  pid_t Victim(const Started& run) const {
    if (cell_.part == "rodeira run") return run.pid();
    const auto found =
        ProcessesWith("--run " + name_, cell_.part == "clock" ? "/rodeira-clock" : "--node " + cell_.part);
    return found.size() == 1 ? found.front() : -1;
  }
  // A recorder that was killed or stopped leaves a file without an end; every other one is closed.
  void CheckRecording() {
    const bool had_no_time = cell_.part == "recorder" && cell_.cause != "SIGTERM" && cell_.outcome != "goes on";
    const Ended info = RunCommand({Bin("rodeira"), "info", recording_});
    if (info.status != 0 && !had_no_time) Add("the recording is not closed: " + info.out);
  }
  void Add(const std::string& difference) { differences_ += (differences_.empty() ? "" : "; ") + difference; }

  const Cell& cell_;
  const std::string& undisturbed_;
  const std::string name_, recording_;
  std::string differences_;
};

TEST(Ends, AreThoseOfTheTable) {
  const std::vector<Cell> table = ReadTable();
  ASSERT_GT(table.size(), 90u) << "docs/reference/ends.md";
  for (const Cell& cell : table) ASSERT_NE(SignalOf(cell.cause), 0) << cell.cause;
  const cli::TemporaryFolder folder;
  const Ended calm = RunCommand({Bin("rodeira"), "run", LaunchFile("first_drive.yaml"), "--for", "4", "--in-process",
                                 "--record", (folder.path() / "calm.mcap").string()});
  ASSERT_EQ(calm.status, 0) << calm.out;
  const std::string undisturbed = DigestIn(calm.out);
  const auto wanted = std::min(static_cast<std::size_t>(Setting("RODEIRA_ENDS", 24)), table.size());
  // Four runs at a time: they mostly wait.
  for (std::size_t first = 0; first < wanted; first += 4) {
    std::vector<std::future<std::string>> runs;
    for (std::size_t i = first; i < std::min(first + 4, wanted); ++i) {
      const Cell& cell = table[i * table.size() / wanted];
      runs.push_back(std::async(std::launch::async, [&cell, &undisturbed, &folder, i] {
        return CellRun(cell, undisturbed, folder.path(), i).Differences();
      }));
    }
    for (auto& run : runs) EXPECT_EQ(run.get(), "");
  }
}

}  // namespace
}  // namespace rodeira::system_test
