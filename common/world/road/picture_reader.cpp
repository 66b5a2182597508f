// SPDX-License-Identifier: Apache-2.0
#include "common/world/road/picture_reader.hpp"

#include <filesystem>

namespace rodeira::road {
namespace {

using config::DeclaredMap;
using config::Map;
using terrain::LaidPicture;

// Once, in a rectangle: the file's keys, or else where the picture itself says that it lies. Without either it has no
// width.
void ReadRectangle(const DeclaredMap& declared, bool on_plane, const std::optional<terrain::PicturePlace>& place,
                   LaidPicture& picture) {
  const Map& map = declared.map();
  picture.repeats = false;
  picture.width_m = picture.height_m = 0.0;
  const bool said = map.Has("west_m") || map.Has("south_m") || map.Has("east_m") || map.Has("north_m");
  if (!said && !place) {
    if (on_plane)
      map.Problem("kind",
                  "a plane has no edges over which a picture could be draped; 'west_m', 'south_m', 'east_m' and "
                  "'north_m' were expected");
    return;
  }
  const auto number = [&](const char* key, double own) { return said ? declared.RequiredNumber(key) : own; };
  const terrain::PicturePlace own = place.value_or(terrain::PicturePlace());
  picture.west_m = number("west_m", own.west);
  picture.south_m = number("south_m", own.south);
  picture.width_m = number("east_m", own.east) - picture.west_m;
  picture.height_m = number("north_m", own.north) - picture.south_m;
  if (!(picture.width_m > 0.0)) map.Problem("east_m", "config.wrong_order", "'east_m' must be greater than 'west_m'");
  if (!(picture.height_m > 0.0))
    map.Problem("north_m", "config.wrong_order", "'north_m' must be greater than 'south_m'");
}

}  // namespace

std::optional<LaidPicture> ReadGroundPicture(const DeclaredMap& ground, std::vector<base::Error>& missing) {
  if (!ground.map().Has("texture")) return std::nullopt;
  const DeclaredMap declared = ground.Child("texture");
  const Map& map = declared.MapWith("file");
  LaidPicture picture;
  const std::filesystem::path file = map.Path("file");
  terrain::PictureFacts facts{1, 1, std::nullopt};
  if (!file.empty()) {
    picture.file = std::filesystem::absolute(file).string();
    auto looked = terrain::LookAtPicture(file);
    if (looked)
      facts = std::move(looked).value();
    else
      missing.push_back(looked.error().WithContext(map.Place("file")));
  }
  if (declared.Word("kind") == "draped") {
    ReadRectangle(declared, ground.map().Has("kind"), facts.place, picture);
    return picture;
  }
  picture.width_m = declared.Number("repeat_m");
  picture.height_m = picture.width_m * facts.height_px / facts.width_px;
  return picture;
}

void SpreadPicture(WorldSpec& spec) {
  if (!spec.ground_picture || spec.ground_picture->width_m > 0.0 || spec.grid == nullptr) return;
  const terrain::ElevationGrid::Frame& frame = spec.grid->frame();
  terrain::LaidPicture& picture = *spec.ground_picture;
  picture.west_m = frame.west_m, picture.south_m = frame.south_m;
  picture.width_m = frame.east_m - frame.west_m, picture.height_m = frame.north_m - frame.south_m;
}

}  // namespace rodeira::road
