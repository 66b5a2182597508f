// SPDX-License-Identifier: Apache-2.0
// What a network's signals and objects are, as things that stand.
#include <algorithm>
#include <cmath>
#include <filesystem>

#include "common/view/scene/road_furniture/sign_face.hpp"
#include "common/view/scene/road_furniture/static_objects.hpp"
#include "common/view/scene/road_markings/object_shapes.hpp"
#include "common/view/scene/road_markings/road_paint.hpp"
#include "common/world/network/network.hpp"

namespace rodeira::scene {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kHousing_m = 0.9;   // of three lights
constexpr double kOverhead_m = 3.5;  // signs this high over a lane hang
constexpr double kAhead_m = 40.0;    // over which a chevron's bend is looked for
constexpr double kFrameOver_m = 0.01;

bool OverLane(const network::Road& road, double s_m, double t_m) {
  const network::LaneSection& section = road.SectionAt(s_m);
  double outside = 0.0;
  const network::LaneSpan span = section.At(t_m, road.CentreAt(s_m), s_m, outside);
  return span.lane != nullptr && outside == 0.0 && network::IsDrivable(span.lane->type);
}

// Whether the road bends to the left of the readers of a sign at s, over what lies before them.
bool BendsLeft(const network::Road& road, const network::Placed& placed) {
  const double way = placed.signal->orientation == "-" ? -1.0 : 1.0;
  const double end = std::clamp(placed.s_m + way * kAhead_m, 0.0, road.length_m());
  double turn = 0.0;
  for (int i = 0; i <= 8; ++i)
    turn += way * road.axis().Evaluate(placed.s_m + (end - placed.s_m) * i / 8.0).curvature_1pm;
  return turn > 0.0;
}

template <class Word>
bool IsOneOf(const Word& word, std::initializer_list<Word> words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}
bool IsOneOf(std::string_view word, std::initializer_list<std::string_view> words) {
  return IsOneOf<std::string_view>(word, words);
}

Colour ObjectColour(std::string_view type) {
  if (type == "building") return Colour::Of(0xb9b2a6);
  if (IsOneOf(type, {"pole", "rail-pole", "streetLamp", "gantry"})) return Colour::Of(0x8d9396);
  if (IsOneOf(type, {"barrier", "soundBarrier", "wall"})) return Colour::Of(0xa9a69f);
  if (type == "trafficIsland") return Colour::Of(0xb4b1a9);
  if (type == "vegetation" || type == "tree") return Colour::Of(0x56703a);
  return Colour::Of(0x9d9a94);
}

// An object's name may be the absolute path of a model (world files write it so). Pictures are none.
bool IsModelFile(const std::string& name) {
  const std::filesystem::path path(name);
  const std::string ending = path.extension().string();
  return path.is_absolute() && IsOneOf(ending, {".osgb", ".osgt", ".osg", ".ive", ".obj", ".3ds", ".dae", ".stl", ".ac",
                                                ".lwo", ".flt", ".dxf"});
}

ThingKind ThingKindOf(const network::Object& object) {
  const std::string_view type = object.type, subtype = object.subtype;
  if (subtype == "bush" || type == "bush") return ThingKind::kBush;
  if (type == "tree" || subtype == "tree") return ThingKind::kTree;
  if (type == "vegetation") return IsOneOf(subtype, {"forest"}) ? ThingKind::kTree : ThingKind::kBush;
  if (subtype == "filling_station") return ThingKind::kFillingStation;
  if (subtype == "house") return ThingKind::kHouse;
  if (subtype == "lamp" || subtype == "streetLight" || type == "streetLamp") return ThingKind::kLamp;
  if (subtype == "post" || subtype == "permanentDelineator" || type == "guide-post") return ThingKind::kPost;
  return ThingKind::kPlain;
}

}  // namespace

void StaticObjects::AddSignal(const network::Road& road, const network::Placed& placed, Thing thing) {
  thing.both_sides = placed.both_sides;
  thing.on_post =
      placed.signal->board.empty() && (placed.z_offset_m < kOverhead_m || !OverLane(road, placed.s_m, placed.t_m));
  if (placed.signal->dynamic && !network::IsBoard(*placed.signal)) {
    thing.kind = ThingKind::kTrafficLight;
    thing.signal = placed.signal->id;
    if (!(thing.height_m > 0.1)) thing.height_m = kHousing_m;
    if (thing.height_m > 1.5 * kHousing_m) {  // some files count the post: its lights are at its upper end
      thing.above_m += thing.height_m - kHousing_m;
      thing.height_m = kHousing_m;
    }
    return Keep(std::move(thing));
  }
  if (IsPaint(*placed.signal) || (thing.height_m > 0.0 && thing.height_m <= kFlatSign_m)) return;  // on the road
  thing.kind = ThingKind::kSign;
  thing.face = FaceOf(*placed.signal, BendsLeft(road, placed));
  if (thing.face.empty()) return;
  const Vector2d usual = UsualPlate_m(thing.face);
  if (!(thing.width_m > 0.05)) thing.width_m = usual.x();
  if (!(thing.height_m > 0.0)) thing.height_m = usual.y();
  Keep(std::move(thing));
}

void StaticObjects::AddOutlines(const network::Road* road, const network::Placed& placed, const Thing& thing) {
  const network::Object& object = *placed.object;
  for (std::size_t i = 0; i < object.outlines.size(); ++i) {
    const network::Outline& outline = object.outlines[i];
    Thing part = thing;
    part.kind = ThingKind::kOutline;
    part.closed = outline.closed;
    part.top = FillColour(outline.fill);
    double highest = 0.0;
    std::vector<Vector2d> corners;
    for (const network::Corner& corner : outline.corners) {
      Vector3d foot = thing.stand.ToWorld({corner.first_m, corner.second_m, placed.z_offset_m + corner.dz_m});
      if (!corner.local && road != nullptr)
        foot = road->Surface(corner.first_m, corner.second_m).p_W + corner.dz_m * Vector3d::UnitZ();
      part.feet_W.push_back(foot);
      part.heights_m.push_back(corner.height_m);
      corners.emplace_back(foot.head<2>());
      highest = std::max(highest, corner.height_m);
    }
    if (highest <= kFlatThing_m) part.heights_m.assign(part.feet_W.size(), highest = placed.height_m);
    if (highest <= kFlatThing_m || part.feet_W.size() < 2) continue;
    // Frames stand a little over what they frame, or both would shine through one another.
    for (const network::ObjectBorder& border : object.borders) {
      if (border.outline != i) continue;
      for (const FramePiece& piece : FrameOf(corners, outline.closed, CornersOf(object, border), border.width_m)) {
        Thing frame = thing;
        frame.kind = ThingKind::kOutline;
        frame.top = frame.colour = BorderColour(border.type);
        for (std::size_t k = 0; k < 4; ++k) {
          const std::size_t at = k == 0 || k == 3 ? piece.from : piece.to;
          frame.feet_W.emplace_back(piece.corners[k].x(), piece.corners[k].y(), part.feet_W[at].z());
          frame.heights_m.push_back(part.heights_m[at] + kFrameOver_m);
        }
        Keep(std::move(frame));
      }
    }
    Keep(std::move(part));
  }
}

void StaticObjects::AddSkeleton(const network::Road* road, const network::Placed& placed, const Thing& thing) {
  for (const network::SkeletonLine& line : placed.object->skeleton) {
    const auto at = [&](const network::SkeletonPoint& point) -> Vector3d {
      if (point.local || road == nullptr)
        return thing.stand.ToWorld({point.first_m, point.second_m, placed.z_offset_m + point.dz_m});
      return road->Surface(point.first_m, point.second_m).p_W + point.dz_m * Vector3d::UnitZ();
    };
    for (std::size_t i = 1; i < line.size(); ++i) {
      Thing bar = thing;
      bar.kind = ThingKind::kBar;
      bar.closed = line[i].radius_m > 0.0;
      for (const network::SkeletonPoint* point : {&line[i - 1], &line[i]}) {
        bar.feet_W.push_back(at(*point));
        bar.heights_m.push_back(bar.closed ? point->radius_m : 0.5 * point->width_m);
        bar.heights_m.push_back(bar.closed ? point->radius_m : 0.5 * point->length_m);
      }
      Keep(std::move(bar));
    }
  }
}

void StaticObjects::AddObject(const network::Road* road, const network::Placed& placed, Thing thing) {
  const network::Object& object = *placed.object;
  thing.kind = ThingKindOf(object);
  thing.colour = ObjectColour(object.type);
  if (IsModelFile(object.name) && (!is_there_ || is_there_(object.name))) {
    thing.kind = ThingKind::kModel;
    thing.file = object.name;
    return Keep(std::move(thing));
  }
  if (network::IsFlat(object)) return;
  const bool skeleton =
      !object.skeleton.empty() && IsOneOf(thing.kind, {ThingKind::kPlain, ThingKind::kPost, ThingKind::kLamp});
  if (skeleton)
    AddSkeleton(road, placed, thing);
  else
    AddOutlines(road, placed, thing);
  if (skeleton || !object.outlines.empty()) return;
  const auto usual = [&](double length, double width, double height) {
    if (!(thing.height_m > kFlatThing_m)) thing.height_m = height;
    if (!(thing.width_m > 0.0)) thing.width_m = thing.radius_m > 0.0 ? 2.0 * thing.radius_m : width;
    if (!(thing.length_m > 0.0)) thing.length_m = thing.radius_m > 0.0 ? 2.0 * thing.radius_m : length;
  };
  // These turn to the road, which lies on the left of what stands to the right of it.
  const bool turned = placed.t_m > 0.0;
  switch (thing.kind) {
    case ThingKind::kTree:
      usual(0.0, 0.0, 8.0);
      break;
    case ThingKind::kBush:
      usual(0.0, 0.0, 1.5);
      break;
    case ThingKind::kHouse:
      usual(12.0, 9.0, 7.0);
      break;
    case ThingKind::kFillingStation:
      usual(24.0, 14.0, 6.0);
      break;
    case ThingKind::kPost:
      usual(0.12, 0.12, 1.0);
      break;
    case ThingKind::kLamp:
      usual(0.2, 0.2, 8.0);
      break;
    default:
      if (!(thing.height_m > kFlatThing_m) &&
          !IsOneOf(object.type, {"pole", "rail-pole", "barrier", "building", "obstacle"}))
        return;
      usual(0.12, 0.12, object.type == "building" ? 6.0 : 1.0);
      if (object.type == "pole" && !(thing.radius_m > 0.0) && placed.length_m == 0.0)
        thing.radius_m = 0.5 * thing.width_m;
      return Keep(std::move(thing));
  }
  if (!(thing.radius_m > 0.0)) thing.radius_m = 0.3 * thing.height_m;
  if (turned && thing.kind != ThingKind::kTree && thing.kind != ThingKind::kBush) thing.stand.x_W = -thing.stand.x_W;
  Keep(std::move(thing));
}

}  // namespace rodeira::scene
