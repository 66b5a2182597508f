#include "common/editor/export.hpp"

#include <fmt/format.h>

#include <system_error>

#include "common/base/files.hpp"
#include "common/map/lane_map.hpp"
#include "common/map/open_drive.hpp"

namespace rodeira::editor {
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

std::string WorldText(const std::string& name, const std::string& network) {
  return fmt::format("rodeira: world/2\nname: {}\ndescription: drawn with rodeira edit\nnetwork: {{file: {}}}\n", Quoted(name), Quoted(network));
}

}  // namespace

base::Result<std::string> Export(const Document& document, const std::filesystem::path& path) {
  const auto lanes = map::MakeLaneMap(document.map, document.companion, "map");
  if (!lanes) return base::WrongInput(lanes.error().message);
  const std::string name = path.stem().string();
  const auto drive = map::ToOpenDrive(lanes.value(), name);
  if (!drive) return base::WrongInput(drive.error().message);
  const bool alone = path.extension() == ".xodr";
  std::filesystem::path roads = path;
  roads.replace_extension(".xodr");
  std::error_code problem;
  if (!alone && std::filesystem::exists(roads, problem) && !std::filesystem::exists(path, problem))
    return base::WrongInput("this file is there already and is not this world's; another name was expected", roads.string());
  if (auto status = base::WriteWhole(roads, drive.value().xml); !status) return status.error();
  if (!alone) {
    if (auto status = base::WriteWhole(path, WorldText(name, roads.filename().string())); !status) return status.error();
  }
  return fmt::format("exported {}{}: {} roads, {} junctions", alone ? "" : path.filename().string() + " and ", roads.filename().string(), drive.value().roads, drive.value().junctions);
}

}  // namespace rodeira::editor
