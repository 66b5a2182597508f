// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "common/core/base/files.hpp"
#include "common/world/network/marking.hpp"
#include "common/world/network/placing.hpp"
#include "common/world/opendrive/import.hpp"
#include "common/world/road/network_world.hpp"
#include "common/world/road/unjoined.hpp"
#include "common/world/terrain/geographic.hpp"

namespace rodeira::road {

NetworkCheck CheckNetwork(const std::filesystem::path& file, bool strict, bool verbose, bool repair) {
  NetworkCheck check;
  const auto import = opendrive::Load(file, strict   ? opendrive::Tolerance::Strict()
                                            : repair ? opendrive::Tolerance::Usual()
                                                     : opendrive::Tolerance::Unrepaired());
  if (!import) {
    check.errors.push_back(import.error());
    return check;
  }
  for (const opendrive::Finding& error : import.value().errors) check.errors.push_back(opendrive::ToError(error, file));
  const std::vector<opendrive::Finding>& all = import.value().warnings;
  for (const opendrive::Finding& warning : verbose ? all : opendrive::OneEachKind(all))
    check.warnings.push_back(opendrive::ToError(warning, file).Text());
  check.table = opendrive::Describe(import.value());
  if (import.value().network == nullptr) return check;
  if (auto nothing = NothingToDrive(*import.value().network, file)) {
    check.errors.push_back(*std::move(nothing));
    check.table.clear();
    return check;
  }
  if (const std::string& earth = import.value().network->geo_reference(); !earth.empty()) {
    if (const auto map = terrain::Geographic::Make(earth); !map)
      check.warnings.push_back(fmt::format("{}: geoReference: {}; nothing can say where on the earth a place is",
                                           file.string(), map.error().message));
  }
  check.network = import.value().network;
  for (const OfRoad& overlap : DescribeOverlaps(*import.value().network, false))
    check.warnings.push_back(fmt::format("{}: {}", file.string(), overlap.text));
  // What else a world of the file needs: surfaces that it names, laid on its roads.
  if (const auto detail = LoadSurfaces(import.value(), file); !detail) {
    check.errors.push_back(detail.error());
    check.table.clear();
    check.network = nullptr;
  } else {
    for (const std::string& passed_over : detail.value().warnings()) check.warnings.push_back(passed_over);
    for (const std::string& wall : detail.value().Walls(*import.value().network))
      check.warnings.push_back(fmt::format("{}: {}", file.string(), wall));
  }
  return check;
}

base::Result<std::vector<std::string>> WriteRepaired(const std::filesystem::path& file,
                                                     const std::filesystem::path& out) {
  auto import = opendrive::Load(file);
  if (!import) return import.error();
  if (!import.value().errors.empty()) return opendrive::ToError(import.value().errors.front(), file);
  std::string text = std::move(import.value().repaired_text);
  if (text.empty()) {
    auto original = opendrive::LoadText(file);
    if (!original) return original.error();
    text = std::move(original).value();
  }
  if (const auto status = base::WriteWhole(out, text); !status) return status.error();
  const auto strictly = opendrive::Read(std::move(text), out, opendrive::Tolerance::Strict());
  if (!strictly) return strictly.error();
  std::vector<std::string> left;
  for (const opendrive::Finding& error : opendrive::OneEachKind(strictly.value().errors))
    left.push_back(opendrive::ToError(error, out).Text());
  return left;
}

std::string DescribeNetwork(const network::Network& network) {
  const auto [low, high] = network.Bounds();
  double length = 0.0;
  for (const network::Road& road : network.roads()) length += road.length_m();
  std::string text = fmt::format("network: {} roads, {:.3f} m, {} junctions\n", network.roads().size(), length,
                                 network.junctions().size());
  text += fmt::format("roads within_m: x {:.3f} to {:.3f}, y {:.3f} to {:.3f}\n", low.x(), high.x(), low.y(), high.y());
  if (!network.geo_reference().empty()) text += fmt::format("projection: {}\n", network.geo_reference());
  return text;
}

namespace {

constexpr double kAtEdge_m = 0.3;  // a line so near to a lane's edge is one of its borders

std::string NamesOf(const network::Network& network, std::span<const network::LaneEnd> ends) {
  std::vector<std::string> names;
  for (const network::LaneEnd& end : ends)
    names.push_back(fmt::format("{}:{}", network.roads()[end.lane.road].id(), end.lane.lane));
  return names.empty() ? "none" : fmt::format("{}", fmt::join(names, " "));
}

// What lies around a place on a lane: its edges, what is painted at them, lanes beside, ahead and behind as it is
// driven, its signs.
std::string DescribeLane(const network::Network& network, const network::Place& place) {
  const network::LaneKey& key = place.lane;
  const network::Road& road = network.roads()[key.road];
  const auto span = network.Span(key, place.s_m);
  if (!span) return "";
  const auto beside = [](const std::optional<network::LaneKey>& lane) {
    return lane ? std::to_string(lane->lane) : std::string("none");
  };
  std::string text = fmt::format("lane_width_m: {:.6f}\nlane_edges_t_m: {:.6f} {:.6f}\nlane_middle_t_m: {:.6f}\n",
                                 span->width_m(), span->inner_t_m, span->outer_t_m, span->centre_t_m());
  text += fmt::format("curvature_1pm: {:.9f}\n", road.axis().Evaluate(place.s_m).curvature_1pm);
  text += fmt::format("lane_left: {}\nlane_right: {}\n", beside(network.Left(key)), beside(network.Right(key)));
  text += fmt::format("lanes_ahead: {}\nlanes_behind: {}\n", NamesOf(network, network.Successors(key)),
                      NamesOf(network, network.Predecessors(key)));
  const double low = std::min(span->inner_t_m, span->outer_t_m) - kAtEdge_m,
               high = std::max(span->inner_t_m, span->outer_t_m) + kAtEdge_m;
  for (const network::Marking& line : network::MarkingsOf(road)) {
    if (line.from_s_m > place.s_m || line.to_s_m < place.s_m ||
        (line.painted == nullptr && line.section != key.section))
      continue;
    const double t = network::MarkingAt(road, line, place.s_m).value;
    if (t < low || t > high) continue;
    text += fmt::format(
        "line: t_m {:.6f}, {} m wide, {}, {}\n", t, line.width_m, line.colour,
        line.gap_m > 0.0 ? fmt::format("strokes of {} m, gaps of {} m", line.stroke_m, line.gap_m) : "continuous");
  }
  for (const auto& [s_m, signal] : network::SignalsFor(network, key)) {
    text += fmt::format("sign: s_m {:.3f}, {} {}{}{}\n", s_m, signal->type, signal->name,
                        signal->value ? fmt::format(" {:g}", *signal->value) : "",
                        signal->text.empty() ? "" : " '" + signal->text + "'");
  }
  return text;
}

}  // namespace

std::string DescribePlace(const network::Network& network, const std::optional<network::Place>& place) {
  if (!place) return "";
  const network::Road& road = network.roads()[place->lane.road];
  std::string text = fmt::format("road: {}\ns_m: {:.6f}\nt_m: {:.6f}\n", road.id(), place->s_m, place->t_m);
  if (place->distance_m > 0.0)
    return text + fmt::format("lane: none, {:.6f} m from lane {}\n", place->distance_m, place->lane.lane);
  const network::Lane& lane = *network.Find(place->lane);
  text += fmt::format("lane: {} ({})\n", lane.id, network::LaneTypeName(lane.type));
  if (const auto limit = road.SpeedLimitAt(lane, place->s_m))
    text += fmt::format("speed_limit_kmh: {:.1f}\n", *limit * 3.6);
  return text + DescribeLane(network, *place);
}

}  // namespace rodeira::road
