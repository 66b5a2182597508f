// SPDX-License-Identifier: Apache-2.0
#include "common/core/base/run_program.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <system_error>

namespace rodeira::base {
namespace {

using Clock = std::chrono::steady_clock;

// A pipe from the program.
class TextPipe {
 public:
  TextPipe() {
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) return;
    from_ = ends[0], to_ = ends[1];
    ::fcntl(from_, F_SETFL, O_NONBLOCK);
  }
  ~TextPipe() {
    if (from_ >= 0) ::close(from_);
    CloseWriter();
  }
  TextPipe(const TextPipe&) = delete;
  TextPipe& operator=(const TextPipe&) = delete;

  bool ok() const { return from_ >= 0; }
  int writer() const { return to_; }
  void CloseWriter() {
    if (to_ >= 0) ::close(to_);
    to_ = -1;
  }
  void Wait(std::chrono::milliseconds limit) const {
    pollfd waiting{from_, POLLIN, 0};
    (void)::poll(&waiting, 1, static_cast<int>(limit.count()));
  }
  // Takes what there is, without waiting, and drops what is beyond the limit; false once the program has closed it.
  bool Read(std::string& text, std::size_t limit_bytes) const {
    std::array<char, 4096> buffer;
    ssize_t size = 0;
    while ((size = ::read(from_, buffer.data(), buffer.size())) > 0)
      text.append(buffer.data(), std::min(static_cast<std::size_t>(size), limit_bytes - text.size()));
    return size < 0 && (errno == EAGAIN || errno == EINTR);
  }

 private:
  int from_ = -1;
  int to_ = -1;
};

// This process's environment, and what is set beside it.
std::vector<std::string> Environment(const ProgramRun& run) {
  std::vector<std::string> variables;
  for (char** variable = environ; *variable != nullptr; ++variable) variables.emplace_back(*variable);
  for (const auto& [name, value] : run.environment) {
    if (std::getenv(name.c_str()) == nullptr) variables.push_back(name + "=" + value);
  }
  return variables;
}

std::vector<char*> Pointers(std::vector<std::string>& words) {
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  return pointers;
}

// A process; killed and waited for where it has not ended.
class Child {
 public:
  Child() = default;
  ~Child() {
    if (pid_ <= 0) return;
    ::kill(pid_, SIGKILL);
    // A process that was killed ends within a moment; one that does not stays a zombie of this process.
    for (int i = 0; i < 1000 && !Ended(); ++i) ::usleep(1000);
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  // errno of the failure, or 0.
  int Start(const ProgramRun& run, int pipe) {
    posix_spawn_file_actions_t files;
    posix_spawnattr_t attributes;
    ::posix_spawn_file_actions_init(&files);
    ::posix_spawnattr_init(&attributes);
    ::posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    ::posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    ::posix_spawn_file_actions_adddup2(&files, pipe, run.text_descriptor);
    ::posix_spawn_file_actions_addclosefrom_np(&files, run.text_descriptor + 1);
    sigset_t none, all;
    ::sigemptyset(&none);
    ::sigfillset(&all);
    ::posix_spawnattr_setsigmask(&attributes, &none);
    ::posix_spawnattr_setsigdefault(&attributes, &all);
    short flags = POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF;
    if (run.is_own_group) flags |= POSIX_SPAWN_SETPGROUP;  // group 0: its own
    ::posix_spawnattr_setflags(&attributes, flags);
    std::vector<std::string> words{run.program.string()}, variables = Environment(run);
    words.insert(words.end(), run.arguments.begin(), run.arguments.end());
    const int problem = ::posix_spawn(&pid_, run.program.c_str(), &files, &attributes, Pointers(words).data(),
                                      Pointers(variables).data());
    ::posix_spawn_file_actions_destroy(&files);
    ::posix_spawnattr_destroy(&attributes);
    if (problem != 0) pid_ = -1;
    return problem;
  }

  // waitpid's status once it has ended.
  std::optional<int> Ended() {
    int status = 0;
    const pid_t ended = ::waitpid(pid_, &status, WNOHANG);
    if (ended == 0 || (ended < 0 && errno == EINTR)) return std::nullopt;
    pid_ = -1;
    return ended < 0 ? 0 : status;
  }

 private:
  pid_t pid_ = -1;
};

}  // namespace

std::optional<std::filesystem::path> FindInPath(std::string_view program) {
  const char* path = std::getenv("PATH");
  std::string_view folders = path == nullptr ? "" : path;
  while (!folders.empty()) {
    const std::size_t end = std::min(folders.find(':'), folders.size());
    const std::filesystem::path file = std::filesystem::path(folders.substr(0, end)) / program;
    folders.remove_prefix(std::min(end + 1, folders.size()));
    std::error_code problem;
    if (std::filesystem::is_regular_file(file, problem) && ::access(file.c_str(), X_OK) == 0) return file;
  }
  return std::nullopt;
}

Result<ProgramEnd> RunProgram(const ProgramRun& run) {
  TextPipe pipe;
  if (!pipe.ok())
    return Failed("system.no_pipe", fmt::format("cannot create a pipe: {}", std::strerror(errno)),
                  run.program.string());
  Child child;
  if (const int problem = child.Start(run, pipe.writer()); problem != 0)
    return Failed("system.cannot_start_program", fmt::format("cannot start the program: {}", std::strerror(problem)),
                  run.program.string());
  pipe.CloseWriter();
  ProgramEnd end;
  const auto until = Clock::now() + run.limit;
  constexpr std::chrono::milliseconds kLook{20};
  std::optional<int> status;
  for (bool is_open = true; !status; status = child.Ended()) {
    end.stopped = run.stop && run.stop();
    end.too_long = Clock::now() >= until;
    if (end.stopped || end.too_long) return end;  // the child is killed
    if (is_open) {
      pipe.Wait(kLook);
      is_open = pipe.Read(end.text, run.text_limit_bytes);
    } else {
      ::usleep(1000);
    }
  }
  (void)pipe.Read(end.text, run.text_limit_bytes);
  if (WIFSIGNALED(*status))
    end.signal = WTERMSIG(*status);
  else
    end.status = WEXITSTATUS(*status);
  return end;
}

}  // namespace rodeira::base
