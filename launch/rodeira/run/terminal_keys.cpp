// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/run/terminal_keys.hpp"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

namespace rodeira::cli {
namespace {

bool Same(const termios& a, const termios& b) {
  return a.c_lflag == b.c_lflag && a.c_iflag == b.c_iflag && a.c_cc[VMIN] == b.c_cc[VMIN] &&
         a.c_cc[VTIME] == b.c_cc[VTIME];
}

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

// Only where the terminal is as this process has set it: a shell that has taken it over is not disturbed.
void TerminalKeys::Guard() {
  int pipe[2] = {-1, -1};
  if (::pipe2(pipe, O_CLOEXEC) != 0) return;
  guardian_ = ::fork();
  if (guardian_ == 0) {
    ::setpgid(0, 0);  // the terminal's signals are not for it
    ::prctl(PR_SET_NAME, "rodeira-keys");
    ::close(pipe[1]);
    for (const int number : {SIGTTOU, SIGHUP, SIGINT, SIGTERM, SIGQUIT}) ::signal(number, SIG_IGN);
    char nothing = 0;
    while (::read(pipe[0], &nothing, 1) < 0 && errno == EINTR) {
    }
    termios now{};
    if (::tcgetattr(file_, &now) == 0 && Same(now, keys_)) ::tcsetattr(file_, TCSANOW, &before_);
    ::_exit(0);
  }
  ::close(pipe[0]);
  if (guardian_ > 0) ::setpgid(guardian_, guardian_);  // here too: a Ctrl-C may come before the child has got so far
  if (guardian_ < 0) {
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
