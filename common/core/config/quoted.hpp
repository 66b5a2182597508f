// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace rodeira::config {

// A text as a YAML scalar in double quotes, on one line: read as YAML it is the same bytes, whatever they are. For each
// text from outside (paths, names) that becomes part of a YAML text or the value of an override.
std::string Quoted(std::string_view text);
// What Quoted was given; nothing for a text that Quoted cannot have made.
std::optional<std::string> Unquoted(std::string_view yaml);

}  // namespace rodeira::config
