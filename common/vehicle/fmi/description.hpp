// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/core/base/result.hpp"

namespace rodeira::fmi {

enum class VariableType { kReal, kInteger, kBoolean, kOther };

// A ScalarVariable of modelDescription.xml.
struct Variable {
  std::string name;
  unsigned reference = 0;
  std::string causality;  // "input", "output", "parameter", "local" …
  VariableType type = VariableType::kOther;
  std::string unit;  // as declared here or in its declared type, may be empty
  int line = 0;      // of modelDescription.xml
};

// A unit by the SI base units and radian, with exponents in this order: kg, m, s, A, K, mol, cd, rad. A value in
// SI is `factor` times the value plus `offset`.
struct UnitDefinition {
  std::array<int, 8> exponents{};
  double factor = 1.0;
  double offset = 0.0;
};

// What modelDescription.xml says, as far as co-simulation needs it.
struct Description {
  std::string model_name;
  std::string guid;
  std::string identifier;            // of the binary
  bool can_get_state = false;        // canGetAndSetFMUstate
  bool can_serialize_state = false;  // canSerializeFMUstate
  bool only_once = false;            // canBeInstantiatedOnlyOncePerProcess
  std::vector<Variable> variables;
  std::map<std::string, UnitDefinition, std::less<>> units;  // those that the file defines by base units

  const Variable* Find(std::string_view name) const;  // null: there is none
};

// A line of the model description, for messages: "car.fmu: modelDescription.xml:12".
std::string PlaceOf(const std::string& file, int line);

// Wrong input where the file is no XML, is not FMI 2.0, or offers no co-simulation without another program. `context`
// stands before the sentence.
base::Result<Description> ReadDescription(const std::filesystem::path& file, const std::string& context);

}  // namespace rodeira::fmi
