// SPDX-License-Identifier: Apache-2.0
#include "common/view/scene/ground_materials/skin.hpp"

#include <algorithm>
#include <cmath>

#include "common/view/scene/breaklines/laid_lines.hpp"
#include "common/view/scene/ground_materials/colours.hpp"
#include "common/view/scene/ground_materials/lay_picture.hpp"
#include "common/world/network/network.hpp"

namespace rodeira::scene {
namespace {

using network::LaneType;

constexpr double kSame_m = 0.5;
constexpr double kSlippery = 0.5;  // coefficients of friction below it are those of ice and snow

Colour PavedColour(LaneType type, ground::Surface surface) {
  if (surface == ground::Surface::kGravel || surface == ground::Surface::kSoil) return SurfaceColour(surface);
  switch (type) {
    case LaneType::kShoulder:
    case LaneType::kStop:
    case LaneType::kBorder:
      return Colour::Of(0x6c6c6b);
    case LaneType::kSidewalk:
    case LaneType::kWalking:
      return Colour::Of(0xa7a49c);
    case LaneType::kCurb:
      return Colour::Of(0xbab7b0);
    case LaneType::kBiking:
      return Colour::Of(0x84524a);
    case LaneType::kParking:
      return Colour::Of(0x696a70);
    case LaneType::kRestricted:
    case LaneType::kRoadWorks:
      return Colour::Of(0x70706e);
    case LaneType::kTram:
    case LaneType::kRail:
      return Colour::Of(0x77706a);
    case LaneType::kBus:
    case LaneType::kTaxi:
      return Colour::Of(0x62574f);
    default:
      return SurfaceColour(surface);
  }
}

// The picture of the material in force at s, where it has one.
std::optional<terrain::LaidPicture> PictureAt(const network::Lane& lane, double s_m) {
  const network::LaneMaterial* found = nullptr;
  for (const network::LaneMaterial& material : lane.materials) {
    if (found == nullptr || material.s_m <= s_m) found = &material;
  }
  return found == nullptr ? std::nullopt : PictureOf(*found);
}

// Whether a patch lies at a place of a road.
bool IsPatched(const network::Road& road, double s_m, double t_m) {
  return std::any_of(road.spec().objects.begin(), road.spec().objects.end(), [&](const network::Object& object) {
    return IsLaid(object) && network::IsPatch(object) && std::fabs(s_m - object.s_m) <= 0.5 * object.length_m &&
           std::fabs(t_m - object.t_m) <= 0.5 * object.width_m;
  });
}

// A patch looks like what it is made of; asphalt pale where it is slippery, otherwise a little darker than the road.
void Patch(double friction, Skin& skin) {
  skin.picture.reset();
  skin.along.reset();
  if (skin.material != Material::kRoad) return;
  skin.colour = friction < kSlippery ? Mix(skin.colour, Colour::Of(0xd3dfe6), 0.8) : Shade(skin.colour, 0.8);
}

}  // namespace

Material MaterialOf(ground::Surface surface) {
  switch (surface) {
    case ground::Surface::kConcrete:
      return Material::kConcrete;
    case ground::Surface::kGravel:
      return Material::kGravel;
    case ground::Surface::kAsphalt:
    case ground::Surface::kRoadMark:
      return Material::kRoad;
    default:
      return Material::kGround;
  }
}

Skin SkinAt(const road::World& world, const Eigen::Vector2d& p_W, const road::SurfacePoint& level) {
  Skin skin;
  skin.surface = level.surface == ground::Surface::kOutside ? ground::Surface::kGrass : level.surface;
  LaneType type = LaneType::kNone;
  bool patched = false;
  if (world.network() != nullptr && level.inside) {
    thread_local std::vector<network::Surfacing> surfaces;
    world.network()->Surfaces(p_W.x(), p_W.y(), surfaces);
    for (const network::Surfacing& surfacing : surfaces) {
      const network::Lane* lane = world.network()->Find(surfacing.place.lane);
      if (lane == nullptr || lane->id == 0 || std::fabs(surfacing.sample.p_W.z() - level.z_m) > kSame_m) continue;
      patched = patched || (!world.open_drive() && IsPatched(world.network()->roads()[surfacing.place.lane.road],
                                                             surfacing.place.s_m, surfacing.place.t_m));
      if (!skin.land) continue;  // the look is the first one's; a patch may lie on any road of a junction
      skin.land = false;
      type = lane->type;
      skin.picture = PictureAt(*lane, surfacing.place.s_m);
      if (skin.picture) skin.along = AlongLane{surfacing.place.lane, surfacing.place.s_m};
    }
  }
  skin.material = MaterialOf(skin.surface);
  const bool paved = skin.material != Material::kGround;
  skin.grown = !paved;
  if (skin.land && world.ground_picture() != nullptr) skin.picture = *world.ground_picture();
  skin.colour =
      paved ? PavedColour(type, skin.surface == ground::Surface::kRoadMark ? ground::Surface::kAsphalt : skin.surface)
            : SurfaceColour(skin.surface);
  if (patched) Patch(level.friction, skin);
  return skin;
}

}  // namespace rodeira::scene
