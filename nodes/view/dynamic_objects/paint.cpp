// SPDX-License-Identifier: Apache-2.0
#include "nodes/view/dynamic_objects/paint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>
#include <vector>

#include "common/core/base/suggest.hpp"

namespace rodeira::nodes {
namespace {

constexpr std::array kNamed = std::to_array<std::pair<std::string_view, std::uint32_t>>({
    {"red", 0xb01e26},
    {"blue", 0x1e4fa0},
    {"yellow", 0xd9b11e},
    {"green", 0x2b7a3d},
    {"white", 0xe8e8e4},
    {"silver", 0xa9adb1},
    {"grey", 0x5b6066},
    {"black", 0x17181a},
});

}  // namespace

base::Result<scene::Colour> PaintOf(std::string_view text) {
  const auto named =
      std::find_if(kNamed.begin(), kNamed.end(), [text](const auto& entry) { return entry.first == text; });
  if (named != kNamed.end()) return scene::Colour::Of(named->second);
  const std::string_view digits = text.starts_with('#') ? text.substr(1) : text;
  std::uint32_t rgb = 0;
  const auto [end, problem] = std::from_chars(digits.data(), digits.data() + digits.size(), rgb, 16);
  if (digits.size() == 6 && problem == std::errc{} && end == digits.data() + digits.size())
    return scene::Colour::Of(rgb);
  std::vector<std::string> names;
  for (const auto& [name, colour] : kNamed) names.emplace_back(name);
  return base::WrongInput("view.wrong_colour",
                          fmt::format("'{}' is no colour; a name or six hexadecimal digits were expected{}", text,
                                      base::DidYouMean(std::string(text), names)));
}

void PaintCars(scene::SceneSnapshot& moment, const CarPaints& paints) {
  for (scene::CarPose& car : moment.cars) {
    const auto chosen = paints.find(car.id);
    if (chosen != paints.end()) car.colour = chosen->second;
  }
}

}  // namespace rodeira::nodes
