// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
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
  std::string unit;  // as declared, may be empty
};

// What modelDescription.xml says, as far as co-simulation needs it.
struct Description {
  std::string model_name;
  std::string guid;
  std::string identifier;            // of the binary
  bool can_get_state = false;        // canGetAndSetFMUstate
  bool can_serialize_state = false;  // canSerializeFMUstate
  std::vector<Variable> variables;

  const Variable* Find(std::string_view name) const;  // null: there is none
};

// Wrong input where the file is no XML, is not FMI 2.0, or offers no co-simulation without another program. `context`
// stands before the sentence.
base::Result<Description> ReadDescription(const std::filesystem::path& file, const std::string& context);

}  // namespace rodeira::fmi
