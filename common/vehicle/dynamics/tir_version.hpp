// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "common/core/base/result.hpp"
#include "common/vehicle/dynamics/magic_formula.hpp"
#include "common/vehicle/dynamics/tir_text.hpp"

namespace rodeira::dynamics {

// By which equations a tyre property file is computed.
struct TirVersion {
  enum class Model { kMagicFormula, kFiala };
  Model model = Model::kMagicFormula;
  std::string name;  // "PAC2002", "Magic Formula 6.1" …
  MagicFormulaVersion equations = MagicFormulaVersion::k61;
  bool has_pressure = true;           // the inflation pressure is part of the equations
  bool has_ellipse = false;           // FE_METHOD = 'YES': combined slip by the friction ellipse
  std::vector<std::string> warnings;  // where the version's own equations are more than is computed here
};

// PAC2002 and FIALA by PROPERTY_FILE_FORMAT, the others by FITTYP: 5, 6, 51 and 52 are of the family 5, 60 to 62 of the
// family 6. Wrong input with file and line: no tyre property file, a motorcycle's tyre, another format or version.
base::Result<TirVersion> FindTirVersion(const TirText& tir, std::string_view name);

}  // namespace rodeira::dynamics
