// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/doctor/capture.hpp"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

#include "launch/rodeira/wall_clock.hpp"

namespace rodeira::cli {
namespace {

constexpr std::size_t kLongestOutput = 1u << 20;

[[noreturn]] void BeChild(const std::function<int()>& body, int out) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  ::dup2(::open("/dev/null", O_RDONLY), STDIN_FILENO);
  ::dup2(out, STDOUT_FILENO);
  ::dup2(out, STDERR_FILENO);
  ::_exit(body());
}

// Until the other end is closed or the time is over.
void ReadAll(int from, WallClock::time_point until, std::string& output) {
  char buffer[4096];
  for (;;) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(until - WallClock::now());
    pollfd waiting{from, POLLIN, 0};
    if (left.count() <= 0) return;
    if (::poll(&waiting, 1, static_cast<int>(left.count())) <= 0) continue;  // the time is over, or a signal came
    const ssize_t size = ::read(from, buffer, sizeof(buffer));
    if (size <= 0) return;
    if (output.size() < kLongestOutput) output.append(buffer, static_cast<std::size_t>(size));
  }
}

// Waits for the end of a child, which is killed at `until`; its waitpid status. A child that does not end a second
// after that, as in a driver that hangs, is left.
int WaitOrKill(pid_t pid, WallClock::time_point until, bool& too_late) {
  using namespace std::chrono_literals;
  for (;; ::usleep(1000)) {
    int status = 0;
    const pid_t ended = ::waitpid(pid, &status, WNOHANG);
    if (ended == pid || (ended < 0 && errno != EINTR)) return status;
    const auto now = WallClock::now();
    if (now >= until && !std::exchange(too_late, true)) ::kill(pid, SIGKILL);
    if (now >= until + 1s) return SIGKILL;
  }
}

}  // namespace

std::string Captured::FirstLine() const { return output.substr(0, output.find('\n')); }

Captured CaptureFork(const std::function<int()>& body, std::chrono::milliseconds limit) {
  Captured captured;
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) return captured;
  const pid_t pid = ::fork();
  if (pid == 0) BeChild(body, ends[1]);
  ::close(ends[1]);
  if (pid > 0) {
    const auto until = WallClock::now() + limit;
    ReadAll(ends[0], until, captured.output);
    const int status = WaitOrKill(pid, until, captured.too_late);
    if (WIFEXITED(status)) captured.status = WEXITSTATUS(status);
  }
  ::close(ends[0]);
  return captured;
}

Captured CaptureProgram(const std::vector<std::string>& command, std::chrono::milliseconds limit) {
  std::vector<char*> arguments;
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  return CaptureFork(
      [&arguments] {
        ::execv(arguments[0], arguments.data());
        return 127;
      },
      limit);
}

}  // namespace rodeira::cli
