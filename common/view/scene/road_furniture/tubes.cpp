// SPDX-License-Identifier: Apache-2.0
#include "common/view/scene/road_furniture/tubes.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <utility>
#include <vector>

#include "common/view/scene/mesh/solids.hpp"

namespace rodeira::scene {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using network::kTubeInside_m, network::kTubeOutside_m, network::kTubeWall_m;

constexpr double kFoot_m = 0.3;        // under the road, within
constexpr double kFounded_m = 1.0;     // outside
constexpr double kTunnelKerb_m = 0.8;  // over the road: dark up to there
constexpr double kPanels_m = 3.0;      // and pale up to there
constexpr double kHaunch_m = 0.6;
constexpr double kUpstand_m = 0.4;  // of the walls over the ceiling: the hill's edge lies behind them
constexpr double kParapet_m = 1.0;  // of a portal over the ceiling
constexpr double kLamps_m = 0.3;    // width of the band
constexpr double kLampsUnder_m = 0.02;

const Colour kKerb = Colour::Of(0x6d6c68), kPanels = Colour::Of(0xd2d2c8), kConcrete = Colour::Of(0xa3a19a),
             kCeiling = Colour::Of(0x7f7d78), kPortal = Colour::Of(0xb5b1a6);
const Colour kLight = Colour::Of(0xfff3d6);

class Tube {
 public:
  Tube(const network::TubePiece& piece, Mesh& solid) : piece_(piece), solid_(solid) {
    const Vector2d left = piece.LeftAt(0) + piece.LeftAt(1);
    left_W_ = Vector3d(left.x(), left.y(), 0.0).normalized();
    forward_W_ = Vector3d(left_W_.y(), -left_W_.x(), 0.0);
  }

  // Both sides, from -1 the right one: the wall's inner face, the haunch, what is outside.
  void AddSide(double side, int level) const {
    const bool wall = HasWall(side);
    const auto band = [&](double low, double high, Colour colour) {
      Extrude(side, {-kTubeInside_m, low}, {-kTubeInside_m, high}, -side * left_W_, colour);
    };
    if (!wall) {
      Extrude(side, {0.0, kTop}, {0.0, kTop + network::kTubeCeiling_m}, side * left_W_, kConcrete);
      return;
    }
    if (level < 2) {
      band(-kFoot_m, kTunnelKerb_m, kKerb), band(kTunnelKerb_m, kPanels_m, kPanels),
          band(kPanels_m, kTop - kHaunch_m, kConcrete);
    } else {
      band(-kFoot_m, kTop - kHaunch_m, kPanels);
    }
    Extrude(side, {-kTubeInside_m, kTop - kHaunch_m}, {-kHaunch_m, kTop}, -side * left_W_ - Vector3d::UnitZ(),
            kCeiling);
    Extrude(side, {kTubeOutside_m, -kFounded_m}, {kTubeOutside_m, kTop + kUpstand_m}, side * left_W_, kConcrete);
    Extrude(side, {-kTubeInside_m, kTop + kUpstand_m}, {kTubeOutside_m, kTop + kUpstand_m}, Vector3d::UnitZ(),
            kConcrete);
    Extrude(side, {-kTubeInside_m, kTop + network::kTubeCeiling_m}, {-kTubeInside_m, kTop + kUpstand_m},
            -side * left_W_, kConcrete);
  }

  void AddCeiling() const {
    const double right = HasWall(-1.0) ? -kHaunch_m : 0.0, left = HasWall(1.0) ? -kHaunch_m : 0.0;
    Face({At(0, -1.0, {right, kTop}), At(1, -1.0, {right, kTop}), At(1, 1.0, {left, kTop}), At(0, 1.0, {left, kTop})},
         -Vector3d::UnitZ(), kCeiling, solid_);
    const double top = kTop + network::kTubeCeiling_m;
    Face({At(0, -1.0, {0.0, top}), At(1, -1.0, {0.0, top}), At(1, 1.0, {0.0, top}), At(0, 1.0, {0.0, top})},
         Vector3d::UnitZ(), kConcrete, solid_);
  }

  void AddLamps(Mesh& lamps) const {
    std::vector<Vector3d> corners(4);
    for (std::size_t end = 0; end < 2; ++end) {
      const Vector3d middle =
          0.5 * (At(end, -1.0, {0.0, kTop}) + At(end, 1.0, {0.0, kTop})) - kLampsUnder_m * Vector3d::UnitZ();
      const Vector3d aside = 0.5 * kLamps_m * (piece_.left_W[end] - piece_.right_W[end]).normalized();
      corners[end == 0 ? 0 : 1] = middle - aside, corners[end == 0 ? 3 : 2] = middle + aside;
    }
    Face(std::move(corners), -Vector3d::UnitZ(), kLight, lamps);
  }

  // A frame around the mouth.
  void AddPortal(std::size_t end) const {
    const Vector3d out = (end == 0 ? -network::kPortalDeep_m : network::kPortalDeep_m) * forward_W_,
                   towards = end == 0 ? Vector3d(-forward_W_) : forward_W_;
    const double top = kTop + kParapet_m;
    const auto face = [&](std::vector<Vector3d> corners, const Vector3d& facing) {
      Face(std::move(corners), facing, kPortal, solid_);
    };
    // Over the opening, before and behind, on top, and its lower side.
    const auto opening = [&](double side, double up) {
      return At(end, side, {HasWall(side) ? -kTubeInside_m : 0.0, up});
    };
    for (const double at : {1.0, 0.0}) {
      const Vector3d moved = at * out;
      face({opening(-1.0, kTop) + moved, opening(1.0, kTop) + moved, opening(1.0, top) + moved,
            opening(-1.0, top) + moved},
           at > 0.0 ? towards : Vector3d(-towards));
    }
    const double right = HasWall(-1.0) ? network::kPortalWing_m : 0.0,
                 left = HasWall(1.0) ? network::kPortalWing_m : 0.0;
    face({At(end, -1.0, {right, top}), At(end, 1.0, {left, top}), At(end, 1.0, {left, top}) + out,
          At(end, -1.0, {right, top}) + out},
         Vector3d::UnitZ());
    const double from_right = HasWall(-1.0) ? -kHaunch_m : 0.0, from_left = HasWall(1.0) ? -kHaunch_m : 0.0;
    face({At(end, -1.0, {from_right, kTop}), At(end, 1.0, {from_left, kTop}), At(end, 1.0, {from_left, kTop}) + out,
          At(end, -1.0, {from_right, kTop}) + out},
         -Vector3d::UnitZ());
    for (const double side : {-1.0, 1.0}) {
      if (!HasWall(side)) continue;
      const auto at = [&](double aside, double up, double moved) {
        return Vector3d(At(end, side, {aside, up}) + moved * out);
      };
      const double wing = network::kPortalWing_m, haunch = kTop - kHaunch_m;
      for (const double moved : {1.0, 0.0}) {
        const double inner = moved > 0.0 ? -kTubeInside_m : kTubeOutside_m;  // behind it the tube stands
        face({at(inner, -kFounded_m, moved), at(wing, -kFounded_m, moved), at(wing, top, moved), at(inner, top, moved)},
             moved > 0.0 ? towards : Vector3d(-towards));
      }
      face({at(wing, -kFounded_m, 0.0), at(wing, top, 0.0), at(wing, top, 1.0), at(wing, -kFounded_m, 1.0)},
           side * left_W_);
      face({at(-kTubeInside_m, -kFoot_m, 0.0), at(-kTubeInside_m, haunch, 0.0), at(-kTubeInside_m, haunch, 1.0),
            at(-kTubeInside_m, -kFoot_m, 1.0)},
           -side * left_W_);
      face({at(-kTubeInside_m, haunch, 0.0), at(-kHaunch_m, kTop, 0.0), at(-kHaunch_m, kTop, 1.0),
            at(-kTubeInside_m, haunch, 1.0)},
           -side * left_W_ - Vector3d::UnitZ());
      Face({at(-kTubeInside_m, haunch, 1.0), at(-kHaunch_m, kTop, 1.0), at(-kTubeInside_m, kTop, 1.0)}, towards,
           kPortal, solid_);
    }
  }

 private:
  // So much and more is a height over the ceiling, less is one over the road.
  static constexpr double kTop = 100.0;
  // Outward from the road's edge, and up.
  struct Place {
    double out_m, up_m;
  };

  bool HasWall(double side) const { return side < 0.0 ? piece_.right_wall : piece_.left_wall; }

  Vector3d At(std::size_t end, double side, const Place& place) const {
    const Vector2d left = piece_.LeftAt(end);
    const Vector3d& edge = side < 0.0 ? piece_.right_W[end] : piece_.left_W[end];
    const double up = place.up_m > 0.5 * kTop ? piece_.ceiling_m[end] + place.up_m - kTop : place.up_m;
    // A ceiling's places within lie on the line from edge to edge.
    const double rise = place.out_m < 0.0
                            ? -place.out_m * side * (piece_.right_W[end].z() - piece_.left_W[end].z()) /
                                  std::max(1.0, (piece_.left_W[end] - piece_.right_W[end]).head<2>().norm())
                            : 0.0;
    return edge + side * place.out_m * Vector3d(left.x(), left.y(), 0.0) + (up + rise) * Vector3d::UnitZ();
  }

  // Along the piece between two places of its section.
  void Extrude(double side, const Place& from, const Place& to, const Vector3d& facing, Colour colour) const {
    Face({At(0, side, from), At(1, side, from), At(1, side, to), At(0, side, to)}, facing, colour, solid_);
  }

  // `facing`: where from it is seen, whichever way its corners are given.
  static void Face(std::vector<Vector3d> corners, const Vector3d& facing, Colour colour, Mesh& mesh) {
    if ((corners[1] - corners[0]).cross(corners[2] - corners[0]).dot(facing) < 0.0)
      std::reverse(corners.begin(), corners.end());
    AddFlat(mesh, corners, colour);
  }

  const network::TubePiece& piece_;
  Mesh& solid_;
  Vector3d left_W_, forward_W_;  // level, of the whole piece
};

}  // namespace

void AddTube(const network::TubePiece& piece, int level, Mesh& solid, Mesh& lamps) {
  const Tube tube(piece, solid);
  for (const double side : {-1.0, 1.0}) tube.AddSide(side, level);
  tube.AddCeiling();
  if (level < 3) tube.AddLamps(lamps);
  for (const std::size_t end : {0, 1}) {
    if (piece.portal[end]) tube.AddPortal(end);
  }
}

}  // namespace rodeira::scene
