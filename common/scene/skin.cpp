#include "common/scene/skin.hpp"

#include <cmath>

#include "common/network/network.hpp"
#include "common/scene/colours.hpp"

namespace rodeira::scene {
namespace {

using network::LaneType;

constexpr double kSame_m = 0.5;

Colour PavedColour(LaneType type, terrain::Surface surface) {
  if (surface == terrain::Surface::kGravel || surface == terrain::Surface::kSoil) return SurfaceColour(surface);
  switch (type) {
    case LaneType::kShoulder:
    case LaneType::kStop:
    case LaneType::kBorder: return Colour::Of(0x6c6c6b);
    case LaneType::kSidewalk:
    case LaneType::kWalking: return Colour::Of(0xa7a49c);
    case LaneType::kCurb: return Colour::Of(0xbab7b0);
    case LaneType::kBiking: return Colour::Of(0x84524a);
    case LaneType::kParking: return Colour::Of(0x696a70);
    case LaneType::kRestricted:
    case LaneType::kRoadWorks: return Colour::Of(0x70706e);
    case LaneType::kTram:
    case LaneType::kRail: return Colour::Of(0x77706a);
    case LaneType::kBus:
    case LaneType::kTaxi: return Colour::Of(0x62574f);
    default: return SurfaceColour(surface);
  }
}

}  // namespace

Skin SkinAt(const road::World& world, const Eigen::Vector2d& p_W, const road::SurfacePoint& level) {
  Skin skin;
  skin.surface = level.surface == terrain::Surface::kOutside ? terrain::Surface::kGrass : level.surface;
  LaneType type = LaneType::kNone;
  if (world.network() != nullptr && level.inside) {
    thread_local std::vector<network::Surfacing> surfaces;
    world.network()->Surfaces(p_W.x(), p_W.y(), surfaces);
    for (const network::Surfacing& surfacing : surfaces) {
      const network::Lane* lane = world.network()->Find(surfacing.place.lane);
      if (lane == nullptr || lane->id == 0 || std::fabs(surfacing.sample.p_W.z() - level.z_m) > kSame_m) continue;
      skin.land = false;
      type = lane->type;
      break;
    }
  }
  const bool paved = skin.surface == terrain::Surface::kAsphalt || skin.surface == terrain::Surface::kConcrete ||
                     skin.surface == terrain::Surface::kGravel || skin.surface == terrain::Surface::kRoadMark;
  skin.grown = !paved;
  skin.material = paved ? Material::kRoad : Material::kGround;
  skin.colour = paved ? PavedColour(type, skin.surface == terrain::Surface::kRoadMark ? terrain::Surface::kAsphalt : skin.surface)
                      : SurfaceColour(skin.surface);
  return skin;
}

}  // namespace rodeira::scene
