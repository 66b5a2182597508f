// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <string>
#include <utility>

namespace rodeira::base {

// Appends the formatted arguments to `out`.
void AppendFormatted(std::string& out, fmt::string_view text, fmt::format_args arguments);

// The same as fmt::format_to(std::back_inserter(out), …). Here fmt's formatter is compiled once, not in every source
// that calls it.
template <typename... Arguments>
void AppendFormat(std::string& out, fmt::format_string<Arguments...> text, Arguments&&... arguments) {
  AppendFormatted(out, text, fmt::make_format_args(arguments...));
}

}  // namespace rodeira::base
