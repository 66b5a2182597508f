// SPDX-License-Identifier: Apache-2.0
#include "common/world/design/road_fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "common/world/design/section_reader.hpp"

namespace rodeira::design {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kFitStep_m = 1.0;  // between samples of a road
constexpr double kMaxSteps = 1e6;   // of longer roads only the terrain is looked for, in longer steps
constexpr int kOwnSteps = 3;        // so near along the road an edge is the stretch's own
constexpr double kMinCell_m = 16.0;
constexpr double kFar_m = 1e9;
constexpr double kTouches_m = 0.01;  // edges so far within one another only touch
constexpr double kSeam_m = 0.1;      // and so may a closed road's ends

// The road at a station.
struct Across {
  double s_m;
  Vector3d right_W, left_W;  // its outermost edges
  bool at_grade;             // neither bridge, tunnel nor junction
};

using Cell = std::pair<std::int64_t, std::int64_t>;

bool IsOnStructure(const network::RoadSpec& spec, double s_m) {
  return std::any_of(spec.structures.begin(), spec.structures.end(), [s_m](const auto& structure) {
    return s_m >= structure.s_m && s_m <= structure.s_m + structure.length_m;
  });
}

std::vector<Across> Sample(std::size_t index, const network::Road& road, std::span<const Piece> pieces) {
  const network::RoadSpec& spec = road.spec();
  const geometry::CubicTable left = EdgeOf(spec, static_cast<int>(spec.sections[0].left.size())),
                             right = EdgeOf(spec, -static_cast<int>(spec.sections[0].right.size()));
  const int steps = std::max(1, static_cast<int>(std::min(std::ceil(road.length_m() / kFitStep_m), kMaxSteps)));
  std::vector<Across> samples;
  samples.reserve(static_cast<std::size_t>(steps) + 1);
  for (int i = 0; i <= steps; ++i) {
    const double s = road.length_m() * i / steps;
    const bool in_piece = std::any_of(pieces.begin(), pieces.end(), [&](const Piece& piece) {
      return piece.design == index && s >= piece.from_s_m && s <= piece.to_s_m;
    });
    samples.push_back({s, road.Surface(s, right.Value(s)).p_W, road.Surface(s, left.Value(s)).p_W,
                       in_piece && !IsOnStructure(spec, s)});
  }
  return samples;
}

// How far p lies to the left of the way from a to b; far to its right where there is none.
double LeftOf(const Vector3d& a, const Vector3d& b, const Vector2d& p) {
  const Vector2d way = (b - a).head<2>(), to = p - a.head<2>();
  const double length = way.norm();
  return length > 0.0 ? (way.x() * to.y() - way.y() * to.x()) / length : -kFar_m;
}

// The road as quadrangles from station to station. The samples must outlive it.
class Stretches {
 public:
  explicit Stretches(std::span<const Across> samples) : samples_(samples) {
    for (const Across& sample : samples_) cell_m_ = std::max(cell_m_, (sample.left_W - sample.right_W).norm());
    for (std::size_t j = 0; j + 1 < samples_.size(); ++j) {
      const Across &here = samples_[j], &next = samples_[j + 1];
      if (!here.at_grade || !next.at_grade) continue;
      Vector2d low = here.left_W.head<2>(), high = low;
      for (const Vector3d* corner : {&here.right_W, &next.right_W, &next.left_W})
        low = low.cwiseMin(corner->head<2>()), high = high.cwiseMax(corner->head<2>());
      const Cell first = CellAt(low), last = CellAt(high);
      for (std::int64_t x = first.first; x <= last.first; ++x) {
        for (std::int64_t y = first.second; y <= last.second; ++y) cells_[{x, y}].push_back(j);
      }
    }
  }

  // The station of another stretch that an edge of the i-th sample lies in.
  std::optional<double> Hold(std::size_t i, const Vector3d& edge_W) const {
    const auto cell = cells_.find(CellAt(edge_W.head<2>()));
    if (cell == cells_.end()) return std::nullopt;
    for (const std::size_t j : cell->second) {
      if (j + kOwnSteps > i && j < i + kOwnSteps) continue;
      const Across &here = samples_[j], &next = samples_[j + 1];
      const Vector2d p = edge_W.head<2>();
      // First what most of the others fail: they lie before or behind on the same road.
      const bool within = LeftOf(here.left_W, here.right_W, p) > (j == 0 ? kSeam_m : 0.0) &&
                          LeftOf(next.right_W, next.left_W, p) > (j + 2 == samples_.size() ? kSeam_m : 0.0) &&
                          LeftOf(here.right_W, next.right_W, p) > kTouches_m &&
                          LeftOf(next.left_W, here.left_W, p) > kTouches_m;
      if (!within) continue;
      const double z = 0.25 * (here.right_W + here.left_W + next.right_W + next.left_W).z();
      if (std::fabs(z - edge_W.z()) < network::Network::kLevel_m) return 0.5 * (here.s_m + next.s_m);
    }
    return std::nullopt;
  }

 private:
  Cell CellAt(const Vector2d& p) const {
    return {static_cast<std::int64_t>(std::floor(p.x() / cell_m_)),
            static_cast<std::int64_t>(std::floor(p.y() / cell_m_))};
  }

  std::span<const Across> samples_;
  double cell_m_ = kMinCell_m;
  std::map<Cell, std::vector<std::size_t>> cells_;
};

}  // namespace

void CheckFits(std::size_t index, const RoadDesign& design, const network::Road& road, std::span<const Piece> pieces,
               const TerrainIsAt& terrain_is_at) {
  const std::vector<Across> samples = Sample(index, road, pieces);
  const bool too_long = road.length_m() > kMaxSteps * kFitStep_m;
  const Stretches stretches(too_long ? std::span<const Across>() : samples);
  const char* key = design.map.Has("points") ? "points" : "axis";
  bool left_terrain = !terrain_is_at, met_itself = too_long;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const Across& sample = samples[i];
    // The middle too: a second round lies on the first edge to edge.
    const Vector3d middle_W = 0.5 * (sample.left_W + sample.right_W);
    for (const auto& [edge, name] : {std::pair(&sample.left_W, "left edge"), std::pair(&sample.right_W, "right edge"),
                                     std::pair(&middle_W, "middle")}) {
      if (!left_terrain && !IsOnStructure(road.spec(), sample.s_m) && !terrain_is_at(edge->x(), edge->y())) {
        left_terrain = true;
        design.map.Problem(key, "world.outside_of_terrain",
                           fmt::format("road '{}' leaves the terrain at s = {:.0f} m: its {} lies at ({:.1f}, {:.1f})",
                                       design.spec.id, sample.s_m, name, edge->x(), edge->y()));
      }
      if (met_itself || !sample.at_grade) continue;
      const auto other_s_m = stretches.Hold(i, *edge);
      if (!other_s_m) continue;
      met_itself = true;
      design.map.Problem(key, "world.road_does_not_fit",
                         fmt::format("road '{}' comes too near to itself: its {} at s = {:.0f} m lies on the road "
                                     "at s = {:.0f} m; move the axis, or let one of them pass on a bridge",
                                     design.spec.id, name, sample.s_m, *other_s_m));
    }
  }
}

}  // namespace rodeira::design
