// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace rodeira::base {

// The text as one cell of a table (RFC 4180): in quotes, with doubled quotes inside, where it holds a quote, comma or
// line break.
std::string CsvCell(std::string_view text);

}  // namespace rodeira::base
