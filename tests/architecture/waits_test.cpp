// SPDX-License-Identifier: Apache-2.0
// A wait that may last for ever, a use of the system time, and a sleep of a test, is named in a list with its reason
// (endless_waits.txt, system_time.txt, test_sleeps.txt). Waits with a limit and waits on the monotonic clock need none.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "tests/tree.hpp"

namespace {

namespace fs = std::filesystem;

// What is looked for in a line of code: a pattern, and words of which every match has one: most lines have none of
// them, and are not given to std::regex, which takes microseconds a character.
struct Pattern {
  std::regex pattern;
  std::vector<std::string> words;

  bool IsIn(const std::string& code) const {
    return std::ranges::any_of(words, [&](const std::string& word) { return code.find(word) != std::string::npos; }) &&
           std::regex_search(code, pattern);
  }
};

const Pattern kEndlessWait{
    std::regex(
        R"((\.|->)wait\(|(\.|->)join\(\)|\bjthread\b.*[;(]|\bfuture<|\bstd::async\(|\bpoll\([^;]*, -1\))"
        R"(|waitpid\([^;]*, 0\)|\bwaitid\(|\bsem_wait\(|\bpthread_join\(|\bepoll_wait\(|\bselect\([^;]*nullptr\))"
        R"(|::pause\(\)|::flock\([^;]*LOCK_|::read\()"),
    {"wait", "join(", "jthread", "future<", "async(", "poll(", "select(", "pause(", "flock(", "read("}};
const Pattern kSystemTime{std::regex(R"(\bsystem_clock\b|\bstd::time\(|::time\(|\bgettimeofday\b|\bCLOCK_REALTIME\b)"
                                     R"(|\blast_write_time\(|\bfile_clock\b)"),
                          {"system_clock", "time(", "gettimeofday", "CLOCK_REALTIME", "file_clock"}};
const Pattern kSleep{std::regex(R"(\bsleep_for\(|\bsleep_until\(|\busleep\(|\bnanosleep\(|\bsleep\()"), {"sleep"}};
// In Python and in shell scripts.
const Pattern kScriptSleep{std::regex(R"(\bsleep [0-9"$]|\btime\.sleep\()"), {"sleep"}};

std::string Trimmed(const std::string& text) {
  const auto begin = text.find_first_not_of(" \t");
  return begin == std::string::npos ? "" : text.substr(begin, text.find_last_not_of(" \t\r") - begin + 1);
}

// The part of a line before its comment.
std::string CodeOf(const std::string& line) { return Trimmed(line.substr(0, line.find("//"))); }

using Hits = std::set<std::string>;  // "path: code"

void Search(std::istream& in, const std::string& path, const Pattern& wanted, Hits& hits) {
  for (std::string line; std::getline(in, line);) {
    const std::string code = CodeOf(line);
    if (!code.starts_with("#") && wanted.IsIn(code)) hits.insert(path + ": " + code);
  }
}

Hits SearchTree(const Pattern& wanted, const std::vector<std::string>& folders = {"common", "nodes", "launch", "idl"}) {
  const fs::path root = rodeira::SourceDir();
  Hits hits;
  for (const std::string& top : folders) {
    for (const auto& entry : fs::recursive_directory_iterator(root / top)) {
      const auto extension = entry.path().extension();
      if (extension != ".cpp" && extension != ".hpp") continue;
      std::ifstream in(entry.path());
      Search(in, entry.path().lexically_relative(root).string(), wanted, hits);
    }
  }
  return hits;
}

// The same in the tests that are scripts: .py, or a first line that begins with #!.
Hits SearchScripts(const Pattern& wanted) {
  const fs::path root = rodeira::SourceDir();
  Hits hits;
  int scripts = 0;
  for (auto entry = fs::recursive_directory_iterator(root / "tests"); entry != fs::recursive_directory_iterator();
       ++entry) {
    if (entry->path().filename() == "node_modules") entry.disable_recursion_pending();
    if (!entry->is_regular_file()) continue;
    std::ifstream in(entry->path());
    std::string line;
    std::getline(in, line);
    if (!line.starts_with("#!") && entry->path().extension() != ".py") continue;
    ++scripts;
    Search(in, entry->path().lexically_relative(root).string(), wanted, hits);
  }
  EXPECT_GT(scripts, 30);
  return hits;
}

// A line with a reason "# …" stands above the lines that it is of; each of these is "path: code".
Hits ReadList(const std::string& name) {
  Hits listed;
  bool has_reason = false;
  std::ifstream in(fs::path(rodeira::SourceDir()) / "tests/architecture" / name);
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("# ")) has_reason = line.size() > 10;
    if (line.empty()) has_reason = false;
    if (line.empty() || line[0] == '#') continue;
    EXPECT_TRUE(has_reason) << name << ": " << line << " has no reason above it";
    EXPECT_TRUE(listed.insert(line).second) << name << " names twice: " << line;
  }
  return listed;
}

void ExpectListed(const Hits& found, const std::string& list) {
  const Hits listed = ReadList(list);
  EXPECT_FALSE(listed.empty());
  for (const std::string& one : found) EXPECT_TRUE(listed.contains(one)) << "not in " << list << ": " << one;
  for (const std::string& one : listed) EXPECT_TRUE(found.contains(one)) << list << " names what is gone: " << one;
}

TEST(Waits, EveryEndlessWaitHasAReason) { ExpectListed(SearchTree(kEndlessWait), "endless_waits.txt"); }
// A test waits for an event. Where it sleeps all the same, the list says why.
TEST(Waits, EverySleepOfATestHasAReason) {
  Hits found = SearchTree(kSleep, {"tests"});
  found.merge(SearchScripts(kScriptSleep));
  ExpectListed(found, "test_sleeps.txt");
}
TEST(Waits, EveryUseOfTheSystemTimeHasAReason) { ExpectListed(SearchTree(kSystemTime), "system_time.txt"); }

TEST(Waits, TheyAreFoundHoweverTheyAreWritten) {
  const std::vector<std::string> waits = {"changed_.wait(lock);",
                                          "changed->wait(lock, [] { return true; });",
                                          "thread.join();",
                                          "::poll(&one, 1, -1);",
                                          "::waitpid(pid, &status, 0);",
                                          "auto f = std::async(read);",
                                          "std::future<int> f;",
                                          "::read(file, buffer, 8);",
                                          "::pause();",
                                          "const std::jthread guard(f);"};
  const std::vector<std::string> none = {
      "changed_.wait_for(lock, 10ms);", "base::WaitFor(changed, lock, 1s, \"x\", p);",
      "::poll(&one, 1, 20);",           "::waitpid(pid, &status, WNOHANG);",
      "fmt::join(names, \", \");",      "// thread.join();"};
  for (const std::string& code : waits) EXPECT_TRUE(kEndlessWait.IsIn(CodeOf(code))) << code;
  for (const std::string& code : none) EXPECT_FALSE(kEndlessWait.IsIn(CodeOf(code))) << code;
  EXPECT_TRUE(kSystemTime.IsIn("until = std::chrono::system_clock::now() + 1s;"));
  EXPECT_TRUE(kSystemTime.IsIn("const auto now = std::time(nullptr);"));
  EXPECT_FALSE(kSystemTime.IsIn("steady_clock::now(); clock.time(3);"));
  EXPECT_TRUE(
      kSleep.IsIn("std::this_thread::sleep"
                  "_for(1s);"));
  EXPECT_TRUE(
      kSleep.IsIn("::usleep"
                  "(100);"));
  EXPECT_TRUE(
      kScriptSleep.IsIn("[ -s x ] || sleep"
                        " 0.5"));
  EXPECT_TRUE(
      kScriptSleep.IsIn("time.sleep"
                        "(0.1)"));
  EXPECT_FALSE(kScriptSleep.IsIn("a sleep of a test; sleeps 3"));
  EXPECT_FALSE(kSleep.IsIn("RODEIRA_SLEEP_S, asleep()"));
}

}  // namespace
