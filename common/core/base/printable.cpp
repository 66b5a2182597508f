// SPDX-License-Identifier: Apache-2.0
#include "common/core/base/printable.hpp"

#include <fmt/format.h>

#include "common/core/base/utf8.hpp"

namespace rodeira::base {
namespace {

unsigned int ByteAt(std::string_view text, std::size_t at) {
  return at < text.size() ? static_cast<unsigned char>(text[at]) : 0u;
}

// Bytes of the printable UTF-8 character that the text begins with; 0 where there is none.
std::size_t LengthOfCharacter(std::string_view text) {
  const unsigned int first = ByteAt(text, 0);
  const bool control = first < 0x20 || first == 0x7F ||
                       (first == 0xC2 && ByteAt(text, 1) < 0xA0);  // U+0080 to U+009F: some terminals obey them
  return control ? 0 : Utf8Length(text);
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
