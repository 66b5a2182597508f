// SPDX-License-Identifier: Apache-2.0
#include "tests/system/command.hpp"
#include "tests/names.hpp"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <thread>

#include "tests/tree.hpp"

namespace rodeira::system_test {

using WallClock = std::chrono::steady_clock;

std::string Bin(const std::string& program) { return BinaryDir() + "/bin/" + program; }
std::string LaunchFile(const std::string& name) { return SourceDir() + "/launch/" + name; }

namespace {

// Where runs of this test program record that say nothing about it: gone with the program.
class DataFolder {
 public:
  DataFolder() { path_ = std::filesystem::temp_directory_path() / ("rodeira-data-" + std::to_string(::getpid())); }
  ~DataFolder() {
    std::error_code problem;
    std::filesystem::remove_all(path_, problem);
  }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

}  // namespace

Started::Started(const std::vector<std::string>& command) {
  static const DataFolder data;
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) return;
  pid_ = ::fork();
  if (pid_ == 0) {
    ::setpgid(0, 0);
    ::dup2(ends[1], STDOUT_FILENO);
    ::dup2(ends[1], STDERR_FILENO);
    ::setenv("XDG_DATA_HOME", data.path().c_str(), 0);
    std::size_t first = 0;
    for (; first < command.size() && command[first].find('=') != std::string::npos && command[first][0] != '/';
         ++first) {
      ::putenv(const_cast<char*>(command[first].c_str()));
    }
    std::vector<char*> arguments;
    for (std::size_t i = first; i < command.size(); ++i) arguments.push_back(const_cast<char*>(command[i].c_str()));
    arguments.push_back(nullptr);
    ::execv(arguments[0], arguments.data());
    ::_exit(127);
  }
  ::close(ends[1]);
  pipe_ = ends[0];
}

Started::~Started() {
  if (pid_ > 0) {
    ::kill(pid_, SIGKILL);
    ::waitpid(pid_, nullptr, 0);
  }
  if (pipe_ >= 0) ::close(pipe_);
}

bool Started::Read(int wait_ms) {
  pollfd waiting{pipe_, POLLIN, 0};
  if (::poll(&waiting, 1, wait_ms) <= 0) return false;
  char buffer[4096];
  const ssize_t size = ::read(pipe_, buffer, sizeof(buffer));
  if (size <= 0) return false;
  out_.append(buffer, static_cast<std::size_t>(size));
  return true;
}

template <class Condition>
std::chrono::milliseconds Started::WaitUntil(const Condition& holds, std::chrono::milliseconds limit) {
  const auto begin = WallClock::now();
  while (!holds()) {
    if (WallClock::now() - begin > limit) return std::chrono::milliseconds(-1);
    if (!Read(10)) ::usleep(2000);
  }
  return std::chrono::duration_cast<std::chrono::milliseconds>(WallClock::now() - begin);
}

std::chrono::milliseconds Started::WaitFor(const std::string& text, std::chrono::milliseconds limit) {
  return WaitUntil([&] { return out_.find(text) != std::string::npos; }, limit);
}

std::chrono::milliseconds Started::WaitForLine(const std::string& things, std::chrono::milliseconds limit) {
  return WaitUntil([&] { return HasLineWith(things, out_); }, limit);
}

Ended Started::Wait(std::chrono::milliseconds limit) {
  const auto until = WallClock::now() + limit;
  int status = 0;
  while (::waitpid(pid_, &status, WNOHANG) != pid_) {
    if (!Read(5)) ::usleep(2000);
    if (WallClock::now() > until) return {-1, out_ + "\n(it did not end)"};
  }
  while (Read(0)) {
  }
  pid_ = -1;
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), out_};
}

Ended RunCommand(const std::vector<std::string>& command) { return Started(command).Wait(); }

std::vector<pid_t> ProcessesWith(const std::string& first, const std::string& second) {
  std::vector<pid_t> found;
  std::error_code problem;
  for (const auto& entry : std::filesystem::directory_iterator("/proc", problem)) {
    const std::string name = entry.path().filename().string();
    if (name.find_first_not_of("0123456789") != std::string::npos) continue;
    std::ifstream in(entry.path() / "cmdline", std::ios::binary);
    std::ostringstream words;
    words << in.rdbuf();  // which is no error where the process ends meanwhile
    std::string line = words.str();
    for (char& c : line) c = c == '\0' ? ' ' : c;
    if (line.find(first) != std::string::npos && line.find(second) != std::string::npos)
      found.push_back(std::stoi(name));
  }
  return found;
}

namespace {

// Asking a run costs a process, which takes time from the run that starts: not before it can be asked. False: it
// cannot.
bool HasControlSocket(const std::string& run_name) {
  if (run_name.size() > 40) return true;  // its socket has another name
  const char* runtime = std::getenv("XDG_RUNTIME_DIR");
  const std::string folder = runtime != nullptr && *runtime != '\0' ? std::string(runtime) + "/rodeira"
                                                                    : "/tmp/rodeira-" + std::to_string(::getuid());
  std::error_code problem;
  return std::filesystem::exists(folder + "/" + run_name + ".ctl", problem);
}

}  // namespace

pid_t ProcessWith(const std::string& first, const std::string& second, pid_t before) {
  const auto until = WallClock::now() + std::chrono::seconds(20);
  while (WallClock::now() < until) {
    const auto found = ProcessesWith(first, second);
    if (found.size() == 1 && found.front() != before) return found.front();
    ::usleep(5000);
  }
  return -1;
}

bool Runs(const std::string& run_name, std::chrono::milliseconds limit) {
  const auto until = WallClock::now() + limit;
  while (WallClock::now() < until) {
    if (HasControlSocket(run_name) && RunCommand({Bin("rodeira"), "ctl", "--run", run_name, "state"}).status == 0)
      return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return false;
}

std::int64_t StepIn(const std::string& state) {
  const std::string before = "at step ";
  const auto at = state.find(before);
  return at == std::string::npos ? -1 : std::strtoll(state.c_str() + at + before.size(), nullptr, 10);
}

bool WaitForStep(const std::string& run_name, std::int64_t step, std::chrono::milliseconds limit) {
  const auto until = WallClock::now() + limit;
  if (!Runs(run_name, limit)) return false;
  while (WallClock::now() < until) {
    if (StepIn(RunCommand({Bin("rodeira"), "ctl", "--run", run_name, "state"}).out) >= step) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return false;
}

std::string DigestIn(const std::string& table) {
  std::istringstream lines(table);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("digest  ")) return line.substr(8);
  }
  return "";
}

}  // namespace rodeira::system_test
