// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/run/operator.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>

#include "common/runtime/launch/command_answer.hpp"
#include "common/runtime/launch/command_text.hpp"
#include "common/runtime/launch/run_control_client.hpp"
#include "launch/rodeira/run/control_folder.hpp"

namespace rodeira::cli {

std::string CommandOfKey(char key) {
  switch (key) {
    case ' ':
      return "toggle";
    case '\n':
    case '\r':
      return "step";
    case '+':
    case '=':
      return "faster";  // where + needs Shift
    case '-':
      return "slower";
    case 'm':
      return "mark key m";
    case 'q':
      return "stop";
    default:
      return "";
  }
}

std::string_view KeyHelp() {
  return "space pause or go on, enter one step, + - twice or half the pace, m marker, q stop, h these keys";
}

Operator::Operator(const std::string& run, bool quiet) : quiet_(quiet) {
  if (::isatty(STDERR_FILENO) != 0) keys_ = TerminalKeys::Open(STDIN_FILENO);
  const auto folder = ControlFolder();
  const auto socket = folder ? ControlSocket(folder.value(), run) : std::filesystem::path();
  auto server = folder ? ControlServer::Open(socket) : base::Result<std::unique_ptr<ControlServer>>(folder.error());
  if (server) {
    server_ = std::move(server).value();
    ::setenv(launch::RunControlClient::kVariable, socket.c_str(), 1);  // windows of the run pause it too
  } else if (!quiet) {
    fmt::print(stderr, "rodeira: no `rodeira ctl` for this run: {}\n", server.error().Text());
  }
}

void Operator::Show(const std::string& text) const {
  if (quiet_) return;
  fmt::print(stderr, "\r\033[K{}\n", text);
  std::fflush(stderr);
}

void Operator::ShowAnswer(const std::string& answer) const {
  const auto done = launch::ReadAnswer(answer);
  Show(done ? done.value() : done.error().Text());
}

std::optional<AskedLine> Operator::Next() {
  const std::int64_t now_ms =
      std::chrono::duration_cast<std::chrono::milliseconds>(std::chrono::steady_clock::now().time_since_epoch())
          .count();
  if (now_ms - looked_ms_ < 10) return std::nullopt;
  while (keys_ != nullptr) {
    const auto key = keys_->Next();
    if (!key) break;
    if (*key == 'h' || *key == '?') Show(std::string(KeyHelp()));
    const std::string line = CommandOfKey(*key);
    if (line.empty()) continue;
    return AskedLine{line, [this](const std::string& answer) { ShowAnswer(answer); }};
  }
  if (server_ != nullptr) {
    if (auto asked = server_->Next()) return asked;
  }
  if (buttons_ != nullptr && buttons_->Pressed())
    return AskedLine{CommandOfKey(' '), [this](const std::string& answer) { ShowAnswer(answer); }};
  looked_ms_ = now_ms;  // only where everything that was there has been taken
  return std::nullopt;
}

std::optional<lockstep::OperatorCommand> NextCommand(Operator& run_operator) {
  while (auto line = run_operator.Next()) {
    const auto command = launch::ParseCommand(line->line);
    if (!command) {
      line->answer(launch::AnswerLine(command.error()));
      continue;
    }
    return lockstep::OperatorCommand{command.value(),
                                     [answer = std::move(line->answer)](const base::Result<std::string>& done) {
                                       answer(launch::AnswerLine(done));
                                     }};
  }
  return std::nullopt;
}

}  // namespace rodeira::cli
