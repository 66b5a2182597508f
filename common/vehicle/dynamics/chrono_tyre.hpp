// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "common/core/base/result.hpp"
#include "common/vehicle/dynamics/tyre_model.hpp"

namespace rodeira::dynamics {

// A tyre as read; its model is shared and does not change.
struct ChronoTyre {
  std::shared_ptr<const TyreModel> model;
  std::string kind;        // "Fiala", "TMeasy"
  double nominal_N = 0.0;  // load at which it is drawn
  std::vector<std::string> warnings;
};

// A tyre of the multibody program Chrono: JSON with comments, "Template": "FialaTire" or "TMeasyTire". A TMeasy tyre
// without "Parameters" gets those that its author proposes for a tyre of that payload ("Load Index" or "Maximum Bearing
// Capacity [N]") on a truck or a passenger car (G. Rill, An Engineer's Guess on Tyre Model Parameter Made Possible with
// TMeasy, 2015). Wrong input with file and line where another template is named, or a value is missing or out of range.
base::Result<ChronoTyre> ReadChronoTyre(std::string_view text, std::string_view name);

}  // namespace rodeira::dynamics
