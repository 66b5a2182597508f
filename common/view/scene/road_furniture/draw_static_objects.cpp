// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>

#include "common/core/base/random.hpp"
#include "common/core/geometry/angle.hpp"
#include "common/view/scene/road_furniture/light_heads.hpp"
#include "common/view/scene/road_furniture/models.hpp"
#include "common/view/scene/road_furniture/sign_face.hpp"
#include "common/view/scene/road_furniture/static_objects.hpp"
#include "common/view/scene/road_furniture/trees.hpp"
#include "common/view/scene/road_furniture/tubes.hpp"

namespace rodeira::scene {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kPlate_m = 0.004;   // thickness
constexpr double kThickBar_m = 0.5;  // is seen from afar
constexpr double kTwoPosts_m = 1.0;  // plates as wide as this have two

const Colour kPostSteel = Colour::Of(0x9aa0a3);

// What differs from one tree or house to the next of a row: by its place, to a millimetre.
std::uint64_t SeedAt(const Vector3d& foot_W, std::uint64_t what) {
  return base::RandomBits({static_cast<std::uint64_t>(std::llround(foot_W.x() * 1e3)),
                           static_cast<std::uint64_t>(std::llround(foot_W.y() * 1e3)), what});
}

Tree TreeOf(const Thing& thing) {
  const auto draw = [&](std::uint64_t what) { return base::RandomUniform({SeedAt(thing.stand.foot_W, what)}); };
  Tree tree;
  tree.foot_W = thing.stand.ToWorld({0.0, 0.0, thing.above_m});
  tree.height_m = thing.height_m;
  tree.crown_m = thing.radius_m;
  tree.bush = thing.kind == ThingKind::kBush;
  tree.conifer = thing.radius_m < 0.24 * thing.height_m;
  tree.leaves = Shade(Mix(Colour::Of(0x4b6330), tree.conifer ? Colour::Of(0x2f4a2e) : Colour::Of(0x74803f), draw(1)),
                      0.85 + 0.25 * draw(2));
  return tree;
}

// By what models are alike: which one, and its measures and colour.
using ModelKey = std::array<double, 6>;
enum class Model { kTree, kPost, kLamp, kPlain, kSignPost, kTrafficLight, kRailPost };

ModelKey KeyOf(Model model, const ModelSize& size, double radius_m = 0.0, Colour colour = {}) {
  return {static_cast<double>(model),
          size.length_m,
          size.width_m,
          size.height_m,
          radius_m,
          static_cast<double>(65536 * colour.red + 256 * colour.green + colour.blue)};
}

struct Drawing {
  Vector3d origin_W;
  Mesh solid;
  std::map<std::string, Mesh> faces;
  std::map<ModelKey, Repeated> repeated;

  // A model that may stand at other places too; it is made where it is the first one.
  template <class Make>
  void Repeat(const ModelKey& key, const PlacedCopy& place, Make make) {
    auto [found, fresh] = repeated.try_emplace(key);
    if (fresh) {
      found->second = make();
      found->second.origin_W = origin_W;
    }
    found->second.places.push_back(place);
  }
  template <class Make>
  void RepeatSolid(const ModelKey& key, const Stand& stand, Make make) {
    Repeat(key, {stand, 1.0, 1.0, {}}, [&] { return Repeated{make(), {}, {}, {}}; });
  }

  Mesh& Face(const std::string& name) {
    auto [found, fresh] = faces.try_emplace(name);
    if (fresh) found->second.material = Material::kSign, found->second.face = name, found->second.origin_W = origin_W;
    return found->second;
  }
};

// The plate with its picture before it: x looks to the reader, whose right hand is on the side of y.
void AddPlate(const Thing& thing, const Stand& stand, Drawing& drawing) {
  const std::vector<Vector2d> outline = PlateOutline(thing.face);
  Mesh& face = drawing.Face(thing.face);
  const auto first = static_cast<std::uint32_t>(face.positions.size());
  std::vector<Vector3d> back;
  for (const Vector2d& p : outline) {
    const Vector3d at(kPost_m + kPlate_m, (p.x() - 0.5) * thing.width_m, thing.above_m + p.y() * thing.height_m);
    face.Add(stand.ToWorld(at), stand.Turned(Vector3d::UnitX()), {});
    face.on_face.push_back(p.cast<float>());
    back.insert(back.begin(), stand.ToWorld(at - kPlate_m * Vector3d::UnitX()));
  }
  for (std::uint32_t i = 1; i + 1 < outline.size(); ++i) face.AddTriangle(first, first + i, first + i + 1);
  AddFlat(drawing.solid, back, kPostSteel);
}

void AddPosts(const Thing& thing, int level, Drawing& drawing) {
  if (!thing.on_post) return;
  const bool two = thing.kind == ThingKind::kSign && thing.width_m >= kTwoPosts_m;
  const double top_m = thing.above_m + 0.92 * thing.height_m;
  for (const double y :
       two ? std::vector<double>{-0.32 * thing.width_m, 0.32 * thing.width_m} : std::vector<double>{0.0}) {
    const Stand stand{thing.stand.ToWorld({0.0, y, 0.0}), thing.stand.x_W};
    drawing.RepeatSolid(KeyOf(Model::kSignPost, {0.0, 0.0, top_m}), stand,
                        [&] { return Pole(-0.05, top_m, kPost_m, kPost_m, level == 0 ? 6 : 3, kPostSteel); });
  }
}

void AddSign(const Thing& thing, int level, Drawing& drawing) {
  if (level > 1) return;
  AddPosts(thing, level, drawing);
  for (const double side : {1.0, -1.0}) {
    if (side < 0.0 && !thing.both_sides) break;
    if (thing.kind == ThingKind::kSign)
      AddPlate(thing, {thing.stand.foot_W, side * thing.stand.x_W}, drawing);
    else
      drawing.RepeatSolid(KeyOf(Model::kTrafficLight, {0.0, 0.0, thing.height_m}),
                          StandOfLight(thing.stand, thing.above_m, thing.height_m, side),
                          [&] { return TrafficLightModel(thing.height_m, level); });
  }
}

void AddThing(const Thing& thing, int level, Drawing& drawing) {
  const ModelSize size{thing.length_m, thing.width_m, thing.height_m};
  const Stand stand{thing.stand.ToWorld({0.0, 0.0, thing.above_m}), thing.stand.x_W};
  switch (thing.kind) {
    case ThingKind::kTree:
    case ThingKind::kBush:
      if (level < (thing.kind == ThingKind::kTree ? 3 : 2)) {
        const Tree tree = TreeOf(thing);
        drawing.Repeat(KeyOf(Model::kTree, {static_cast<double>(KindOf(tree)), 0.0, 0.0}), PlaceOf(tree),
                       [&] { return TreeModel(KindOf(tree), level); });
      }
      return;
    case ThingKind::kHouse:
      return AddPlaced(HouseModel(size, SeedAt(thing.stand.foot_W, 3), level), stand, drawing.solid);
    case ThingKind::kFillingStation:
      return AddPlaced(FillingStationModel(size, level), stand, drawing.solid);
    case ThingKind::kPost:
      return drawing.RepeatSolid(KeyOf(Model::kPost, size), stand, [&] { return PostModel(size, level); });
    case ThingKind::kLamp:
      return drawing.RepeatSolid(KeyOf(Model::kLamp, size), stand, [&] { return LampModel(size, level); });
    case ThingKind::kPlain:
      return drawing.RepeatSolid(KeyOf(Model::kPlain, size, thing.radius_m, thing.colour), stand,
                                 [&] { return PlainModel(size, thing.radius_m, thing.colour, level); });
    case ThingKind::kOutline:
      return AddOutline(drawing.solid, thing.feet_W, thing.heights_m, thing.closed, thing.colour,
                        thing.top.value_or(Shade(thing.colour, 0.85)));
    case ThingKind::kBar: {
      const std::array<BarEnd, 2> ends = {BarEnd{thing.feet_W[0], thing.heights_m[0], thing.heights_m[1]},
                                          BarEnd{thing.feet_W[1], thing.heights_m[2], thing.heights_m[3]}};
      const Vector2d left(-thing.stand.x_W.y(), thing.stand.x_W.x());
      if (level < 2 || std::max(ends[0].wide_m, ends[1].wide_m) > kThickBar_m)
        AddBar(drawing.solid, ends[0], ends[1], thing.closed, level == 0 ? 10 : 5, left, thing.colour);
      return;
    }
    case ThingKind::kSign:
    case ThingKind::kTrafficLight:
      return AddSign(thing, level, drawing);
    case ThingKind::kModel:
      return;
  }
}

// A band between two lines along a piece, from its end `0` to its end `1`; seen from the left of the piece.
void AddBand(Mesh& mesh, const RailPiece& piece, const std::array<Vector2d, 2>& low,
             const std::array<Vector2d, 2>& high, Colour colour) {
  std::array<Vector3d, 4> corners;  // each pair: (left of the line, height)
  for (std::size_t k = 0; k < 2; ++k) {
    const auto at = [&](const Vector2d& p) {
      return Vector3d(piece.foot_W[k] + Vector3d(p.x() * piece.left_W[k].x(), p.x() * piece.left_W[k].y(), p.y()));
    };
    corners[k == 0 ? 1 : 0] = at(low[k]);
    corners[k == 0 ? 2 : 3] = at(high[k]);
  }
  AddFlat(mesh, corners, colour);
}

void AddBothSides(Mesh& mesh, const RailPiece& piece, double half_low, double half_high, double low_share,
                  double high_share, Colour colour) {
  for (const double side : {1.0, -1.0}) {
    std::array<Vector2d, 2> low, high;
    for (std::size_t k = 0; k < 2; ++k) {
      low[k] = {side * half_low * piece.width_m[k], low_share * piece.height_m[k]};
      high[k] = {side * half_high * piece.width_m[k], high_share * piece.height_m[k]};
    }
    if (side > 0.0)
      AddBand(mesh, piece, low, high, colour);
    else
      AddBand(mesh, piece, high, low, colour);
  }
}

void AddRail(const RailPiece& piece, int level, Drawing& drawing) {
  if (level > 2) return;
  Mesh& mesh = drawing.solid;
  const Colour zinc = Colour::Of(0xb4b9bb), fold = Colour::Of(0x94999c);
  if (piece.wall) {
    const Colour concrete = Colour::Of(0xb0ada5);
    AddBothSides(mesh, piece, 0.5, 0.5, -0.2, 1.0, concrete);
    std::array<Vector2d, 2> right, left;
    for (std::size_t k = 0; k < 2; ++k)
      right[k] = {-0.5 * piece.width_m[k], piece.height_m[k]}, left[k] = {0.5 * piece.width_m[k], piece.height_m[k]};
    AddBand(mesh, piece, left, right, concrete);
    return;
  }
  if (level > 0) return AddBothSides(mesh, piece, 0.35, 0.35, 0.58, 1.0, zinc);
  // Two waves and the fold between them, and a post at the beginning.
  AddBothSides(mesh, piece, 0.42, 0.42, 0.58, 0.72, zinc);
  AddBothSides(mesh, piece, 0.42, 0.28, 0.72, 0.79, fold);
  AddBothSides(mesh, piece, 0.28, 0.42, 0.79, 0.86, fold);
  AddBothSides(mesh, piece, 0.42, 0.42, 0.86, 1.0, zinc);
  const double top_m = 0.95 * piece.height_m[0];
  drawing.RepeatSolid(KeyOf(Model::kRailPost, {0.0, 0.0, top_m}),
                      {piece.foot_W[0], Vector2d(piece.left_W[0].y(), -piece.left_W[0].x())}, [&] {
                        return Block({-0.04, -0.05, -0.02}, {0.04, 0.05, top_m}, fold);
                      });
}

}  // namespace

std::vector<PlacedModel> ModelsOf(const StaticObjects::Tile& tile, int level) {
  std::vector<PlacedModel> models;
  for (const Thing& thing : tile.things) {
    if (thing.kind == ThingKind::kModel && level < 3)
      models.push_back({thing.file, {thing.stand.ToWorld({0.0, 0.0, thing.above_m}), thing.stand.x_W}});
  }
  return models;
}

DrawnStaticObjects DrawStaticObjects(const StaticObjects::Tile& tile, const TileKey& key, int level) {
  const Vector2d middle = key.south_west_W() + Vector2d::Constant(0.5 * kTile_m);
  const double z = !tile.things.empty()  ? tile.things.front().stand.foot_W.z()
                   : !tile.rails.empty() ? tile.rails.front().foot_W[0].z()
                   : !tile.tubes.empty() ? tile.tubes.front().right_W[0].z()
                                         : 0.0;
  Drawing drawing;
  drawing.origin_W = drawing.solid.origin_W = OriginNear({middle.x(), middle.y(), z});
  drawing.solid.material = Material::kMatt;
  for (const Thing& thing : tile.things) AddThing(thing, level, drawing);
  for (const RailPiece& piece : tile.rails) AddRail(piece, level, drawing);
  Mesh lamps;
  lamps.material = Material::kLamp, lamps.origin_W = drawing.origin_W;
  for (const network::TubePiece& piece : tile.tubes) AddTube(piece, level, drawing.solid, lamps);
  DrawnStaticObjects drawn;
  std::vector<Repeated> few;
  for (auto& [model, repeated] : drawing.repeated) {
    if (!repeated.model.triangles.empty())
      (repeated.places.size() < kFewestPlaces ? few : drawn.repeated).push_back(std::move(repeated));
  }
  for (Mesh& mesh : Merged(few)) {
    if (mesh.material == Material::kMatt)
      drawing.solid.Append(mesh);
    else
      drawn.meshes.push_back(std::move(mesh));
  }
  if (!drawing.solid.triangles.empty()) drawn.meshes.insert(drawn.meshes.begin(), std::move(drawing.solid));
  if (!lamps.triangles.empty()) drawn.meshes.push_back(std::move(lamps));
  for (auto& [name, mesh] : drawing.faces) drawn.meshes.push_back(std::move(mesh));
  return drawn;
}

}  // namespace rodeira::scene
