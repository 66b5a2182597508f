// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/commands/world_import.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <system_error>

#include "common/core/base/files.hpp"
#include "common/core/base/print_error.hpp"
#include "common/world/sumo/import_file.hpp"
#include "launch/rodeira/interrupt.hpp"

namespace rodeira::cli {
namespace {

// On a terminal, after two seconds: how long it takes.
class ImportProgress {
 public:
  explicit ImportProgress(bool quiet) : quiet_(quiet || ::isatty(STDERR_FILENO) == 0) {}
  ~ImportProgress() {
    if (shown_) fmt::print(stderr, "\r\033[K");
  }
  ImportProgress(const ImportProgress&) = delete;
  ImportProgress& operator=(const ImportProgress&) = delete;

  bool Stop() {
    const auto passed = std::chrono::duration_cast<std::chrono::seconds>(std::chrono::steady_clock::now() - start_);
    if (!quiet_ && passed.count() > shown_s_ && passed.count() >= 2) {
      fmt::print(stderr, "\r\033[Kreading the roads for {} s", passed.count());
      shown_ = true, shown_s_ = passed.count();
    }
    return Interrupted();
  }

 private:
  bool quiet_;
  bool shown_ = false;
  std::int64_t shown_s_ = 0;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

// A YAML text in quotes.
std::string Quoted(const std::string& text) {
  std::string quoted = "\"";
  for (const char letter : text) {
    if (letter == '"' || letter == '\\') quoted += '\\';
    quoted += letter;
  }
  return quoted + '"';
}

base::Status NotThere(const std::filesystem::path& file) {
  std::error_code problem;
  if (!std::filesystem::exists(std::filesystem::symlink_status(file, problem))) return {};
  return base::WrongInput("file.exists", "this file exists; another name was expected", file.string());
}

base::Status WriteWorld(const std::string& drive, const std::filesystem::path& source,
                        const std::filesystem::path& roads, const std::filesystem::path& world) {
  if (auto status = base::WriteWhole(roads, drive); !status || world == roads) return status;
  const std::string text =
      fmt::format("rodeira: world/2\nname: {}\ndescription: {}\nnetwork: {{file: {}}}\n", Quoted(world.stem().string()),
                  Quoted("made of " + source.filename().string()), Quoted(roads.filename().string()));
  auto status = base::WriteWhole(world, text);
  std::error_code ignored;
  if (!status) std::filesystem::remove(roads, ignored);
  return status;
}

base::Status Import(const WorldImportOptions& options) {
  const std::filesystem::path world = options.out;
  const std::string kind = world.extension();
  if (kind != ".xodr" && kind != ".yaml")
    return base::WrongInput("command.wrong_value",
                            fmt::format("the file's name ends with '{}'; .yaml or .xodr was expected", kind),
                            options.out);
  const std::filesystem::path roads = std::filesystem::path(world).replace_extension(".xodr");
  for (const std::filesystem::path& file : {world, roads}) {
    if (auto status = options.force ? base::Status() : NotThere(file); !status) return status;
  }
  CatchInterrupts();
  const auto imported = [&] {
    ImportProgress progress(options.quiet);
    return sumo::ImportFile({options.file, roads, options.elevation, [&progress] { return progress.Stop(); }});
  }();
  if (!imported) return imported.error();
  if (auto status = WriteWorld(imported.value().drive, options.file, roads, world); !status) return status;
  for (const std::string& warning : imported.value().warnings) fmt::print(stderr, "rodeira: warning: {}\n", warning);
  fmt::print("{}wrote {}{}\n", imported.value().table, world.string(), world == roads ? "" : " and " + roads.string());
  return {};
}

}  // namespace

int WorldImport(const WorldImportOptions& options) {
  const auto status = Import(options);
  return status ? 0 : base::PrintError("rodeira", status.error());
}

}  // namespace rodeira::cli
