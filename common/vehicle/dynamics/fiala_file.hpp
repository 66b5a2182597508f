// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "common/core/base/result.hpp"
#include "common/vehicle/dynamics/fiala_tyre.hpp"
#include "common/vehicle/dynamics/tir_text.hpp"

namespace rodeira::dynamics {

// A tyre property file of PROPERTY_FILE_FORMAT 'FIALA': CSLIP, CALPHA, UMIN and UMAX, whatever their section, in the
// file's units of force and angle. Wrong input with file and line: a coefficient that is missing, stands twice or is
// out of range, a unit that is not known.
base::Result<FialaSettings> ReadFialaTir(const TirText& tir, std::string_view name);

// What both kinds of file with a Fiala tyre ask for; an empty text where it fits.
std::string FialaProblem(const FialaSettings& fiala);

}  // namespace rodeira::dynamics
