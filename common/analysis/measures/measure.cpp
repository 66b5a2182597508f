// SPDX-License-Identifier: Apache-2.0
#include "common/analysis/measures/measure.hpp"

#include <fmt/format.h>

namespace rodeira::measures {

UsedOptions Used(std::initializer_list<std::pair<const char*, OptionValue>> options) {
  UsedOptions used;
  for (const auto& [name, value] : options) {
    used.push_back({name, std::visit([](const auto& v) { return fmt::format("{}", v); }, value)});
  }
  return used;
}

Measure Found(double value, const char* unit, std::size_t n, std::size_t all, UsedOptions options) {
  const double share = all == 0 ? 0.0 : static_cast<double>(n) / static_cast<double>(all);
  return {value, unit, n, share, std::move(options), {}};
}

Measure NotFound(std::string reason, const char* unit, std::size_t n, std::size_t all, UsedOptions options) {
  const double share = all == 0 ? 0.0 : static_cast<double>(n) / static_cast<double>(all);
  return {std::nullopt, unit, n, share, std::move(options), std::move(reason)};
}

Measure FoundOr(std::optional<double> value, const char* reason, const char* unit, std::size_t n, std::size_t all,
                UsedOptions options) {
  if (value) return Found(*value, unit, n, all, std::move(options));
  return NotFound(reason, unit, n, all, std::move(options));
}

}  // namespace rodeira::measures
