// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string_view>

#include "common/core/base/result.hpp"
#include "common/vehicle/dynamics/magic_formula.hpp"

namespace rodeira::dynamics {

// Tyre property files of the Magic Formula as test benches deliver them (.tir): sections in brackets, KEY = value,
// comments behind $ or !. Taken are the coefficients of MagicFormulaCoefficients(), whatever their section; what the
// formula here has no use for (moments, turn slip, shape, structure) is passed over. [MODEL] FITTYP says the version:
// 5, 6, 51 and 52 are 5.2; 60 to 62 are 6.1; TYRESIDE on which side of a car it was measured. Wrong input with file and
// line: other units than SI, another version, a coefficient that is no number or stands twice, one among those of the
// two directions and their scales that is unknown, one without which there is no force (FNOMIN, PCX1, PDX1, PKX1,
// PCY1, PDY1, PKY1) missing, a stiffness of the wrong sign.
base::Result<MagicFormulaSettings> LoadTir(const std::filesystem::path& path);
// The same from a text; `name` stands for the file in messages.
base::Result<MagicFormulaSettings> ParseTir(std::string_view text, std::string_view name);

}  // namespace rodeira::dynamics
