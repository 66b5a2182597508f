// SPDX-License-Identifier: Apache-2.0
// How far the building of a world's picture has come, as it is told to the waiting part.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <thread>
#include <vector>

#include "common/view/scene/visual_world/world_scene.hpp"
#include "tests/long_form.hpp"
#include "tests/tree.hpp"

namespace rodeira::scene {
namespace {

struct Heard {
  std::vector<double> shares;
  bool elsewhere = false;  // on another thread than the one that waits
};

Heard ShareOf(const char* name, WorldScene* built = nullptr) {
  const auto world = road::World::Load(SourceDir() + "/configs/worlds/" + name);
  EXPECT_TRUE(world.ok()) << world.error().Text();
  Heard heard;
  const auto here = std::this_thread::get_id();
  WorldScene scene = BuildWorldScene(*world.value(), {}, [&](double share) {
    heard.shares.push_back(share);
    heard.elsewhere = heard.elsewhere || std::this_thread::get_id() != here;
  });
  if (built != nullptr) *built = std::move(scene);
  return heard;
}

// The lights' crossing has roads of version 2, the old N222 one of version 1, the plane has none.
TEST(Progress, TheShareNeverFallsAndIsWholeAtLast) {
  for (const char* name : BriefOrLong<std::vector<const char*>>(
           {"lights.yaml", "plane.yaml"}, {"lights.yaml", "../../tests/data/n222_version1.yaml", "plane.yaml"})) {
    const Heard heard = ShareOf(name);
    ASSERT_GE(heard.shares.size(), 3u) << name;
    EXPECT_TRUE(std::is_sorted(heard.shares.begin(), heard.shares.end())) << name;
    EXPECT_GT(heard.shares.front(), 0.0) << name;
    EXPECT_LT(heard.shares.front(), 0.5) << name;
    EXPECT_EQ(heard.shares.back(), 1.0) << name;
    EXPECT_FALSE(heard.elsewhere) << name << ": OpenGL and the window live on one thread";
  }
}

// The waiting part is told of a tile at least as often as this thread has built one; with 6 of them none is a leap to
// the end.
TEST(Progress, ItGoesTileByTile) {
  WorldScene scene;
  const Heard heard = ShareOf("lights.yaml", &scene);
  ASSERT_GE(scene.ground.size(), 6u);
  double widest = 0.0;
  for (std::size_t i = 1; i < heard.shares.size(); ++i)
    widest = std::max(widest, heard.shares[i] - heard.shares[i - 1]);
  EXPECT_LT(widest, 0.6);
}

TEST(Progress, EachPieceOfWorkIsCountedOnce) {
  for (const unsigned threads : {1u, 4u}) {
    std::vector<std::size_t> told;
    std::atomic<std::size_t> worked{0};
    ForEachAtOnce(
        100, threads, [&](std::size_t) { ++worked; },
        [&](std::size_t done) {
          EXPECT_LE(done, worked.load());
          told.push_back(done);
        });
    EXPECT_EQ(worked.load(), 100u);
    EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
    EXPECT_EQ(told.back(), 100u);
    EXPECT_EQ(std::count(told.begin(), told.end(), 100u), 1);
    if (threads == 1) {
      EXPECT_EQ(told.size(), 100u);
    }
  }
}

}  // namespace
}  // namespace rodeira::scene
