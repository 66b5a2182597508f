// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "common/world/network/marking.hpp"
#include "common/world/network/network.hpp"

namespace rodeira::road {

// Where the lane marks of an OpenDRIVE network are painted, ready to be asked.
class MarkPaint {
 public:
  explicit MarkPaint(std::shared_ptr<const network::Network> network);

  // s_m lies in the road's section of this number.
  bool At(std::uint32_t road, std::uint32_t section, double s_m, double t_m) const;

 private:
  struct Line {
    network::Marking marking;
    std::vector<double> edges_s_m;  // where the paint begins and ends, in turn
  };
  // A line near a stretch of the road; no paint of it lies beyond these t there.
  struct Near {
    std::uint32_t line = 0;
    double low_t_m = 0.0, high_t_m = 0.0;
  };
  struct Lines {
    std::vector<Line> lines;
    std::vector<std::vector<Near>> by_stretch;
  };
  static void Add(const network::Road& road, const network::Marking& marking, Lines& lines);

  std::shared_ptr<const network::Network> network_;
  std::vector<Lines> roads_;
};

}  // namespace rodeira::road
