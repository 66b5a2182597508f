// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/key_values.hpp"

#include <fmt/format.h>

namespace rodeira::cli {

base::Result<std::vector<std::pair<std::string, std::string>>> KeyValues(std::string_view option,
                                                                         const std::vector<std::string>& texts) {
  std::vector<std::pair<std::string, std::string>> pairs;
  for (const std::string& text : texts) {
    const auto equals = text.find('=');
    if (equals == std::string::npos || equals == 0)
      return base::WrongInput("command.wrong_value", "KEY=VALUE was expected", fmt::format("{} {}", option, text));
    pairs.emplace_back(text.substr(0, equals), text.substr(equals + 1));
  }
  return pairs;
}

}  // namespace rodeira::cli
