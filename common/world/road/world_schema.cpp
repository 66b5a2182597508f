// SPDX-License-Identifier: Apache-2.0
#include "common/world/road/world_schema.hpp"

#include <utility>

#include "common/world/design/design_schema.hpp"
#include "common/world/road/hills.hpp"
#include "common/world/road/world_spec.hpp"
#include "common/world/weather/weather_schema.hpp"

namespace rodeira::road {
namespace {

using config::ComputedNumberKey;
using config::Key;
using config::MappingKey;
using config::NumberKey;
using config::OptionalNumberKey;
using config::Range;
using config::Required;
using config::RequiredNumberKey;
using config::WithDefaultNote;

constexpr Range kPlace_m{-1e8, 1e8}, kHeight_m{-12'000.0, 12'000.0}, kFriction{0.01, 2.0};

Key SurfaceKey(const char* usual) {
  return config::WordKey("surface", {"asphalt", "concrete", "gravel", "grass", "soil"}, usual, "Surface.");
}

// Up to the largest whole number, which is no double.
Key SeedKey() {
  Key key = config::RequiredIntegerKey("seed", 0, 1, "The same seed gives the same hills.");
  key.range.high = Range{}.high;
  return key;
}

Key PictureKey() { return MappingKey("texture", GroundPictureKeys(), "Picture on the ground."); }

std::vector<Key> FrictionKeys() {
  using ground::Surface;
  const WorldSpec usual;
  std::vector<Key> keys;
  for (const Surface surface :
       {Surface::kAsphalt, Surface::kConcrete, Surface::kGravel, Surface::kGrass, Surface::kSoil, Surface::kRoadMark})
    keys.push_back(NumberKey(std::string(SurfaceName(surface)), kFriction,
                             usual.friction[static_cast<std::size_t>(surface)], "Coefficient of friction."));
  return keys;
}

std::vector<Key> StartKeys() {
  return {config::ComputedTextKey("road", "the first", "", "Road."),
          WithDefaultNote("the first driven", config::OptionalIntegerKey("lane", -30, 30, "Lane.")),
          ComputedNumberKey("s_m", Range::NotNegative(), "10, at most half of the road", "Station."),
          ComputedNumberKey("x_m", kPlace_m, "with `y_m` instead of `road`", "Place to the east."),
          ComputedNumberKey("y_m", kPlace_m, "with `x_m` instead of `road`", "Place to the north."),
          NumberKey("heading_deg", {-360.0, 360.0}, 0.0, "Heading at this place, from east to north.")};
}

config::Schema MakeWorldSchema() {
  std::vector<Key> keys{
      config::RequiredTextKey("name", "w", "Name, for the reader."),
      config::TextKey("description", "", "Description, for the reader."),
      MappingKey("friction", FrictionKeys(), "Friction of the surfaces."),
      MappingKey("terrain", TerrainKeys(), "Elevation file or hills; one of `terrain`, `ground`, `network`."),
      MappingKey("ground", PlaneKeys(), "A plane without end."),
      MappingKey("network", {config::RequiredTextKey("file", "street.xodr", "OpenDRIVE file.")},
                 "Roads of an OpenDRIVE file."),
      MappingKey("start", StartKeys(), "Where vehicles start."),
      config::Summarised("as in scenario files",
                         MappingKey("weather", weather::ConstantWeatherKeys(), "Weather of runs on this world."))};
  keys.insert(keys.end(), design::DesignKeys().begin(), design::DesignKeys().end());
  return {"world", "world/2", "A world: ground, roads, objects, weather.",
          config::FileKeys("world/2", std::move(keys))};
}

}  // namespace

const std::vector<Key>& PlaneKeys() {
  static const std::vector<Key> keys{
      Required(config::WordKey("kind", {"plane"}, "plane", "Kind of ground.")),
      NumberKey("z_m", kHeight_m, 0.0, "Height at the origin."),
      NumberKey("slope_x", {-1.0, 1.0}, 0.0, "Rise a metre to the east."),
      NumberKey("slope_y", {-1.0, 1.0}, 0.0, "Rise a metre to the north."),
      SurfaceKey("asphalt"),
      ComputedNumberKey("friction", kFriction, "that of the surface", "Coefficient of friction."),
      PictureKey()};
  return keys;
}

const std::vector<Key>& TerrainKeys() {
  static const std::vector<Key> keys{
      config::ComputedTextKey("file", "or `generate`", "heights.asc", "Elevation file."),
      WithDefaultNote("that of the format", config::OptionalWordKey("registration", {"posts", "cells"},
                                                                    "Where the heights of the file stand.")),
      SurfaceKey("grass"), PictureKey(), MappingKey("generate", HillsKeys(), "Hills from a seed.")};
  return keys;
}

const std::vector<Key>& HillsKeys() {
  using config::RequiredIntegerKey;
  using config::WithSample;
  static const std::vector<Key> keys{
      SeedKey(),
      WithSample("9", RequiredIntegerKey("columns", 2, 8193, "Heights from west to east.")),
      WithSample("9", RequiredIntegerKey("rows", 2, 8193, "Heights from south to north.")),
      WithSample("50", RequiredNumberKey("spacing_m", {0.1, 1000.0}, "Distance of two heights.")),
      WithSample("-200", RequiredNumberKey("west_m", kPlace_m, "Western edge.")),
      WithSample("-200", RequiredNumberKey("south_m", kPlace_m, "Southern edge.")),
      ComputedNumberKey("base_z_m", kHeight_m, "mean of the axes, rounded to 10 m", "Height far from roads."),
      NumberKey("below_m", {-50.0, 50.0}, 0.0, "Terrain below the axis of a road."),
      NumberKey("flat_m", {0.1, 10'000.0}, 15.0, "Up to here from an axis the terrain is level with the road."),
      NumberKey("full_m", {0.2, 100'000.0}, 200.0, "From here on the hills have full height; over `flat_m`."),
      ComputedNumberKey("reach_m", {0.2, 1e6}, "three times `full_m`", "From here on a road changes no bit."),
      config::FlagKey("follow_structures", true, "Hills follow bridges and tunnels, too."),
      Required(config::ListKey(
          "relief",
          {WithSample("100", RequiredNumberKey("wavelength_m", {1.0, 1e6}, "Lattice of a layer of gradient noise.")),
           RequiredNumberKey("amplitude_m", {0.0, 10'000.0}, "Height of the layer.")},
          "Layers of hills.")),
      config::ComputedTextKey("projection", "none", "", "EPSG code, PROJ string or WKT.")};
  return keys;
}

const std::vector<Key>& GroundPictureKeys() {
  const auto edge = [](std::string name, std::string meaning) {
    return ComputedNumberKey(std::move(name), kPlace_m, "with `draped`: own place of the file", std::move(meaning));
  };
  static const std::vector<Key> keys{
      config::RequiredTextKey("file", "fields.png", "JPEG, PNG, BMP or TIFF."),
      config::WordKey("kind", {"geotypical", "draped"}, "geotypical", "Repeated, or laid once between the edges."),
      NumberKey("repeat_m", {0.01, 100'000.0}, 20.0, "Width of a repeated picture."),
      edge("west_m", "Western edge."),
      edge("south_m", "Southern edge."),
      edge("east_m", "Eastern edge."),
      edge("north_m", "Northern edge.")};
  return keys;
}

const config::Schema& WorldSchema() {
  static const config::Schema schema = MakeWorldSchema();
  return schema;
}

}  // namespace rodeira::road
