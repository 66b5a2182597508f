// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>

#include "common/vehicle/fmi/description.hpp"

namespace rodeira::dynamics {

// How a value of an FMU becomes one of ours: factor times value plus offset.
struct UnitConversion {
  double factor = 1.0;
  double offset = 0.0;

  bool is_identity() const { return factor == 1.0 && offset == 0.0; }
};

// From a unit that the FMU declares to one of ours ("m", "rad", "m/s", "rad/s", "N", "N.m", "kg/s", "1"): by the file's
// definition by SI base units, or by a table of usual units where the file defines none. An empty unit is ours. Nothing
// where it is of another quantity or is not known. A definition without radian counts for an angle only if it is named
// as one is (rad, deg …): a turn a second is another number than a radian a second.
std::optional<UnitConversion> ConversionOf(const fmi::Description& description, std::string_view declared,
                                           std::string_view ours);

}  // namespace rodeira::dynamics
