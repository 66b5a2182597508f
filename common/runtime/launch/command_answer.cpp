// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/launch/command_answer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "common/core/base/printable.hpp"

namespace rodeira::launch {
namespace {

// Of all errors that answer a command: ids are texts of the program, not of a message. The last one stands for others.
constexpr std::array<base::ErrorId, 10> kIds = {"command.too_long",    "launch.wrong_pace",   "command.unknown_command",
                                                "command.wrong_value", "launch.unknown_node", "run.cannot_restart",
                                                "run.clock_lost",      "run.failed",          "run.not_running",
                                                "run.refused"};

base::ErrorId IdOf(std::string_view text) {
  const auto found = std::ranges::find(kIds, text, &base::ErrorId::text);
  return found == kIds.end() ? kIds.back() : *found;
}

// The text up to a space, which is taken away with it.
std::string_view TakeWord(std::string_view& text) {
  const std::string_view word = text.substr(0, text.find(' '));
  text.remove_prefix(std::min(word.size() + 1, text.size()));
  return word;
}

}  // namespace

std::string AnswerLine(const base::Result<std::string>& done) {
  std::string line = done ? "ok " + done.value()
                          : fmt::format("{} {} {}", done.error().exit_status() == 2 ? "wrong" : "failed",
                                        done.error().id.text(), done.error().Text());
  std::ranges::replace(line, '\n', ' ');
  return line;
}

base::Result<std::string> ReadAnswer(std::string_view line) {
  const std::string_view how = TakeWord(line);
  if (how == "ok") return std::string(line);
  if (how == "wrong" || how == "failed") {
    const base::ErrorId id = IdOf(TakeWord(line));
    const auto code = how == "wrong" ? base::ErrorCode::kWrongInput : base::ErrorCode::kFailed;
    return base::Error{code, id, base::Printable(line), ""};
  }
  return base::Failed("run.no_answer", fmt::format("'{}' was found; ok, wrong or failed was expected", how));
}

}  // namespace rodeira::launch
