// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "common/editor/commands.hpp"
#include "common/editor/history.hpp"
#include "tests/common/world/traffic_map/sample_map.hpp"

namespace rodeira::editor {

inline Document Parsed(const std::string& bytes, const std::string& companion = "") {
  Document document;
  auto map = traffic_map::ParseMap(bytes, "x.motors");
  EXPECT_TRUE(map.ok()) << (map.ok() ? "" : map.error().Text());
  if (map.ok()) document.map = std::move(map).value();
  if (companion.empty()) return document;
  const auto heights = traffic_map::ParseHeights(companion, "x.motors.yaml");
  EXPECT_TRUE(heights.ok()) << (heights.ok() ? "" : heights.error().Text());
  if (heights.ok()) document.companion = heights.value();
  return document;
}

inline Points Straight(const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  return {from, from + (to - from) / 3.0, to - (to - from) / 3.0, to};
}

inline traffic_map::LaneSide Side(std::int32_t curve, bool inverted = false,
                                  traffic_map::BorderType type = traffic_map::BorderType::kBoundary) {
  return {curve, inverted, type};
}

// The command does something, undo gives the same bytes again, redo those after it.
template <class Command>
void ExpectUndone(History& history, const Command& command) {
  const std::string before = BytesOf(history.document());
  const auto status = history.Do(command);
  ASSERT_TRUE(status.ok()) << status.error().Text();
  const std::string after = BytesOf(history.document());
  EXPECT_NE(after, before) << history.Last();
  history.Undo();
  EXPECT_EQ(BytesOf(history.document()), before) << history.Next();
  history.Redo();
  EXPECT_EQ(BytesOf(history.document()), after) << history.Last();
}

// The command is refused with this sentence, and nothing changes.
template <class Command>
void ExpectRefused(History& history, const Command& command, const std::string& sentence) {
  const std::string before = BytesOf(history.document());
  const std::uint64_t state = history.state();
  const auto status = history.Do(command);
  ASSERT_FALSE(status.ok());
  EXPECT_NE(status.error().Text().find(sentence), std::string::npos) << status.error().Text();
  EXPECT_EQ(status.error().exit_status(), 2);
  EXPECT_EQ(BytesOf(history.document()), before);
  EXPECT_EQ(history.state(), state);
}

}  // namespace rodeira::editor
