// SPDX-License-Identifier: Apache-2.0
#include "common/view/scene/raster/lettering.hpp"

#include <algorithm>
#include <string>
#include <vector>

namespace rodeira::scene {
namespace {

// Strokes as pairs of coordinates: x from 0 to 4, y from 0 (the line) to 6 (a capital's height), a and b are -1 and -2.
// A stroke with ~ is smooth, one with @ smooth and closed.
struct Glyph {
  char letter;
  const char* strokes;
};
constexpr Glyph kGlyphs[] = {
    {'A', "002640 1232"},
    {'B', "0006 ~062646432303 ~032343402000"},
    {'C', "~454606004041"},
    {'D', "0006 ~062646402000"},
    {'E', "46060040 0333"},
    {'F', "460600 0333"},
    {'G', "~4546060040434323"},
    {'H', "0006 4046 0343"},
    {'I', "0006"},
    {'J', "~36300001"},
    {'K', "0006 4602 1340"},
    {'L', "060040"},
    {'M', "0006224640"},
    {'N', "00064046"},
    {'O', "@00064640"},
    {'P', "0006 ~062646432303"},
    {'Q', "@00064640 2240"},
    {'R', "0006 ~062646432303 2340"},
    {'S', "~4546060343400001"},
    {'T', "0646 2620"},
    {'U', "~06004046"},
    {'V', "062046"},
    {'W', "0610243046"},
    {'X', "0046 0640"},
    {'Y', "062346 2320"},
    {'Z', "06460040"},
    {'0', "@00063630"},
    {'1', "042620"},
    {'2', "~0506464300 0040"},
    {'3', "~0506464323 ~2343400001"},
    {'4', "30360242"},
    {'5', "460603 ~032444400001"},
    {'6', "@00034340 ~45460602"},
    {'7', "064610"},
    {'8', "@03064643 @00034340"},
    {'9', "@03064643 ~44400001"},
    {'%', "0046 @04061614 @30324240"},
    {'-', "0333"},
    {'.', "0000"},
    {',', "001a"},
    {'\'', "0506"},
    {'/', "0046"},
    {'!', "0602 0000"},
    {':', "0101 0404"},
};
constexpr double kGap = 1.5, kSpace = 2.2, kThick = 1.0;

const char* StrokesOf(char letter) {
  for (const Glyph& glyph : kGlyphs) {
    if (glyph.letter == letter) return glyph.strokes;
  }
  return nullptr;
}

// A letter of Latin-1 beyond ASCII as a capital and the strokes of its accent.
struct Parts {
  char base = ' ';
  const char* accent = "";
};
Parts PartsOf(unsigned code) {
  constexpr const char *kGrave = "1827", *kAcute = "2738", *kRoof = "172837", *kTilde = "~07183748",
                       *kDots = "1717 3737", *kRing = "@17183837", *kTailStroke = "202a1b";
  if (code >= 0xE0 && code != 0xF7 && code != 0xFF) code -= 0x20;
  constexpr const char* kBases = "AAAAAA CEEEEIIII NOOOOO OUUUUY";  // from 0xC0 on
  if (code < 0xC0 || code > 0xDD) return {};
  const char* accent = "";
  switch (code) {
    case 0xC0:
    case 0xC8:
    case 0xCC:
    case 0xD2:
    case 0xD9:
      accent = kGrave;
      break;
    case 0xC1:
    case 0xC9:
    case 0xCD:
    case 0xD3:
    case 0xDA:
    case 0xDD:
      accent = kAcute;
      break;
    case 0xC2:
    case 0xCA:
    case 0xCE:
    case 0xD4:
    case 0xDB:
      accent = kRoof;
      break;
    case 0xC3:
    case 0xD1:
    case 0xD5:
      accent = kTilde;
      break;
    case 0xC4:
    case 0xCB:
    case 0xCF:
    case 0xD6:
    case 0xDC:
      accent = kDots;
      break;
    case 0xC5:
      accent = kRing;
      break;
    case 0xC7:
      accent = kTailStroke;
      break;
    default:
      break;
  }
  return {kBases[code - 0xC0], accent};
}

// Cuts corners three times (Chaikin); the ends of an open line stay.
Polyline CutCorners(Polyline line, bool closed) {
  for (int round = 0; round < 3; ++round) {
    Polyline cut;
    if (!closed) cut.push_back(line.front());
    for (std::size_t i = 0; i + (closed ? 0 : 1) < line.size(); ++i) {
      const Eigen::Vector2d &a = line[i], &b = line[(i + 1) % line.size()];
      cut.push_back(0.75 * a + 0.25 * b);
      cut.push_back(0.25 * a + 0.75 * b);
    }
    if (!closed) cut.push_back(line.back());
    line = std::move(cut);
  }
  if (closed) line.push_back(line.front());
  return line;
}

void AddStrokes(std::string_view text, double x, std::vector<Polyline>& lines, double& width) {
  const auto digit = [](char c) {
    return c >= 'a' ? static_cast<double>('a' - c) - 1.0 : static_cast<double>(c - '0');
  };
  while (!text.empty()) {
    const std::string_view word = text.substr(0, text.find(' '));
    text.remove_prefix(std::min(text.size(), word.size() + 1));
    const bool smooth = word[0] == '~', closed = word[0] == '@';
    Polyline line;
    for (std::size_t i = smooth || closed ? 1 : 0; i + 1 < word.size(); i += 2) {
      width = std::max(width, digit(word[i]));
      line.emplace_back(x + digit(word[i]), digit(word[i + 1]));
    }
    lines.push_back(smooth || closed ? CutCorners(std::move(line), closed) : std::move(line));
  }
}

}  // namespace

void Letter(Canvas& canvas, std::string_view text, const Eigen::Vector2d& middle, double height, double most,
            Colour colour) {
  std::vector<Polyline> lines;
  double x = 0.0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    auto code = static_cast<unsigned char>(text[i]);
    Parts parts;
    if (code == 0xC3 && i + 1 < text.size())
      parts = PartsOf(0xC0U + (static_cast<unsigned char>(text[++i]) & 0x3FU));
    else if (code < 0x80)
      parts.base = static_cast<char>(code >= 'a' && code <= 'z' ? code - 32 : code);
    const char* strokes = StrokesOf(parts.base);
    if (strokes == nullptr) {
      if (code < 0x80 || code >= 0xC0) x += kSpace;
      continue;
    }
    double width = 0.0, above = 0.0;
    AddStrokes(strokes, x, lines, width);
    if (*parts.accent != '\0') AddStrokes(parts.accent, x + 0.5 * (width - 4.0), lines, above);
    x += width + kGap;
  }
  if (lines.empty()) return;
  const double length = x - kGap + kThick, scale = height / (6.0 + kThick),
               narrow = std::min(1.0, most / (length * scale));
  for (Polyline& line : lines) {
    for (Eigen::Vector2d& p : line) {
      p = middle + scale * Eigen::Vector2d(narrow * (p.x() - 0.5 * (length - kThick)), p.y() - 3.0);
    }
    canvas.Stroke(line, kThick * scale * (0.4 + 0.6 * narrow), colour);
  }
}

}  // namespace rodeira::scene
