// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/core/base/result.hpp"
#include "common/vehicle/dynamics/aligning_moment.hpp"
#include "common/vehicle/dynamics/magic_formula.hpp"
#include "common/vehicle/dynamics/tir_text.hpp"
#include "common/vehicle/dynamics/tir_version.hpp"

namespace rodeira::dynamics {

// What a tyre property file of the Magic Formula holds.
struct TirFile {
  MagicFormulaSettings formula;
  std::optional<AligningSettings> aligning;  // nothing: the file has none, or no radius
  std::string version;                       // "Magic Formula 6.1", "PAC2002" …
  std::vector<std::string> warnings;         // sentences: what the file lacks, and what was put in its place
};

// Tyre property files of the Magic Formula as test benches deliver them (.tir). Taken are the coefficients of
// MagicFormulaCoefficients() and AligningCoefficients(), whatever their section; what is of no use here (other moments,
// turn slip, shape, structure) is passed over. The version is that of FindTirVersion; TYRESIDE says on which side of a
// car the tyre was measured. Values that are left empty count as absent. Without INFLPRES the tyre is at NOMPRES.
// PAC2002 calls the pressures IP and IP_NOM, and LIP scales the nominal one.
//
// Where two coefficients of opposite sign make the same curve, the usual signs are made: a negative PDY1 or PDX1
// changes its sign together with the coefficients that multiply it.
//
// Wrong input with file and line: other units than SI, another format or version, a coefficient that is no number or
// stands twice, one that is not known while the one it resembles is missing, one without which there is no force
// (FNOMIN, PCX1, PDX1, PKX1, PCY1, PDY1, PKY1) missing, a stiffness of the wrong sign at FNOMIN, a load range that no
// tyre has.
base::Result<TirFile> ReadTir(const TirText& tir, const TirVersion& version, std::string_view name);

// Those of a Magic Formula alone, without the warnings.
base::Result<MagicFormulaSettings> LoadTir(const std::filesystem::path& path);
// The same from a text; `name` stands for the file in messages.
base::Result<MagicFormulaSettings> ParseTir(std::string_view text, std::string_view name);

}  // namespace rodeira::dynamics
