// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/run/processes.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <string>
#include <utility>

#include "launch/rodeira/run/memory_kills.hpp"

namespace rodeira::cli {
namespace {

// Both ends are closed with it, but for those that were taken away.
struct Pipe {
  Pipe() = default;
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  ~Pipe() {
    if (out >= 0) ::close(out);
    if (in >= 0) ::close(in);
  }
  bool Open() {
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0) return false;
    out = ends[0], in = ends[1];
    return true;
  }
  int out = -1;  // to read from
  int in = -1;   // to write to
};

}  // namespace

base::Result<Child> Child::Start(const std::string& name, const std::vector<std::string>& command, bool with_pipes,
                                 PartLog* log) {
  Pipe to_child, from_child, errors;
  if ((with_pipes && !(to_child.Open() && from_child.Open())) || (log != nullptr && !errors.Open()))
    return base::Failed("system.no_pipe", fmt::format("cannot create a pipe: {}", std::strerror(errno)), name);
  std::vector<char*> arguments;
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  const pid_t parent = ::getpid();
  const std::uint64_t memory_kills = MemoryKills();
  const pid_t pid = ::fork();
  if (pid < 0) {
    const int error = errno;
    return base::Failed("system.cannot_start_program",
                        fmt::format("cannot create a process: {}{}", std::strerror(error),
                                    error == EAGAIN ? " (ulimit -u, the container's limit of processes)" : ""),
                        name);
  }
  if (pid == 0) {
    ::setpgid(0, 0);
    ::prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (::getppid() != parent) ::_exit(1);  // it died in between
    if (with_pipes) {
      ::dup2(to_child.out, STDIN_FILENO);
      ::dup2(from_child.in, STDOUT_FILENO);
    } else {
      const int nothing = ::open("/dev/null", O_RDONLY);
      ::dup2(nothing, STDIN_FILENO);
    }
    if (log != nullptr) ::dup2(errors.in, STDERR_FILENO);
    ::execv(arguments[0], arguments.data());
    ::_exit(127);
  }
  Child child;
  child.name_ = name;
  child.pid_ = pid;
  child.memory_kills_at_start_ = memory_kills;
  if (with_pipes) {
    child.in_ = std::exchange(to_child.in, -1);
    child.out_ = std::exchange(from_child.out, -1);
  }
  if (log != nullptr) {
    ::fcntl(errors.out, F_SETFL, O_NONBLOCK);
    child.error_ = std::exchange(errors.out, -1);
    child.log_ = log;
    log->ForgetEnd();
  }
  return child;
}

Child::Child(Child&& other) noexcept { *this = std::move(other); }

Child& Child::operator=(Child&& other) noexcept {
  Close();
  name_ = std::move(other.name_);
  pid_ = std::exchange(other.pid_, -1);
  in_ = std::exchange(other.in_, -1);
  out_ = std::exchange(other.out_, -1);
  error_ = std::exchange(other.error_, -1);
  log_ = std::exchange(other.log_, nullptr);
  ended_ = other.ended_;
  ended_at_ = other.ended_at_;
  stopped_ = other.stopped_;
  stop_signal_ = other.stop_signal_;
  kill_signal_ = other.kill_signal_;
  exit_status_ = other.exit_status_;
  memory_kills_at_start_ = other.memory_kills_at_start_;
  for_memory_ = other.for_memory_;
  return *this;
}

Child::~Child() { Close(); }

int KilledBy(pid_t pid) {
  // proc_pid_stat(5): behind the name in brackets the third field is the state, the 52nd what waitpid will say.
  std::ifstream file(fmt::format("/proc/{}/stat", pid));
  std::string line;
  std::getline(file, line);
  const auto name_end = line.rfind(") ");
  if (name_end == std::string::npos || line.compare(name_end, 3, ") Z") != 0) return 0;
  const int status = std::atoi(line.c_str() + line.find_last_of(' ') + 1);
  return WIFSIGNALED(status) ? WTERMSIG(status) : 0;
}

void Child::CloseInput() {
  if (in_ >= 0) ::close(std::exchange(in_, -1));
}

void Child::Close() {
  CloseInput();
  if (out_ >= 0) ::close(std::exchange(out_, -1));
  if (error_ < 0) return;
  log_->Read(error_);
  log_->Finish();
  ::close(std::exchange(error_, -1));
}

void Child::Poll() {
  if (error_ >= 0) log_->Read(error_);
  if (ended_ || pid_ < 0) return;
  int status = 0;
  while (::waitpid(pid_, &status, WNOHANG | WUNTRACED | WCONTINUED) == pid_) {
    if (WIFSTOPPED(status)) {
      stopped_ = true;
      stop_signal_ = WSTOPSIG(status);
    } else if (WIFCONTINUED(status)) {
      stopped_ = false;
    } else {
      ended_ = true;
      ended_at_ = std::chrono::steady_clock::now();
      if (WIFEXITED(status)) exit_status_ = WEXITSTATUS(status);
      if (WIFSIGNALED(status)) kill_signal_ = WTERMSIG(status);
      if (error_ >= 0) log_->Read(error_);
      break;
    }
  }
  if (!ended_ && kill_signal_ == 0) kill_signal_ = KilledBy(pid_);
  if (kill_signal_ == SIGKILL) for_memory_ = MemoryKills() != memory_kills_at_start_;
}

void Child::Signal(int number) const {
  if (!ended_ && pid_ > 0) ::kill(pid_, number);
}

std::string Child::Fate() const {
  const std::string place = log_ == nullptr || log_->crash_place().empty() ? "" : " in " + log_->crash_place();
  if (kill_signal_ != 0)
    return fmt::format("was killed by signal {} ({}{}){}", kill_signal_, ::strsignal(kill_signal_),
                       for_memory_ ? "; the kernel has killed for lack of memory since this part started" : "", place);
  if (exit_status_ == 127) return "could not be started";
  if (exit_status_) return fmt::format("left with status {}{}", *exit_status_, place);
  if (stopped_) return fmt::format("was stopped by signal {} ({})", stop_signal_, ::strsignal(stop_signal_));
  return "lives";
}

void Child::Send(const std::string& line) const {
  const std::string text = line + "\n";
  if (in_ >= 0) [[maybe_unused]]
    const ssize_t sent = ::write(in_, text.data(), text.size());
}

}  // namespace rodeira::cli
