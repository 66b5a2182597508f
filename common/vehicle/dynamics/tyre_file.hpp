// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/core/base/result.hpp"
#include "common/vehicle/dynamics/aligning_moment.hpp"
#include "common/vehicle/dynamics/magic_formula.hpp"
#include "common/vehicle/dynamics/tyre_model.hpp"

namespace rodeira::dynamics {

// A tyre of its maker's file, whatever its model.
struct TyreFile {
  MagicFormulaSettings formula;                             // where `model` is null
  std::shared_ptr<const TyreModel> model = nullptr;         // Fiala, TMeasy
  std::optional<AligningSettings> aligning = std::nullopt;  // of the formula, where the file has it
  std::string kind;                                         // "Magic Formula 6.1", "PAC2002", "Fiala" …
  double nominal_N = 0.0;                                   // nominal load
  std::vector<std::string> warnings;                        // sentences: what is missing, and what was put in its place
};

// A tyre property file (.tir: Magic Formula 5 and 6, PAC2002, FIALA) or a tyre of Chrono (JSON: Fiala, TMeasy), told
// apart by their contents. Wrong input with file and line.
base::Result<TyreFile> LoadTyreFile(const std::filesystem::path& path);
// The same from a text; `name` stands for the file in messages.
base::Result<TyreFile> ParseTyreFile(std::string_view text, std::string_view name);

}  // namespace rodeira::dynamics
