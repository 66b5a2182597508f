// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <termios.h>

#include <charconv>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>

namespace rodeira::cli {

// Whether two settings of a terminal are alike in what single keys need.
inline bool Same(const termios& a, const termios& b) {
  return a.c_lflag == b.c_lflag && a.c_iflag == b.c_iflag && a.c_cc[VMIN] == b.c_cc[VMIN] &&
         a.c_cc[VTIME] == b.c_cc[VTIME];
}

// Settings as a word of hexadecimal digits, for a program of the same build.
inline std::string SettingsText(const termios& settings) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  unsigned char bytes[sizeof(termios)];
  std::memcpy(bytes, &settings, sizeof(bytes));
  std::string text;
  for (const unsigned char byte : bytes) text += {kDigits[byte / 16], kDigits[byte % 16]};
  return text;
}

// The same, read; nothing where the word is of another form.
inline std::optional<termios> ReadSettings(std::string_view text) {
  unsigned char bytes[sizeof(termios)];
  if (text.size() != 2 * sizeof(bytes)) return std::nullopt;
  for (std::size_t i = 0; i < sizeof(bytes); ++i) {
    const char* begin = text.data() + 2 * i;
    const auto [end, problem] = std::from_chars(begin, begin + 2, bytes[i], 16);
    if (problem != std::errc{} || end != begin + 2) return std::nullopt;
  }
  termios settings{};
  std::memcpy(&settings, bytes, sizeof(bytes));
  return settings;
}

}  // namespace rodeira::cli
