// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/run/ctl_command.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>

#include "common/core/base/print_error.hpp"
#include "common/core/base/suggest.hpp"
#include "common/runtime/launch/command_answer.hpp"
#include "common/runtime/launch/command_text.hpp"
#include "launch/rodeira/run/control_folder.hpp"

namespace rodeira::cli {
namespace {

constexpr std::chrono::seconds kPatience(5);

base::Result<std::filesystem::path> FindRun(const std::string& run) {
  const auto folder = ControlFolder();
  if (!folder) return folder.error();
  const auto living = LivingRuns(folder.value());
  std::vector<std::string> names;
  for (const auto& socket : living) names.push_back(socket.stem().string());
  if (!run.empty()) {
    const auto wanted = ControlSocket(folder.value(), run);
    for (const auto& socket : living) {
      if (socket == wanted) return socket;
    }
    return base::WrongInput("run.unknown_run",
                            fmt::format("no run '{}' of yours is going on on this PC{}", run,
                                        names.empty() ? "" : base::DidYouMean(run, names)),
                            "ctl --run");
  }
  if (living.empty()) return base::WrongInput("run.unknown_run", "no run of yours is going on on this PC", "ctl");
  if (living.size() > 1)
    return base::WrongInput(
        "command.missing_option",
        fmt::format("{} runs are going on: {}; choose one by --run NAME", living.size(), fmt::join(names, ", ")),
        "ctl");
  return living.front();
}

// The answer line; empty if none arrives in time.
std::string SendCommand(int file, const std::string& line) {
  const std::string text = line + "\n";
  if (::send(file, text.data(), text.size(), MSG_NOSIGNAL) != static_cast<ssize_t>(text.size())) return "";
  std::string answer;
  const auto until = std::chrono::steady_clock::now() + kPatience;
  while (std::chrono::steady_clock::now() < until) {
    pollfd waiting{file, POLLIN, 0};
    if (::poll(&waiting, 1, 50) <= 0) continue;
    char buffer[1024];
    const ssize_t size = ::recv(file, buffer, sizeof(buffer), 0);
    if (size <= 0) return "";
    answer.append(buffer, static_cast<std::size_t>(size));
    if (const auto end = answer.find('\n'); end != std::string::npos) return answer.substr(0, end);
  }
  return "";
}

}  // namespace

int Ctl(const CtlOptions& options) {
  std::string line = fmt::format("{}", fmt::join(options.words, " "));
  std::ranges::replace_if(
      line, [](unsigned char c) { return c < 0x20; }, ' ');  // a line is a command
  // Nonsense is refused whether there is a run or not.
  if (const auto command = launch::ParseCommand(line); !command)
    return base::PrintError("rodeira", command.error().In("ctl"));
  const auto socket = FindRun(options.run);
  if (!socket) return base::PrintError("rodeira", socket.error());
  const std::string name = socket.value().stem().string();
  const int file = ConnectTo(socket.value());
  if (file < 0)
    return base::PrintError("rodeira",
                            base::Failed("run.no_answer", fmt::format("run '{}' has just ended", name), "ctl"));
  const std::string answer = SendCommand(file, line);
  ::close(file);
  if (answer.empty())
    return base::PrintError("rodeira",
                            base::Failed("run.no_answer", fmt::format("run '{}' gives no answer", name), "ctl"));
  const auto done = launch::ReadAnswer(answer);
  if (!done) return base::PrintError("rodeira", done.error().In("ctl"));
  fmt::print("{}\n", done.value());
  return 0;
}

}  // namespace rodeira::cli
