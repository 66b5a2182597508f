// SPDX-License-Identifier: Apache-2.0
#include "common/world/network/cluster_band.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "common/core/geometry/plane.hpp"

namespace rodeira::network {
namespace {

constexpr double kApart_m = 1e-3;     // far above BandIndex::kSlack_m, by which a smooth joint is closed
constexpr std::size_t kMaxBands = 3;  // of one road: a panel and its neighbours
constexpr double kMaxHalfTurn_rad = 0.26;

geometry::PlanPoint EndOf(const geometry::PlanAxis& axis, const geometry::AxisPanel& panel, bool last) {
  return axis.At(panel, last ? panel.half_m : -panel.half_m);
}

// All bands with rectangles that touch a box, ascending; false where there are more than a few.
bool Touching(const BandIndex& index, const Eigen::Vector2d& low_W, const Eigen::Vector2d& high_W,
              std::array<std::uint32_t, kMaxBands>& bands, std::size_t& count) {
  const Eigen::Vector2d size = high_W - low_W, middle = low_W + 0.5 * size;
  // A part of a cell is wider than this: what touches some of the box is listed at a corner.
  constexpr double kWidest_m = 1.5;
  if (!(size.x() <= kWidest_m && size.y() <= kWidest_m)) return false;
  const double radius = 0.5 * size.norm() + BandIndex::kSlack_m;
  count = 0;
  bool few = true;
  for (const Eigen::Vector2d& corner :
       {low_W, high_W, Eigen::Vector2d(low_W.x(), high_W.y()), Eigen::Vector2d(high_W.x(), low_W.y())}) {
    index.Around(corner, [&](std::uint32_t listed) {
      const Band& band = index.bands()[listed];
      const Eigen::Vector2d away = middle - band.centre_W;
      if (std::fabs(away.dot(band.along_W)) > band.half_along_m + radius ||
          std::fabs(geometry::Cross(band.along_W, away)) > band.half_across_m + radius)
        return;
      const auto end = bands.begin() + static_cast<std::ptrdiff_t>(count);
      if (std::find(bands.begin(), end, listed) != end) return;
      if (count == kMaxBands) {
        few = false;
        return;
      }
      std::size_t at = count++;
      for (; at > 0 && bands[at - 1] > listed; --at) bands[at] = bands[at - 1];
      bands[at] = listed;
    });
  }
  return few && count > 0;
}

// Whether a neighbour says nothing of the points. A point p that lies at (a, b) of the line across its beginning, a < 0
// behind it, has no foot on it: ahead of p at the station u, turned by x, is a cos x + b sin x less the way along the
// tangent there, at least u cos x, with |sin x| <= K u. So while K |b| is below cos x, nothing is nearer than the
// beginning, which is more than |a| away along the line.
bool SaysNothing(const geometry::PlanAxis& axis, const geometry::AxisPanel& neighbour, bool follows,
                 const Cluster& cluster) {
  const auto rate = axis.RateOf(neighbour);
  if (!rate) return false;
  const double steepest = std::fabs(neighbour.curvature_1pm) + std::fabs(*rate) * neighbour.half_m;
  if (!(steepest * neighbour.half_m <= kMaxHalfTurn_rad)) return false;
  const geometry::PlanPoint joint = EndOf(axis, neighbour, !follows);
  const double sign = follows ? 1.0 : -1.0, x = joint.p_W.x(), y = joint.p_W.y(), T_x = joint.tangent_W.x(),
               T_y = joint.tangent_W.y();
  std::int64_t near = 0;
  for (std::size_t i = 0; i < cluster.feet.count; ++i) {
    const double away_x = cluster.feet.x_m[i] - x, away_y = cluster.feet.y_m[i] - y;
    const double ahead = sign * (away_x * T_x + away_y * T_y), aside = std::fabs(T_x * away_y - T_y * away_x);
    near += ahead < -kApart_m && steepest * aside < 0.8 ? 0 : 1;
  }
  return near == 0;
}

}  // namespace

std::optional<ClusterBand> FindBand(const BandIndex& index, std::span<const Road> roads, const Eigen::Vector2d& low_W,
                                    const Eigen::Vector2d& high_W) {
  if (const auto only = index.OnlyOne(low_W, high_W)) return ClusterBand{*only};
  std::array<std::uint32_t, kMaxBands> bands;
  std::size_t count;
  if (!Touching(index, low_W, high_W, bands, count) || count < 2) return std::nullopt;
  // The bands of a road follow one another as its panels do. The box lies between the beginning of the last panel that
  // its middle is past, and its end.
  std::size_t on = 0;
  const Eigen::Vector2d middle = 0.5 * (low_W + high_W);
  for (std::size_t i = 1; i < count; ++i) {
    const Band &band = index.bands()[bands[i]], &before = index.bands()[bands[i - 1]];
    if (bands[i] != bands[i - 1] + 1 || band.road != before.road) return std::nullopt;
    const geometry::PlanAxis& axis = roads[band.road].axis();
    const geometry::PlanPoint begin = EndOf(axis, axis.panels()[band.panel], false);
    if ((middle - begin.p_W).dot(begin.tangent_W) > 0.0) on = i;
  }
  const Band& band = index.bands()[bands[on]];
  const Eigen::Vector2d away = middle - band.centre_W;
  const double radius = 0.5 * (high_W - low_W).norm() + BandIndex::kSlack_m;
  if (std::fabs(away.dot(band.along_W)) > band.half_along_m - radius ||
      std::fabs(geometry::Cross(band.along_W, away)) > band.half_across_m - radius)
    return std::nullopt;
  if (on > 1 || on + 2 < count) return std::nullopt;  // farther away along the road
  return ClusterBand{bands[on], on > 0, on + 1 < count};
}

bool IsApart(const ClusterBand& found, const BandIndex& index, const Road& road, const Cluster& cluster) {
  const geometry::PlanAxis& axis = road.axis();
  const auto& panels = axis.panels();
  const Band& band = index.bands()[found.band];
  const geometry::AxisPanel& panel = panels[band.panel];
  if (found.before) {
    if (index.bands()[found.band - 1].closed_behind_m > BandIndex::kSlack_m ||
        !(cluster.low_s_m > panel.begin_s_m() + kApart_m))
      return false;
    if (!SaysNothing(axis, panels[band.panel - 1], false, cluster)) return false;
  }
  if (found.behind) {
    if (index.bands()[found.band + 1].closed_before_m > BandIndex::kSlack_m ||
        !(cluster.high_s_m < panel.end_s_m() - kApart_m))
      return false;
    if (!SaysNothing(axis, panels[band.panel + 1], true, cluster)) return false;
  }
  return true;
}

}  // namespace rodeira::network
