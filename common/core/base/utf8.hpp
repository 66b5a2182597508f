// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace rodeira::base {

// Bytes of the UTF-8 character that the text begins with (Unicode 15, table 3-7); 0 where there is none.
std::size_t Utf8Length(std::string_view text);

// Offset of the first byte that belongs to no UTF-8 character; nothing where all of the text is UTF-8.
std::optional<std::size_t> FirstNotUtf8(std::string_view text);

// The text; each byte that belongs to no UTF-8 character becomes four characters ("\xe4").
std::string ToUtf8(std::string_view text);

}  // namespace rodeira::base
