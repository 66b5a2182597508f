// SPDX-License-Identifier: Apache-2.0
#include "tests/property/mutate.hpp"

#include <algorithm>
#include <iterator>
#include <string_view>
#include <utility>
#include <vector>

namespace rodeira::property {
namespace {

constexpr std::string_view kPieces[] = {
    "[",        "]",    "{",   "}",         ":",       ": ",   ",",   "&a ", "*a",   "!x ",
    "|",        ">",    "'",   "\"",        "%",       "@",    "`",   "#",   "- ",   "? ",
    "\t",       "\r\n", "\n",  "\n---\n",   "\n...\n", "<<: ", "~",   "\\x", "\xC3", "\xEF\xBB\xBF",
    "\x1B[31m", "\x01", "../", "/dev/null", "true",    "null", "a: ", "=",   "+"};
constexpr std::string_view kNumbers[] = {"0",
                                         "-0",
                                         "1",
                                         "-1",
                                         "0.5",
                                         "2",
                                         "1e-320",
                                         "1e-9",
                                         "1e9",
                                         "1e308",
                                         "-1e308",
                                         "1e999",
                                         "nan",
                                         ".inf",
                                         "-.inf",
                                         "2147483647",
                                         "2147483648",
                                         "-2147483649",
                                         "4294967296",
                                         "9223372036854775807",
                                         "9223372036854775808",
                                         "99999999999999999999999",
                                         "0x10",
                                         "1_000",
                                         "1,5",
                                         "٣",
                                         "",
                                         "[1, 2]",
                                         "{a: 1}",
                                         "text"};

struct Piece {
  std::size_t at = 0;
  std::size_t size = 0;
};

// The lines with their ends.
std::vector<Piece> Lines(const std::string& text) {
  std::vector<Piece> lines;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size() - 1);
    lines.push_back({at, end + 1 - at});
    at = end + 1;
  }
  return lines;
}

// What looks like numbers.
std::vector<Piece> Numbers(const std::string& text) {
  constexpr std::string_view kDigits = "0123456789.+-e";
  std::vector<Piece> numbers;
  for (std::size_t at = text.find_first_of("0123456789"); at != std::string::npos;
       at = text.find_first_of("0123456789", at)) {
    std::size_t end = at;
    while (end < text.size() && kDigits.find(text[end]) != std::string_view::npos) ++end;
    numbers.push_back({at, end - at});
    at = end;
  }
  return numbers;
}

void ChangeBytes(std::string& text, Draw& draw) {
  const std::size_t at = draw.Below(text.size());
  const std::size_t size = 1 + draw.Below(std::min<std::size_t>(text.size() - at, 64));
  switch (draw.Below(6)) {
    case 0:
      text[at] = static_cast<char>(text[at] ^ static_cast<char>(1u << draw.Below(8)));
      break;
    case 1:
      text[at] = static_cast<char>(draw.Bits());
      break;
    case 2:
      text.insert(at, kPieces[draw.Below(std::size(kPieces))]);
      break;
    case 3:
      text.erase(at, size);
      break;
    case 4:
      text.insert(draw.Below(text.size()), text.substr(at, size));
      break;
    default:
      text.resize(at);
  }
}

void ChangeLines(std::string& text, Draw& draw) {
  const std::vector<Piece> lines = Lines(text);
  const Piece a = lines[draw.Below(lines.size())];
  const Piece b = lines[draw.Below(lines.size())];
  switch (draw.Below(5)) {
    case 0: {
      const auto& [first, second] = a.at < b.at ? std::pair(a, b) : std::pair(b, a);
      if (first.at == second.at) return;
      const std::string one = text.substr(first.at, first.size);
      const std::string other = text.substr(second.at, second.size);
      text.replace(second.at, second.size, one);
      text.replace(first.at, first.size, other);
      break;
    }
    case 1:
      text.insert(b.at, text.substr(a.at, a.size));
      break;
    case 2:
      text.erase(a.at, a.size);
      break;
    case 3:
      text.insert(a.at, std::string(1 + draw.Below(6), ' '));
      break;
    default:
      text.erase(a.at, std::min(text.find_first_not_of(' ', a.at), a.at + a.size) - a.at);
  }
}

void ChangeNumber(std::string& text, Draw& draw) {
  const std::vector<Piece> numbers = Numbers(text);
  if (numbers.empty()) return;
  const Piece number = numbers[draw.Below(numbers.size())];
  if (draw.Below(3) == 0) {
    const Piece other = numbers[draw.Below(numbers.size())];
    text.replace(number.at, number.size, text.substr(other.at, other.size));
  } else {
    text.replace(number.at, number.size, EdgeNumber(draw));
  }
}

}  // namespace

std::string_view EdgeNumber(Draw& draw) { return kNumbers[draw.Below(std::size(kNumbers))]; }

void Mutate(std::string& text, Draw& draw) {
  if (text.empty()) return;
  switch (draw.Below(10)) {
    case 0:
    case 1:
    case 2:
      return ChangeBytes(text, draw);
    case 3:
    case 4:
      return ChangeLines(text, draw);
    case 5: {
      const std::string_view open = draw.Below(2) == 0 ? "[" : "{a: ";
      std::string many;
      for (std::size_t i = draw.Below(3000); i > 0; --i) many += open;
      text.insert(draw.Below(text.size()), many);
      return;
    }
    default:
      return ChangeNumber(text, draw);
  }
}

}  // namespace rodeira::property
