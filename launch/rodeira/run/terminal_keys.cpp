// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/run/terminal_keys.hpp"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <string>

#include "common/core/base/installation.hpp"
#include "launch/rodeira/run/terminal_settings.hpp"

namespace rodeira::cli {
namespace {

// For the handler of Ctrl-Z alone.
int g_file = -1;
termios g_before{};

void OnTerminalStop(int) {
  const int error = errno;
  if (g_file >= 0) ::tcsetattr(g_file, TCSANOW, &g_before);
  ::raise(SIGSTOP);
  errno = error;  // continued: Next() takes the keys again
}

}  // namespace

std::unique_ptr<TerminalKeys> TerminalKeys::Open(int file) {
  termios before{};
  if (::isatty(file) == 0 || ::tcgetattr(file, &before) != 0) return nullptr;
  std::unique_ptr<TerminalKeys> keys(new TerminalKeys(file, before));
  keys->Guard();
  g_before = before;
  g_file = file;
  struct sigaction action {};
  action.sa_handler = OnTerminalStop;
  action.sa_flags = SA_RESTART;
  ::sigaction(SIGTSTP, &action, nullptr);
  return keys;
}

TerminalKeys::TerminalKeys(int file, const termios& before) : file_(file), before_(before), keys_(before) {
  keys_.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
  keys_.c_cc[VMIN] = 1;
  keys_.c_cc[VTIME] = 0;
}

TerminalKeys::~TerminalKeys() {
  g_file = -1;
  ::signal(SIGTSTP, SIG_DFL);
  termios now{};
  if (IsForeground() && ::tcgetattr(file_, &now) == 0 && Same(now, keys_)) ::tcsetattr(file_, TCSANOW, &before_);
  if (guarded_ >= 0) ::close(guarded_);
  // The guardian ends at once, unless it is stopped.
  for (int i = 0; guardian_ > 0 && i < 1000 && ::waitpid(guardian_, nullptr, WNOHANG) == 0; ++i) ::usleep(1000);
}

bool TerminalKeys::IsForeground() const { return ::tcgetpgrp(file_) == ::getpgrp(); }

// A program of its own, which has no thread, lock or file of this process: the terminal as standard output, our end of
// a pipe as standard input. In a group of its own: the terminal's signals are not for it.
void TerminalKeys::Guard() {
  int pipe[2] = {-1, -1};
  if (::pipe2(pipe, O_CLOEXEC) != 0) return;
  const std::string program = base::FindProgram("rodeira-keys").string(), keys = SettingsText(keys_),
                    before = SettingsText(before_);
  const char* arguments[] = {program.c_str(), keys.c_str(), before.c_str(), nullptr};
  posix_spawn_file_actions_t files;
  posix_spawnattr_t attributes;
  ::posix_spawn_file_actions_init(&files);
  ::posix_spawnattr_init(&attributes);
  ::posix_spawn_file_actions_adddup2(&files, file_, STDOUT_FILENO);
  ::posix_spawn_file_actions_adddup2(&files, pipe[0], STDIN_FILENO);
  ::posix_spawn_file_actions_addclosefrom_np(&files, STDERR_FILENO + 1);
  ::posix_spawnattr_setpgroup(&attributes, 0);
  ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  const int problem =
      ::posix_spawn(&guardian_, program.c_str(), &files, &attributes, const_cast<char* const*>(arguments), environ);
  ::posix_spawn_file_actions_destroy(&files);
  ::posix_spawnattr_destroy(&attributes);
  ::close(pipe[0]);
  if (problem != 0) {
    guardian_ = -1;
    ::close(pipe[1]);
    return;
  }
  guarded_ = pipe[1];
}

std::optional<char> TerminalKeys::Next() {
  if (!IsForeground()) return std::nullopt;  // to read or to set it would stop us
  termios now{};
  if (::tcgetattr(file_, &now) != 0) return std::nullopt;
  if (!Same(now, keys_) && ::tcsetattr(file_, TCSANOW, &keys_) != 0) return std::nullopt;
  pollfd waiting{file_, POLLIN, 0};
  if (::poll(&waiting, 1, 0) <= 0 || (waiting.revents & POLLIN) == 0) return std::nullopt;
  char key = 0;
  if (::read(file_, &key, 1) != 1) return std::nullopt;
  return key;
}

}  // namespace rodeira::cli
