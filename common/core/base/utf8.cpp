// SPDX-License-Identifier: Apache-2.0
#include "common/core/base/utf8.hpp"

#include <fmt/format.h>

namespace rodeira::base {
namespace {

unsigned int OctetAt(std::string_view text, std::size_t at) {
  return at < text.size() ? static_cast<unsigned char>(text[at]) : 0u;
}

}  // namespace

std::size_t Utf8Length(std::string_view text) {
  if (text.empty()) return 0;
  const unsigned int first = OctetAt(text, 0);
  if (first < 0x80) return 1;
  const std::size_t length = first >= 0xC2 && first <= 0xDF   ? 2
                             : first >= 0xE0 && first <= 0xEF ? 3
                             : first >= 0xF0 && first <= 0xF4 ? 4
                                                              : 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((OctetAt(text, i) & 0xC0u) != 0x80u) return 0;
  }
  const unsigned int second = OctetAt(text, 1);
  const bool outside = (first == 0xE0 && second < 0xA0) || (first == 0xED && second > 0x9F) ||
                       (first == 0xF0 && second < 0x90) || (first == 0xF4 && second > 0x8F);
  return outside ? 0 : length;
}

std::optional<std::size_t> FirstNotUtf8(std::string_view text) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = Utf8Length(text.substr(at));
    if (length == 0) return at;
    at += length;
  }
  return std::nullopt;
}

std::string ToUtf8(std::string_view text) {
  std::string out;
  while (const auto at = FirstNotUtf8(text)) {
    out += text.substr(0, *at);
    out += fmt::format("\\x{:02x}", OctetAt(text, *at));
    text.remove_prefix(*at + 1);
  }
  return out += text;
}

}  // namespace rodeira::base
