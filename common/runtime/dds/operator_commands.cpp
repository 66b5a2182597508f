// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/dds/operator_commands.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "common/runtime/dds/statements.hpp"
#include "common/runtime/launch/command_answer.hpp"
#include "common/runtime/launch/command_text.hpp"
#include "common/runtime/lockstep/wait_chain.hpp"

namespace rodeira::dds {

void OperatorCommands::Do(const std::vector<std::string>& lines) {
  for (const std::string& line : lines) {
    const auto space = std::min(line.find(' '), line.size());
    const std::string number = line.substr(0, space);
    const auto command = launch::ParseCommand(std::string_view(line).substr(space));
    const auto done = command ? Do(command.value()) : base::Result<std::string>(command.error());
    Say("answer {} {}", number, launch::AnswerLine(done));
  }
}

base::Result<std::string> OperatorCommands::Do(const lockstep::Command& command) {
  using Kind = lockstep::Command::Kind;
  if (command.kind == Kind::kRestart) return losses_.RestartByHand(command.text);
  stop_asked_ = stop_asked_ || command.kind == Kind::kStop;
  auto done = run_.controller.Do(command, run_.Now());
  if (!done || command.kind != Kind::kState) return done;
  const std::string state = fmt::format("{} in domain {}", done.value(), run_.domain);
  if (!run_.missed.empty()) return state + "; it stands: " + run_.missed.Text(run_.NowNs());
  const std::string chain = lockstep::WaitChain(run_.roster, run_.clock.reports());
  return chain.empty() ? state : state + "; " + chain;
}

void OperatorCommands::StopBySignal() {
  run_.controller.Stop(run_.Now());
  stop_asked_ = true;
}

}  // namespace rodeira::dds
