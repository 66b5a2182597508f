// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "common/core/base/result.hpp"

namespace rodeira::decode {

// A word of an IDL text, with its line.
struct Token {
  enum class Kind { kName, kNumber, kText, kSign, kEnd };
  Kind kind = Kind::kEnd;
  std::string text;  // a sign is one character, or "::"
  int line = 1;
};

// The words of an IDL text without its comments; the last one is kEnd. Wrong input ("PLACE:LINE: …") where a comment or
// a text does not end, at preprocessor lines, and at characters that IDL does not use.
base::Result<std::vector<Token>> Tokenise(std::string_view text, std::string_view place);

}  // namespace rodeira::decode
