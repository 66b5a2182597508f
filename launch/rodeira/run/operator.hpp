// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "common/runtime/lockstep/in_process.hpp"
#include "launch/rodeira/run/control_server.hpp"
#include "launch/rodeira/run/pause_buttons.hpp"
#include "launch/rodeira/run/terminal_keys.hpp"

namespace rodeira::cli {

// What a key of the terminal asks for: space "toggle", Enter "step", + "faster", - "slower", m "mark key m", q "stop".
// Empty: nothing.
std::string CommandOfKey(char key);
// What h shows.
std::string_view KeyHelp();

// What controls the run: the terminal's keys and the clients of the control socket.
class Operator {
 public:
  // Where no socket can be made the run goes without, and says so. `quiet`: keys answer nothing.
  Operator(const std::string& run, bool quiet);

  // The next thing asked for; nothing where there is none. Never waits; looks at most every 10 ms.
  std::optional<AskedLine> Next();
  // Buttons of wheels pause the run too; null: none do.
  void Listen(std::unique_ptr<PauseButtons> buttons) { buttons_ = std::move(buttons); }
  bool has_keys() const { return keys_ != nullptr; }

 private:
  void Show(const std::string& text) const;
  void ShowAnswer(const std::string& answer) const;

  bool quiet_;
  std::unique_ptr<TerminalKeys> keys_;
  std::unique_ptr<ControlServer> server_;
  std::unique_ptr<PauseButtons> buttons_;
  std::int64_t looked_ms_ = 0;
};

// The next command of theirs for a run in this process; an unreadable one is answered at once.
std::optional<lockstep::OperatorCommand> NextCommand(Operator& run_operator);

}  // namespace rodeira::cli
