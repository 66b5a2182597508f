// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "common/core/base/result.hpp"
#include "common/world/surface/crg_header.hpp"

namespace rodeira::surface {

// Share of the increment by which the distance of two rows or long sections may differ from it.
inline constexpr double kIncrementTolerance = 1e-3;

// Which column of the numbers holds what; -1: none does.
struct CrgColumns {
  int heading = -1, x = -1, y = -1, slope = -1, banking = -1;
  std::vector<std::size_t> heights;  // from right to left
  std::vector<double> v_m;           // of them, ascending
};

// Sorts the header's columns out. Wrong input where one is there twice, where sections are partly placed and partly
// counted, fewer than two, or at places that nothing names.
base::Result<CrgColumns> FindCrgColumns(const CrgHeader& header, std::string_view name,
                                        std::vector<std::string>& warnings);

}  // namespace rodeira::surface
