// SPDX-License-Identifier: Apache-2.0
#include "common/world/road/world_reader.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "common/core/base/suggest.hpp"
#include "common/core/config/declared.hpp"
#include "common/core/config/either.hpp"
#include "common/core/geometry/angle.hpp"
#include "common/world/design/design_reader.hpp"
#include "common/world/road/hills_cache.hpp"
#include "common/world/road/named_network.hpp"
#include "common/world/road/network_world.hpp"
#include "common/world/road/picture_reader.hpp"
#include "common/world/road/road_network.hpp"
#include "common/world/road/road_reader.hpp"
#include "common/world/road/surface_detail.hpp"
#include "common/world/road/world_fit.hpp"
#include "common/world/road/world_schema.hpp"
#include "common/world/terrain/elevation_file.hpp"
#include "common/world/terrain/ground_move.hpp"
#include "common/world/terrain/nearest_ground.hpp"
#include "common/world/weather/weather_plan.hpp"

namespace rodeira::road {
namespace {

using config::List;
using config::Map;
using config::Range;

constexpr const char* kFirstVersion = "world/1";
constexpr const char* kVersion = "world/2";

// Whether the file is of the second version.
bool ReadVersion(const Map& root) {
  const std::string version = root.Text("rodeira");
  if (!version.starts_with("world/")) {
    (void)root.Choice("rodeira", {kVersion, kFirstVersion}, kVersion);
  } else if (root.Has("rodeira") && version != kVersion && version != kFirstVersion) {
    root.Problem("rodeira", "config.other_version",
                 fmt::format("'rodeira' is '{}'; a world file of this program says '{}' or '{}'", version, kVersion,
                             kFirstVersion));
  }
  return version == kVersion;
}

HillsSpec ReadHills(const config::DeclaredMap& declared) {
  const Map& map = declared.map();
  HillsSpec hills;
  hills.seed =
      static_cast<std::uint64_t>(declared.MapWith("seed").Integer("seed", 0, std::numeric_limits<std::int64_t>::max()));
  hills.columns = static_cast<int>(declared.Integer("columns"));
  hills.rows = static_cast<int>(declared.Integer("rows"));
  hills.spacing_m = declared.Number("spacing_m");
  hills.west_m = declared.Number("west_m");
  hills.south_m = declared.Number("south_m");
  if (map.Has("base_z_m")) hills.base_z_m = declared.RequiredNumber("base_z_m");
  hills.below_m = declared.Number("below_m");
  hills.flat_m = declared.Number("flat_m");
  hills.full_m = declared.Number("full_m");
  if (hills.full_m <= hills.flat_m)
    map.Problem("full_m", "config.wrong_order", "'full_m' must be greater than 'flat_m': the hills grow between them");
  hills.reach_m = declared.Number("reach_m", 3.0 * hills.full_m);
  hills.follow_structures = declared.Flag("follow_structures");
  if (hills.reach_m < hills.full_m)
    map.Problem(
        "reach_m", "config.wrong_order",
        "'reach_m' must not be less than 'full_m': up to there the hills grow with the distance from the roads");
  const config::DeclaredList relief = declared.Items("relief");
  for (std::size_t i = 0; i < relief.size(); ++i) {
    const config::DeclaredMap layer = relief.At(i);
    hills.relief.push_back({layer.Number("wavelength_m"), layer.Number("amplitude_m")});
    const double nodes = hills.columns * hills.spacing_m / hills.relief.back().wavelength_m * hills.rows *
                         hills.spacing_m / hills.relief.back().wavelength_m;
    if (nodes > 1e8)
      layer.map().Problem("wavelength_m", "config.out_of_range",
                          "the wavelength is too short for a terrain of this size");
  }
  if (map.Has("projection")) {
    auto wkt = terrain::ProjectionWkt(declared.Text("projection", ""));
    if (wkt)
      hills.projection_wkt = std::move(wkt).value();
    else
      map.Problem("projection", wkt.error().id, wkt.error().message);
  }
  return hills;
}

void ReadFriction(const config::DeclaredMap& map, WorldSpec& spec) {
  using ground::Surface;
  for (const Surface surface :
       {Surface::kAsphalt, Surface::kConcrete, Surface::kGravel, Surface::kGrass, Surface::kSoil, Surface::kRoadMark}) {
    spec.friction[static_cast<std::size_t>(surface)] = map.Number(SurfaceName(surface));
  }
}

void ReadPlane(const config::DeclaredMap& map, WorldSpec& spec) {
  (void)map.Word("kind");
  spec.plane = PlaneSpec{map.Number("z_m"), map.Number("slope_x"), map.Number("slope_y")};
  spec.terrain_surface = ReadSurface(map.MapWith("surface"), "surface", ground::Surface::kAsphalt);
  if (map.map().Has("friction")) spec.terrain_friction = map.RequiredNumber("friction");
}

// On a road: its index, lane and s, from which the rest follows once the road stands. Elsewhere: the pose itself.
void ReadStart(const Map& map, const std::vector<RoadSpec>& roads, StartPose& start) {
  for (const char* place : {"x_m", "y_m"}) {
    if (config::RejectConflictingKeys(map, "road", place) || config::RejectConflictingKeys(map, "s_m", place)) return;
  }
  const auto radians = [](double degrees) { return geometry::WrapAngle(degrees * geometry::kPi / 180.0); };
  if (!map.Has("road") && (roads.empty() || map.Has("x_m") || map.Has("y_m"))) {
    start.x_m = map.Number("x_m", {-1e8, 1e8});
    start.y_m = map.Number("y_m", {-1e8, 1e8});
    start.heading_rad = radians(map.Number("heading_deg", {-360.0, 360.0}, 0.0));
    return;
  }
  const std::string id = map.Text("road", roads.empty() ? "" : roads.front().id);
  std::vector<std::string> ids;
  for (std::size_t i = 0; i < roads.size(); ++i) {
    ids.push_back(roads[i].id);
    if (roads[i].id == id) start.road = static_cast<int>(i);
  }
  if (start.road < 0)
    return map.Problem("road", "world.unknown_road",
                       fmt::format("there is no road '{}'{}", id, base::DidYouMean(id, ids)));
  start.lane = static_cast<int>(map.Integer("lane", -20, 20, -1));
  start.s_m = map.Number("s_m", Range::NotNegative(), 0.0);
  bool known = false;
  for (const Lane& lane : roads[static_cast<std::size_t>(start.road)].section.lanes) known |= lane.id == start.lane;
  if (!known) map.Problem("lane", "world.unknown_lane", fmt::format("road '{}' has no lane {}", id, start.lane));
}

// The same of a file of version 2: what stands on a road is found with the roads.
design::StartSpec ReadStartSpec(const config::DeclaredMap& declared, StartPose& start) {
  const Map& map = declared.map();
  design::StartSpec start_spec;
  if (map.Has("x_m") || map.Has("y_m")) {
    ReadStart(map, {}, start);
    return start_spec;
  }
  start_spec.road = declared.Text("road", "");
  if (const auto lane = declared.OptionalInteger("lane")) start_spec.lane = static_cast<int>(*lane);
  if (map.Has("s_m")) start_spec.s_m = declared.RequiredNumber("s_m");
  return start_spec;
}

// All keys of the file. What needs other files or the finished roads comes afterwards.
struct Keys {
  WorldSpec spec;
  std::vector<RoadSpec> roads;  // of version 1
  std::optional<HillsSpec> hills;
  std::optional<std::filesystem::path> elevation_file, network_file;
  std::string elevation_place;  // "file:line" where it is named
  terrain::GroundMove move;     // of places of the elevation file's map, where its heights were moved
  terrain::Registration registration = terrain::Registration::kUsual;
  bool second = false;  // version 2: the roads are read by common/world/design
  design::StartSpec start;
  std::vector<base::Error> missing;
  base::FileCache* cache = nullptr;
};

Keys ReadKeys(const Map& root) {
  const config::DeclaredMap declared(root, WorldSchema().keys);
  Keys keys;
  keys.second = ReadVersion(declared.MapWith("rodeira"));
  keys.spec.name = declared.Text("name");
  (void)declared.Text("description");
  ReadFriction(declared.Child("friction"), keys.spec);
  if (root.Has("network")) keys.network_file = declared.Child("network").MapWith("file").Path("file");
  const int grounds = (root.Has("ground") ? 1 : 0) + (root.Has("terrain") ? 1 : 0) + (keys.network_file ? 1 : 0);
  if (grounds != 1) {
    root.Problem(grounds == 0        ? ""
                 : keys.network_file ? "network"
                                     : "ground",
                 "config.conflicting_keys",
                 "a world stands either on 'terrain' (an elevation file, or hills) or on 'ground' (a plane), or is the "
                 "'network' of an OpenDRIVE file");
  }
  if (root.Has("ground")) {
    ReadPlane(declared.Child("ground"), keys.spec);
    keys.spec.ground_picture = ReadGroundPicture(declared.Child("ground"), keys.missing);
  }
  const config::DeclaredMap given_terrain = declared.Child("terrain");
  const Map& terrain = given_terrain.map();
  if (root.Has("terrain")) {
    keys.spec.terrain_surface = ReadSurface(given_terrain.MapWith("surface"), "surface", ground::Surface::kGrass);
    keys.spec.ground_picture = ReadGroundPicture(given_terrain, keys.missing);
    keys.elevation_file = given_terrain.MapWith("file").OptionalPath("file");
    keys.elevation_place = terrain.Place("file");
    if (terrain.Has("registration")) {
      keys.registration = given_terrain.Word("registration", "posts") == "cells" ? terrain::Registration::kCells
                                                                                 : terrain::Registration::kPosts;
      if (!keys.elevation_file)
        terrain.Problem("registration", "config.conflicting_keys",
                        "'registration' says where the heights of a 'file' stand; there is none");
    }
    if (terrain.Has("generate")) keys.hills = ReadHills(given_terrain.Child("generate"));
    if (terrain.Has("generate") == terrain.Has("file"))
      terrain.Problem("file", "config.conflicting_keys", "'terrain' needs either 'file' or 'generate'");
  }
  if (keys.second && root.Has("weather"))
    (void)weather::ReadConstant(declared.Child("weather").map());  // a scenario's node asks for it (WeatherOf)
  if (keys.network_file && !keys.second)
    root.Problem("network", "config.missing_key", "'network' needs 'rodeira: world/2'");
  if (keys.second) {
    if (root.Has("start")) keys.start = ReadStartSpec(declared.Child("start"), keys.spec.start);
    return keys;
  }
  const List roads = root.OptionalItems("roads");
  for (std::size_t i = 0; i < roads.size(); ++i) keys.roads.push_back(ReadRoad(roads.At(i)));
  if (roads.size() > 1)
    roads.Problem(1, "a second road; version 1 has one road a world, several need 'rodeira: world/2'");
  if (root.Has("start")) ReadStart(root.Child("start"), keys.roads, keys.spec.start);
  return keys;
}

void PutStart(const Map& root, const std::vector<Road>& roads, const WorldSpec& spec, const terrain::GroundMove& move,
              StartPose& start) {
  const Map map = root.OptionalChild("start");
  if (!root.Has("start")) {  // a lane in its direction where there is one, otherwise the middle of the terrain
    if (!roads.empty()) {
      start.road = 0;
      start.lane = roads[0].lanes().front().id;
    } else if (spec.grid != nullptr) {
      start.x_m = 0.5 * (spec.grid->frame().west_m + spec.grid->frame().east_m);
      start.y_m = 0.5 * (spec.grid->frame().south_m + spec.grid->frame().north_m);
      if (const auto ground = terrain::NearestGround(*spec.grid, start.x_m, start.y_m))
        start.x_m = ground->x(), start.y_m = ground->y();
    }
  } else if (start.road < 0 && move) {
    Eigen::Vector2d at(start.x_m, start.y_m);
    move(at, start.heading_rad);
    start.x_m = at.x(), start.y_m = at.y();
  }
  if (start.road >= 0) {
    const Road& road = roads[static_cast<std::size_t>(start.road)];
    const Lane& lane = *road.section().FindLane(start.lane);
    if (start.s_m > road.length_m()) {
      map.Problem("s_m", "config.out_of_range",
                  fmt::format("'start.s_m' is {}; the road is {:.3f} m long", start.s_m, road.length_m()));
    }
    const Eigen::Vector3d p = road.Position(start.s_m, lane.centre_t_m());
    start.x_m = p.x();
    start.y_m = p.y();
    const double turned = lane.direction > 0 ? 0.0 : geometry::kPi;
    start.heading_rad = geometry::WrapAngle(road.Evaluate(start.s_m).heading_rad + turned);
  } else if (spec.grid != nullptr && !spec.grid->At(start.x_m, start.y_m).inside) {
    const auto& frame = spec.grid->frame();
    const bool in_void = start.x_m >= frame.west_m && start.x_m <= frame.east_m && start.y_m >= frame.south_m &&
                         start.y_m <= frame.north_m;
    const auto nearest = terrain::NearestGround(*spec.grid, start.x_m, start.y_m);
    map.Problem(root.Has("start") ? "x_m" : "",
                !nearest  ? std::string("the elevation file has no height that a car could stand on")
                : in_void ? fmt::format("the start ({}, {}) lies where the elevation file has no height; the nearest "
                                        "place with ground is ({:.3f}, {:.3f})",
                                        start.x_m, start.y_m, nearest->x(), nearest->y())
                          : fmt::format("the start ({}, {}) lies outside the terrain", start.x_m, start.y_m));
  }
}

// The terrain's file or hills; false, and a problem, where the file cannot be read.
bool PutTerrain(Keys& keys, std::span<const AxisPoint> axis, WorldReading& reading) {
  if (keys.elevation_file) {
    auto loaded = terrain::LoadGround(*keys.elevation_file, keys.registration);
    if (!loaded) {
      reading.problems.push_back(loaded.error().In(keys.elevation_place));
      return false;
    }
    keys.spec.grid = loaded.value().grid;
    if (const auto& origin = loaded.value().origin) {
      keys.move = terrain::MoveWith(*origin, keys.spec.grid->projection_wkt());
      reading.warnings.push_back(fmt::format(
          "{}: a metre on the ground is {:.4f} m in the map of '{}'; the heights are brought into true metres (UTM), "
          "and x and y of this world that lie among them move with them",
          keys.elevation_place, origin->units_a_m, keys.elevation_file->filename().string()));
    }
    if (const auto missing = terrain::MissingProjection(*keys.elevation_file)) {
      reading.warnings.push_back(fmt::format(
          "{}: '{}' says that its coordinates are those of '{}', which is not there: {}", keys.elevation_place,
          keys.elevation_file->filename().string(), missing->filename().string(),
          keys.spec.grid->projection_wkt().empty() ? "nothing can say where on the earth it lies"
                                                   : "they are taken for those of the UTM zone that it names"));
    }
  } else if (keys.hills) {
    keys.spec.grid = std::make_shared<const terrain::ElevationGrid>(MakeHillsOnce(*keys.hills, axis, keys.cache));
  }
  SpreadPicture(keys.spec);
  return true;
}

// Where roads may lie: on the heights of a file, or on hills, which are made when the roads are known; on a plane
// anywhere.
design::TerrainIsAt TerrainOf(const Keys& keys) {
  if (const auto grid = keys.spec.grid) return [grid](double x_m, double y_m) { return grid->At(x_m, y_m).inside; };
  if (!keys.hills) return {};
  const HillsSpec& hills = *keys.hills;
  const double west = hills.west_m, south = hills.south_m, east = west + (hills.columns - 1) * hills.spacing_m,
               north = south + (hills.rows - 1) * hills.spacing_m;
  return [=](double x_m, double y_m) { return x_m >= west && x_m <= east && y_m >= south && y_m <= north; };
}

WorldReading ReadSecond(const config::File& file, Keys keys) {
  const Map root = file.root();
  WorldReading reading;
  if (keys.elevation_file && !PutTerrain(keys, {}, reading)) return reading;
  const std::string projection = keys.hills                  ? keys.hills->projection_wkt
                                 : keys.spec.grid != nullptr ? keys.spec.grid->projection_wkt()
                                                             : "";
  design::Design design = design::ReadDesign(file, keys.spec.friction, keys.spec.name, projection, keys.start,
                                             root.OptionalChild("start"), TerrainOf(keys), keys.move);
  std::move(design.warnings.begin(), design.warnings.end(), std::back_inserter(reading.warnings));
  reading.road_places = std::move(design.road_places);
  reading.missing = std::move(keys.missing);
  std::move(design.missing.begin(), design.missing.end(), std::back_inserter(reading.missing));
  reading.problems = file.Problems();
  reading.problems.insert(reading.problems.end(), design.problems.begin(), design.problems.end());
  if (!reading.problems.empty()) return reading;
  keys.spec.network = design.network;
  keys.spec.junctions = std::move(design.junctions);
  if (!design.props.empty()) {
    keys.spec.props = std::make_shared<const network::Props>(std::move(design.props));
    // What is drawn of roads and their things is drawn of things alone, too: they stand beside no road.
    if (keys.spec.network == nullptr)
      keys.spec.network = design.network =
          std::make_shared<const network::Network>(network::NetworkSpec{keys.spec.name, projection, {}, {}, {}, {}});
  }
  if (keys.hills && !PutTerrain(keys,
                                design.network == nullptr ? std::vector<AxisPoint>()
                                                          : AxisPoints(*design.network, keys.hills->follow_structures),
                                reading))
    return reading;
  if (design.start)
    keys.spec.start = PoseOn(*design.network, {design.start->road, 0, design.start->lane}, design.start->s_m);
  else
    PutStart(root, {}, keys.spec, keys.move, keys.spec.start);
  if (design.network != nullptr) {
    auto detail = SurfaceDetail::Load(*design.network, file.path().parent_path(), design.laid);
    if (!detail) {
      reading.problems.push_back(detail.error().In(file.path().string()));
      return reading;
    }
    for (const std::string& passed_over : detail.value().warnings()) reading.warnings.push_back(passed_over);
    for (const std::string& wall : detail.value().Walls(*design.network))
      reading.warnings.push_back(fmt::format("{}: {}", file.path().string(), wall));
    keys.spec.detail = std::make_shared<const SurfaceDetail>(std::move(detail).value());
  }
  reading.problems = file.Problems();
  reading.hills = std::move(keys.hills);
  if (reading.problems.empty()) reading.spec = std::move(keys.spec);
  return reading;
}

}  // namespace

WorldReading ReadWorld(const config::File& file, base::FileCache* cache) {
  const Map root = file.root();
  if (const std::string version = root.Peek({"rodeira"}).value_or(kVersion);
      version != kVersion && version != kFirstVersion) {
    (void)ReadVersion(root);
    (void)root.Keys();  // those of another version are not known here
    WorldReading reading;
    reading.problems = file.Problems();
    return reading;
  }
  Keys keys = ReadKeys(root);
  keys.cache = cache;
  if (keys.network_file) return ReadNamedNetwork(file, *keys.network_file, std::move(keys.spec), keys.start);
  if (keys.second) return ReadSecond(file, std::move(keys));
  WorldReading reading;
  reading.missing = std::move(keys.missing);
  reading.problems = file.Problems();
  if (!reading.problems.empty()) return reading;

  if (keys.elevation_file) {
    if (!PutTerrain(keys, {}, reading)) return reading;
    if (keys.move) {
      for (RoadSpec& road : keys.roads) keys.move(road.start_W, road.heading_rad);
    }
  }
  std::vector<Road> roads;
  for (const RoadSpec& road : keys.roads) roads.emplace_back(road);
  if (keys.hills && !PutTerrain(keys, AxisPoints(roads), reading)) return reading;
  PutStart(root, roads, keys.spec, keys.move, keys.spec.start);
  for (std::size_t i = 0; i < roads.size(); ++i)
    CheckRoadFits(roads[i], keys.spec.grid.get(), root.Items("roads").At(i));
  reading.problems = file.Problems();
  reading.hills = std::move(keys.hills);
  if (!reading.problems.empty()) return reading;
  const std::string projection = keys.spec.grid != nullptr ? keys.spec.grid->projection_wkt() : "";
  keys.spec.network = AsNetwork(keys.spec.name, projection, roads, keys.spec.friction);
  reading.spec = std::move(keys.spec);
  return reading;
}

}  // namespace rodeira::road
