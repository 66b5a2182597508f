// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <initializer_list>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace rodeira::measures {

// Marks a missing sample of a time series. A missing sample is left out of every measure; it is never 0.
inline constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

// A time series: samples at a uniform period, in the unit that the parameter's name says.
using Series = std::span<const double>;

// An option by which a value was computed.
struct UsedOption {
  std::string name;  // with its unit
  std::string value;

  bool operator==(const UsedOption&) const = default;
};
using UsedOptions = std::vector<UsedOption>;
using OptionValue = std::variant<double, int, const char*>;
// Numbers become the shortest text that reads back to the same number.
UsedOptions Used(std::initializer_list<std::pair<const char*, OptionValue>> options);

// The value of a measure, with all that is needed to judge it.
struct Measure {
  std::optional<double> value;  // none: missing
  std::string unit;
  std::size_t n = 0;         // samples, or events, that the value was computed from
  double valid_share = 0.0;  // of the samples of the interval, 0 to 1
  UsedOptions options;
  std::string reason;  // why the value is missing; empty where there is one
};

// A value computed from n of all samples.
Measure Found(double value, const char* unit, std::size_t n, std::size_t all, UsedOptions options = {});
// A missing value.
Measure NotFound(std::string reason, const char* unit, std::size_t n, std::size_t all, UsedOptions options = {});
// Found where there is a value, otherwise NotFound with the reason.
Measure FoundOr(std::optional<double> value, const char* reason, const char* unit, std::size_t n, std::size_t all,
                UsedOptions options = {});

}  // namespace rodeira::measures
