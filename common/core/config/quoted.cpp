// SPDX-License-Identifier: Apache-2.0
#include "common/core/config/quoted.hpp"

#include <fmt/format.h>

#include <array>
#include <utility>

namespace rodeira::config {
namespace {

constexpr std::array<std::pair<char, char>, 6> kShort = {
    {{'"', '"'}, {'\\', '\\'}, {'\n', 'n'}, {'\t', 't'}, {'\r', 'r'}, {'\0', '0'}}};

int HexDigit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  return c >= 'a' && c <= 'f' ? c - 'a' + 10 : -1;
}

}  // namespace

std::string Quoted(std::string_view text) {
  std::string yaml = "\"";
  for (const char c : text) {
    const auto* found = kShort.begin();
    while (found != kShort.end() && found->first != c) ++found;
    const auto byte = static_cast<unsigned char>(c);
    if (found != kShort.end()) {
      yaml += '\\';
      yaml += found->second;
    } else if (byte < 0x20 || byte == 0x7F) {
      yaml += fmt::format("\\x{:02x}", byte);
    } else {
      yaml += c;
    }
  }
  return yaml + "\"";
}

std::optional<std::string> Unquoted(std::string_view yaml) {
  if (yaml.size() < 2 || yaml.front() != '"' || yaml.back() != '"') return std::nullopt;
  yaml = yaml.substr(1, yaml.size() - 2);
  std::string text;
  for (std::size_t i = 0; i < yaml.size(); ++i) {
    if (yaml[i] == '"') return std::nullopt;
    if (yaml[i] != '\\') {
      text += yaml[i];
      continue;
    }
    if (++i == yaml.size()) return std::nullopt;
    const auto* found = kShort.begin();
    while (found != kShort.end() && found->second != yaml[i]) ++found;
    if (found != kShort.end()) {
      text += found->first;
      continue;
    }
    if (yaml[i] != 'x' || i + 2 >= yaml.size()) return std::nullopt;
    const int high = HexDigit(yaml[i + 1]), low = HexDigit(yaml[i + 2]);
    if (high < 0 || low < 0) return std::nullopt;
    text += static_cast<char>(16 * high + low);
    i += 2;
  }
  return text;
}

}  // namespace rodeira::config
