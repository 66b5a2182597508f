// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

// What can be seen, as plain numbers: no graphics library is known here.
namespace rodeira::scene {

// How a surface is drawn. The colour is each vertex's own.
enum class Material : std::uint32_t {
  kGround,    // terrain, verges
  kCheckers,  // a plane without features: squares let its motion be seen
  kRoad,      // asphalt
  kMark,
  kCarPaint,
  kGlass,
  kMatt,  // rubber, grilles
  kLamp,  // shines by itself
  kFoliage,
  kSign,  // a picture of its own
  kConcrete,
  kGravel,
  kPicture,  // a picture from a file lies on it; where it ends, as kGround
  kCarLamp,  // dull, or shining as its vehicle says
};
inline constexpr int kMaterials = 14;
// Whether it is ground, or lies on it.
bool IsGround(Material material);

// sRGB, eight bits a part.
struct Colour {
  std::uint8_t red = 255;
  std::uint8_t green = 255;
  std::uint8_t blue = 255;

  bool operator==(const Colour&) const = default;
  // 0xRRGGBB
  static constexpr Colour Of(std::uint32_t rgb) {
    return {static_cast<std::uint8_t>(rgb >> 16), static_cast<std::uint8_t>(rgb >> 8), static_cast<std::uint8_t>(rgb)};
  }
};
// (1 - weight) a + weight b; weight in [0, 1].
Colour Mix(Colour a, Colour b, double weight);
// Every part multiplied by `factor` and held within its bounds.
Colour Shade(Colour colour, double factor);

// Triangles, counter-clockwise seen from outside (from above). Positions are relative to the origin, which is
// subtracted in double before anything becomes float, so that a mesh is as exact far from the world's origin as near to
// it.
struct Mesh {
  Material material = Material::kGround;
  Eigen::Vector3d origin_W = Eigen::Vector3d::Zero();
  std::vector<Eigen::Vector3f> positions;
  std::vector<Eigen::Vector3f> normals;  // unit length
  std::vector<Colour> colours;
  std::vector<std::uint32_t> triangles;  // three indices each
  // Of kSign and kPicture only: which face (scene::DrawFace) or file, and where on it each vertex lies: (0, 0) its
  // lower left corner, (1, 1) its upper right one. Of kCarLamp: which lamp (scene::Lamp) each vertex belongs to, and 0.
  std::string face;
  std::vector<Eigen::Vector2f> on_face;
  bool repeats = false;  // the picture, beyond its edges

  // A vertex at a point in W; `normal` has unit length. Returns its index, for AddTriangle.
  std::uint32_t Add(const Eigen::Vector3d& p_W, const Eigen::Vector3d& normal, Colour colour);
  // Indices of vertices, counter-clockwise seen from outside.
  void AddTriangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) { triangles.insert(triangles.end(), {a, b, c}); }
  // The other mesh behind this one; it must have the same origin.
  void Append(const Mesh& other);

  // Of a vertex, in W, metres.
  Eigen::Vector3d PositionW(std::size_t vertex) const { return origin_W + positions[vertex].cast<double>(); }
  std::size_t triangle_count() const { return triangles.size() / 3; }
};

// Patterns on the ground repeat after this length, so origins that are multiples of it keep them in phase.
inline constexpr double kOriginGrid_m = 64.0;
// The multiple of kOriginGrid_m nearest to a point, for x, y and z.
Eigen::Vector3d OriginNear(const Eigen::Vector3d& p_W);

// Gives each vertex the mean normal of the faces around its place, weighted by their areas, as far as they turn from
// its own face by less than crease_rad. The mesh must have three vertices of its own for each triangle.
void SmoothNormals(Mesh& mesh, double crease_rad);

}  // namespace rodeira::scene
