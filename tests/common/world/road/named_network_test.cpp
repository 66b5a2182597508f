// SPDX-License-Identifier: Apache-2.0
// World files with the roads of an OpenDRIVE file: the same world under a name of its own.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "common/core/base/files.hpp"
#include "common/core/base/temporary_folder.hpp"
#include "common/world/road/network_world.hpp"
#include "common/world/road/world.hpp"
#include "common/world/road/world_report.hpp"
#include "tests/common/world/opendrive/sample.hpp"
#include "tests/names.hpp"

namespace rodeira::road {
namespace {

using testing::HasSubstr;

class NamedNetwork : public testing::Test {
 protected:
  void SetUp() override {
    auto made = base::TemporaryFolder::Make("named-network");
    ASSERT_TRUE(made.ok());
    folder_.emplace(std::move(made).value());
    ASSERT_TRUE(
        base::WriteWhole(folder_->path() / "roads.xodr", opendrive::Document(opendrive::RoadText().Text())).ok());
  }
  base::Result<std::shared_ptr<const World>> With(const std::string& more) {
    path_ = folder_->path() / "town.yaml";
    EXPECT_TRUE(base::WriteWhole(path_, "rodeira: world/2\nname: a town\n" + more).ok());
    return World::Load(path_);
  }
  std::string Refusal(const std::string& more) {
    const auto world = With(more);
    EXPECT_FALSE(world.ok()) << more;
    return world.ok() ? "" : world.error().Text();
  }
  std::optional<base::TemporaryFolder> folder_;
  std::filesystem::path path_;
};

constexpr const char* kNetwork = "network: {file: roads.xodr}\n";

TEST_F(NamedNetwork, IsTheWorldOfItsFile) {
  const auto named = With(kNetwork);
  ASSERT_TRUE(named.ok()) << named.error().Text();
  const auto roads = World::Load(folder_->path() / "roads.xodr");
  ASSERT_TRUE(roads.ok()) << roads.error().Text();
  EXPECT_EQ(named.value()->content_hash(), roads.value()->content_hash());
  EXPECT_EQ(named.value()->name(), "a town");
  EXPECT_TRUE(named.value()->open_drive());
  EXPECT_TRUE(WorldProblems(path_).empty());
  EXPECT_EQ(OpenDriveOf(path_), folder_->path() / "roads.xodr");
  EXPECT_EQ(OpenDriveOf(folder_->path() / "roads.xodr"), folder_->path() / "roads.xodr");
}

// A kink of 0.5 mrad behind 50 m, which is closed.
TEST_F(NamedNetwork, HasTheWarningsOfItsFile) {
  opendrive::RoadText road;
  road.geometry =
      R"(<geometry s="0" x="0" y="0" hdg="0" length="50"><line/></geometry>
          <geometry s="50" x="50" y="0" hdg="0.0005" length="50"><line/></geometry>)";
  const auto file = folder_->path() / "roads.xodr";
  ASSERT_TRUE(base::WriteWhole(file, opendrive::Document(road.Text())).ok());
  ASSERT_TRUE(With(kNetwork).ok());
  const auto warnings = CheckNetwork(file, false).warnings;
  EXPECT_THAT(warnings,
              testing::ElementsAre(testing::AllOf(HasSubstr("roads.xodr:"), HasSubstr("road 1"), HasSubstr("s 50"))));
  EXPECT_EQ(WorldWarnings(path_), warnings);
  EXPECT_TRUE(WorldProblems(path_).empty());
}

TEST_F(NamedNetwork, SaysWhereTheCarStartsAndHowTheRoadGrips) {
  const auto usual = With(kNetwork);
  const auto placed = With(std::string(kNetwork) + "start: {road: 1, lane: -1, s_m: 30}\nfriction: {asphalt: 0.4}\n");
  ASSERT_TRUE(placed.ok()) << placed.error().Text();
  const StartPose& start = placed.value()->start();
  EXPECT_EQ(start.lane, -1);
  EXPECT_EQ(start.s_m, 30.0);
  EXPECT_NE(placed.value()->content_hash(), usual.value()->content_hash());
  const auto at = placed.value()->At(start.x_m, start.y_m, 0.0);
  ASSERT_TRUE(at.inside);
  EXPECT_EQ(at.friction, 0.4);
  const auto posed = With(std::string(kNetwork) + "start: {x_m: 12, y_m: -1, heading_deg: 90}\n");
  ASSERT_TRUE(posed.ok()) << posed.error().Text();
  EXPECT_EQ(posed.value()->start().x_m, 12.0);
  EXPECT_NEAR(posed.value()->start().heading_rad, std::acos(0.0), 1e-12);
}

// Its lanes are 3.5 m wide on both sides of y = 0.
TEST_F(NamedNetwork, AStartBesideTheRoadIsAWarning) {
  ASSERT_TRUE(With(std::string(kNetwork) + "start: {x_m: 12, y_m: -1}\n").ok());
  EXPECT_TRUE(WorldWarnings(path_).empty());
  ASSERT_TRUE(With(std::string(kNetwork) + "start: {x_m: 12, y_m: -10}\n").ok());
  EXPECT_THAT(WorldWarnings(path_), testing::ElementsAre(Names("town.yaml:4: … (12.0, -10.0) … 6.5 m … road '1'")));
}

TEST_F(NamedNetwork, WhatDoesNotFitIsRefusedWithItsPlace) {
  EXPECT_THAT(Refusal("network: {file: roads.xodr}\nground: {kind: plane}\n"),
              HasSubstr("town.yaml:3: a world stands either on 'terrain'"));
  EXPECT_THAT(Refusal("network: {file: toads.xodr}\n"), HasSubstr("toads.xodr"));
  EXPECT_THAT(Refusal("network: {fiel: roads.xodr}\n"), HasSubstr("did you mean 'file'?"));
  EXPECT_THAT(Refusal("network: {file: roads.xodr}\nroads: []\n"), HasSubstr("town.yaml:4: unknown key 'roads'"));
  EXPECT_THAT(Refusal(std::string(kNetwork) + "start: {road: 11}\n"), HasSubstr("town.yaml:4: there is no road '11'"));
  EXPECT_THAT(Refusal(std::string(kNetwork) + "start: {road: 1, lane: -9}\n"),
              HasSubstr("road '1' has no lane -9 to drive on there"));
  EXPECT_THAT(Refusal(std::string(kNetwork) + "start: {road: 1, s_m: 1e6}\n"), HasSubstr("'start.s_m' is 1000000"));
  const auto first =
      World::Parse("rodeira: world/1\nname: old\nnetwork: {file: roads.xodr}\n", folder_->path() / "old.yaml");
  ASSERT_FALSE(first.ok());
  EXPECT_THAT(first.error().Text(), HasSubstr("old.yaml:3: 'network' needs 'rodeira: world/2'"));
  ASSERT_TRUE(base::WriteWhole(folder_->path() / "roads.xodr", "<OpenDRIVE>").ok());
  EXPECT_THAT(Refusal(kNetwork), HasSubstr("roads.xodr"));
}

}  // namespace
}  // namespace rodeira::road
