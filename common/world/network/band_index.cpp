// SPDX-License-Identifier: Apache-2.0
#include "common/world/network/band_index.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/base/constants.hpp"
#include "common/core/geometry/plane.hpp"

namespace rodeira::network {
namespace {

constexpr double kSlack_m = BandIndex::kSlack_m;
constexpr double kMaxCells = 4e6;
constexpr std::uint32_t kLeaf = 4;

// What is closed between a panel's end and the next one's beginning.
double ClosedBetween(const geometry::PlanAxis& axis, std::size_t before, double closed_m) {
  constexpr double kSmooth = 1e-9;  // metres, and radians
  const auto& panels = axis.panels();
  if (before + 1 >= panels.size()) return closed_m;
  const geometry::PlanPoint end = axis.At(panels[before], panels[before].half_m),
                            begin = axis.At(panels[before + 1], -panels[before + 1].half_m);
  const bool smooth = (end.p_W - begin.p_W).norm() < kSmooth && (end.tangent_W - begin.tangent_W).norm() < kSmooth;
  return smooth ? kSlack_m : closed_m;
}

// Of an angle between two stations, without its sign.
double LargestSine(const geometry::CubicTable& angle, double low_s_m, double high_s_m) {
  double smallest, largest;
  angle.Bounds(low_s_m, high_s_m, smallest, largest);
  const double most = std::max(std::fabs(smallest), std::fabs(largest));
  return most < 0.5 * base::kPi ? std::sin(most) : 1.0;
}

// Of how steeply a height climbs or falls between two stations.
double SteepestSine(const geometry::CubicTable& height, double low_s_m, double high_s_m) {
  const std::vector<geometry::Cubic>& records = height.records();
  double steepest = 0.0;
  for (std::size_t i = 0; i < records.size(); ++i) {
    const double from = i == 0 ? low_s_m : std::max(low_s_m, records[i].from);
    const double to = i + 1 < records.size() ? std::min(high_s_m, records[i + 1].from) : high_s_m;
    if (from > to) continue;
    const double flex =
        records[i].d == 0.0 ? from : std::clamp(records[i].from - records[i].c / (3.0 * records[i].d), from, to);
    for (const double s : {from, flex, to}) steepest = std::max(steepest, std::fabs(records[i].Slope(s)));
  }
  return steepest / std::sqrt(1.0 + steepest * steepest);
}

Band MakeBand(const Road& road, std::uint32_t road_index, std::uint32_t panel_index, double closed_m) {
  const geometry::PlanAxis& axis = road.axis();
  const geometry::AxisPanel& panel = axis.panels()[panel_index];
  // The lanes' edges over all sections that the panel passes; where one ends at a joint, both sides count.
  double right = 0.0, left = 0.0;
  const std::vector<LaneSection>& sections = road.spec().sections;
  bool any = false;
  for (std::size_t i = 0; i < sections.size(); ++i) {
    const double from = i == 0 ? panel.begin_s_m() : std::max(panel.begin_s_m(), sections[i].s_m);
    const double to = i + 1 == sections.size() ? panel.end_s_m() : std::min(panel.end_s_m(), sections[i].end_s_m);
    if (from > to) continue;
    double section_right, section_left;
    sections[i].Bounds(road.spec().lane_offset, from, to, section_right, section_left);
    right = any ? std::min(right, section_right) : section_right;
    left = any ? std::max(left, section_left) : section_left;
    any = true;
  }
  const Eigen::Vector2d begin = axis.At(panel, -panel.half_m).p_W, end = axis.At(panel, panel.half_m).p_W;
  Band band;
  band.road = road_index;
  band.panel = panel_index;
  const Eigen::Vector2d chord = end - begin;
  const double length = chord.norm();
  band.along_W = length > 0.0 ? Eigen::Vector2d(chord / length) : axis.At(panel, 0.0).tangent_W;
  double turn = 0.0;  // sine of the largest angle between the panel and its chord
  for (int i = -4; i <= 4; ++i)
    turn = std::max(turn, std::fabs(geometry::Cross(band.along_W, axis.At(panel, 0.25 * i * panel.half_m).tangent_W)));
  turn = std::min(1.0, 1.25 * turn);
  const double reach = std::max(std::fabs(left), std::fabs(right));
  const double bulge = axis.Bulge(panel) + kSlack_m;
  double along = turn * reach + bulge + closed_m;
  double low = std::min(right, right * std::sqrt(1.0 - turn * turn)),
         high = std::max(left, left * std::sqrt(1.0 - turn * turn));
  const double from_s = std::max(panel.begin_s_m(), 0.0), to_s = std::min(panel.end_s_m(), road.length_m());
  if (road.LeansBetween(from_s, to_s)) {  // the section leans forward on a slope, and is narrower seen from above
    along += reach * LargestSine(road.spec().superelevation, from_s, to_s) *
             SteepestSine(road.spec().elevation, from_s, to_s);
    low = std::min(low, 0.0), high = std::max(high, 0.0);
  }
  band.centre_W = 0.5 * (begin + end) + 0.5 * (low + high) * geometry::Left(band.along_W);
  band.half_along_m = 0.5 * length + along;
  band.half_across_m = 0.5 * (high - low) + bulge + turn * closed_m;
  const auto at_end = [&](const auto& link) {
    return link ? closed_m : kSlack_m;
  };  // where it leads nowhere, there is no gap
  band.closed_before_m =
      panel_index == 0 ? at_end(road.spec().predecessor) : ClosedBetween(axis, panel_index - 1, closed_m);
  band.closed_behind_m =
      panel.end_s_m() >= road.length_m() ? at_end(road.spec().successor) : ClosedBetween(axis, panel_index, closed_m);
  return band;
}

// How far the middle of a square of the grid may be from that of a band's rectangle, along the sides of both, where
// they may touch.
struct Reach {
  Reach(const Band& band, double half_m) {
    const Eigen::Vector2d along = band.along_W.cwiseAbs();
    const double turned_m = half_m * along.sum() + kSlack_m;
    along_m = band.half_along_m + turned_m, across_m = band.half_across_m + turned_m;
    x_m = band.half_along_m * along.x() + band.half_across_m * along.y() + half_m + kSlack_m;
    y_m = band.half_along_m * along.y() + band.half_across_m * along.x() + half_m + kSlack_m;
  }
  double along_m, across_m, x_m, y_m;
};

// Whether a band's rectangle and a square of the grid may have a point in common: where no line along a side of either
// parts them.
bool Touches(const Band& band, const Eigen::Vector2d& centre_W, double half_m) {
  const Eigen::Vector2d away = centre_W - band.centre_W;
  const Reach reach(band, half_m);
  return std::fabs(away.dot(band.along_W)) <= reach.along_m &&
         std::fabs(geometry::Cross(band.along_W, away)) <= reach.across_m && std::fabs(away.x()) <= reach.x_m &&
         std::fabs(away.y()) <= reach.y_m;
}

}  // namespace

double Band::Distance(const Eigen::Vector2d& p_W) const {
  const Eigen::Vector2d away = p_W - centre_W;
  const double ahead = std::max(0.0, std::fabs(away.dot(along_W)) - half_along_m);
  const double aside = std::max(0.0, std::fabs(geometry::Cross(along_W, away)) - half_across_m);
  return std::sqrt(ahead * ahead + aside * aside);
}

BandIndex::BandIndex(std::span<const Road> roads, double closed_m) {
  AddBands(roads, closed_m);
  if (bands_.empty()) return;
  BuildGrid();
  std::vector<Eigen::Vector2d> low, high;
  for (const Band& band : bands_) {
    const Eigen::Vector2d reach =
        band.half_along_m * band.along_W.cwiseAbs() + band.half_across_m * geometry::Left(band.along_W).cwiseAbs();
    low.push_back(band.centre_W - reach);
    high.push_back(band.centre_W + reach);
    order_.push_back(static_cast<std::uint32_t>(order_.size()));
  }
  BuildTree(0, static_cast<std::uint32_t>(bands_.size()), low, high);
}

void BandIndex::AddBands(std::span<const Road> roads, double closed_m) {
  for (std::uint32_t road = 0; road < roads.size(); ++road) {
    const auto& panels = roads[road].axis().panels();
    for (std::uint32_t panel = 0; panel < panels.size(); ++panel) {
      if (panel > 0 && panels[panel].begin_s_m() > roads[road].length_m()) break;
      bands_.push_back(MakeBand(roads[road], road, panel, closed_m));
    }
  }
}

void BandIndex::BuildGrid() {
  Eigen::Vector2d low = bands_[0].centre_W, high = low;
  for (const Band& band : bands_) {
    const Eigen::Vector2d reach = Eigen::Vector2d::Constant(band.half_along_m + band.half_across_m + kSlack_m);
    low = low.cwiseMin(band.centre_W - reach);
    high = high.cwiseMax(band.centre_W + reach);
  }
  origin_W_ = low;
  const Eigen::Vector2d size = high - low;
  cell_m_ = std::max(cell_m_, std::sqrt(size.x() * size.y() / kMaxCells));
  columns_ = std::floor(size.x() / cell_m_) + 1.0;
  rows_ = std::floor(size.y() / cell_m_) + 1.0;
  const auto each_cell = [&](const Band& band, const auto& use) {
    const Eigen::Vector2d reach =
        band.half_along_m * band.along_W.cwiseAbs() + band.half_across_m * geometry::Left(band.along_W).cwiseAbs();
    const auto index = [&](double value, double origin, double count) {
      return std::clamp(std::floor((value - origin) / cell_m_), 0.0, count - 1.0);
    };
    const double row_high = index(band.centre_W.y() + reach.y(), low.y(), rows_),
                 column_high = index(band.centre_W.x() + reach.x(), low.x(), columns_);
    for (double row = index(band.centre_W.y() - reach.y(), low.y(), rows_); row <= row_high; row += 1.0) {
      for (double column = index(band.centre_W.x() - reach.x(), low.x(), columns_); column <= column_high;
           column += 1.0) {
        const Eigen::Vector2d centre = origin_W_ + cell_m_ * Eigen::Vector2d(column + 0.5, row + 0.5);
        if (Touches(band, centre, 0.5 * cell_m_)) use(column, row, centre);
      }
    }
  };
  block_columns_ = static_cast<std::size_t>(columns_) / kBlock + 1;
  blocks_.assign(block_columns_ * (static_cast<std::size_t>(rows_) / kBlock + 1), 0);
  for (const Band& band : bands_) {
    each_cell(band, [&](double column, double row, const Eigen::Vector2d&) {
      blocks_[static_cast<std::size_t>(row) / kBlock * block_columns_ + static_cast<std::size_t>(column) / kBlock] = 1;
    });
  }
  std::uint32_t blocks = 0;
  for (std::uint32_t& block : blocks_) block = block == 0 ? 0 : ++blocks;
  first_.assign(blocks * kBlock * kBlock + 1, 0);
  for (const Band& band : bands_)
    each_cell(band, [&](double column, double row, const Eigen::Vector2d&) { ++first_[CellOf(column, row)]; });
  for (std::size_t cell = 0; cell + 1 < first_.size(); ++cell) first_[cell + 1] += first_[cell];
  cell_bands_.resize(first_.back());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for (std::uint32_t i = 0; i < bands_.size(); ++i) {
    each_cell(bands_[i], [&](double column, double row, const Eigen::Vector2d& centre) {
      cell_bands_[next[CellOf(column, row) - 1]++] = {i, PartsOf(bands_[i], centre)};
    });
  }
}

// As Touches says of each square of a cell.
std::uint32_t BandIndex::PartsOf(const Band& band, const Eigen::Vector2d& cell_centre_W) const {
  const double part_m = cell_m_ / kParts;
  const Eigen::Vector2d first =
      cell_centre_W - Eigen::Vector2d::Constant(0.5 * (cell_m_ - part_m)) - band.centre_W;  // the first square's centre
  const Reach reach(band, 0.5 * part_m);
  const double ahead = first.dot(band.along_W), aside = geometry::Cross(band.along_W, first);
  std::uint32_t parts = 0;
  for (std::uint32_t row = 0; row < kParts; ++row) {
    const double up = part_m * row;
    if (std::fabs(first.y() + up) > reach.y_m) continue;
    for (std::uint32_t column = 0; column < kParts; ++column) {
      const double right = part_m * column;
      const bool touches = std::fabs(first.x() + right) <= reach.x_m &&
                           std::fabs(ahead + right * band.along_W.x() + up * band.along_W.y()) <= reach.along_m &&
                           std::fabs(aside + up * band.along_W.x() - right * band.along_W.y()) <= reach.across_m;
      parts |= std::uint32_t{touches} << (row * kParts + column);
    }
  }
  return parts;
}

std::optional<std::uint32_t> BandIndex::OnlyOne(const Eigen::Vector2d& low_W, const Eigen::Vector2d& high_W) const {
  const Eigen::Vector2d size = high_W - low_W, middle = low_W + 0.5 * size;
  if (!(size.x() <= kWidest_m && size.y() <= kWidest_m)) return std::nullopt;
  const double radius = 0.5 * size.norm() + kSlack_m;
  std::optional<std::uint32_t> only;
  // A cell is wider than the box: what holds some of it is known in a corner's cell.
  for (const Eigen::Vector2d& corner :
       {low_W, high_W, Eigen::Vector2d(low_W.x(), high_W.y()), Eigen::Vector2d(high_W.x(), low_W.y())}) {
    for (const CellBand& listed :
         Listed((corner.x() - origin_W_.x()) / cell_m_, (corner.y() - origin_W_.y()) / cell_m_)) {
      const std::uint32_t index = listed.band;
      if (only == index) continue;
      const Band& band = bands_[index];
      const Eigen::Vector2d away = middle - band.centre_W;
      const double ahead = std::fabs(away.dot(band.along_W)), aside = std::fabs(geometry::Cross(band.along_W, away));
      if (ahead > band.half_along_m + radius || aside > band.half_across_m + radius) continue;
      if (only || ahead > band.half_along_m - radius || aside > band.half_across_m - radius) return std::nullopt;
      only = index;
    }
  }
  return only;
}

std::uint32_t BandIndex::BuildTree(std::uint32_t first, std::uint32_t last, std::span<const Eigen::Vector2d> low,
                                   std::span<const Eigen::Vector2d> high) {
  const auto index = static_cast<std::uint32_t>(nodes_.size());
  nodes_.emplace_back();
  Eigen::Vector2d node_low = low[order_[first]], node_high = high[order_[first]];
  for (std::uint32_t i = first; i < last; ++i) {
    node_low = node_low.cwiseMin(low[order_[i]]);
    node_high = node_high.cwiseMax(high[order_[i]]);
  }
  nodes_[index].low = node_low;
  nodes_[index].high = node_high;
  if (last - first <= kLeaf) {
    nodes_[index].first = first;
    nodes_[index].count = last - first;
    return index;
  }
  const Eigen::Vector2d size = node_high - node_low;
  const int axis = size.x() >= size.y() ? 0 : 1;
  const std::uint32_t middle = first + (last - first) / 2;
  std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + last,
                   [&](std::uint32_t a, std::uint32_t b) {
                     const double at_a = bands_[a].centre_W[axis], at_b = bands_[b].centre_W[axis];
                     return at_a < at_b || (at_a == at_b && a < b);
                   });
  BuildTree(first, middle, low, high);
  nodes_[index].right = BuildTree(middle, last, low, high);
  return index;
}

}  // namespace rodeira::network
