// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <string>

#include "common/world/design/design_reader.hpp"

namespace rodeira::design {

inline constexpr std::array<double, 7> kFriction = {0.0, 1.0, 1.0, 0.6, 0.55, 0.65, 0.9};

// What a text gives; its own problems are among the design's.
inline Design DesignOf(const std::string& text) {
  const auto file = config::File::Parse(text, "made.yaml");
  EXPECT_TRUE(file.ok()) << file.error().Text();
  const config::Map root = file.value().root();
  (void)root.Text("rodeira");
  Design design = ReadDesign(file.value(), kFriction, "made", "", {}, root.OptionalChild("start"));
  for (const auto& problem : file.value().Problems()) design.problems.push_back(problem);
  return design;
}

inline Design SoundDesign(const std::string& text) {
  Design design = DesignOf(text);
  for (const auto& problem : design.problems) ADD_FAILURE() << problem.Text();
  return design;
}

inline std::string FirstProblem(const std::string& text) {
  const Design design = DesignOf(text);
  if (design.problems.empty() && !design.missing.empty()) return design.missing.front().Text();
  return design.problems.empty() ? "none" : design.problems.front().Text();
}

}  // namespace rodeira::design
