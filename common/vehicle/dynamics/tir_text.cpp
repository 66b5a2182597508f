// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/dynamics/tir_text.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace rodeira::dynamics {
namespace {

std::string_view Trimmed(std::string_view text) {
  constexpr std::string_view kBlank = " \t\r\f\v";
  const auto begin = text.find_first_not_of(kBlank);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kBlank) - begin + 1);
}

std::string_view Unquoted(std::string_view text) {
  const auto is_quote = [](char c) { return c == '\'' || c == '"'; };
  while (!text.empty() && is_quote(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_quote(text.back())) text.remove_suffix(1);
  return Trimmed(text);
}

}  // namespace

std::string UpperCase(std::string_view text) {
  std::string upper(text);
  std::transform(upper.begin(), upper.end(), upper.begin(),
                 [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; });
  return upper;
}

std::optional<double> TirNumber(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0.0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (problem != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

TirText SplitTir(std::string_view text) {
  TirText tir;
  std::string section;
  int number = 0;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    ++number;
    std::string_view line = text.substr(begin, end - begin);
    begin = end + 1;
    line = Trimmed(line.substr(0, line.find_first_of("$!")));
    if (line.starts_with('[')) {
      section = UpperCase(Trimmed(line.substr(1, line.find(']') - 1)));
      tir.sections.push_back(section);
      continue;
    }
    const auto equals = line.find('=');
    if (equals == std::string_view::npos) continue;  // a table's heading or row
    tir.entries.push_back({section, UpperCase(Trimmed(line.substr(0, equals))),
                           std::string(Unquoted(Trimmed(line.substr(equals + 1)))), number});
  }
  return tir;
}

bool TirText::HasSection(std::string_view name) const { return std::ranges::find(sections, name) != sections.end(); }

const TirEntry* TirText::Find(std::string_view key) const {
  const auto found = std::ranges::find(entries, key, &TirEntry::key);
  return found == entries.end() ? nullptr : &*found;
}

std::string TirText::Word(std::string_view key) const {
  const TirEntry* entry = Find(key);
  return entry == nullptr ? std::string() : UpperCase(entry->value);
}

}  // namespace rodeira::dynamics
