#include <fmt/format.h>

#include "common/opendrive/import.hpp"
#include "common/road/network_world.hpp"

namespace rodeira::road {

NetworkCheck CheckNetwork(const std::filesystem::path& file, bool strict) {
  NetworkCheck check;
  const auto import = opendrive::Load(file, strict ? opendrive::Tolerance::Strict() : opendrive::Tolerance::Usual());
  if (!import) {
    check.errors.push_back(import.error());
    return check;
  }
  for (const opendrive::Finding& error : import.value().errors) check.errors.push_back(opendrive::ToError(error, file));
  for (const opendrive::Finding& warning : import.value().warnings)
    check.warnings.push_back(opendrive::ToError(warning, file).Text());
  check.table = opendrive::Describe(import.value());
  return check;
}

std::string DescribeNetwork(const network::Network& network) {
  const auto [low, high] = network.Bounds();
  double length = 0.0;
  for (const network::Road& road : network.roads()) length += road.length_m();
  std::string text =
      fmt::format("network: {} roads, {:.3f} m, {} junctions\n", network.roads().size(), length, network.junctions().size());
  text += fmt::format("roads within_m: x {:.3f} to {:.3f}, y {:.3f} to {:.3f}\n", low.x(), high.x(), low.y(), high.y());
  if (!network.geo_reference().empty()) text += fmt::format("projection: {}\n", network.geo_reference());
  return text;
}

std::string DescribePlace(const network::Network& network, double x_m, double y_m, std::optional<double> z_m) {
  const auto place = network.Locate(x_m, y_m, z_m);
  if (!place) return "";
  const network::Road& road = network.roads()[place->lane.road];
  std::string text = fmt::format("road: {}\ns_m: {:.6f}\nt_m: {:.6f}\n", road.id(), place->s_m, place->t_m);
  if (place->distance_m > 0.0)
    return text + fmt::format("lane: none, {:.6f} m from lane {}\n", place->distance_m, place->lane.lane);
  const network::Lane& lane = *network.Find(place->lane);
  text += fmt::format("lane: {} ({})\n", lane.id, network::LaneTypeName(lane.type));
  if (const auto limit = road.SpeedLimitAt(lane, place->s_m)) text += fmt::format("speed_limit_kmh: {:.1f}\n", *limit * 3.6);
  return text;
}

}  // namespace rodeira::road
