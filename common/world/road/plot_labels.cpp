// SPDX-License-Identifier: Apache-2.0
#include "common/world/road/plot_labels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace rodeira::road {
namespace {

// Of a sans-serif letter, by the font's size; DejaVu's digits and small letters are 0.64 wide, its capitals up to 0.8.
constexpr double kWide = 0.66, kAbove = 0.8, kBelow = 0.25;
constexpr double kRoom = 1.0;  // between two words

std::size_t Letters(std::string_view text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xc0u) != 0x80u; }));
}

}  // namespace

std::string EscapedText(std::string_view text) {
  std::string out;
  for (const char c : text) out += c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '&' ? "&amp;" : std::string(1, c);
  return out;
}

bool PlotLabels::IsFree(const Box& box) const {
  if (box.low.x() < 0.0 || box.low.y() < 0.0 || box.high.x() > width_ || box.high.y() > height_) return false;
  return std::none_of(taken_.begin(), taken_.end(), [&](const Box& other) { return Touch(box, other); });
}

bool PlotLabels::Touch(const Box& a, const Box& b) {
  return (a.low.array() < b.high.array() + kRoom).all() && (b.low.array() < a.high.array() + kRoom).all();
}

bool PlotLabels::Keep(const Eigen::Vector2d& corner, const Eigen::Vector2d& size) {
  const Box box{corner, corner + size};
  if (!IsFree(box)) return false;
  taken_.push_back(box);
  return true;
}

bool PlotLabels::Put(const Eigen::Vector2d& point, double gap, double size, const char* colour, std::string_view text) {
  const double wide = kWide * size * static_cast<double>(Letters(text)), high = (kAbove + kBelow) * size;
  // Where the box's middle lies, in halves of its size and in gaps.
  static constexpr std::array<std::array<double, 2>, 8> kSides = {
      {{1, 0}, {-1, 0}, {0, -1}, {0, 1}, {1, -1}, {1, 1}, {-1, -1}, {-1, 1}}};
  for (const bool beside : {true, false}) {  // beside all that is to be avoided, or else anywhere
    for (const auto& [x, y] : kSides) {
      const Eigen::Vector2d middle = point + Eigen::Vector2d(x * (0.5 * wide + gap), y * (0.5 * high + gap));
      const Eigen::Vector2d corner = middle - 0.5 * Eigen::Vector2d(wide, high);
      const Box box{corner, corner + Eigen::Vector2d(wide, high)};
      if (beside && std::any_of(avoided_.begin(), avoided_.end(), [&](const Box& other) { return Touch(box, other); }))
        continue;
      if (!Keep(corner, {wide, high})) continue;
      svg_ += fmt::format(
          "<text x=\"{:.1f}\" y=\"{:.1f}\" font-family=\"sans-serif\" font-size=\"{}\" fill=\"{}\">{}</text>\n",
          corner.x(), corner.y() + kAbove * size, size, colour, EscapedText(text));
      return true;
    }
  }
  return false;
}

}  // namespace rodeira::road
