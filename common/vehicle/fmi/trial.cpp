// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/fmi/trial.hpp"

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
#include <cstring>
#include <optional>
#include <vector>

#include "common/core/base/installation.hpp"
#include "common/core/base/temporary_folder.hpp"

namespace rodeira::fmi {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::string_view kRefused = "refused: ";

// The reading end of the pipe; the other one belongs to the program.
class Pipe {
 public:
  Pipe() {
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) return;
    from_ = ends[0], to_ = ends[1];
    ::fcntl(from_, F_SETFL, O_NONBLOCK);
  }
  ~Pipe() {
    if (from_ >= 0) ::close(from_);
    CloseWriter();
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;

  bool ok() const { return from_ >= 0; }
  int writer() const { return to_; }
  void CloseWriter() {
    if (to_ >= 0) ::close(to_);
    to_ = -1;
  }
  // Waits for text, or for the other end to be closed.
  void Wait(std::chrono::milliseconds limit) const {
    pollfd waiting{from_, POLLIN, 0};
    (void)::poll(&waiting, 1, static_cast<int>(limit.count()));
  }
  // Takes what there is, without waiting; false once the other end is closed.
  bool Read(std::string& text) const {
    std::array<char, 512> buffer;
    ssize_t size = 0;
    while ((size = ::read(from_, buffer.data(), buffer.size())) > 0)
      text.append(buffer.data(), static_cast<std::size_t>(size));
    return size < 0 && (errno == EAGAIN || errno == EINTR);
  }

 private:
  int from_ = -1;
  int to_ = -1;
};

// The program's process; killed and waited for where it has not ended.
class Process {
 public:
  // errno of the failure, or 0.
  int Start(const std::filesystem::path& program, const std::vector<std::string>& words, int pipe) {
    posix_spawn_file_actions_t files;
    posix_spawnattr_t attributes;
    ::posix_spawn_file_actions_init(&files);
    ::posix_spawnattr_init(&attributes);
    ::posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    ::posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    ::posix_spawn_file_actions_adddup2(&files, pipe, kTrialDescriptor);
    ::posix_spawn_file_actions_addclosefrom_np(&files, kTrialDescriptor + 1);
    sigset_t none, all;
    ::sigemptyset(&none);
    ::sigfillset(&all);
    ::posix_spawnattr_setsigmask(&attributes, &none);
    ::posix_spawnattr_setsigdefault(&attributes, &all);
    ::posix_spawnattr_setpgroup(&attributes, 0);  // Ctrl-C is for the run
    ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP);
    std::vector<char*> arguments;
    for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    const int problem = ::posix_spawn(&pid_, program.c_str(), &files, &attributes, arguments.data(), environ);
    ::posix_spawn_file_actions_destroy(&files);
    ::posix_spawnattr_destroy(&attributes);
    if (problem != 0) pid_ = -1;
    return problem;
  }
  Process() = default;
  ~Process() {
    if (pid_ <= 0) return;
    ::kill(pid_, SIGKILL);
    // A process that was killed ends within a moment; one that does not stays a zombie of this process.
    for (int i = 0; i < 1000 && !Ended(); ++i) ::usleep(1000);
  }
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  // waitpid's status once it has ended.
  std::optional<int> Ended() {
    int status = 0;
    const pid_t ended = ::waitpid(pid_, &status, WNOHANG);
    if (ended == 0 || (ended < 0 && errno == EINTR)) return std::nullopt;
    pid_ = -1;
    return ended < 0 ? 0 : status;  // no child: the program ignores SIGCHLD, and nothing is known
  }

 private:
  pid_t pid_ = -1;
};

base::Status RunTheTrial(const std::filesystem::path& folder, const std::string& file, const TrialLimits& limits,
                         const std::vector<std::string>& more) {
  const auto program = base::FindProgram("rodeira-fmu-trial");
  Pipe pipe;
  if (!pipe.ok()) return base::Failed(fmt::format("cannot create a pipe: {}", std::strerror(errno)), file);
  Process process;
  std::vector<std::string> words{program.string(), folder.string(), file, std::to_string(limits.cpu.count())};
  words.insert(words.end(), more.begin(), more.end());
  const int problem = process.Start(program, words, pipe.writer());
  if (problem != 0)
    return base::Failed(fmt::format("cannot start {}, which tries an FMU before it is used: {}", program.string(),
                                    std::strerror(problem)),
                        file);
  pipe.CloseWriter();
  std::string said;
  const auto refusal = [&](const std::string& what) {
    const auto end = said.find_last_of('\n');
    const auto begin = end == std::string::npos || end == 0 ? std::string::npos : said.find_last_of('\n', end - 1);
    const std::string call = end == std::string::npos ? "its start" : said.substr(begin + 1, end - begin - 1);
    return base::WrongInput(fmt::format("its binary {} in {}, when it is tried in a process of its own", what, call),
                            file);
  };
  const auto until = Clock::now() + limits.wall;
  constexpr std::chrono::milliseconds kLook{20};
  std::optional<int> status;
  for (bool is_open = true; !status; status = process.Ended()) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(until - Clock::now());
    if (left.count() <= 0) return refusal(fmt::format("does not come back within {} s", limits.wall.count()));
    if (is_open) {
      pipe.Wait(std::min(left, kLook));
      is_open = pipe.Read(said);
    } else {
      ::usleep(1000);
    }
  }
  (void)pipe.Read(said);
  if (WIFSIGNALED(*status)) {
    const int number = WTERMSIG(*status);
    if (number == SIGXCPU) return refusal(fmt::format("computes for {} s and does not come back", limits.cpu.count()));
    return refusal(fmt::format("crashes (signal {}, {})", number, ::strsignal(number)));
  }
  if (!said.ends_with("\n\n")) return refusal(fmt::format("ends the process (status {})", WEXITSTATUS(*status)));
  if (const auto at = said.find(kRefused); at != std::string::npos) {
    const std::size_t begin = at + kRefused.size();
    return base::WrongInput(said.substr(begin, said.find('\n', begin) - begin), file);
  }
  return {};
}

}  // namespace

base::Status TryInProcessOfItsOwn(const std::filesystem::path& folder, const std::string& file,
                                  const TrialLimits& limits) {
  return RunTheTrial(folder, file, limits, {});
}

base::Status TryStateInProcessOfItsOwn(const std::filesystem::path& folder, const std::string& file,
                                       const TrialLimits& limits) {
  auto states = base::TemporaryFolder::Make("fmu-state");
  if (!states) return states.error();
  const std::string state = (states.value().path() / "state").string();
  for (const char* what : {"save", "set"}) {
    if (auto status = RunTheTrial(folder, file, limits, {what, state}); !status) return status;
  }
  return {};
}

}  // namespace rodeira::fmi
