// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "common/core/base/result.hpp"
#include "common/world/surface/crg_surface.hpp"
#include "common/world/surface/crg_table.hpp"

namespace rodeira::surface {

// Puts the grid together from what the header says and the numbers are:
// - u from start_u (0), a row every increment; the sections where they say "at v =", otherwise evenly from v_right to
//   v_left, or about the middle where only the increment is given;
// - the reference line from (start_x, start_y) = (0, 0) by a step of the increment in the direction of each row's
//   heading, or straight on in start_phi (0); where the header says end_x and end_y, what is missing to them is shared
//   evenly among the steps, and the same for z by the rows' slopes, or start_s (0) everywhere;
// - scales and missing heights as the modifiers say.
// Wrong input where a part does not fit another: an end by more than 1 % of the length, a bend of 90 degrees in a row.
// Smaller gaps, from 0.01 % on, are warnings.
base::Result<CrgShape> BuildCrgShape(const CrgHeader& header, const CrgTable& table, const CrgModifiers& modifiers,
                                     const CrgOptions& options, std::string_view name,
                                     std::vector<std::string>& warnings);

// Moves it as the modifiers say: the reference point to its place, or else turned and shifted.
CrgShape PlaceCrgShape(CrgShape shape, const CrgModifiers& modifiers);

}  // namespace rodeira::surface
