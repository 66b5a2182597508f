// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/result_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

namespace rodeira::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* kForce = "--force";
constexpr const char* kFile = "new file";  // names of validators
constexpr const char* kFolder = "new folder";
constexpr const char* kBeside = "also writes ";    // … ENDING WHEN
constexpr const char* kRenewed = "renewed with ";  // … FILE

bool HasValidator(CLI::Option& option, const char* name) {
  try {
    return option.get_validator(name) != nullptr;
  } catch (const CLI::OptionNotFound&) {
    return false;
  }
}

bool NamesResult(CLI::Option* option) { return HasValidator(*option, kFile) || HasValidator(*option, kFolder); }

// What follows in the name of the option's validator that begins with `begin`, from number `i` on, which is then that
// of the next one; nothing: there is none.
std::optional<std::string> NextNamed(CLI::Option& option, const char* begin, int& i) {
  while (true) {
    const CLI::Validator* validator = nullptr;
    try {
      validator = option.get_validator(i++);
    } catch (const CLI::OptionNotFound&) {
      return std::nullopt;
    }
    const std::string name = validator->get_name();
    if (name.starts_with(begin)) return name.substr(std::string_view(begin).size());
  }
}

// The first file that is there of those that are written beside one; empty: there is none.
fs::path FoundBeside(CLI::Option& option, const fs::path& file) {
  std::error_code problem;
  int i = 0;
  while (const auto endings = NextNamed(option, kBeside, i)) {
    const auto space = endings->find(' ');
    const std::string when = endings->substr(space + 1);
    const fs::path beside = fs::path(file).replace_extension(endings->substr(0, space));
    if ((when.empty() || file.extension() == when) && fs::is_regular_file(beside, problem)) return beside;
  }
  return {};
}

// Empty: nothing would be replaced.
std::string WhyNot(CLI::Option& option, const std::string& path) {
  std::error_code problem;
  if (HasValidator(option, kFile)) {
    if (fs::is_regular_file(path, problem)) return "the file exists; name another one, or replace it by --force";
    const fs::path beside = FoundBeside(option, path);
    return beside.empty() ? ""
                          : fmt::format(
                                "{} would be written, too, and exists; name another one, or replace it by "
                                "--force",
                                beside.filename().string());
  }
  if (!fs::is_directory(path, problem) || fs::is_empty(path, problem) || problem) return "";
  int i = 0;
  const auto renewed = NextNamed(option, kRenewed, i);
  if (!renewed) return "the folder is not empty; name another one, or replace its files by --force";
  if (fs::is_regular_file(fs::path(path) / *renewed, problem)) return "";
  return fmt::format(
      "the folder is not empty, and without '{}' it is none that this command wrote; name another one, or write into "
      "it "
      "by --force",
      *renewed);
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

CLI::Validator AlsoWrites(const std::string& ending, const std::string& when) {
  return CLI::Validator([](std::string&) { return std::string(); }, "", kBeside + ending + " " + when);
}

CLI::Validator NewFolder() {
  return CLI::Validator([](std::string&) { return std::string(); }, "FOLDER", kFolder);
}

CLI::Validator RenewedWith(const std::string& file) {
  return CLI::Validator([](std::string&) { return std::string(); }, "", kRenewed + file);
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
