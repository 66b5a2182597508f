// SPDX-License-Identifier: Apache-2.0
// World files: what changes the content hash and what does not; every kind of mistake gets its sentence.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "common/core/base/files.hpp"
#include "common/world/road/world_report.hpp"
#include "common/world/terrain/bt.hpp"
#include "tests/common/world/road/sample_world.hpp"
#include "tests/launch/rodeira/temporary_folder.hpp"
#include "tests/names.hpp"

namespace rodeira::road {
namespace {

using ::testing::HasSubstr;

std::string Refusal(const std::string& text) {
  const auto world = World::Parse(text, "sample.yaml");
  EXPECT_FALSE(world.ok());
  if (world.ok()) return {};
  EXPECT_EQ(world.error().exit_status(), 2);
  return world.error().Text();
}

TEST(WorldFile, EveryNumberChangesTheContentHash) {
  const base::Digest original = Sample()->content_hash();
  int changed = 0, refused = 0;
  for (std::size_t at = kSample.find(": "); at != std::string::npos; at = kSample.find(": ", at + 1)) {
    const std::size_t begin = at + 2;
    const std::size_t end = kSample.find_first_not_of("-.0123456789", begin);
    if (end == begin) continue;  // no number
    const std::string found = kSample.substr(begin, end - begin);
    const bool whole = found.find('.') == std::string::npos;
    std::string text = kSample;
    const std::string other = whole ? std::to_string(std::stoi(found) + 1) : std::to_string(std::stod(found) * 1.01);
    text.replace(begin, found.size(), other);
    const auto world = World::Parse(text, "sample.yaml");
    if (!world.ok()) {
      ++refused;  // lane 0, say, or a mark beyond the end
      continue;
    }
    ++changed;
    EXPECT_NE(world.value()->content_hash(), original) << kSample.substr(begin - 20, 20) << found << " -> " << other;
  }
  EXPECT_GT(changed, 60);
  EXPECT_LT(refused, changed / 10);
}

TEST(WorldFile, WordsThatDecideAnAnswerChangeTheHashToo) {
  const base::Digest original = Sample()->content_hash();
  EXPECT_NE(MustParse(SampleWith("surface: soil", "surface: grass"))->content_hash(), original);
  EXPECT_NE(MustParse(SampleWith("surface: gravel", "surface: concrete"))->content_hash(), original);
  EXPECT_NE(MustParse(SampleWith("colour: yellow", "colour: white"))->content_hash(), original);
  EXPECT_NE(MustParse(SampleWith("kind: crown", "kind: left"))->content_hash(), original);
  EXPECT_NE(MustParse(SampleWith("id: 1, width_m: 3,", "id: 1, direction: along, width_m: 3,"))->content_hash(),
            original);
  EXPECT_NE(MustParse(SampleWith("kind: continuous", "kind: dashed, stroke_m: 1, gap_m: 1"))->content_hash(), original);
}

TEST(WorldFile, NamesCommentsAndOrderDoNotChangeTheHash) {
  const base::Digest original = Sample()->content_hash();
  EXPECT_EQ(MustParse(kSample)->content_hash(), original);
  EXPECT_EQ(MustParse(SampleWith("name: sample", "name: another   # with a comment"))->content_hash(), original);
  EXPECT_EQ(MustParse(SampleWith("description: for tests\n", ""))->content_hash(), original);
  EXPECT_EQ(
      MustParse(SampleWith("{length_m: 20, radius_end_m: 45}", "{radius_end_m: 45.0, length_m: 2e1}"))->content_hash(),
      original);
  const std::string right = "        - {id: -1, width_m: 3.25, speed_limit_kmh: 70}\n",
                    left = "        - {id: 1, width_m: 3, speed_limit_kmh: 60}\n";
  EXPECT_EQ(MustParse(SampleWith(right + left, left + right))->content_hash(), original);
  EXPECT_EQ(
      MustParse(SampleWith("    west_m: -100\n", "    west_m: -100\n    projection: \"EPSG:3763\"\n"))->content_hash(),
      original);
}

TEST(WorldFile, TheStartIsOnItsLaneInItsDirection) {
  const auto world = MustParse(SampleWith("lane: -1, s_m: 12.5", "lane: 1, s_m: 40"));
  const RoadFrame frame = SampleRoad().Evaluate(40.0);
  EXPECT_NEAR(std::cos(world->start().heading_rad - frame.heading_rad), -1.0, 1e-12);
  EXPECT_NEAR(SampleRoad().Locate(world->start().x_m, world->start().y_m)->t_m, 1.5, 1e-9);
  const auto free = MustParse(SampleWith("{road: main, lane: -1, s_m: 12.5}", "{x_m: 20, y_m: -40, heading_deg: 90}"));
  EXPECT_EQ(free->start().road, -1);
  EXPECT_EQ(free->start().y_m, -40.0);
  EXPECT_NEAR(free->start().heading_rad, std::acos(0.0), 1e-15);
  const auto none = MustParse(SampleWith("start: {road: main, lane: -1, s_m: 12.5}\n", ""));
  EXPECT_EQ(none->start().lane, -1);
  EXPECT_EQ(none->start().s_m, 0.0);
}

TEST(WorldFile, EveryKindOfMistakeGetsItsSentence) {
  struct Mistake {
    const char *found, *instead, *sentence;
  };
  const Mistake mistakes[] = {
      {"rodeira: world/1", "rodeira: world/9",
       "sample.yaml:1: 'rodeira' is 'world/9'; a world file of this program says 'world/2' or 'world/1'"},
      {"name: sample\n", "", "key 'name' is missing"},
      {"seed: 7", "sead: 7", "sample.yaml:8: unknown key 'terrain.generate.sead'; did you mean 'seed'?"},
      {"blend_m: 8", "blent_m: 8", "sample.yaml:47: unknown key 'roads[0].section.blent_m'; did you mean 'blend_m'?"},
      {"below_m: 0.4", "below_km: 0.4", "sample.yaml:14: … 'terrain.generate.below_km' … 'below_m'"},
      {"spacing_m: 8.5", "spacing_m: wide", "sample.yaml:11: … 'terrain.generate.spacing_m' … 'wide'"},
      {"columns: 61", "columns: 1", "'terrain.generate.columns' is 1; … 2 … 8193 "},
      {"full_m: 40", "full_m: 5", "'full_m' must be greater than 'flat_m'"},
      {"full_m: 40", "full_m: 40\n    reach_m: 39", "'reach_m' must not be less than 'full_m'"},
      {"  generate:", "  file: x.bt\n  generate:", "'terrain' needs either 'file' or 'generate'"},
      {"start: {road: main", "start: {road: mein", "sample.yaml:20: … 'mein' … 'main'"},
      {"lane: -1, s_m: 12.5", "lane: -2, s_m: 12.5", "road 'main' has no lane -2"},
      {"lane: -1, s_m: 12.5", "lane: -1, s_m: 900", "'start.s_m' is 900; the road is 305.500 m long"},
      {"{road: main, lane: -1, s_m: 12.5}", "{x_m: 9000, y_m: 0}", "(9000, 0) … outside the terrain"},
      {"- arc: {length_m: 25", "- ark: {length_m: 25", "sample.yaml:27: … 'ark' … 'arc'"},
      {"- line: {length_m: 80}", "- line: {length_m: -80}",
       "sample.yaml:25: 'roads[0].axis[0].line.length_m' is -80; a number from 0.01 to 100000 was expected"},
      {"{length_m: 25, radius_m: 45}", "{length_m: 25, radius_m: 0}",
       "sample.yaml:27: 'radius_m' is 0; at least 5 m to the left (positive) or right"},
      {"{length_m: 20, radius_end_m: 45}", "{length_m: 20}", "a clothoid needs 'radius_start_m' or 'radius_end_m'"},
      {"{length_m: 25, radius_m: 45}", "{length_m: 10, radius_m: 12}",
       "sample.yaml:27: the bend of radius 12 m is too sharp for lanes, shoulder, verge and blend"},
      {"s_m: 190, z_m: 98.5", "s_m: 80, z_m: 98.5", "sample.yaml:35: … 'vertical' … 's_m'"},
      {"{s_m: 0, z_m: 100}", "{s_m: 0, z_m: 100, parabola_m: 10}",
       "the first and the last point of 'vertical' have no parabola"},
      {"z_m: 105, parabola_m: 60", "z_m: 105, parabola_m: 150", "overlap"},
      {"s_m: 90, z_m: 105", "s_m: 90, z_m: 160",
       "the grade before the point of 'vertical' at s_m: 90 is 0.667; at most 0.5 was expected"},
      {"{id: 1, width_m: 3,", "{id: 0, width_m: 3,", "a lane's 'id' is 0"},
      {"{id: 1, width_m: 3,", "{id: -1, width_m: 3,", "sample.yaml:40: lane -1 appears twice"},
      {"{id: 1, width_m: 3,", "{id: 3, width_m: 3,", "there is a lane 3 but no lane 2 between it and the axis"},
      {"speed_limit_kmh: 60", "speed_limit_mph: 60", "'roads[0].section.lanes[1].speed_limit_mph' … 'speed_limit_kmh'"},
      {"surface: gravel", "surface: gravle",
       "sample.yaml:45: 'roads[0].section.shoulders.right.surface' is 'gravle'; did you mean 'gravel'?"},
      {"kind: crown", "kind: crow", "did you mean 'crown'?"},
      {"kind: dashed, stroke_m: 3,", "kind: dashed,", "key 'roads[0].marks[1].stroke_m' is missing"},
      {"from_s_m: 10, to_s_m: 250", "from_s_m: 260, to_s_m: 250", "a mark must end after its beginning"},
      {"to_s_m: 250", "to_s_m: 2500", "'roads[0].marks[1].to_s_m' is 2500"},
      {"asphalt: 0.95", "asphalt: 95", "sample.yaml:4: 'friction.asphalt' is 95; a number from 0.01 to 2 was expected"},
      {"columns: 61", "columns: 21", "road 'main' with its blend leaves the terrain at s ="},
      {"arc: {length_m: 100, radius_m: -60}", "arc: {length_m: 330, radius_m: -60}",
       "road 'main' comes too near to itself"},
      {"terrain:\n", "ground: {kind: plane}\nterrain:\n", "a world stands either on 'terrain'"},
  };
  for (const Mistake& mistake : mistakes) {
    EXPECT_THAT(Refusal(SampleWith(mistake.found, mistake.instead)), Names(mistake.sentence)) << mistake.instead;
  }
  EXPECT_THAT(Refusal("rodeira: world/1\nname: empty\n"), HasSubstr("a world stands either on 'terrain'"));
  EXPECT_THAT(Refusal("just words"), HasSubstr("a mapping (key: value) was expected"));
  EXPECT_THAT(Refusal("a: [1, 2"), HasSubstr("this is no YAML"));
}

TEST(WorldFile, AllProblemsAreToldInTheOrderOfLines) {
  const auto folder = std::filesystem::temp_directory_path() / ("rodeira-problems-" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  auto text = SampleWith("seed: 7", "sead: 7");
  text.replace(text.find("kind: crown"), 11, "kind: crow");
  ASSERT_TRUE(base::WriteWhole(folder / "two.yaml", text).ok());
  const auto problems = WorldProblems(folder / "two.yaml");
  ASSERT_EQ(problems.size(), 2u);  // the sead that should be a seed, the crow
  EXPECT_THAT(problems[1].Text(), HasSubstr("two.yaml:42:"));
  EXPECT_THAT(WorldProblems(folder / "none.yaml").at(0).Text(), HasSubstr("none.yaml"));
  ASSERT_TRUE(base::WriteWhole(folder / "fine.yaml", kSample).ok());
  EXPECT_TRUE(WorldProblems(folder / "fine.yaml").empty());
  std::filesystem::remove_all(folder);
}

// The file that a world names, given instead of the world, is refused with its place, whatever is in it.
TEST(WorldFile, WhatAWorldNamesIsToldToBeNone) {
  for (const auto& [file, key] :
       {std::pair("hills.bt", "terrain: {file: …}"), std::pair("hills.bt.gz", "terrain: {file: …}"),
        std::pair("HILLS.TIF", "terrain: {file: …}"), std::pair("road.crg", "surfaces: [{crg: …}]"),
        std::pair("line.csv", "points: {file: …}")}) {
    const auto world = World::Load(file);
    ASSERT_FALSE(world.ok()) << file;
    EXPECT_EQ(world.error().exit_status(), 2);
    EXPECT_THAT(world.error().Text(), testing::AllOf(testing::StartsWith(std::string(file) + ": "), HasSubstr(key),
                                                     HasSubstr("a world (.yaml, .xodr or .motors) was expected")));
    ASSERT_EQ(WorldProblems(file).size(), 1u);
    EXPECT_EQ(WorldProblems(file).front().Text(), world.error().Text());
  }
}

TEST(WorldFile, WhereTheHeightsOfAFileStandCanBeSaid) {
  const cli::TemporaryFolder temporary;
  const std::filesystem::path& folder = temporary.path();
  const terrain::ElevationGrid grid({3, 3, 0.0, 0.0, 30.0, 30.0},
                                    {0.0F, 0.0F, 0.0F, 3.0F, 3.0F, 3.0F, 6.0F, 6.0F, 6.0F});
  ASSERT_TRUE(terrain::WriteBt(folder / "hills.bt", grid).ok());
  const auto parse = [&folder](const std::string& terrain) {
    return World::Parse("rodeira: world/1\nname: w\nterrain: {" + terrain + "}\nstart: {x_m: 15, y_m: 15}\n",
                        folder / "w.yaml");
  };
  EXPECT_EQ(parse("file: hills.bt").value()->At(15.0, 15.0).slope_x, 0.2);  // posts every 15 m
  EXPECT_EQ(parse("file: hills.bt, registration: posts").value()->At(15.0, 15.0).slope_x, 0.2);
  EXPECT_NEAR(parse("file: hills.bt, registration: cells").value()->At(15.0, 15.0).slope_x, 0.3,
              1e-12);  // 10 m from middle to middle
  EXPECT_FALSE(parse("file: hills.bt, registration: cells").value()->At(4.9, 15.0).inside);
  EXPECT_THAT(parse("file: hills.bt, registration: corners").error().Text(), HasSubstr("corners"));
  EXPECT_THAT(parse("generate: {seed: 1, columns: 3, rows: 3, spacing_m: 20, west_m: 0, south_m: 0, relief: []}, "
                    "registration: cells")
                  .error()
                  .Text(),
              HasSubstr("'registration' says where the heights of a 'file' stand"));
}

TEST(WorldFile, ElevationFilesAreFoundBesideItAndRefusedWhenBroken) {
  const auto folder = std::filesystem::temp_directory_path() / ("rodeira-beside-" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  const auto world = [&] { return World::Load(folder / "w.yaml"); };
  ASSERT_TRUE(
      base::WriteWhole(folder / "w.yaml", std::string_view("rodeira: world/1\nname: w\nterrain: {file: hills.bt}\n"))
          .ok());
  EXPECT_THAT(world().error().Text(), HasSubstr("/w.yaml:3: " + (folder / "hills.bt").string() + ": "));
  ASSERT_TRUE(base::WriteWhole(folder / "hulls.bt", std::string_view("x")).ok());
  EXPECT_THAT(world().error().Text(), HasSubstr("there is no such elevation file; did you mean 'hulls.bt'?"));
  ASSERT_TRUE(
      base::WriteWhole(folder / "n.yaml", std::string_view("rodeira: world/2\nname: w\nnetwork:\n  file: town.xodr\n"))
          .ok());
  EXPECT_THAT(World::Load(folder / "n.yaml").error().Text(),
              HasSubstr("/n.yaml:4: " + (folder / "town.xodr").string() + ": there is no such file"));
  const terrain::ElevationGrid grid({2, 2, 0.0, 0.0, 10.0, 10.0}, {1.0F, 2.0F, 3.0F, 4.0F});
  auto bytes = terrain::BtBytes(grid);
  bytes.pop_back();
  ASSERT_TRUE(base::WriteWhole(folder / "hills.bt", std::span<const std::byte>(bytes)).ok());
  EXPECT_THAT(world().error().Text(),
              Names("/w.yaml:3: " + (folder / "hills.bt").string() + ": … 271 bytes … 2 x 2 … 272"));
  EXPECT_EQ(world().error().exit_status(), 2);
  ASSERT_TRUE(terrain::WriteBt(folder / "hills.bt", grid).ok());
  const auto loaded = world();
  ASSERT_TRUE(loaded.ok()) << loaded.error().Text();
  EXPECT_EQ(loaded.value()->At(10.0, 10.0).z_m, 4.0);
  EXPECT_EQ(loaded.value()->start().x_m, 5.0);
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace rodeira::road
