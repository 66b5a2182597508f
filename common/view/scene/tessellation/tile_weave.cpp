// SPDX-License-Identifier: Apache-2.0
#include "common/view/scene/tessellation/tile_weave.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "common/view/scene/ground_materials/colours.hpp"
#include "common/view/scene/ground_materials/lay_picture.hpp"
#include "common/view/scene/tessellation/levels_at.hpp"
#include "common/view/scene/tessellation/tile_heights.hpp"

namespace rodeira::scene {
namespace {

using tessellation::Triangulation;

constexpr double kApron_m = 0.9;     // of a bridge's side, and as deep its underside lies
constexpr double kMaxKerb_m = 0.35;  // lower steps are stone, higher ones earth
constexpr std::size_t kNoFace = 99;
// A picture's samples may lie outside the triangle that they take the light of: thinner than a pixel, it would be lit
// as the ground at the far end of a change that goes on and on. Where normals change by more than this a metre a
// triangle has one normal: its own, or where it is too thin to have a good one, the mean.
constexpr double kBend_1pm = 0.6;
constexpr double kThin_m = 0.05;  // ten times what heights may be off

class Weaver {
 public:
  Weaver(const road::World& world, const TilePlan& plan)
      : world_(world),
        plan_(plan),
        heights_(world, plan),
        first_(plan.triangles.points().size(), Triangulation::kNone) {
    const Face& first = plan.faces.front();
    origin_W_ = TileOrigin(plan.key, first.levels.empty() ? 0.0 : first.levels.front().z_m);
    wall_.material = Material::kRoad;
    wall_.origin_W = origin_W_;
  }

  WovenTile Weave() {
    const auto triangles = plan_.triangles.triangles();
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
      const Face& face = plan_.faces[plan_.face_of[i]];
      for (std::size_t level = 0; level < face.levels.size(); ++level) {
        Ground(i, level);
        if (HasUnderside(face, level)) Underside(i, level);
      }
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t beyond = triangles[i].across[k];
        if (beyond != Triangulation::kNone && plan_.face_of[beyond] != plan_.face_of[i]) Steps(i, k, beyond);
      }
    }
    for (auto& [kind, made] : meshes_) {
      if (made.mesh.triangles.empty()) continue;
      if (made.picture != nullptr && made.mesh.on_face.empty()) LayPicture(*made.picture, made.mesh);
      woven_.meshes.push_back(std::move(made.mesh));
    }
    if (!wall_.triangles.empty()) woven_.meshes.push_back(std::move(wall_));
    return std::move(woven_);
  }

 private:
  Eigen::Vector3d Place(std::uint32_t point, double z_m) const {
    const Eigen::Vector2d p = ToWorld(plan_.key, plan_.triangles.points()[point]);
    return {p.x(), p.y(), z_m};
  }

  // The point's on that face with a normal so near to the given one, or a new one with it.
  std::uint32_t Vertex(Mesh& mesh, std::uint32_t point, std::uint32_t face, std::size_t level,
                       const Eigen::Vector3d& normal_W, double near) {
    for (std::uint32_t i = first_[point]; i != Triangulation::kNone; i = vertices_[i].next) {
      const Known& known = vertices_[i];
      if (known.face == face && known.level == level && (known.normal_W - normal_W).squaredNorm() <= near * near)
        return known.vertex;
    }
    const Skin& skin = plan_.faces[face].skins[level];
    const Eigen::Vector3d p_W = Place(point, heights_.At(point, face)[level].z_m);
    const Colour colour = skin.grown ? GroundColour(skin.surface, p_W.x(), p_W.y(), normal_W) : skin.colour;
    if (skin.along)
      mesh.on_face.push_back(OnPicture(*world_.network(), *skin.along, *skin.picture, p_W.head<2>()).cast<float>());
    vertices_.push_back(
        {face, static_cast<std::uint32_t>(level), mesh.Add(p_W, normal_W, colour), first_[point], normal_W});
    first_[point] = static_cast<std::uint32_t>(vertices_.size() - 1);
    return vertices_.back().vertex;
  }

  // One for each material, and for each way that a picture lies.
  Mesh& MeshOf(const Skin& skin) {
    const bool pictured = skin.picture.has_value();
    const auto kind =
        pictured ? std::tuple(Material::kPicture, skin.picture->file, skin.picture->width_m, skin.along.has_value())
                 : std::tuple(skin.material, std::string(), 0.0, false);
    auto [found, fresh] = meshes_.try_emplace(kind);
    if (fresh) {
      found->second.mesh.material = skin.material;
      found->second.mesh.origin_W = origin_W_;
      found->second.picture = pictured ? &*skin.picture : nullptr;
      if (skin.along) Show(*skin.picture, found->second.mesh);
    }
    return found->second.mesh;
  }

  void Ground(std::uint32_t triangle, std::size_t level) {
    const auto& corner = plan_.triangles.triangles()[triangle].corner;
    const std::uint32_t face = plan_.face_of[triangle];
    Mesh& mesh = MeshOf(plan_.faces[face].skins[level]);
    GroundTriangle ground;
    std::array<Eigen::Vector3d, 3> normals_W;
    for (std::size_t k = 0; k < 3; ++k) {
      const CornerHeight& height = heights_.At(corner[k], face)[level];
      ground.p_W[k] = Place(corner[k], height.z_m);
      normals_W[k] = height.normal_W;
    }
    const Eigen::Vector3d twice_area_W = (ground.p_W[1] - ground.p_W[0]).cross(ground.p_W[2] - ground.p_W[0]);
    ground.normal_W = twice_area_W.normalized();
    double longest_m = 0.0, widest = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      longest_m = std::max(longest_m, (ground.p_W[(k + 1) % 3] - ground.p_W[k]).norm());
      widest = std::max(widest, (normals_W[(k + 1) % 3] - normals_W[k]).norm());
    }
    const double thickness_m = twice_area_W.norm() / longest_m;
    const bool bent = widest > kBend_1pm * thickness_m;
    const Eigen::Vector3d one_W = thickness_m > kThin_m
                                      ? ground.normal_W
                                      : Eigen::Vector3d((normals_W[0] + normals_W[1] + normals_W[2]).normalized());
    std::array<std::uint32_t, 3> index{};
    for (std::size_t k = 0; k < 3; ++k) {
      index[k] = bent ? Vertex(mesh, corner[k], face, level, one_W, 0.5 * kBend_1pm * thickness_m)
                      : Vertex(mesh, corner[k], face, level, normals_W[k], 0.0);
    }
    mesh.AddTriangle(index[0], index[1], index[2]);
    woven_.triangles.push_back(ground);
  }

  static bool HasUnderside(const Face& face, std::size_t level) {
    return level + 1 < face.levels.size() && !face.skins[level].land;
  }

  // Of a deck, as deep as its sides: seen from the road below it.
  void Underside(std::uint32_t triangle, std::size_t level) {
    const auto& corner = plan_.triangles.triangles()[triangle].corner;
    const Colour concrete = SurfaceColour(ground::Surface::kConcrete);
    std::array<std::uint32_t, 3> index{};
    for (std::size_t k = 0; k < 3; ++k) {
      index[k] = wall_.Add(Place(corner[k], heights_.At(corner[k], plan_.face_of[triangle])[level].z_m - kApron_m),
                           -Eigen::Vector3d::UnitZ(), concrete);
    }
    wall_.AddTriangle(index[0], index[2], index[1]);
  }

  double MeanHeight(const std::array<std::uint32_t, 2>& side, std::uint32_t face, std::size_t level) const {
    return 0.5 * (heights_.At(side[0], face)[level].z_m + heights_.At(side[1], face)[level].z_m);
  }

  // Which of the other face's levels is nearest to this one.
  std::size_t Nearest(const std::array<std::uint32_t, 2>& side, std::uint32_t face, std::size_t level,
                      std::uint32_t other) const {
    const std::size_t count = plan_.faces[other].levels.size();
    if (count == 1 && plan_.faces[face].levels.size() == 1) return 0;
    const double z = MeanHeight(side, face, level);
    std::size_t best = kNoFace;
    double nearest = kLevelApart_m;
    for (std::size_t i = 0; i < count; ++i) {
      const double apart = std::fabs(MeanHeight(side, other, i) - z);
      if (apart < nearest) nearest = apart, best = i;
    }
    return best;
  }

  // Which of the other face's levels goes on from this one: each is the other's nearest. At most two sheets of ground
  // meet in a line.
  std::size_t Partner(const std::array<std::uint32_t, 2>& side, std::uint32_t face, std::size_t level,
                      std::uint32_t other) const {
    const std::size_t nearest = Nearest(side, face, level, other);
    return nearest != kNoFace && Nearest(side, other, nearest, face) == level ? nearest : kNoFace;
  }

  // What stands between a triangle's side and the face beyond, seen from there: where this one is higher.
  void Steps(std::uint32_t triangle, std::size_t k, std::uint32_t beyond) {
    const auto& t = plan_.triangles.triangles()[triangle];
    const std::array<std::uint32_t, 2> side = {t.corner[k], t.corner[(k + 1) % 3]};
    const std::uint32_t face = plan_.face_of[triangle], other = plan_.face_of[beyond];
    for (std::size_t level = 0; level < plan_.faces[face].levels.size(); ++level) {
      const auto z = [&](std::size_t c) { return heights_.At(side[c], face)[level].z_m; };
      const std::size_t partner = Partner(side, face, level, other);
      std::array<double, 2> foot = {z(0) - kApron_m, z(1) - kApron_m};
      const Face& own = plan_.faces[face];
      // The ground below a deck that goes on beyond its end stops at the abutment, up to the deck's underside.
      const bool abuts = partner == kNoFace && level > 0 && !HasUnderside(own, level) && HasUnderside(own, level - 1) &&
                         Partner(side, face, level - 1, other) != kNoFace;
      if (abuts) {
        for (const std::size_t c : {0, 1}) foot[c] = heights_.At(side[c], face)[level - 1].z_m - kApron_m;
        if (z(0) == foot[0] && z(1) == foot[1]) continue;
      }
      if (partner != kNoFace) {
        foot = {heights_.At(side[0], other)[partner].z_m, heights_.At(side[1], other)[partner].z_m};
        if (z(0) == foot[0] && z(1) == foot[1]) continue;
        const double higher = z(0) + z(1) - foot[0] - foot[1];
        if (higher < 0.0 || (higher == 0.0 && face > other)) continue;  // that face's wall
      }
      const double high = std::max(z(0) - foot[0], z(1) - foot[1]);
      const Skin& skin = plan_.faces[face].skins[level];
      Colour colour = SurfaceColour(ground::Surface::kSoil);
      if (partner == kNoFace || (high < kMaxKerb_m && !skin.grown)) colour = SurfaceColour(ground::Surface::kConcrete);
      if (partner != kNoFace && high < kMaxKerb_m && plan_.faces[other].skins[partner].colour == skin.colour)
        colour = skin.colour;
      Wall(side, {heights_.Way(side[0], z(0), foot[0]), heights_.Way(side[1], z(1), foot[1])}, colour);
    }
  }

  // Between two points, each with its way down, or up.
  void Wall(const std::array<std::uint32_t, 2>& side, const std::array<std::vector<double>, 2>& ways_m, Colour colour) {
    const Eigen::Vector3d along = Place(side[1], 0.0) - Place(side[0], 0.0);
    const bool up = ways_m[0].back() + ways_m[1].back() >
                    ways_m[0].front() + ways_m[1].front();  // then it is seen from the other side
    const Eigen::Vector3d normal = (up ? -1.0 : 1.0) * Eigen::Vector3d(along.y(), -along.x(), 0.0).normalized();
    std::array<std::vector<std::uint32_t>, 2> down;
    for (std::size_t k = 0; k < 2; ++k) {
      for (const double z_m : ways_m[k]) down[k].push_back(wall_.Add(Place(side[k], z_m), normal, colour));
    }
    for (std::size_t i = 0; i + 1 < down[1].size(); ++i) wall_.AddTriangle(down[0].front(), down[1][i + 1], down[1][i]);
    for (std::size_t i = 0; i + 1 < down[0].size(); ++i) wall_.AddTriangle(down[0][i], down[0][i + 1], down[1].back());
  }

  const road::World& world_;
  const TilePlan& plan_;
  TileHeights heights_;
  Eigen::Vector3d origin_W_;
  WovenTile woven_;
  struct Made {
    Mesh mesh;
    const terrain::LaidPicture* picture = nullptr;  // the plan's
  };
  std::map<std::tuple<Material, std::string, double, bool>, Made> meshes_;
  Mesh wall_;
  struct Known {
    std::uint32_t face;
    std::uint32_t level;
    std::uint32_t vertex;
    std::uint32_t next;  // of the same point
    Eigen::Vector3d normal_W;
  };
  std::vector<Known> vertices_;       // what is there already
  std::vector<std::uint32_t> first_;  // by point
};

}  // namespace

Eigen::Vector3d TileOrigin(const TileKey& key, double z_m) {
  const Eigen::Vector2d middle = key.south_west_W() + Eigen::Vector2d::Constant(0.5 * kTile_m);
  return {middle.x(), middle.y(), std::round(z_m / kOriginGrid_m) * kOriginGrid_m};
}

WovenTile WeaveTile(const road::World& world, const TilePlan& plan) {
  if (plan.faces.empty()) return {};
  return Weaver(world, plan).Weave();
}

}  // namespace rodeira::scene
