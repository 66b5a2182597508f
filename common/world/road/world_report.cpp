// SPDX-License-Identifier: Apache-2.0
#include "common/world/road/world_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/core/config/config.hpp"
#include "common/core/geometry/angle.hpp"
#include "common/world/road/map_world.hpp"
#include "common/world/road/network_ground.hpp"
#include "common/world/road/network_world.hpp"
#include "common/world/road/passes.hpp"
#include "common/world/road/road_chains.hpp"
#include "common/world/road/start_place.hpp"
#include "common/world/road/unjoined.hpp"
#include "common/world/road/world_reader.hpp"
#include "common/world/terrain/geographic.hpp"

namespace rodeira::road {
namespace {

double Degrees(double angle_rad) { return angle_rad * 180.0 / geometry::kPi; }

// The roads of a world file, each with its parts put together again.
std::string DescribeChains(const network::Network& network) {
  std::string text =
      fmt::format("network: {} roads with {} junctions\n", ChainsOf(network).size(), network.junctions().size());
  for (const RoadChain& chain : ChainsOf(network)) {
    double sharpest = 0.0, up = 0.0, down = 0.0, lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
    for (double at = 0.0; at <= chain.length_m; at += 1.0) {
      const auto [road, s] = chain.At(network, at);
      const geometry::CubicPoint z = road->spec().elevation.Evaluate(s);
      sharpest = std::max(sharpest, std::fabs(road->axis().Evaluate(s).curvature_1pm));
      up = std::max(up, z.slope), down = std::min(down, z.slope);
      lowest = std::min(lowest, z.value), highest = std::max(highest, z.value);
    }
    const auto junctions = std::count_if(chain.parts.begin(), chain.parts.end(), [&](const RoadChain::Part& part) {
      return !network.roads()[part.road].spec().junction.empty();
    });
    text += fmt::format("road {}\n  length_m: {:.3f}\n  passes junctions: {}\n", chain.name, chain.length_m, junctions);
    if (sharpest > 1e-9) text += fmt::format("  smallest_radius_m: {:.6g}\n", 1.0 / sharpest);
    text += fmt::format("  heights_m: {:.2f} to {:.2f}\n  grades: {:.2f} % to {:.2f} %\n", lowest, highest,
                        100.0 * down, 100.0 * up);
  }
  return text;
}

// What the world says about where it lies on the earth; empty: nothing.
std::string ProjectionOf(const World& world) {
  if (world.grid() != nullptr && !world.grid()->projection_wkt().empty()) return world.grid()->projection_wkt();
  return world.network() != nullptr ? world.network()->geo_reference() : "";
}

// Only an OpenDRIVE file has one.
network::GeoOffset OffsetOf(const World& world) {
  return world.open_drive() ? world.network()->geo_offset() : network::GeoOffset();
}

std::string DescribeEarth(const World& world, double x_m, double y_m) {
  const std::string projection = ProjectionOf(world);
  if (projection.empty()) return "";
  const auto map = terrain::Geographic::Make(projection);
  if (!map) return "";
  const Eigen::Vector2d on_map = OffsetOf(world).ToMap({x_m, y_m});
  const auto place = map.value().ToEarth(on_map.x(), on_map.y());
  return place ? fmt::format("longitude_deg: {:.9f}\nlatitude_deg: {:.9f}\n", place->longitude_deg, place->latitude_deg)
               : "";
}

// The place that SUELO's answer is of; between the roads of a junction and on a world's own ground, the nearest to it.
std::optional<network::Place> AnsweredFrom(const World& world, double x_m, double y_m, std::optional<double> z_hint_m) {
  std::optional<network::Place> place;
  if (world.open_drive())
    place = NetworkPlace(*world.network(), *world.land(), x_m, y_m,
                         z_hint_m.value_or(std::numeric_limits<double>::quiet_NaN()));
  return place ? place : world.network()->Locate(x_m, y_m, z_hint_m);
}

}  // namespace

std::vector<std::string> WorldWarnings(const std::filesystem::path& world_yaml) {
  if (IsOpenDrive(world_yaml)) return CheckNetwork(world_yaml, false).warnings;
  if (IsTrafficMap(world_yaml)) return {};
  const auto file = config::File::Load(world_yaml);
  if (!file) return {};
  WorldReading reading = ReadWorld(file.value());
  if (const std::filesystem::path named = OpenDriveOf(world_yaml); !named.empty()) {
    for (std::string& warning : CheckNetwork(named, false).warnings) reading.warnings.push_back(std::move(warning));
  } else if (reading.spec && reading.spec->network != nullptr) {
    const WorldSpec& spec = *reading.spec;
    const BareTerrain terrain{spec.grid, spec.plane};
    for (const auto& said : {DescribeOverlaps(*spec.network, true), DescribePasses(*spec.network, terrain)}) {
      for (const OfRoad& sentence : said) {
        reading.warnings.push_back(fmt::format(
            "{}: {}",
            sentence.road < reading.road_places.size() ? reading.road_places[sentence.road] : world_yaml.string(),
            sentence.text));
      }
    }
  }
  if (reading.spec && reading.spec->network != nullptr && file.value().root().OptionalChild("start").Has("x_m")) {
    const StartPose& start = reading.spec->start;
    if (const std::string beside = StartBesideRoads(*reading.spec->network, start.x_m, start.y_m); !beside.empty())
      reading.warnings.push_back(fmt::format("{}: {}", file.value().root().Place("start"), beside));
  }
  return std::move(reading.warnings);
}

std::vector<base::Error> WorldProblems(const std::filesystem::path& world_yaml) {
  if (const auto other = WhatWorldsName(world_yaml)) return {*other};
  if (IsOpenDrive(world_yaml)) return CheckNetwork(world_yaml, false).errors;
  if (IsTrafficMap(world_yaml)) {
    const auto spec = ReadMapWorld(world_yaml);
    return spec ? std::vector<base::Error>() : std::vector{spec.error()};
  }
  const auto file = config::File::Load(world_yaml);
  if (!file) return {file.error()};
  WorldReading reading = ReadWorld(file.value());
  std::move(reading.missing.begin(), reading.missing.end(), std::back_inserter(reading.problems));
  return std::move(reading.problems);
}

std::string DescribeWorld(const World& world) {
  std::string text = fmt::format("world {}\ncontent_hash: {}\n", world.name(), base::Hex(world.content_hash()));
  if (const terrain::ElevationGrid* grid = world.grid()) {
    float low = std::numeric_limits<float>::max(), high = std::numeric_limits<float>::lowest();
    std::size_t voids = 0;
    for (const float height : grid->heights_m()) {
      if (height == terrain::ElevationGrid::kVoid)
        ++voids;
      else
        low = std::min(low, height), high = std::max(high, height);
    }
    const terrain::ElevationGrid::Frame& frame = grid->frame();
    text += fmt::format("terrain: {} x {} heights every {:.6g} m x {:.6g} m, {:.2f} m to {:.2f} m, {} void\n",
                        frame.columns, frame.rows, grid->spacing_x_m(), grid->spacing_y_m(), low, high, voids);
    text += fmt::format("extents_m: x {:.3f} to {:.3f}, y {:.3f} to {:.3f}\n", frame.west_m, frame.east_m,
                        frame.south_m, frame.north_m);
    const std::string& wkt = grid->projection_wkt();
    text += fmt::format("projection: {}\n", wkt.empty() ? "none" : wkt.substr(0, 70) + (wkt.size() > 70 ? "…" : ""));
  } else if (world.open_drive()) {
    text += DescribeNetwork(*world.network());
  } else {
    text += fmt::format("ground: a plane, z_m = {} + {} x + {} y\n", world.plane()->z_m, world.plane()->slope_x,
                        world.plane()->slope_y);
  }
  if (world.network() != nullptr && !world.open_drive()) text += DescribeChains(*world.network());
  const StartPose& start = world.start();
  text += fmt::format("start: x_m {:.3f}, y_m {:.3f}, heading {:.2f} degrees", start.x_m, start.y_m,
                      Degrees(start.heading_rad));
  if (start.road >= 0) {
    text += fmt::format(" (road {}, lane {}, s_m {:.3f})",
                        world.network()->roads()[static_cast<std::size_t>(start.road)].id(), start.lane, start.s_m);
  }
  return text + "\n";
}

std::string DescribePoint(const World& world, double x_m, double y_m, std::optional<double> z_hint_m) {
  const ground::GroundPoint at =
      world.MakeGround()->At(x_m, y_m, z_hint_m.value_or(std::numeric_limits<double>::quiet_NaN()));
  std::string text = fmt::format("x_m: {}\ny_m: {}\n", x_m, y_m) + DescribeEarth(world, x_m, y_m);
  if (!at.inside) {
    const Extents extents = world.extents();
    return text + fmt::format("inside: false\nextents_m: x {:.3f} to {:.3f}, y {:.3f} to {:.3f}\n", extents.west_m,
                              extents.east_m, extents.south_m, extents.north_m);
  }
  const Eigen::Vector3d normal = at.normal_W + Eigen::Vector3d::Zero();  // -0 is 0
  text += fmt::format("inside: true\nz_m: {:.7f}\nnormal: [{:.9f}, {:.9f}, {:.9f}]\nfriction: {}\nsurface: {}\n",
                      at.z_m, normal.x(), normal.y(), normal.z(), at.friction, SurfaceName(at.surface));
  if (world.network() != nullptr) text += DescribePlace(*world.network(), AnsweredFrom(world, x_m, y_m, z_hint_m));
  return text;
}

base::Result<Eigen::Vector2d> PlaceOnMap(const World& world, double longitude_deg, double latitude_deg) {
  const std::string projection = ProjectionOf(world);
  if (projection.empty())
    return base::WrongInput("world.no_projection",
                            "the world has no position on the earth: its terrain has no projection, its roads have no "
                            "geoReference",
                            world.name());
  const auto map = terrain::Geographic::Make(projection);
  if (!map) return map.error();
  const auto place = map.value().ToMap({longitude_deg, latitude_deg});
  if (!place)
    return base::WrongInput(
        "world.off_the_projection",
        fmt::format("longitude {} and latitude {} are no place of the world's projection", longitude_deg, latitude_deg),
        world.name());
  return OffsetOf(world).FromMap(*place);
}

}  // namespace rodeira::road
