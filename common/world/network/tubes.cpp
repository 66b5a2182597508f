// SPDX-License-Identifier: Apache-2.0
#include "common/world/network/tubes.hpp"

#include <algorithm>
#include <cmath>

namespace rodeira::network {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kPiece_m = 8.0;   // at most
constexpr double kChord_m = 0.02;  // between a piece and the edges that it stands for
constexpr double kMinTubePiece_m = 0.5;
constexpr double kNarrowest_m = 0.5;  // of a road with a tube
constexpr double kAtEnd_m = 1e-6;     // of a road's end that a tunnel reaches

bool IsInTunnel(const RoadSpec& road, double s_m) {
  return std::any_of(road.structures.begin(), road.structures.end(), [s_m](const Structure& structure) {
    return !structure.bridge && s_m >= structure.s_m - kAtEnd_m && s_m <= structure.s_m + structure.length_m + kAtEnd_m;
  });
}

// Whether a road goes on into nothing, or in a road that is in no tunnel there.
bool IsOpen(const Network& network, const std::optional<RoadLink>& link) {
  if (!link) return true;
  if (link->junction) return false;
  const auto next = std::find_if(network.roads().begin(), network.roads().end(),
                                 [&](const Road& road) { return road.spec().id == link->id; });
  if (next == network.roads().end()) return true;
  return !IsInTunnel(next->spec(), link->s_m.value_or(link->contact == End::kStart ? 0.0 : next->length_m()));
}

// How sharply a road's edges bend at s, 1/m.
double BendOf(const Road& road, double s_m, double right_m, double left_m) {
  const double k = road.axis().Evaluate(s_m).curvature_1pm;
  return std::max(std::fabs(k / std::max(0.1, 1.0 - k * right_m)), std::fabs(k / std::max(0.1, 1.0 - k * left_m)));
}

class TubeOfRoad {
 public:
  TubeOfRoad(const Network& network, std::uint32_t index)
      : network_(network), index_(index), road_(network.roads()[index]) {}

  void Add(const Structure& structure, std::vector<TubePiece>& pieces) const {
    const double from = std::max(structure.s_m, 0.0),
                 to = std::min(structure.s_m + structure.length_m, road_.length_m());
    if (!(to > from)) return;
    const RoadSpec& spec = road_.spec();
    const std::size_t first = pieces.size();
    double begin = from;
    for (const LaneSection& section : spec.sections) {  // widths change where sections do
      if (section.end_s_m <= begin) continue;
      if (section.s_m >= to) break;
      const double end = std::min(section.end_s_m, to);
      AddSection(structure, section, begin, end, pieces);
      begin = end;
    }
    if (pieces.size() == first) return;
    pieces[first].portal[0] = from > kAtEnd_m || IsOpen(network_, spec.predecessor);
    pieces.back().portal[1] = to < road_.length_m() - kAtEnd_m || IsOpen(network_, spec.successor);
  }

 private:
  void AddSection(const Structure& structure, const LaneSection& section, double from, double to,
                  std::vector<TubePiece>& pieces) const {
    double step = kPiece_m;
    for (double s = from; s <= to; s += 1.0) {
      double right, left;
      section.Bounds(road_.spec().lane_offset, s, s, right, left);
      const double bend = BendOf(road_, s, right, left);
      if (bend > 0.0) step = std::min(step, std::max(kMinTubePiece_m, std::sqrt(8.0 * kChord_m / bend)));
    }
    const int count = std::max(1, static_cast<int>(std::ceil((to - from) / step - 1e-9)));
    TubePiece piece;
    piece.road = index_, piece.structure = &structure;
    for (int i = 0; i <= count; ++i) {
      piece.s_m[0] = piece.s_m[1], piece.right_W[0] = piece.right_W[1], piece.left_W[0] = piece.left_W[1],
      piece.ceiling_m[0] = piece.ceiling_m[1];
      SetEnd(section, i == count ? to : from + (to - from) * i / count, piece);
      if (i == 0 || (piece.left_W[1] - piece.right_W[1]).norm() < kNarrowest_m ||
          (piece.left_W[0] - piece.right_W[0]).norm() < kNarrowest_m)
        continue;
      piece.right_wall = !IsRoadBeside(piece.right_W, -1.0, piece);
      piece.left_wall = !IsRoadBeside(piece.left_W, 1.0, piece);
      pieces.push_back(piece);
    }
  }

  void SetEnd(const LaneSection& section, double s, TubePiece& piece) const {
    double right, left;
    section.Bounds(road_.spec().lane_offset, s, s, right, left);
    piece.s_m[1] = s;
    piece.right_W[1] = road_.Surface(s, right).p_W, piece.left_W[1] = road_.Surface(s, left).p_W;
    // The road may lie higher between its edges than at them.
    double over = 0.0;
    const auto look = [&](double t) {
      const double share = left > right ? (t - right) / (left - right) : 0.0;
      over = std::max(over, road_.Surface(s, std::clamp(t, right, left)).p_W.z() -
                                (piece.right_W[1].z() + share * (piece.left_W[1].z() - piece.right_W[1].z())));
    };
    const geometry::CubicPoint centre = road_.CentreAt(s);
    look(centre.value);
    for (const auto* side : {&section.right, &section.left}) {
      for (const Lane& lane : *side) look(section.Span(lane.id, centre, s)->outer_t_m);
    }
    piece.ceiling_m[1] = kTubeClear_m + over;
  }

  // Whether another road lies where a piece's wall would stand.
  bool IsRoadBeside(const std::array<Vector3d, 2>& edge_W, double side, const TubePiece& piece) const {
    std::vector<Surfacing> surfaces;
    for (const double share : {0.0, 0.5, 1.0}) {
      const Vector3d foot = edge_W[0] + share * (edge_W[1] - edge_W[0]);
      const Vector2d out = side * (piece.LeftAt(0) + share * (piece.LeftAt(1) - piece.LeftAt(0)));
      const Vector2d p = foot.head<2>() + (0.5 * kTubeWall_m - kTubeInside_m) * out;
      network_.Surfaces(p.x(), p.y(), surfaces);
      if (std::any_of(surfaces.begin(), surfaces.end(), [&](const Surfacing& other) {
            const double height = other.sample.p_W.z() - foot.z();
            return other.place.lane.lane != 0 && other.place.lane.road != index_ && !other.claim.past_end &&
                   height > -Network::kLevel_m && height < kTubeClear_m;
          })) {
        return true;
      }
    }
    return false;
  }

  const Network& network_;
  std::uint32_t index_;
  const Road& road_;
};

}  // namespace

std::vector<TubePiece> PlaceTubes(const Network& network) {
  std::vector<TubePiece> pieces;
  for (std::uint32_t index = 0; index < network.roads().size(); ++index) {
    std::vector<const Structure*> tunnels;
    for (const Structure& structure : network.roads()[index].spec().structures) {
      if (!structure.bridge) tunnels.push_back(&structure);
    }
    std::stable_sort(tunnels.begin(), tunnels.end(),
                     [](const Structure* a, const Structure* b) { return a->s_m < b->s_m; });
    const TubeOfRoad tube(network, index);
    for (const Structure* tunnel : tunnels) tube.Add(*tunnel, pieces);
  }
  return pieces;
}

}  // namespace rodeira::network
