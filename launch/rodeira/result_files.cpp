// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/result_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <system_error>

namespace rodeira::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* kForce = "--force";
constexpr const char* kFile = "new file";  // names of validators
constexpr const char* kFolder = "new folder";

bool HasValidator(CLI::Option& option, const char* name) {
  try {
    return option.get_validator(name) != nullptr;
  } catch (const CLI::OptionNotFound&) {
    return false;
  }
}

bool NamesResult(CLI::Option* option) { return HasValidator(*option, kFile) || HasValidator(*option, kFolder); }

// Empty: nothing would be replaced.
std::string WhyNot(CLI::Option& option, const std::string& path) {
  std::error_code problem;
  if (HasValidator(option, kFile))
    return fs::is_regular_file(path, problem) ? "the file exists; name another one, or replace it by --force" : "";
  if (!fs::is_directory(path, problem) || fs::is_empty(path, problem) || problem) return "";
  return "the folder is not empty; name another one, or replace its files by --force";
}

}  // namespace

CLI::Validator NewFile() {
  return CLI::Validator(
      [](std::string& text) {
        const fs::path folder = fs::path(text).parent_path();
        std::error_code problem;
        if (folder.empty() || fs::is_directory(folder, problem)) return std::string();
        return fmt::format("'{}' was found; there is no folder '{}'", text, folder.string());
      },
      "FILE", kFile);
}

CLI::Validator NewFolder() {
  return CLI::Validator([](std::string&) { return std::string(); }, "FOLDER", kFolder);
}

void AddForce(CLI::App& app) {
  if (std::ranges::any_of(app.get_options({}), NamesResult))
    app.add_flag(kForce)->description("replace files that exist");
  for (CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) AddForce(*command);
}

bool IsForced(const CLI::App& command) {
  const CLI::Option* force = command.get_option_no_throw(kForce);
  return force != nullptr && force->count() > 0;
}

base::Status CheckResults(CLI::App& app) {
  CLI::App* command = &app;
  std::string name = app.get_name();
  while (!command->get_subcommands().empty()) {
    command = command->get_subcommands().back();
    name += " " + command->get_name();
  }
  if (IsForced(*command)) return {};
  for (CLI::Option* option : command->get_options({})) {
    if (!NamesResult(option) || option->count() == 0) continue;
    const std::string path = option->as<std::string>();
    const std::string why = WhyNot(*option, path);
    if (!why.empty())
      return base::WrongInput("file.exists", why, fmt::format("{}: --{} {}", name, option->get_lnames().front(), path));
  }
  return {};
}

}  // namespace rodeira::cli
