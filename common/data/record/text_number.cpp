// SPDX-License-Identifier: Apache-2.0
#include "common/data/record/text_number.hpp"

#include <charconv>
#include <string>

namespace rodeira::record {

std::optional<std::int64_t> WholeNumber(const TextMap& entries, std::string_view key) {
  const auto found = entries.find(std::string(key));
  if (found == entries.end()) return std::nullopt;
  std::int64_t number = 0;
  const char* end = found->second.data() + found->second.size();
  const auto [at, problem] = std::from_chars(found->second.data(), end, number);
  if (problem != std::errc() || at != end) return std::nullopt;
  return number;
}

}  // namespace rodeira::record
