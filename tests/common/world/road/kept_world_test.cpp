// SPDX-License-Identifier: Apache-2.0
#include "common/world/road/kept_world.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "common/core/base/temporary_folder.hpp"
#include "tests/tree.hpp"

namespace rodeira::road {
namespace {

TEST(KeptWorld, IsLoadedWithoutItsFileAsLongAsItIsKept) {
  const std::filesystem::path plane = std::filesystem::path(SourceDir()) / "configs/worlds/plane.yaml";
  const auto folder = base::TemporaryFolder::Make("kept_world").value();
  const std::filesystem::path file = folder.path() / "world.yaml", other = folder.path() / "other.yaml";
  std::filesystem::copy_file(plane, file);
  std::filesystem::copy_file(plane, other);
  const auto world = World::Load(file).value();
  {
    const KeptWorld kept(file, world);
    std::filesystem::remove(file);
    EXPECT_EQ(World::Load(file).value(), world);
    EXPECT_NE(World::Load(other).value(), world);
  }
  EXPECT_FALSE(World::Load(file).ok());
}

}  // namespace
}  // namespace rodeira::road
