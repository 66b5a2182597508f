// SPDX-License-Identifier: Apache-2.0
#include "common/world/traffic_map/world_files.hpp"

#include <fmt/format.h>

#include <system_error>

#include "common/core/base/files.hpp"

namespace rodeira::traffic_map {
namespace {

// A YAML text in quotes.
std::string Quoted(const std::string& text) {
  std::string quoted = "\"";
  for (const char letter : text) {
    if (letter == '"' || letter == '\\') quoted += '\\';
    quoted += letter;
  }
  return quoted + '"';
}

}  // namespace

base::Result<OpenDrive> WriteWorld(const LaneMap& map, const std::filesystem::path& path,
                                   const std::string& description) {
  const std::string name = path.stem().string();
  auto drive = ToOpenDrive(map, name);
  if (!drive) return drive.error().WithContext("");
  const bool alone = path.extension() == ".xodr";
  std::filesystem::path roads = path;
  roads.replace_extension(".xodr");
  std::error_code problem;
  if (!alone && std::filesystem::exists(roads, problem) && !std::filesystem::exists(path, problem))
    return base::WrongInput(
        "file.exists", "this file is there already and is not this world's; another name was expected", roads.string());
  if (auto status = base::WriteWhole(roads, drive.value().xml); !status) return status.error();
  if (alone) return drive;
  const std::string world = fmt::format("rodeira: world/2\nname: {}\ndescription: {}\nnetwork: {{file: {}}}\n",
                                        Quoted(name), Quoted(description), Quoted(roads.filename().string()));
  if (auto status = base::WriteWhole(path, world); !status) return status.error();
  return drive;
}

}  // namespace rodeira::traffic_map
