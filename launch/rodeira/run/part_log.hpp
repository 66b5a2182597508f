// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace spdlog {
class logger;
}

namespace rodeira::cli {

// What one part of a run (the clock, a node, the nodes of a shared process) writes to its standard error: passed on to
// ours line by line (backtraces left out), kept in a log file with time and level, and the last lines remembered for
// the report of a failure.
//
// The file is FOLDER/PART.log, rotated at 1 MB, with three older ones; it is created with the first line. A file that
// cannot be written is left out. For one thread.
class PartLog {
 public:
  // `exhaustion_told`, shared by the parts of a run: what this PC is short of stops several, and is passed on once.
  PartLog(const std::string& part, std::filesystem::path folder, std::shared_ptr<bool> exhaustion_told = {});

  // Reads what there is in the non-blocking descriptor, without waiting.
  void Read(int descriptor);
  // The rest of an unfinished line, once the part has ended.
  void Finish();

  // The foreign code that the part's process crashed in, by base::TraceCrashes ("fmi2DoStep of FMU 'a.fmu'"); empty: it
  // has not crashed, or not in foreign code.
  const std::string& crash_place() const { return crash_place_; }
  // The node that the process crashed in, by base::TraceCrashes; empty: it has not crashed, or has one node.
  const std::string& crash_node() const { return crash_node_; }
  // What a node of the process said of its own end (dds::kLastWord): "PHASE STEP TEXT"; empty: nothing.
  std::string LastWordOf(const std::string& node) const;
  // Another process of the part begins.
  void ForgetEnd() {
    crash_place_.clear();
    crash_node_.clear();
    last_words_.clear();
  }

  const std::deque<std::string>& last_lines() const { return last_lines_; }  // at most kLastLines
  static constexpr std::size_t kLastLines = 100;

 private:
  void Take(std::string line);
  bool IsPassedOn(const std::string& line);
  bool TakeLastWord(std::string_view line);  // false if it is none

  std::string part_;
  std::filesystem::path folder_;
  std::shared_ptr<bool> exhaustion_told_;
  std::string rest_;
  std::deque<std::string> last_lines_;
  std::string crash_place_;
  std::string crash_node_;
  struct LastWord {
    std::string node;  // empty: the process has one
    std::string text;
  };
  std::vector<LastWord> last_words_;
  std::shared_ptr<spdlog::logger> file_;
  bool is_opened_ = false;
};

}  // namespace rodeira::cli
