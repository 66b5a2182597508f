// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

namespace rodeira::system_test {

// Where the programs are.
std::string Bin(const std::string& program);
// A launch file of the project.
std::string LaunchFile(const std::string& name);

struct Ended {
  int status = -1;  // exit status; 128 + signal where it was killed
  std::string out;  // standard output and error together
};

// A program run in the background, its output gathered.
class Started {
 public:
  // "KEY=VALUE" words before the program go into its environment.
  explicit Started(const std::vector<std::string>& command);
  ~Started();
  Started(const Started&) = delete;
  Started& operator=(const Started&) = delete;

  pid_t pid() const { return pid_; }
  // Waits until the output holds `text`; how long that took, or a negative duration where it did not come.
  std::chrono::milliseconds WaitFor(const std::string& text, std::chrono::milliseconds limit);
  // Likewise for a line that names these things in this order, separated by " … ".
  std::chrono::milliseconds WaitForLine(const std::string& things, std::chrono::milliseconds limit);
  Ended Wait(std::chrono::milliseconds limit = std::chrono::milliseconds(60000));

 private:
  bool Read(int wait_ms);
  template <class Condition>
  std::chrono::milliseconds WaitUntil(const Condition& holds, std::chrono::milliseconds limit);
  pid_t pid_ = -1;
  int pipe_ = -1;
  std::string out_;
};

Ended RunCommand(const std::vector<std::string>& command);

// Living processes with a command line that holds both texts (the run's name, "--node a").
std::vector<pid_t> ProcessesWith(const std::string& first, const std::string& second = "");
// Waits until there is exactly one, another than `before`: a process between fork and exec has another command line. -1
// where there is none within 20 s.
pid_t ProcessWith(const std::string& first, const std::string& second, pid_t before = -1);

// Waits until a run of separate processes goes on; false where it does not within `limit`.
bool Runs(const std::string& run_name, std::chrono::milliseconds limit = std::chrono::milliseconds(30000));

// The step that an answer of `rodeira ctl state` says; -1: it says none.
std::int64_t StepIn(const std::string& state);
// Waits until the run has granted this step; false where it does not within `limit`.
bool WaitForStep(const std::string& run_name, std::int64_t step,
                 std::chrono::milliseconds limit = std::chrono::milliseconds(30000));

// The word behind "digest" in a closing table.
std::string DigestIn(const std::string& table);

}  // namespace rodeira::system_test
