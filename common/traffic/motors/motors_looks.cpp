// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/motors/motors_looks.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "common/traffic/motors/motors_driver.hpp"
#include "common/world/network/network.hpp"

namespace rodeira::traffic {
namespace {

// Of the lower left corner of a look's box.
struct Cell {
  std::int64_t x = 0, y = 0;
  std::uint32_t look = 0;
};

}  // namespace

void EachCrossing(const std::vector<MotorsLook>& looks,
                  const std::function<void(const MotorsLook&, const MotorsLook&)>& tell) {
  double longest_m = 1.0;  // no box is wider or higher, so that those that meet have their corners in one cell, or in
                           // cells side by side
  for (const MotorsLook& look : looks)
    longest_m = std::max({longest_m, std::fabs(look.to.x() - look.from.x()), std::fabs(look.to.y() - look.from.y())});
  std::vector<Cell> cells;
  for (std::uint32_t i = 0; i < looks.size(); ++i) {
    const auto cell = [&](double a, double b) {
      return static_cast<std::int64_t>(std::floor(std::min(a, b) / longest_m));
    };
    cells.push_back({cell(looks[i].from.x(), looks[i].to.x()), cell(looks[i].from.y(), looks[i].to.y()), i});
  }
  const auto before = [](const Cell& a, const Cell& b) {
    return std::tie(a.x, a.y, a.look) < std::tie(b.x, b.y, b.look);
  };
  std::sort(cells.begin(), cells.end(), before);
  const auto compare = [&](const Cell& one, const Cell& other) {
    const MotorsLook &a = looks[one.look], &b = looks[other.look];
    if (std::fabs(a.z_m - b.z_m) <= network::Network::kLevel_m && SegmentsCross(a.from, a.to, b.from, b.to)) tell(a, b);
  };
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const Cell& own = cells[i];
    for (std::size_t k = i + 1; k < cells.size() && cells[k].x == own.x && cells[k].y <= own.y + 1; ++k)
      compare(own, cells[k]);
    const Cell first{own.x + 1, own.y - 1, 0};
    for (auto k = std::lower_bound(cells.begin(), cells.end(), first, before);
         k != cells.end() && k->x == own.x + 1 && k->y <= own.y + 1; ++k)
      compare(own, *k);
  }
}

}  // namespace rodeira::traffic
