// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "common/world/network/network.hpp"

namespace rodeira::road {

// Where the painted lines of a network's roads are, ready to be asked. It keeps the network's tables, not the network.
class Paint {
 public:
  Paint() = default;
  explicit Paint(const network::Network& network);

  // Whether a line is painted at (s, t) of the road. Precondition: a road of the network.
  bool At(std::uint32_t road, double s_m, double t_m) const;
  // False: nothing is painted anywhere between these.
  bool MayBe(std::uint32_t road, double low_s_m, double high_s_m, double low_t_m, double high_t_m) const;

 private:
  struct Line {
    double from_s_m, to_s_m, half_width_m;
    double low_t_m, high_t_m;  // no paint of it lies beyond
    const geometry::CubicTable* t;
    std::vector<double> edges_s_m;  // where the paint begins and ends, in turn
  };
  struct Lines {
    std::vector<Line> lines;
    std::vector<std::vector<std::uint32_t>> by_stretch;  // of kPaintStretch_m

    std::size_t StretchAt(double s_m) const;
  };
  std::vector<Lines> roads_;
};

}  // namespace rodeira::road
