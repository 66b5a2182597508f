// SPDX-License-Identifier: Apache-2.0
#include "common/world/road/hills.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>

#include "common/core/base/assert.hpp"
#include "common/core/base/random.hpp"
#include "common/core/base/thread_pool.hpp"
#include "common/world/road/decks.hpp"

namespace rodeira::road {
namespace {

constexpr double kAxisStep_m = 20.0;
constexpr double kNetworkStep_m = 40.0;

// Heights at places north of one another, and the distances to the nearest point of a road.
constexpr std::size_t kTogether = 8;
using Several = std::array<double, kTogether>;
struct Bases {
  Several z_m, distance_m;
};

// The points that may reach a column of the grid, with their heights already below the axis; what none reaches has the
// base's height.
Bases BasesAt(const HillsSpec& spec, double base_z_m, std::span<const AxisPoint> points, double x_m,
              const Several& y_m) {
  const double softness_m2 = spec.flat_m * spec.flat_m, per_reach2 = 1.0 / (spec.reach_m * spec.reach_m),
               base_weight = 4.0 / (spec.reach_m * spec.reach_m * spec.reach_m);
  Several weights, heights, nearest;
  weights.fill(base_weight);
  heights.fill(base_weight * base_z_m);
  nearest.fill(std::numeric_limits<double>::infinity());
  for (const AxisPoint& point : points) {
    const double dx = x_m - point.p_W.x(), z = point.p_W.z() - spec.below_m, length = point.length_m;
    for (std::size_t k = 0; k < kTogether; ++k) {
      const double dy = y_m[k] - point.p_W.y();
      const double squared = dx * dx + dy * dy;
      const double soft = squared + softness_m2;
      const double left = std::max(0.0, 1.0 - squared * per_reach2);
      const double weight = length * (left * left * left) / (soft * soft);
      weights[k] += weight;
      heights[k] += weight * z;
      nearest[k] = std::min(nearest[k], squared);
    }
  }
  Bases bases;
  for (std::size_t k = 0; k < kTogether; ++k)
    bases.z_m[k] = heights[k] / weights[k], bases.distance_m[k] = std::sqrt(nearest[k]);
  return bases;
}

// Gradient noise (K. Perlin, SIGGRAPH 1985, with the fifth-degree fade of 2002) with random gradients on a lattice.
class Noise {
 public:
  Noise(const HillsSpec& spec, std::size_t layer) : cells_per_m_(1.0 / spec.relief[layer].wavelength_m) {
    columns_ = static_cast<int>((spec.columns - 1) * spec.spacing_m * cells_per_m_) + 2;
    const int rows = static_cast<int>((spec.rows - 1) * spec.spacing_m * cells_per_m_) + 2;
    for (int row = 0; row < rows; ++row) {
      for (int column = 0; column < columns_; ++column) {
        const auto draw = [&](std::uint64_t part) {
          return base::RandomUniform(
              {spec.seed, layer, static_cast<std::uint64_t>(column), static_cast<std::uint64_t>(row), part}, -1.0, 1.0);
        };
        gradients_.push_back({draw(0), draw(1)});
      }
    }
  }

  // East and north of the grid's south-west corner. Within about ±1.
  double At(double east_m, double north_m) const {
    const double across = east_m * cells_per_m_, along = north_m * cells_per_m_;
    const int column = static_cast<int>(across), row = static_cast<int>(along);
    const double u = across - column, v = along - row;
    const auto corner = [&](int i, int j) {
      const Gradient& g = gradients_[static_cast<std::size_t>(row + j) * static_cast<std::size_t>(columns_) +
                                     static_cast<std::size_t>(column + i)];
      return g.x * (u - i) + g.y * (v - j);
    };
    const double fu = Fade(u), fv = Fade(v);
    const double south = corner(0, 0) + fu * (corner(1, 0) - corner(0, 0));
    const double north = corner(0, 1) + fu * (corner(1, 1) - corner(0, 1));
    return south + fv * (north - south);
  }

 private:
  struct Gradient {
    double x, y;
  };
  static double Fade(double u) { return u * u * u * (u * (u * 6.0 - 15.0) + 10.0); }

  double cells_per_m_;
  int columns_;
  std::vector<Gradient> gradients_;
};

}  // namespace

namespace {

// Points from one station to another, at most `step_m` apart, that stand for the way between them.
template <class At>
void AddPoints(double from_s_m, double to_s_m, double step_m, const At& at, std::vector<AxisPoint>& points) {
  const int steps = std::max(1, static_cast<int>(std::ceil((to_s_m - from_s_m) / step_m)));
  const double length_m = (to_s_m - from_s_m) / steps;
  for (int i = 0; i <= steps; ++i)
    points.push_back(
        {at(from_s_m + (to_s_m - from_s_m) * i / steps), i == 0 || i == steps ? 0.5 * length_m : length_m});
}

// Where a road is carried by bridges or runs in tunnels, ascending and apart.
std::vector<Stretch> StructuresOf(const network::Road& road) {
  std::vector<Stretch> all, apart;
  for (const network::Structure& structure : road.spec().structures) {
    const Stretch stretch{std::max(structure.s_m, 0.0), std::min(structure.s_m + structure.length_m, road.length_m())};
    if (stretch.from_s_m < stretch.to_s_m) all.push_back(stretch);
  }
  std::sort(all.begin(), all.end(), [](const Stretch& a, const Stretch& b) { return a.from_s_m < b.from_s_m; });
  for (const Stretch& stretch : all) {
    if (apart.empty() || stretch.from_s_m > apart.back().to_s_m)
      apart.push_back(stretch);
    else
      apart.back().to_s_m = std::max(apart.back().to_s_m, stretch.to_s_m);
  }
  return apart;
}

}  // namespace

std::vector<AxisPoint> AxisPoints(std::span<const Road> roads) {
  std::vector<AxisPoint> points;
  for (const Road& road : roads)
    AddPoints(
        0.0, road.length_m(), kAxisStep_m, [&](double s_m) { return road.Evaluate(s_m).p_W; }, points);
  return points;
}

std::vector<AxisPoint> AxisPoints(const network::Network& network, bool structures) {
  std::vector<AxisPoint> points;
  for (const network::Road& road : network.roads()) {
    if (!road.spec().junction.empty()) continue;
    const std::vector<Stretch> standing = StandingOn(road, structures ? std::vector<Stretch>() : StructuresOf(road));
    for (const geometry::PlanElement& element : road.axis().elements()) {
      const double from_s_m = element.s_m, to_s_m = std::min(element.s_m + element.length_m, road.length_m());
      for (const Stretch& stretch : standing) {
        const double begin = std::max(from_s_m, stretch.from_s_m), end = std::min(to_s_m, stretch.to_s_m);
        if (begin < end)
          AddPoints(
              begin, end, kNetworkStep_m, [&](double s_m) { return road.Surface(s_m, 0.0).p_W; }, points);
      }
    }
  }
  return points;
}

double BaseOf(std::span<const AxisPoint> axis) {
  double length_m = 0.0, sum = 0.0;
  for (const AxisPoint& point : axis) length_m += point.length_m, sum += point.length_m * point.p_W.z();
  return length_m > 0.0 ? 10.0 * std::round(0.1 * sum / length_m) : 0.0;
}

terrain::ElevationGrid::Frame FrameOf(const HillsSpec& spec) {
  return {spec.columns,
          spec.rows,
          spec.west_m,
          spec.south_m,
          spec.west_m + (spec.columns - 1) * spec.spacing_m,
          spec.south_m + (spec.rows - 1) * spec.spacing_m};
}

terrain::ElevationGrid MakeHills(const HillsSpec& spec, std::span<const AxisPoint> axis) {
  RODEIRA_ASSERT(spec.full_m > spec.flat_m && spec.flat_m > 0.0 && spec.spacing_m > 0.0 && spec.reach_m >= spec.full_m);
  const double base_z_m = spec.base_z_m.value_or(BaseOf(axis) - (axis.empty() ? 0.0 : spec.below_m));
  std::vector<Noise> layers;
  for (std::size_t layer = 0; layer < spec.relief.size(); ++layer) layers.emplace_back(spec, layer);
  std::vector<float> heights(static_cast<std::size_t>(spec.columns) * static_cast<std::size_t>(spec.rows));
  const auto fill = [&](int column) {
    const double east = column * spec.spacing_m, x_m = spec.west_m + east;
    std::vector<AxisPoint> near;
    std::copy_if(axis.begin(), axis.end(), std::back_inserter(near),
                 [&](const AxisPoint& point) { return std::fabs(point.p_W.x() - x_m) < spec.reach_m; });
    Bases bases{};
    for (int row = 0; row < spec.rows; ++row) {
      const auto k = static_cast<std::size_t>(row) % kTogether;
      if (k == 0) {
        Several y{};
        for (std::size_t i = 0; i < kTogether; ++i)
          y[i] = spec.south_m + (row + static_cast<double>(i)) * spec.spacing_m;
        bases = BasesAt(spec, base_z_m, near, x_m, y);
      }
      const double u = std::clamp((bases.distance_m[k] - spec.flat_m) / (spec.full_m - spec.flat_m), 0.0, 1.0),
                   grown = u * u * (3.0 - 2.0 * u);
      double z = bases.z_m[k];
      if (grown > 0.0) {
        for (std::size_t layer = 0; layer < layers.size(); ++layer) {
          z += grown * spec.relief[layer].amplitude_m * layers[layer].At(east, row * spec.spacing_m);
        }
      }
      heights[static_cast<std::size_t>(column) * static_cast<std::size_t>(spec.rows) + static_cast<std::size_t>(row)] =
          static_cast<float>(z);
    }
  };
  base::ThreadPool pool(0);  // each post by itself: the same bits by any number of threads
  pool.ParallelFor(static_cast<std::size_t>(spec.columns), [&](std::size_t begin, std::size_t end) {
    for (std::size_t column = begin; column < end; ++column) fill(static_cast<int>(column));
  });
  return terrain::ElevationGrid(FrameOf(spec), std::move(heights), spec.projection_wkt);
}

}  // namespace rodeira::road
