#include "common/road/hills.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <thread>

#include "common/base/assert.hpp"
#include "common/base/crew.hpp"
#include "common/base/random.hpp"

namespace rodeira::road {
namespace {

constexpr double kAxisStep_m = 20.0;
constexpr double kNetworkStep_m = 40.0;

// The roads' heights at places north of one another, and the distances to them.
constexpr std::size_t kTogether = 8;
using Several = std::array<double, kTogether>;
struct Bases {
  Several z_m, distance_m;
};

Bases BasesAt(std::span<const Eigen::Vector3d> points, double x_m, const Several& y_m, double softness_m2) {
  Several weights{}, heights{}, nearest;
  nearest.fill(std::numeric_limits<double>::infinity());
  for (const Eigen::Vector3d& point : points) {
    const double dx = x_m - point.x(), z = point.z();
    for (std::size_t k = 0; k < kTogether; ++k) {
      const double dy = y_m[k] - point.y();
      const double squared = dx * dx + dy * dy;
      const double soft = squared + softness_m2;
      const double weight = 1.0 / (soft * soft);
      weights[k] += weight;
      heights[k] += weight * z;
      nearest[k] = std::min(nearest[k], squared);
    }
  }
  Bases bases;
  for (std::size_t k = 0; k < kTogether; ++k) bases.z_m[k] = heights[k] / weights[k], bases.distance_m[k] = std::sqrt(nearest[k]);
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
          return base::RandomUniform({spec.seed, layer, static_cast<std::uint64_t>(column), static_cast<std::uint64_t>(row), part}, -1.0, 1.0);
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
      const Gradient& g = gradients_[static_cast<std::size_t>(row + j) * columns_ + column + i];
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

std::vector<Eigen::Vector3d> AxisPoints(std::span<const Road> roads) {
  std::vector<Eigen::Vector3d> points;
  for (const Road& road : roads) {
    const int steps = static_cast<int>(std::ceil(road.length_m() / kAxisStep_m));
    for (int i = 0; i <= steps; ++i) points.push_back(road.Evaluate(road.length_m() * i / steps).p_W);
  }
  return points;
}

std::vector<Eigen::Vector3d> AxisPoints(const network::Network& network) {
  std::vector<Eigen::Vector3d> points;
  for (const network::Road& road : network.roads()) {
    if (!road.spec().junction.empty()) continue;
    const int steps = static_cast<int>(std::ceil(road.length_m() / kNetworkStep_m));
    for (int i = 0; i <= steps; ++i) points.push_back(road.Surface(road.length_m() * i / steps, 0.0).p_W);
  }
  return points;
}

terrain::ElevationGrid MakeHills(const HillsSpec& spec, std::span<const Eigen::Vector3d> axis) {
  RODEIRA_ASSERT(spec.full_m > spec.flat_m && spec.flat_m > 0.0 && spec.spacing_m > 0.0);
  std::vector<Noise> layers;
  for (std::size_t layer = 0; layer < spec.relief.size(); ++layer) layers.emplace_back(spec, layer);
  std::vector<float> heights(static_cast<std::size_t>(spec.columns) * static_cast<std::size_t>(spec.rows));
  const auto fill = [&](int column) {
    const double east = column * spec.spacing_m;
    Bases bases{};
    for (int row = 0; row < spec.rows; ++row) {
      const auto k = static_cast<std::size_t>(row) % kTogether;
      if (k == 0 && !axis.empty()) {
        Several y{};
        for (std::size_t i = 0; i < kTogether; ++i) y[i] = spec.south_m + (row + static_cast<double>(i)) * spec.spacing_m;
        bases = BasesAt(axis, spec.west_m + east, y, spec.flat_m * spec.flat_m);
      }
      double z = spec.base_z_m, grown = 1.0;
      if (!axis.empty()) {
        const double u = std::clamp((bases.distance_m[k] - spec.flat_m) / (spec.full_m - spec.flat_m), 0.0, 1.0);
        z = bases.z_m[k] - spec.below_m;
        grown = u * u * (3.0 - 2.0 * u);
      }
      if (grown > 0.0) {
        for (std::size_t layer = 0; layer < layers.size(); ++layer) {
          z += grown * spec.relief[layer].amplitude_m * layers[layer].At(east, row * spec.spacing_m);
        }
      }
      heights[static_cast<std::size_t>(column) * static_cast<std::size_t>(spec.rows) + static_cast<std::size_t>(row)] = static_cast<float>(z);
    }
  };
  base::Crew crew(std::max(1u, std::thread::hardware_concurrency()));  // each post by itself: the same bits by any number of threads
  crew.Share(static_cast<std::size_t>(spec.columns), [&](std::size_t begin, std::size_t end) {
    for (std::size_t column = begin; column < end; ++column) fill(static_cast<int>(column));
  });
  const terrain::ElevationGrid::Frame frame{spec.columns, spec.rows, spec.west_m, spec.south_m,
                                            spec.west_m + (spec.columns - 1) * spec.spacing_m,
                                            spec.south_m + (spec.rows - 1) * spec.spacing_m};
  return terrain::ElevationGrid(frame, std::move(heights), spec.projection_wkt);
}

}  // namespace rodeira::road
