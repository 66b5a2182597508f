// SPDX-License-Identifier: Apache-2.0
// rodeira-keys KEYS BEFORE: waits until its standard input is closed, then puts the terminal on its standard output
// back to BEFORE, where it is as KEYS: a shell that has taken the terminal over is not disturbed. Both are terminal
// settings as TerminalKeys writes them.
#include <signal.h>
#include <unistd.h>

#include <cerrno>

#include "launch/rodeira/run/terminal_settings.hpp"

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const auto keys = rodeira::cli::ReadSettings(argv[1]), before = rodeira::cli::ReadSettings(argv[2]);
  if (!keys || !before) return 2;
  for (const int number : {SIGTTOU, SIGHUP, SIGINT, SIGTERM, SIGQUIT}) ::signal(number, SIG_IGN);
  char nothing = 0;
  while (::read(STDIN_FILENO, &nothing, 1) < 0 && errno == EINTR) {
  }
  termios now{};
  if (::tcgetattr(STDOUT_FILENO, &now) == 0 && rodeira::cli::Same(now, *keys))
    ::tcsetattr(STDOUT_FILENO, TCSANOW, &*before);
  return 0;
}
