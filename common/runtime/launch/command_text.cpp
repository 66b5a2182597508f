// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/launch/command_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>

#include "common/core/base/suggest.hpp"
#include "common/runtime/launch/pace.hpp"

namespace rodeira::launch {
namespace {

using lockstep::Command;
using Kind = Command::Kind;

Command Of(Kind kind) {
  Command command;
  command.kind = kind;
  return command;
}

constexpr lockstep::Step kMaxSteps = 1'000'000'000;
constexpr std::size_t kMaxText = 500;

std::string_view Trim(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
}

base::Result<Command> ParseStep(std::string_view rest) {
  Command command = Of(Kind::kStep);
  if (rest.empty()) return command;
  const auto [end, problem] = std::from_chars(rest.data(), rest.data() + rest.size(), command.steps);
  if (problem != std::errc{} || end != rest.data() + rest.size() || command.steps < 1 || command.steps > kMaxSteps) {
    return base::WrongInput(
        "command.wrong_value",
        fmt::format("'{}' was found; a number of base steps from 1 to {} was expected", rest, kMaxSteps), "step");
  }
  return command;
}

base::Result<Command> ParseMark(std::string_view rest) {
  Command command = Of(Kind::kMark);
  if (rest.empty()) return base::WrongInput("command.wrong_value", "a text was expected", "mark");
  if (rest.size() > kMaxText)
    return base::WrongInput("command.wrong_value",
                            fmt::format("{} bytes of text were found, at most {} were expected", rest.size(), kMaxText),
                            "mark");
  command.text = base::Printable(rest);
  return command;
}

}  // namespace

const std::vector<std::string>& CommandNames() {
  static const std::vector<std::string> kNames{"pause", "resume", "step",   "pace",   "mark",   "stop",
                                               "state", "toggle", "faster", "slower", "restart"};
  return kNames;
}

base::Result<Command> ParseCommand(std::string_view line) {
  line = Trim(line);
  const std::string name(line.substr(0, line.find_first_of(" \t")));
  const std::string_view rest = Trim(line.substr(name.size()));
  const auto found = std::find(CommandNames().begin(), CommandNames().end(), name);
  if (found == CommandNames().end()) {
    return base::WrongInput("command.unknown_command",
                            fmt::format("unknown command '{}'{}", name, base::DidYouMean(name, CommandNames())));
  }
  if (name == "step") return ParseStep(rest);
  if (name == "mark") return ParseMark(rest);
  if (name == "restart") {
    Command command = Of(Kind::kRestart);
    if (rest.empty()) return base::WrongInput("command.wrong_value", "the name of a node was expected", "restart");
    command.text = rest;
    return command;
  }
  if (name == "pace") {
    const auto pace = ParsePace(std::string(rest), "pace");
    if (!pace) return pace.error();
    Command command = Of(Kind::kPace);
    command.pace = pace.value();
    return command;
  }
  if (!rest.empty())
    return base::WrongInput("command.wrong_value", fmt::format("'{}' was found behind it; nothing was expected", rest),
                            name);
  static const std::map<std::string, Kind> kBare{
      {"state", Kind::kState},   {"pause", Kind::kPause},   {"resume", Kind::kResume}, {"stop", Kind::kStop},
      {"toggle", Kind::kToggle}, {"faster", Kind::kFaster}, {"slower", Kind::kSlower}};
  return Of(kBare.at(name));
}

}  // namespace rodeira::launch
