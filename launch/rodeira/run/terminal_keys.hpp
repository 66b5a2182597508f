// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>
#include <termios.h>

#include <memory>
#include <optional>

namespace rodeira::cli {

// Single keys of a terminal, without echo and without waiting for Enter. Ctrl-C, Ctrl-Z and the rest keep their
// meaning. The terminal is put back as it was by the destructor, and by a guardian, the program rodeira-keys, however
// this process ends (kill -9 too).
class TerminalKeys {
 public:
  // Null where `file` is no terminal.
  static std::unique_ptr<TerminalKeys> Open(int file);
  ~TerminalKeys();
  TerminalKeys(const TerminalKeys&) = delete;
  TerminalKeys& operator=(const TerminalKeys&) = delete;

  // The next key pressed; nothing where there is none or where this process is in the background. Never waits.
  std::optional<char> Next();

 private:
  TerminalKeys(int file, const termios& before);
  bool IsForeground() const;
  void Guard();

  int file_;
  termios before_;
  termios keys_;
  pid_t guardian_ = -1;
  int guarded_ = -1;  // closed at our end, whatever end that is
};

}  // namespace rodeira::cli
