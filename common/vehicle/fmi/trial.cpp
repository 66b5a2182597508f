// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/fmi/trial.hpp"

#include <fmt/format.h>
#include <signal.h>

#include <cstring>
#include <vector>

#include "common/core/base/installation.hpp"
#include "common/core/base/run_program.hpp"
#include "common/core/base/temporary_folder.hpp"

namespace rodeira::fmi {
namespace {

constexpr std::string_view kRefused = "refused: ";

base::Status RunTheTrial(const std::filesystem::path& folder, const std::string& file, const TrialLimits& limits,
                         const std::vector<std::string>& more) {
  base::ProgramRun run;
  run.program = base::FindProgram("rodeira-fmu-trial");
  run.arguments = {folder.string(), file, std::to_string(limits.cpu.count())};
  run.arguments.insert(run.arguments.end(), more.begin(), more.end());
  run.limit = limits.wall;
  run.text_descriptor = kTrialDescriptor;
  run.is_own_group = true;  // Ctrl-C is for the run
  const auto ended = base::RunProgram(run);
  if (!ended) {
    return base::Failed(ended.error().id,
                        fmt::format("{}: the program tries an FMU before it is used", ended.error().Text()), file);
  }
  const base::ProgramEnd& end_of_trial = ended.value();
  const std::string& said = end_of_trial.text;
  const auto refusal = [&](const std::string& what) {
    const auto end = said.find_last_of('\n');
    const auto begin = end == std::string::npos || end == 0 ? std::string::npos : said.find_last_of('\n', end - 1);
    const std::string call = end == std::string::npos ? "its start" : said.substr(begin + 1, end - begin - 1);
    return base::WrongInput("fmu.trial_failed",
                            fmt::format("its binary {} in {}, when it is tried in a process of its own", what, call),
                            file);
  };
  if (end_of_trial.too_long) return refusal(fmt::format("does not come back within {} s", limits.wall.count()));
  if (const int number = end_of_trial.signal; number != 0) {
    if (number == SIGXCPU) return refusal(fmt::format("computes for {} s and does not come back", limits.cpu.count()));
    return refusal(fmt::format("crashes (signal {}, {})", number, ::strsignal(number)));
  }
  if (!said.ends_with("\n\n")) return refusal(fmt::format("ends the process (status {})", end_of_trial.status));
  if (const auto at = said.find(kRefused); at != std::string::npos) {
    const std::size_t begin = at + kRefused.size();
    return base::WrongInput("fmu.trial_failed", said.substr(begin, said.find('\n', begin) - begin), file);
  }
  return {};
}

}  // namespace

base::Status TryInProcessOfItsOwn(const std::filesystem::path& folder, const std::string& file,
                                  const TrialLimits& limits) {
  return RunTheTrial(folder, file, limits, {});
}

base::Status TryStateInProcessOfItsOwn(const std::filesystem::path& folder, const std::string& file,
                                       const TrialLimits& limits) {
  auto states = base::TemporaryFolder::Make("fmu-state");
  if (!states) return states.error();
  const std::string state = (states.value().path() / "state").string();
  for (const char* what : {"save", "set"}) {
    if (auto status = RunTheTrial(folder, file, limits, {what, state}); !status) return status;
  }
  return {};
}

}  // namespace rodeira::fmi
