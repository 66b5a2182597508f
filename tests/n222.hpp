// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <memory>

#include "common/world/road/world.hpp"
#include "tests/tree.hpp"
#include "tests/version1_road.hpp"

namespace rodeira {

// The world that most launch files drive on, `configs/worlds/n222.yaml`.
inline std::shared_ptr<const road::World> N222() {
  static const auto world = road::World::Load(SourceDir() + "/configs/worlds/n222.yaml");
  EXPECT_TRUE(world.ok()) << world.error().Text();
  return world.value();
}

// The same road in other hills, as the world file of version 1 that it was: for what is about version 1.
inline std::shared_ptr<const road::World> N222OfVersion1() {
  static const auto world = road::World::Load(SourceDir() + "/tests/data/n222_version1.yaml");
  EXPECT_TRUE(world.ok()) << world.error().Text();
  return world.value();
}

// Where N222's road lies, by the formulas of version 1, which share none with the network that drives, draws and
// answers (N222.LiesWhereItDidInVersion1): an oracle.
inline const Version1Road& N222Road() {
  static const auto road = Version1Road::Load(SourceDir() + "/tests/data/n222_version1.yaml");
  return road;
}

}  // namespace rodeira
