// SPDX-License-Identifier: Apache-2.0
// The ground that a road shapes, as triangles.
#include <algorithm>
#include <cmath>
#include <map>

#include "common/view/scene/ground_materials/colours.hpp"
#include "common/view/scene/ground_materials/skin.hpp"
#include "common/view/scene/terrain/ribbon.hpp"

namespace rodeira::scene {
namespace {

constexpr double kNormalInset_m = 0.005;  // normals are asked for this far within a strip: at its edge the slope jumps

// A strip along the road between two t.
struct Strip {
  double from_t_m;
  double to_t_m;
  Material material;
  ground::Surface surface;   // of the road's band, or of the verge that the blend begins with
  bool outer_right = false;  // its right edge is the ribbon's
  bool outer_left = false;
};

// From right to left.
std::vector<Strip> StripsOf(const road::Section& section, Material ground) {
  static constexpr double kBlendParts[] = {0.0, 0.15, 0.3, 0.5, 0.7, 0.85, 1.0};
  constexpr int kCount = static_cast<int>(std::size(kBlendParts)) - 1;
  const double blend = section.spec().blend_m;
  const ground::Surface verge = section.spec().verge.surface;
  std::vector<Strip> strips;
  for (int k = kCount; k > 0; --k) {
    strips.push_back({section.verge_right_m() - blend * kBlendParts[k],
                      section.verge_right_m() - blend * kBlendParts[k - 1], ground, verge});
  }
  for (const road::Band& band : section.bands()) {
    const Material own = MaterialOf(band.surface);
    strips.push_back({band.from_t_m, band.to_t_m, own == Material::kGround ? ground : own, band.surface});
  }
  for (int k = 0; k < kCount; ++k) {
    strips.push_back({section.verge_left_m() + blend * kBlendParts[k],
                      section.verge_left_m() + blend * kBlendParts[k + 1], ground, verge});
  }
  strips.front().from_t_m = section.blend_right_m();
  strips.front().outer_right = true;
  strips.back().to_t_m = section.blend_left_m();
  strips.back().outer_left = true;
  return strips;
}

// Makes the triangles of one tile.
class RibbonTessellator {
 public:
  RibbonTessellator(const road::World& world, const road::Road& road, const Ribbon& ribbon, const Lattice& lattice,
                    const Eigen::Vector3d& origin_W)
      : world_(world), section_(road.section()), ribbon_(ribbon), lattice_(lattice), origin_W_(origin_W) {}

  // The strip between the lines of numbers from and to.
  void Weave(const Strip& strip, std::size_t from, std::size_t to) {
    Mesh& mesh = MeshOf(strip.material);
    std::vector<Vertex> right, left;
    for (std::size_t i = from; i <= to; ++i) {
      right.push_back(Place(mesh, strip, ribbon_.lines[i], ribbon_.lines[i].At(strip.from_t_m), strip.from_t_m,
                            strip.outer_right || IsEnd(i)));
      left.push_back(Place(mesh, strip, ribbon_.lines[i], ribbon_.lines[i].At(strip.to_t_m), strip.to_t_m,
                           strip.outer_left || IsEnd(i)));
    }
    for (std::size_t i = from; i < to; ++i)
      Quad(mesh, strip, i, right[i - from], right[i + 1 - from], left[i + 1 - from], left[i - from]);
  }

  std::vector<Mesh> Take() {
    std::vector<Mesh> meshes;
    for (auto& [material, mesh] : meshes_) {
      if (!mesh.triangles.empty()) meshes.push_back(std::move(mesh));
    }
    return meshes;
  }

 private:
  struct Vertex {
    std::uint32_t index = 0;
    bool inside = false;
    Eigen::Vector2d p_W;
    double t_m = 0.0;
  };

  bool IsEnd(std::size_t line) const { return line == 0 || line + 1 == ribbon_.lines.size(); }

  Mesh& MeshOf(Material material) {
    auto [found, fresh] = meshes_.try_emplace(material);
    if (fresh) {
      found->second.material = material;
      found->second.origin_W = origin_W_;
    }
    return found->second;
  }

  // How much of the terrain's own look there is: 0 within the verges, 1 at the ribbon's edge.
  double Wildness(double t_m, double beyond_m) const {
    const double aside = t_m - std::clamp(t_m, section_.verge_right_m(), section_.verge_left_m());
    return std::min(1.0, std::hypot(aside, beyond_m) / section_.spec().blend_m);
  }

  // A vertex at p_W. On the ribbon's edge the terrain's triangle gives it everything, so that no seam is seen.
  Vertex Place(Mesh& mesh, const Strip& strip, const CrossLine& line, const Eigen::Vector2d& p_W, double t_m,
               bool on_edge) const {
    Vertex vertex{0, true, p_W, t_m};
    const Lattice::Sample wild = lattice_.At(p_W.x(), p_W.y());
    if (on_edge && wild.inside) {
      vertex.index = mesh.Add(wild.p_W, wild.normal_W, wild.colour);
      return vertex;
    }
    const double middle = 0.5 * (strip.from_t_m + strip.to_t_m);
    const Eigen::Vector2d within = p_W + std::clamp(middle - t_m, -kNormalInset_m, kNormalInset_m) * line.left_W;
    const road::SurfacePoint at = world_.At(p_W.x(), p_W.y());
    const road::SurfacePoint slope = world_.At(within.x(), within.y());
    vertex.inside = at.inside && slope.inside;
    Eigen::Vector3d normal = Eigen::Vector3d(-slope.slope_x, -slope.slope_y, 1.0).normalized();
    Colour colour = SurfaceColour(strip.surface);
    if (strip.material == lattice_.material() && wild.inside) {
      const double wildness = Wildness(t_m, line.beyond_m);
      Colour verge = GroundColour(strip.surface, p_W.x(), p_W.y(), Eigen::Vector3d::UnitZ());
      const double beside = std::max(t_m - section_.paved_left_m(), section_.paved_right_m() - t_m);
      if (beside < 0.5)
        verge = Mix(verge, SurfaceColour(ground::Surface::kGravel), 0.6);  // little grows right beside the road
      colour = Mix(verge, wild.colour, std::max(wildness, line.beyond_m != 0.0 ? 0.5 : 0.0));
      normal = ((1.0 - wildness) * normal + wildness * wild.normal_W).normalized();
    }
    vertex.index = mesh.Add({p_W.x(), p_W.y(), at.z_m}, normal, colour);
    return vertex;
  }

  // Vertices on the ribbon's edge between two of its corners, where it passes from one of the terrain's triangles to
  // another.
  std::vector<std::uint32_t> Between(Mesh& mesh, const Vertex& a, const Vertex& b) const {
    std::vector<std::uint32_t> indices;
    for (const double part : lattice_.Crossings(a.p_W, b.p_W)) {
      const Eigen::Vector2d p = a.p_W + part * (b.p_W - a.p_W);
      const Lattice::Sample wild = lattice_.At(p.x(), p.y());
      if (wild.inside) indices.push_back(mesh.Add(wild.p_W, wild.normal_W, wild.colour));
    }
    return indices;
  }

  // Corners counter-clockwise: right and left on line i, right and left on line i + 1.
  void Quad(Mesh& mesh, const Strip& strip, std::size_t i, const Vertex& right, const Vertex& next_right,
            const Vertex& next_left, const Vertex& left) const {
    if (!right.inside || !next_right.inside || !next_left.inside || !left.inside) return;
    const std::array<const Vertex*, 4> corners = {&right, &next_right, &next_left, &left};
    const std::array<bool, 4> on_edge = {strip.outer_right, IsEnd(i + 1), strip.outer_left,
                                         IsEnd(i)};  // of the side after each
    // The fan starts at a corner neither of whose sides is on the ribbon's edge, where there is one.
    std::size_t apex = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      if (!on_edge[k] && !on_edge[(k + 3) % 4]) {
        apex = k;
        break;
      }
    }
    std::vector<std::uint32_t> ring;
    for (std::size_t k = 0; k < 4; ++k) {
      const std::size_t corner = (apex + k) % 4;
      ring.push_back(corners[corner]->index);
      if (!on_edge[corner]) continue;
      for (const std::uint32_t index : Between(mesh, *corners[corner], *corners[(corner + 1) % 4]))
        ring.push_back(index);
    }
    for (std::size_t k = 1; k + 1 < ring.size(); ++k) mesh.AddTriangle(ring[0], ring[k], ring[k + 1]);
  }

  const road::World& world_;
  const road::Section& section_;
  const Ribbon& ribbon_;
  const Lattice& lattice_;
  Eigen::Vector3d origin_W_;
  std::map<Material, Mesh> meshes_;
};

// The t at which a mark is cut lengthwise: its edges, and where the cross-section has a kink under it.
std::vector<double> CutsOf(const road::Mark& mark, const road::Section& section) {
  const double low = mark.t_m - 0.5 * mark.width_m, high = mark.t_m + 0.5 * mark.width_m;
  std::vector<double> cuts = {low};
  for (const road::Band& band : section.bands()) {
    if (band.from_t_m > low + 1e-6 && band.from_t_m < high - 1e-6) cuts.push_back(band.from_t_m);
  }
  cuts.push_back(high);
  return cuts;
}

// One painted piece between two s, cut at the road's own lines between them.
void Paint(const road::World& world, const road::Road& road, const Ribbon& ribbon, const road::Mark& mark,
           double from_s, double to_s, Mesh& mesh) {
  std::vector<double> stations = {from_s};
  for (std::size_t i = ribbon.first; i <= ribbon.last; ++i) {
    const double s = ribbon.lines[i].s_m;
    if (s > from_s + 1e-6 && s < to_s - 1e-6) stations.push_back(s);
  }
  stations.push_back(to_s);
  const Colour colour =
      mark.colour == road::MarkColour::kYellow ? Colour::Of(0xe5b52e) : SurfaceColour(ground::Surface::kRoadMark);
  const std::vector<double> cuts = CutsOf(mark, road.section());
  std::vector<std::uint32_t> row, before;
  for (const double s : stations) {
    const geometry::PlanPoint at = road.plan().Evaluate(s);
    row.clear();
    for (const double t : cuts) {
      const Eigen::Vector2d p = at.p_W + t * at.left_W();
      const road::SurfacePoint ground = world.At(p.x(), p.y());
      row.push_back(mesh.Add({p.x(), p.y(), ground.z_m},
                             Eigen::Vector3d(-ground.slope_x, -ground.slope_y, 1.0).normalized(), colour));
    }
    for (std::size_t k = 0; k + 1 < row.size() && !before.empty(); ++k) {
      mesh.AddTriangle(before[k], row[k], row[k + 1]);
      mesh.AddTriangle(before[k], row[k + 1], before[k + 1]);
    }
    before = row;
  }
}

}  // namespace

std::vector<RoadTile> BuildRoad(const road::World& world, const road::Road& road, const Ribbon& ribbon,
                                const Lattice& lattice, double tile_m) {
  const std::vector<Strip> strips = StripsOf(road.section(), lattice.material());
  std::vector<Strip> wild = strips;  // past the ends nothing is paved
  for (Strip& strip : wild) {
    strip.material = lattice.material();
    strip.surface = road.section().spec().verge.surface;
  }
  std::vector<std::vector<road::Stroke>> strokes;
  for (const road::Mark& mark : road.marks()) strokes.push_back(road.Strokes(mark));

  std::vector<RoadTile> tiles;
  for (std::size_t from = ribbon.first; from < ribbon.last;) {
    std::size_t to = from + 1;
    while (to < ribbon.last && ribbon.lines[to].s_m - ribbon.lines[from].s_m < tile_m) ++to;
    const double from_s = ribbon.lines[from].s_m, to_s = ribbon.lines[to].s_m;
    const Eigen::Vector3d origin = OriginNear(road.Position(0.5 * (from_s + to_s), 0.0));
    RibbonTessellator tessellator(world, road, ribbon, lattice, origin);
    for (const Strip& strip : strips) tessellator.Weave(strip, from, to);
    if (from == ribbon.first) {
      for (const Strip& strip : wild) tessellator.Weave(strip, 0, ribbon.first);
    }
    if (to == ribbon.last) {
      for (const Strip& strip : wild) tessellator.Weave(strip, ribbon.last, ribbon.lines.size() - 1);
    }
    RoadTile tile{tessellator.Take(), {}};
    tile.marks.material = Material::kMark;
    tile.marks.origin_W = origin;
    for (std::size_t m = 0; m < strokes.size(); ++m) {
      for (const road::Stroke& stroke : strokes[m]) {
        const double begin = std::max(stroke.from_s_m, from_s), end = std::min(stroke.to_s_m, to_s);
        if (end - begin > 1e-6) Paint(world, road, ribbon, road.marks()[m], begin, end, tile.marks);
      }
    }
    tiles.push_back(std::move(tile));
    from = to;
  }
  return tiles;
}

}  // namespace rodeira::scene
