// SPDX-License-Identifier: Apache-2.0
#include "common/world/design/laid_schema.hpp"

#include <string>
#include <utility>

#include "common/world/design/common_keys.hpp"

namespace rodeira::design {
namespace {

using config::ComputedNumberKey;
using config::Key;
using config::NumberKey;
using config::WithDefaultNote;
using config::WithSample;

Key BeginKey() { return WithSample("10", StationKey("from_s_m", "Begins here.")); }
Key EndKey() { return WithSample("20", StationKey("to_s_m", "Ends here.")); }

// Up to the largest whole number, which is no double.
Key SeedKey() {
  Key key = config::IntegerKey("seed", 0, 1, 0, "The same seed gives the same roughness.");
  key.range.high = config::Range{}.high;
  return key;
}

// A piece of the road, and more.
std::vector<Key> PieceKeys(std::vector<Key> more) {
  std::vector<Key> keys{
      BeginKey(), EndKey(),
      ComputedNumberKey("from_t_m", {-200.0, 200.0}, "edge of the drivable lanes", "Right edge; t grows to the left."),
      ComputedNumberKey("to_t_m", {-200.0, 200.0}, "edge of the drivable lanes", "Left edge; above `from_t_m`.")};
  for (Key& key : more) keys.push_back(std::move(key));
  return keys;
}

}  // namespace

const std::vector<Key>& StructureKeys() {
  static const std::vector<Key> keys{BeginKey(), EndKey(), config::TextKey("name", "", "Name.")};
  return keys;
}

const std::vector<Key>& SurfaceKeys() {
  static const std::vector<Key> keys{
      FromKey(),
      ToKey(),
      WithDefaultNote("or `crg`", config::OptionalWordKey("iso_8608", {"A", "B", "C", "D", "E", "F", "G", "H"},
                                                          "Class of made roughness.")),
      SeedKey(),
      config::ComputedTextKey("crg", "or `iso_8608`", "bumps.crg", "File of a measured surface."),
      config::WordKey("orientation", {"same", "opposite"}, "same", "Direction of the file along the road."),
      NumberKey("s_offset_m", {-1e6, 1e6}, 0.0, "Station of the file at the beginning."),
      NumberKey("t_offset_m", {-100.0, 100.0}, 0.0, "Moved to the left."),
      NumberKey("z_offset_m", {-10.0, 10.0}, 0.0, "Added to the heights."),
      NumberKey("z_scale", {-100.0, 100.0}, 1.0, "Factor of the heights.")};
  return keys;
}

const std::vector<Key>& PatchKeys() {
  static const std::vector<Key> keys =
      PieceKeys({MaterialKey("that of the road"),
                 ComputedNumberKey("friction", kFriction, "that of `material`", "Coefficient of friction.")});
  return keys;
}

const std::vector<Key>& BumpKeys() {
  static const std::vector<Key> keys = PieceKeys(
      {ComputedNumberKey("height_m", {-1.0, 1.0}, "or `heights`", "Height in the middle; a hollow is negative."),
       WithDefaultNote("or `height_m`", config::Counted(2, kAnyNumber,
                                                        PointsKey("heights", "z_m", {-1.0, 1.0},
                                                                  "Height over the road, 0 at both ends."))),
       WithDefaultNote(
           "round; straight with `heights`",
           config::OptionalWordKey("shape", {"round", "straight", "smooth"}, "Parabola, straight, or 3u² − 2u³.")),
       NumberKey("side_m", {0.01, 50.0}, 0.3, "Width over which it fades at both sides.")});
  return keys;
}

}  // namespace rodeira::design
