// SPDX-License-Identifier: Apache-2.0
// Worlds on which things stand at no road: on a bare elevation grid, on a plane, beside roads.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>

#include "common/core/base/random.hpp"
#include "common/world/road/world_plot.hpp"
#include "tests/common/world/road/sample_world.hpp"

namespace rodeira::road {
namespace {

using testing::HasSubstr;

const std::string kHills =
    "rodeira: world/2\nname: w\nterrain: {surface: grass, generate: {seed: 3, columns: 41, rows: 41, spacing_m: 10, "
    "west_m: 0, south_m: 0, relief: [{wavelength_m: 90, amplitude_m: 6}]}}\n";
const std::string kObjects =
    "objects:\n  - {type: house, x_m: 120, y_m: 80, heading_deg: 30}\n  - {type: tree, along: [[20, 20], [380, 350]], "
    "every_m: 9}\n  - {type: wall, along: [[200, 100], [300, 100], [300, 200]]}\n";

// The ground is the bare grid's to the bit, hints or not, in batches too.
TEST(WorldOfProps, TheGroundIsTheBareGrids) {
  const auto bare = MustParse(kHills), planted = MustParse(kHills + kObjects);
  ASSERT_NE(planted->props(), nullptr);
  EXPECT_EQ(bare->props(), nullptr);
  std::vector<ground::GroundQuery> queries;
  for (std::uint64_t i = 0; i < 4000; ++i) {
    queries.push_back({base::RandomUniform({i, 1}, -10.0, 410.0), base::RandomUniform({i, 2}, -10.0, 410.0),
                       i % 3 == 0 ? base::RandomUniform({i, 3}, -10.0, 10.0) : std::nan("")});
  }
  std::vector<ground::GroundPoint> ours(queries.size()), theirs(queries.size());
  bare->MakeGround()->Query(queries, theirs);
  planted->MakeGround()->Query(queries, ours);
  int outside = 0;
  for (std::size_t i = 0; i < queries.size(); ++i) {
    ASSERT_EQ(ours[i].inside, theirs[i].inside);
    ASSERT_EQ(std::bit_cast<std::uint64_t>(ours[i].z_m), std::bit_cast<std::uint64_t>(theirs[i].z_m));
    ASSERT_EQ(ours[i].normal_W, theirs[i].normal_W);
    ASSERT_EQ(ours[i].friction, theirs[i].friction);
    outside += !ours[i].inside;
  }
  EXPECT_GT(outside, 50);
}

// A car runs into them: they are of the content hash, by place and size, names and comments are not.
TEST(WorldOfProps, TheContentHashKnowsThem) {
  const auto hash = [](const std::string& text) { return MustParse(text)->content_hash(); };
  const base::Digest own = hash(kHills + kObjects);
  EXPECT_NE(own, hash(kHills));
  const auto with = [&](const std::string& before, const std::string& after) {
    std::string text = kHills + kObjects;
    text.replace(text.find(before), before.size(), after);
    return hash(text);
  };
  EXPECT_EQ(with("type: house", "type: house, name: mill"), own);
  EXPECT_NE(with("x_m: 120", "x_m: 120.5"), own);
  EXPECT_NE(with("heading_deg: 30", "heading_deg: 31"), own);
  EXPECT_NE(with("type: house", "type: house, height_m: 8"), own);
  EXPECT_NE(with("[300, 200]", "[300, 201]"), own);
  EXPECT_NE(with("every_m: 9", "every_m: 10"), own);
}

TEST(WorldOfProps, WhereThereIsNoTerrainNothingStands) {
  const auto problem = [](const std::string& objects) {
    const auto world = World::Parse(kHills + "objects:\n" + objects, "made.yaml");
    return world.ok() ? std::string("none") : world.error().Text();
  };
  EXPECT_EQ(problem("  - {type: tree, x_m: 400, y_m: 400}\n"), "none");
  EXPECT_EQ(problem("  - {type: tree, x_m: 400.5, y_m: 400}\n"), "made.yaml:5: there is no terrain at (400.5, 400)");
  EXPECT_EQ(problem("  - {type: tree, along: [[10, 10], [10, 410]], every_m: 5}\n"),
            "made.yaml:5: there is no terrain at (10, 410)");
  EXPECT_EQ(problem("  - {type: wall, along: [[10, 10], [-1, 10]]}\n"), "made.yaml:5: there is no terrain at (-1, 10)");
  // A plane has no edge; a file of version 1 has no such list.
  EXPECT_TRUE(
      World::Parse("rodeira: world/2\nname: w\nground: {kind: plane}\nobjects: [{type: tree, x_m: 90000, y_m: 3}]\n",
                   "made.yaml")
          .ok());
  const auto first = World::Parse(
      "rodeira: world/1\nname: w\nground: {kind: plane}\nobjects: [{type: tree, x_m: 9, y_m: 3}]\n", "made.yaml");
  ASSERT_FALSE(first.ok());
  EXPECT_THAT(first.error().Text(), HasSubstr("made.yaml:4: unknown key 'objects'"));
}

TEST(WorldOfProps, ThePlanShowsThem) {
  const std::string plan = PlotWorld(*MustParse(kHills + kObjects));
  std::size_t trees = 0;
  for (std::size_t at = plan.find("<circle"); at != std::string::npos; at = plan.find("<circle", at + 1)) ++trees;
  EXPECT_EQ(trees, static_cast<std::size_t>(std::hypot(360.0, 330.0) / 9.0) + 1);
  EXPECT_THAT(plan, HasSubstr("rotate(-30.0)"));
}

}  // namespace
}  // namespace rodeira::road
