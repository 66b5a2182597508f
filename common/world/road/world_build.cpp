// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cctype>
#include <set>
#include <string_view>

#include "common/core/base/files.hpp"
#include "common/core/config/config.hpp"
#include "common/core/config/quoted.hpp"
#include "common/world/road/logical_files.hpp"
#include "common/world/road/map_world.hpp"
#include "common/world/road/network_world.hpp"
#include "common/world/road/world_report.hpp"
#include "common/world/terrain/bt.hpp"

namespace rodeira::road {
namespace {

bool LeadsOut(const std::filesystem::path& name) {
  return name.is_absolute() || name.lexically_normal().begin()->string() == "..";
}

// The picture on the terrain: below the world file's folder it is copied, elsewhere it stays.
std::string TextureText(const terrain::LaidPicture& picture, const std::filesystem::path& world_yaml) {
  const std::filesystem::path whole = std::filesystem::absolute(picture.file).lexically_normal();
  const std::filesystem::path below =
      whole.lexically_relative(std::filesystem::absolute(world_yaml).lexically_normal().parent_path());
  const std::string start = fmt::format("  texture:\n    file: {}\n",
                                        config::Quoted((below.empty() || LeadsOut(below) ? whole : below).string()));
  if (picture.repeats) return start + fmt::format("    kind: geotypical\n    repeat_m: {}\n", picture.width_m);
  return start + fmt::format("    kind: draped\n    west_m: {}\n    south_m: {}\n    east_m: {}\n    north_m: {}\n",
                             picture.west_m, picture.south_m, picture.west_m + picture.width_m,
                             picture.south_m + picture.height_m);
}

// The world file's text with another 'terrain:' block; everything else, comments too, stays as it is.
std::string WithTerrain(const std::string& text, const std::string& block) {
  std::string out;
  bool within = false;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size() - 1) + 1;
    const std::string line = text.substr(at, end - at);
    at = end;
    const bool top_level = line[0] != ' ' && line[0] != '\t' && line[0] != '#' && line[0] != '\n' && line[0] != '\r';
    if (top_level) within = line.starts_with("terrain:");
    if (top_level && within) out += block;
    const bool blank = line.find_first_not_of(" \t\r\n") == std::string::npos;
    if (!within || blank) out += line;
  }
  return out;
}

bool IsPartOfAPath(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 ||
         std::string_view("/._-~+").find(c) != std::string_view::npos;
}

// The files that the world file names outside of its own folder, by their whole paths: the text is written into another
// folder, and the others are copied.
std::string WithWholePaths(std::string text, const config::File& file) {
  const std::filesystem::path folder = std::filesystem::absolute(file.path()).parent_path();
  std::set<std::string> names;
  for (const std::string& scalar : file.Scalars()) {
    std::error_code problem;
    const std::filesystem::path name(scalar);
    if (name.is_relative() && name.has_extension() && LeadsOut(name) &&
        std::filesystem::is_regular_file(folder / name, problem))
      names.insert(scalar);
  }
  for (const std::string& name : names) {
    const std::string whole = (folder / name).lexically_normal().string();
    for (std::size_t at = text.find(name); at != std::string::npos; at = text.find(name, at)) {
      const std::size_t end = at + name.size();
      const bool is_whole =
          (at == 0 || !IsPartOfAPath(text[at - 1])) && (end == text.size() || !IsPartOfAPath(text[end]));
      if (is_whole) text.replace(at, name.size(), whole);
      at += is_whole ? whole.size() : name.size();
    }
  }
  return text;
}

}  // namespace

bool IsGenerated(const std::filesystem::path& world_file) {
  if (IsOpenDrive(world_file) || IsTrafficMap(world_file)) return false;
  const auto file = config::File::Load(world_file);
  return file.ok() && file.value().root().OptionalChild("terrain").Has("generate");
}

base::Status CopyWorld(const std::filesystem::path& world_yaml, const std::filesystem::path& folder) {
  const auto file = config::File::Load(world_yaml);
  if (!file) return file.error();
  std::error_code problem;
  std::filesystem::create_directories(folder, problem);
  const auto target = folder / world_yaml.filename();
  if (std::filesystem::equivalent(target, world_yaml, problem)) return {};
  return base::WriteWhole(target, std::string_view(WithWholePaths(file.value().text(), file.value())));
}

base::Result<std::string> BuildWorld(const std::filesystem::path& world_yaml, const std::filesystem::path& folder) {
  const auto world = World::Load(world_yaml);
  if (!world) return world.error();
  return BuildWorld(*world.value(), world_yaml, folder);
}

base::Result<std::string> BuildWorld(const World& wanted, const std::filesystem::path& world_yaml,
                                     const std::filesystem::path& folder) {
  const auto file = config::File::Load(world_yaml);
  if (!file) return file.error();
  if (!IsGenerated(world_yaml)) {
    return base::WrongInput("world.nothing_to_build",
                            "there is nothing to build: a world with 'generate' under 'terrain' was expected",
                            world_yaml.string());
  }
  std::error_code problem;
  std::filesystem::create_directories(folder, problem);
  if (!std::filesystem::is_directory(folder, problem))
    return base::WrongInput("file.not_folder", "this is no folder, and none can be made", folder.string());
  const auto target = folder / world_yaml.filename();
  if (std::filesystem::equivalent(target, world_yaml, problem)) {
    return base::WrongInput("file.exists", "the world file itself would be overwritten; another folder was expected",
                            folder.string());
  }
  auto elevation = target;
  elevation.replace_extension(".bt");
  const auto surface = ground::SurfaceName(wanted.terrain_surface());
  std::string terrain = fmt::format("terrain:\n  surface: {}\n  file: {}\n", surface, elevation.filename().string());
  if (wanted.ground_picture() != nullptr) terrain += TextureText(*wanted.ground_picture(), world_yaml);
  const std::string text = WithTerrain(WithWholePaths(file.value().text(), file.value()), terrain);
  if (const auto copied = CopyNamed(world_yaml, folder); !copied) return copied.error();
  if (const auto written = terrain::WriteBt(elevation, *wanted.grid()); !written) return written.error();
  const auto again = World::Parse(text, target);
  if (!again)
    return base::Failed(again.error().id, fmt::format("the world built cannot be read: {}", again.error().Text()),
                        world_yaml.string());
  if (again.value()->content_hash() != wanted.content_hash()) {
    return base::Failed(
        "world.other_hash",
        "the world built is not the same world; write 'terrain:' as a block of its own at the top level",
        world_yaml.string());
  }
  if (const auto written = base::WriteWhole(target, text); !written) return written.error();
  std::string report = fmt::format("{}\n", elevation.string());
  if (!wanted.grid()->projection_wkt().empty())
    report += fmt::format("{}\n", std::filesystem::path(elevation).replace_extension(".prj").string());
  return report + fmt::format("{}\ncontent_hash: {}\n", target.string(), base::Hex(wanted.content_hash()));
}

}  // namespace rodeira::road
