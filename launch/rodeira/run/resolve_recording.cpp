// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/run/resolve_recording.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <ctime>
#include <filesystem>

#include "common/core/base/user_folders.hpp"
#include "common/core/config/quoted.hpp"

namespace rodeira::cli {

std::string FreeName(const launch::Launch& launch, const std::string& name) {
  std::string free = name;
  const auto is_it = [&free](const launch::LaunchNode& node) { return node.name == free; };
  const auto taken = [&] { return std::ranges::any_of(launch.nodes(), is_it); };
  for (int number = 2; taken(); ++number) free = fmt::format("{}{}", name, number);
  return free;
}

std::string DatedRecording(const std::string& launch_name) {
  const std::time_t now = std::time(nullptr);
  std::tm local{};
  ::localtime_r(&now, &local);
  std::string name = launch_name;
  std::ranges::replace(name, '/', '_');
  return (base::UserDataFolder() / fmt::format("{}-{:%Y%m%d-%H%M%S}-{}.mcap", name, local, ::getpid())).string();
}

base::Status ResolveRecording(const launch::Launch& launch, const Placement& placement, RunOptions& options,
                              launch::Overrides& overrides) {
  std::string recorder;
  std::string own;  // what the launch file says
  for (const launch::LaunchNode& node : launch.nodes()) {
    if (node.kind->name != "recorder") continue;
    if (options.no_record) overrides.emplace_back("nodes." + node.name + ".kind", std::string(launch::kNoKind));
    if (options.no_record || !recorder.empty()) continue;
    if (!placement.Has(node)) {
      if (options.record.empty()) return {};
      return base::WrongInput("command.wrong_combination",
                              fmt::format("the recorder '{}' runs on another host; say it there", node.name),
                              "--record");
    }
    recorder = node.name;
    own = node.config->OptionalChild("config").Peek({"file"}).value_or("");
    if (!own.empty()) own = node.config->OptionalChild("config").Path("file").string();
  }
  if (options.no_record) return {};
  if (options.record.empty()) options.record = own;
  if (!own.empty() && options.record == own) return {};
  if (options.record.empty() && recorder.empty() && !placement.host().empty()) return {};
  std::error_code problem;
  if (options.record.empty()) {
    options.record = DatedRecording(launch.name());
    std::filesystem::create_directories(base::UserDataFolder(), problem);
    if (problem) {
      const std::string what =
          fmt::format("the folder for recordings cannot be made: {}; name a file by --record, or say --no-record",
                      problem.message());
      return base::Failed("file.cannot_make_folder", what, base::UserDataFolder().string());
    }
  }
  options.record = std::filesystem::absolute(options.record, problem).string();
  if (std::filesystem::exists(options.record, problem))
    return base::WrongInput("file.exists", "the file exists; a recording is never overwritten", options.record);
  if (recorder.empty()) {
    if (!placement.host().empty()) {
      return base::WrongInput(
          "launch.no_recorder",
          "the launch file has no recorder; with several PCs it must have one, 'recorder: {kind: recorder}'",
          "--record");
    }
    recorder = FreeName(launch, "recorder");
    overrides.emplace_back("nodes." + recorder + ".kind", "recorder");
  }
  overrides.emplace_back("nodes." + recorder + ".config.file", config::Quoted(options.record));
  return {};
}

}  // namespace rodeira::cli
