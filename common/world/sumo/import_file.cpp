// SPDX-License-Identifier: Apache-2.0
#include "common/world/sumo/import_file.hpp"

#include <fmt/format.h>

#include <pugixml.hpp>
#include <set>
#include <sstream>
#include <string_view>
#include <utility>

#include "common/core/base/temporary_folder.hpp"
#include "common/world/opendrive/import.hpp"
#include "common/world/sumo/clashes.hpp"
#include "common/world/sumo/lane_joints.hpp"
#include "common/world/sumo/lane_permissions.hpp"
#include "common/world/sumo/mirror.hpp"
#include "common/world/sumo/netconvert.hpp"
#include "common/world/sumo/read_net.hpp"
#include "common/world/sumo/right_of_way_signs.hpp"
#include "common/world/sumo/road_edges.hpp"
#include "common/world/sumo/road_heights.hpp"
#include "common/world/sumo/signals.hpp"
#include "common/world/sumo/unpack.hpp"

namespace rodeira::sumo {
namespace {

// What was written into netconvert's OpenDRIVE.
struct Written {
  LightsWritten lights;
  RightOfWayWritten right_of_way;
  std::size_t denied_lanes = 0;
  std::size_t fitted_ways = 0, bent_ways = 0;
};

// netconvert writes SUMO's offset, from places on the map to the network; OpenDRIVE's goes the other way. The date
// would make two imports of one file differ.
void WriteHeader(pugi::xml_node drive, const std::string& name) {
  pugi::xml_node header = drive.child("header");
  header.remove_attribute("date");
  header.attribute("name") = name.c_str();
  pugi::xml_node offset = header.child("offset");
  for (const char* axis : {"x", "y"}) {
    if (const double value = offset.attribute(axis).as_double(); value != 0.0)
      offset.attribute(axis) = fmt::format("{}", -value).c_str();
  }
}

// netconvert goes on with the lines between lanes across junctions.
void ClearJunctions(pugi::xml_node drive) {
  for (const pugi::xml_node& road : drive.children("road")) {
    if (std::string_view(road.attribute("junction").value()) == "-1") continue;
    for (const pugi::xml_node& lane : RightLanes(road)) {
      pugi::xml_attribute type = lane.child("roadMark").attribute("type");
      if (std::string_view(type.value()) == "broken") type = "none";
    }
  }
}

std::string TextOf(const pugi::xml_document& document) {
  std::ostringstream out;
  document.save(out, " ");
  return std::move(out).str();
}

std::string Listed(const std::set<std::string>& names) {
  constexpr std::size_t kListed = 5;
  std::string list;
  std::size_t count = 0;
  for (const std::string& name : names) {
    if (++count > kListed) return list + fmt::format(" and {} more", names.size() - kListed);
    list += (list.empty() ? "'" : ", '") + name + "'";
  }
  return list;
}

void WarnOfLights(const LightsWritten& lights, const std::string& file, std::vector<std::string>& warnings) {
  const auto warn = [&](const std::set<std::string>& of, const char* sentence) {
    if (!of.empty()) warnings.push_back(fmt::format("{}: {}: {}", file, sentence, Listed(of)));
  };
  warn(lights.actuated, "green phases that SUMO extends by traffic have the lengths that the file says");
  warn(lights.held, "lights that are green and yield to a green from another side are red there");
  warn(lights.dark, "lights without a program that can be followed are dark; signs and priorities hold");
}

void WarnOfWays(const Written& written, const std::string& file, std::vector<std::string>& warnings) {
  if (written.fitted_ways > 0)
    warnings.push_back(
        fmt::format("{}: lanes have other widths behind a junction than before it ({} ways): they change "
                    "over 6 m a metre",
                    file, written.fitted_ways));
  if (written.bent_ways > 0)
    warnings.push_back(fmt::format("{}: ways over junctions with kinks are curves ({} ways)", file, written.bent_ways));
}

std::string Table(const Written& written) {
  return fmt::format(
      "lights: {} with {} controllers\nright of way: {} pairs of ways, {} signs\nlanes closed to cars: {}\n",
      written.lights.lights, written.lights.light_of.size(), written.right_of_way.pairs, written.right_of_way.signs,
      written.denied_lanes);
}

// The file with the heights of the ground, repaired where they make that necessary.
base::Result<std::string> Lifted(const network::Network& network, const std::string& drive,
                                 const ImportOptions& options) {
  const auto ground = GroundOf(options.elevation, network);
  if (!ground) return ground.error();
  const auto heights = HeightsOf(network, ground.value());
  if (!heights) return heights.error().WithContext(options.elevation.string());
  std::string text = WithHeights(drive, heights.value());
  auto import = opendrive::Read(text, options.named);
  if (!import) return import.error();
  if (!import.value().errors.empty()) return opendrive::ToError(import.value().errors.front(), options.named);
  return import.value().repaired_text.empty() ? std::move(text) : std::move(import.value().repaired_text);
}

}  // namespace

base::Result<Imported> ImportFile(const ImportOptions& options) {
  const std::string said = options.file.string();
  const auto kind = KindOf(options.file);
  if (!kind) return kind.error();
  const auto folder = base::TemporaryFolder::Make("import");
  if (!folder) return folder.error();
  const bool is_net = kind.value() == SourceKind::kNet;
  const std::filesystem::path unpacked = folder.value().path() / (is_net ? "from.net.xml" : "from.osm");
  if (auto status = Unpack(options.file, kind.value(), unpacked); !status) return status.error();
  const bool is_left_hand = is_net && MirrorLeftHandNet(unpacked);
  const auto converted = RunNetconvert(unpacked, kind.value(), folder.value().path(), said, options.stop);
  if (!converted) return converted.error();
  const auto net = ReadNet(converted.value().net);
  if (!net) return net.error();

  std::set<std::string> dark;
  // Each turn makes at least one light dark.
  for (std::size_t turn = 0; turn <= net.value().programs.size(); ++turn) {
    pugi::xml_document document;
    const pugi::xml_parse_result parsed = document.load_file(converted.value().drive.c_str());
    const pugi::xml_node drive = document.child("OpenDRIVE");
    if (!parsed || !drive) return base::Failed("sumo.netconvert_failed", "netconvert wrote no OpenDRIVE", said);
    if (!drive.child("road")) return base::WrongInput("world.no_lane", "the network has no lane for driving", said);
    const RoadEdges edges = FindEdges(net.value(), drive);
    Written written;
    WriteHeader(drive, options.named.stem().string());
    ClearJunctions(drive);
    written.bent_ways = BendKinkedWays(drive);
    written.lights = WriteLights(net.value(), edges, drive, dark);
    written.right_of_way = WriteRightOfWay(net.value(), edges, drive);
    written.denied_lanes = WritePermissions(net.value(), edges);
    WriteNames(net.value(), edges);
    written.fitted_ways = FitWidths(drive);
    if (is_left_hand) MirrorToLeftHand(drive);

    std::string text = TextOf(document);
    auto import = opendrive::Read(text, options.named);
    if (!import) return import.error();
    if (!import.value().errors.empty()) return opendrive::ToError(import.value().errors.front(), options.named);
    if (import.value().network == nullptr || opendrive::ReachOf(*import.value().network).lanes_m == 0.0)
      return base::WrongInput("world.no_lane", "the network has no lane for driving", said);
    if (options.stop && options.stop()) return base::Failed("run.interrupted", "interrupted; nothing is written", said);
    const std::set<std::string> clash = ClashingLights(*import.value().network, written.lights.light_of);
    if (!clash.empty()) {
      dark.insert(clash.begin(), clash.end());
      continue;
    }
    if (!import.value().repaired_text.empty()) text = std::move(import.value().repaired_text);
    if (!options.elevation.empty()) {
      auto lifted = Lifted(*import.value().network, text, options);
      if (!lifted) return lifted.error();
      text = std::move(lifted).value();
    }
    Imported imported;
    imported.drive = std::move(text);
    for (const opendrive::Finding& warning : opendrive::OneEachKind(import.value().warnings))
      imported.warnings.push_back(opendrive::ToError(warning, options.named).Text());
    WarnOfLights(written.lights, said, imported.warnings);
    WarnOfWays(written, said, imported.warnings);
    imported.table = opendrive::Describe(import.value()) + Table(written);
    return imported;
  }
  return base::Failed("sumo.no_lights", "the lights of the network come to no end", said);
}

}  // namespace rodeira::sumo
