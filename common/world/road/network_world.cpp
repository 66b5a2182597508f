// SPDX-License-Identifier: Apache-2.0
#include "common/world/road/network_world.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "common/core/config/config.hpp"
#include "common/core/geometry/angle.hpp"
#include "common/world/network/placing.hpp"

namespace rodeira::road {
namespace {

constexpr double kFromStart_m = 10.0;
constexpr double kNarrowest_m = 2.0;

// Where on a lane the car starts.
double StationIn(const network::Network& network, const network::LaneKey& key) {
  const network::LaneSection& section = network.Section(key);
  const double into = std::min(kFromStart_m, 0.5 * (section.end_s_m - section.s_m));
  return network.Find(key)->direction < 0 ? section.end_s_m - into : section.s_m + into;
}

// What pieces of a road that are made of something else say of their friction, by road: in the rectangle of s and t
// about each.
std::vector<network::Laid> PatchesOf(const network::Network& network) {
  std::vector<network::Laid> laid(network.roads().size());
  bool any = false;
  for (const network::Placed& placed : network::PlaceFurniture(network).things) {
    if (placed.object == nullptr || !network::IsPatch(*placed.object) || !placed.object->material.friction) continue;
    network::LaidPiece piece{placed.s_m - 0.5 * placed.length_m, placed.s_m + 0.5 * placed.length_m,
                             placed.t_m - 0.5 * placed.width_m, placed.t_m + 0.5 * placed.width_m};
    if (!placed.object->outlines.empty() && !placed.object->outlines.front().corners.empty()) {
      const double turn = placed.heading_rad - network.roads()[placed.road].axis().Evaluate(placed.s_m).heading_rad;
      piece = {std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
               std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
      for (const network::Corner& corner : placed.object->outlines.front().corners) {
        const double s = corner.local ? placed.s_m + std::cos(turn) * corner.first_m - std::sin(turn) * corner.second_m
                                      : corner.first_m;
        const double t = corner.local ? placed.t_m + std::sin(turn) * corner.first_m + std::cos(turn) * corner.second_m
                                      : corner.second_m;
        piece = {std::min(piece.from_s_m, s), std::max(piece.to_s_m, s), std::min(piece.right_t_m, t),
                 std::max(piece.left_t_m, t)};
      }
    }
    if (!(piece.to_s_m > piece.from_s_m && piece.left_t_m > piece.right_t_m)) continue;
    laid[placed.road].patches.push_back({piece, placed.object->material.surface, *placed.object->material.friction});
    any = true;
  }
  if (!any) laid.clear();
  return laid;
}

}  // namespace

StartPose StartOn(const network::Network& network) {
  const network::LaneKey* longest = nullptr;
  double length = 0.0;
  bool goes_on = false;
  const auto lanes = network.Lanes();
  for (const network::LaneKey& key : lanes) {
    const network::LaneSection& section = network.Section(key);
    if (!network::IsDrivable(network.Find(key)->type) || !network::OpenToCars(*network.Find(key)) ||
        !network.roads()[key.road].spec().junction.empty())
      continue;
    const auto span = network.Span(key, StationIn(network, key));
    if (span->width_m() < kNarrowest_m) continue;
    const bool leads_on = !network.Successors(key).empty();
    if (leads_on < goes_on || (leads_on == goes_on && section.end_s_m - section.s_m <= length)) continue;
    length = section.end_s_m - section.s_m, longest = &key, goes_on = leads_on;
  }
  if (longest == nullptr) return {};
  StartPose start = PoseOn(network, *longest, StationIn(network, *longest));
  start.road = -1;  // none was named
  return start;
}

StartPose PoseOn(const network::Network& network, const network::LaneKey& key, double s_m) {
  const Eigen::Vector3d p = network.Centre(key, s_m);
  const double turned = network.Find(key)->direction < 0 ? geometry::kPi : 0.0;
  StartPose start;
  start.road = static_cast<int>(key.road);
  start.lane = key.lane;
  start.s_m = s_m;
  start.x_m = p.x();
  start.y_m = p.y();
  start.heading_rad = geometry::WrapAngle(network.roads()[key.road].axis().Evaluate(s_m).heading_rad + turned);
  return start;
}

namespace {

std::string ExtensionOf(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return c >= 'A' && c <= 'Z' ? c + 32 : c; });
  return extension;
}

}  // namespace

bool IsOpenDrive(const std::filesystem::path& file) {
  const std::string extension = ExtensionOf(file);
  if (extension == ".gz") return ExtensionOf(file.stem()) == ".xodr" || ExtensionOf(file.stem()) == ".xml";
  return extension == ".xodr" || extension == ".xodrz" || extension == ".xml" || extension == ".zip";
}

std::optional<base::Error> WhatWorldsName(const std::filesystem::path& file) {
  const std::string extension = ExtensionOf(ExtensionOf(file) == ".gz" ? file.stem() : file);
  const char* what =
      extension == ".bt" || extension == ".tif" || extension == ".tiff" || extension == ".asc" || extension == ".hgt"
          ? "an elevation file, which a world file names as 'terrain: {file: …}'"
      : extension == ".crg" ? "a measured surface, which a road of a world file names in its 'surfaces: [{crg: …}]'"
      : extension == ".csv" ? "a table of points, which a road of a world file names as 'points: {file: …}'"
                            : nullptr;
  if (what == nullptr) return std::nullopt;
  return base::WrongInput("world.unknown_kind",
                          fmt::format("by its name this is {}; a world (.yaml, .xodr or .motors) was expected", what),
                          file.string());
}

std::filesystem::path OpenDriveOf(const std::filesystem::path& world_file) {
  if (IsOpenDrive(world_file)) return world_file;
  const auto file = config::File::Load(world_file);
  if (!file || !file.value().root().Has("network")) return {};
  return file.value().root().Child("network").Path("file");
}

base::Result<SurfaceDetail> LoadSurfaces(const opendrive::Import& import, const std::filesystem::path& file) {
  SurfaceDetail::FileOf file_of;
  if (import.surface_files != nullptr)
    file_of = [&import](const std::string& name) { return import.surface_files->Read(name); };
  return SurfaceDetail::Load(*import.network, file.parent_path(), PatchesOf(*import.network), file_of);
}

std::optional<base::Error> NothingToDrive(const network::Network& network, const std::filesystem::path& file) {
  std::set<std::string> types;
  for (const network::LaneKey& key : network.Lanes()) {
    const network::LaneType type = network.Find(key)->type;
    if (network::IsDrivable(type)) return std::nullopt;
    types.emplace(network::LaneTypeName(type));
  }
  return base::WrongInput(
      "world.no_lane",
      fmt::format("the network has no lane for driving: its lanes are of the types {}; driving was expected",
                  types.empty() ? "(none)" : fmt::format("{}", fmt::join(types, ", "))),
      file.string());
}

std::vector<std::string> RepairSentences(const opendrive::Import& import, const std::filesystem::path& file) {
  std::vector<opendrive::Finding> findings;
  for (const opendrive::Finding& warning : import.warnings) {
    if (warning.repair.kind != opendrive::RepairKind::kNone || warning.rule == opendrive::kDeadEndRule)
      findings.push_back(warning);
  }
  std::vector<std::string> sentences;
  for (const opendrive::Finding& finding : opendrive::OneEachKind(findings))
    sentences.push_back(opendrive::ToError(finding, file).Text());
  return sentences;
}

base::Result<WorldSpec> ReadNetworkWorld(const std::filesystem::path& file) {
  auto import = opendrive::Load(file);
  if (!import) return import.error();
  if (!import.value().errors.empty()) return opendrive::ToError(import.value().errors.front(), file);
  if (auto nothing = NothingToDrive(*import.value().network, file)) return *std::move(nothing);
  WorldSpec spec;
  spec.name = file.stem().string();
  spec.network = import.value().network;
  spec.network_hash = import.value().content_hash;
  spec.start = StartOn(*spec.network);
  spec.warnings = RepairSentences(import.value(), file);
  auto detail = LoadSurfaces(import.value(), file);
  if (!detail) return detail.error();
  if (!detail.value().empty()) spec.detail = std::make_shared<const SurfaceDetail>(std::move(detail).value());
  return spec;
}

}  // namespace rodeira::road
