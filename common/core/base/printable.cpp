// SPDX-License-Identifier: Apache-2.0
#include "common/core/base/printable.hpp"

#include <fmt/format.h>

namespace rodeira::base {
namespace {

unsigned int ByteAt(std::string_view text, std::size_t at) {
  return at < text.size() ? static_cast<unsigned char>(text[at]) : 0u;
}

// Bytes of the printable UTF-8 character that the text begins with (Unicode 15, table 3-7); 0 where there is none.
std::size_t LengthOfCharacter(std::string_view text) {
  const unsigned int first = ByteAt(text, 0);
  if (first < 0x80) return first >= 0x20 && first != 0x7F ? 1 : 0;
  const std::size_t length = first >= 0xC2 && first <= 0xDF   ? 2
                             : first >= 0xE0 && first <= 0xEF ? 3
                             : first >= 0xF0 && first <= 0xF4 ? 4
                                                              : 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((ByteAt(text, i) & 0xC0u) != 0x80u) return 0;
  }
  const unsigned int second = ByteAt(text, 1);
  const bool control = first == 0xC2 && second < 0xA0;  // U+0080 to U+009F: some terminals obey them
  const bool outside = (first == 0xE0 && second < 0xA0) || (first == 0xED && second > 0x9F) ||
                       (first == 0xF0 && second < 0x90) || (first == 0xF4 && second > 0x8F);
  return control || outside ? 0 : length;
}

}  // namespace

std::string Printable(std::string_view text, std::size_t limit_bytes) {
  std::string line;
  while (!text.empty()) {
    if (line.size() >= limit_bytes) return line + "…";
    const std::size_t length = LengthOfCharacter(text);
    if (length > 0) {
      line += text.substr(0, length);
    } else if (text[0] == '\n') {
      line += "\\n";
    } else if (text[0] == '\t') {
      line += "\\t";
    } else {
      line += fmt::format("\\x{:02x}", ByteAt(text, 0));
    }
    text.remove_prefix(length > 0 ? length : 1);
  }
  return line;
}

}  // namespace rodeira::base
