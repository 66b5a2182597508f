// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <filesystem>
#include <memory>
#include <string>

namespace spdlog {
class logger;
}

namespace rodeira::cli {

// What one part of a run (the clock, a node) writes to its standard error: passed on to ours line by line (backtraces
// left out), kept in a log file with time and level, and the last lines remembered for the report of a failure.
//
// The file is FOLDER/PART.log, rotated at 1 MB, with three older ones; it is created with the first line. A file that
// cannot be written is left out. For one thread.
class PartLog {
 public:
  PartLog(const std::string& part, std::filesystem::path folder);

  // Reads what there is in the non-blocking descriptor, without waiting.
  void Read(int descriptor);
  // The rest of an unfinished line, once the part has ended.
  void Finish();

  // The foreign code that the part's process crashed in, by base::TraceCrashes ("fmi2DoStep of FMU 'a.fmu'"); empty: it
  // has not crashed, or not in foreign code.
  const std::string& crash_place() const { return crash_place_; }
  // What the process said of its own end (dds::kLastWord): "PHASE STEP TEXT"; empty: nothing.
  const std::string& last_word() const { return last_word_; }
  // Another process of the part begins.
  void ForgetEnd() {
    crash_place_.clear();
    last_word_.clear();
  }

  const std::deque<std::string>& last_lines() const { return last_lines_; }  // at most kLastLines
  static constexpr std::size_t kLastLines = 100;

 private:
  void Take(std::string line);

  std::string part_;
  std::filesystem::path folder_;
  std::string rest_;
  std::deque<std::string> last_lines_;
  std::string crash_place_;
  std::string last_word_;
  std::shared_ptr<spdlog::logger> file_;
  bool is_opened_ = false;
};

}  // namespace rodeira::cli
