// SPDX-License-Identifier: Apache-2.0
// Boards that hold several signs: ASAM OpenDRIVE 1.8, 14.7. What is on one has its place and its traffic,
// unless it says so itself.
#include <gmock/gmock.h>

#include "tests/common/world/opendrive/sample.hpp"

namespace rodeira::opendrive {
namespace {

Import WithSignals(const std::string& signals) {
  RoadText road;
  road.more = "<signals>" + signals + "</signals>";
  return MustImport(Document(road.Text()));
}

std::vector<std::string> Said(const Import& import) {
  std::vector<std::string> said;
  for (const Finding& warning : import.warnings) said.push_back(warning.Text());
  return said;
}

TEST(Boards, SignsAreSignalsAtTheirPlacesOnTheBoard) {
  const Import import = WithSignals(
      R"(<signal s="40" t="-6" id="534" name="board" dynamic="no" orientation="+" zOffset="2" country="OpenDRIVE"
          type="staticBoard" subtype="-1" height="2.0" width="1.5">
    <validity fromLane="-2" toLane="-1"/><dependency id="9"/>
    <staticBoard><sign id="535" country="DE" type="274" subtype="-1" v="-0.5" z="1.5" width="0.5" height="0.5"
      value="60" unit="km/h"><validity fromLane="-1" toLane="-1"/><signalDependency id="536"/></sign>
    <sign id="536" country="DE" type="206" subtype="-1" v="0.3" z="0.9" width="0.42" height="0.42"/></staticBoard>
      </signal>)");
  EXPECT_THAT(Said(import), testing::IsEmpty());
  const auto& signals = import.network->roads()[0].spec().signals;
  ASSERT_EQ(signals.size(), 3u);
  EXPECT_TRUE(network::IsBoard(signals[0]));
  EXPECT_TRUE(signals[0].board.empty());
  for (const std::size_t i : {1u, 2u}) {
    EXPECT_EQ(signals[i].board, "534");
    EXPECT_EQ(signals[i].s_m, 40.0);
    EXPECT_EQ(signals[i].t_m, -6.0);
    EXPECT_EQ(signals[i].z_offset_m, 2.0);
    EXPECT_EQ(signals[i].orientation, "+");
  }
  EXPECT_EQ(signals[1].id, "535");
  EXPECT_EQ(signals[1].board_left_m, -0.5);
  EXPECT_EQ(signals[1].board_up_m, 1.5);
  EXPECT_EQ(signals[1].value, 60.0);
  ASSERT_EQ(signals[1].validity.size(), 1u);  // its own, in the place of the board's
  EXPECT_EQ(signals[1].validity[0].from_lane, -1);
  EXPECT_THAT(signals[1].depends_on, testing::ElementsAre("536"));
  ASSERT_EQ(signals[2].validity.size(), 1u);  // the board's
  EXPECT_EQ(signals[2].validity[0].from_lane, -2);
  EXPECT_THAT(signals[2].depends_on, testing::ElementsAre("9"));
}

TEST(Boards, DisplaysAreDarkPiecesOfTheirBoards) {
  const Import import = WithSignals(R"(
    <signal s="40" t="-2" id="1" dynamic="yes" orientation="+" zOffset="5" type="vmsBoard" subtype="-1" height="1.5"
      width="1.5"><vmsBoard displayType="colorGraphics" displayHeight="1.5" displayWidth="1.5" v="0" z="0">
      <displayArea index="1" v="0" z="0" width="1.4" height="1.4"/></vmsBoard></signal>
    <signal s="60" t="-2" id="2" dynamic="yes" orientation="+" zOffset="5" type="multiBoard" subtype="-1" height="3"
      width="7.5"><vmsBoard displayType="colorGraphics" displayHeight="2.5" displayWidth="7" v="0.1" z="0.5"/>
      <staticBoard><sign id="3" country="DE" type="206" subtype="-1" v="-3" z="0.1"/></staticBoard></signal>)");
  EXPECT_THAT(Said(import), testing::IsEmpty());
  const auto& signals = import.network->roads()[0].spec().signals;
  ASSERT_EQ(signals.size(), 4u);
  EXPECT_EQ(signals[0].id, "1");
  EXPECT_EQ(signals[1].id, "2");
  EXPECT_EQ(signals[2].id, "3");
  EXPECT_EQ(signals[3].type, network::kDisplay);
  EXPECT_EQ(signals[3].board, "2");
  EXPECT_EQ(signals[3].width_m, 7.0);
  EXPECT_EQ(signals[3].board_left_m, 0.1);
  EXPECT_EQ(signals[3].board_up_m, 0.5);
}

// Files that say nothing of a board's type or measures: what is on it needs something to be on.
TEST(Boards, ABoardIsOneByWhatIsOnItAndAsLarge) {
  const Import import = WithSignals(
      R"(<signal s="40" t="-6" id="1" dynamic="no" orientation="+" type="-1" subtype="-1"><staticBoard>
          <sign id="2" country="DE" type="206" subtype="-1" v="0.75" z="1.0" width="0.5" height="0.4"/>
          <sign id="3" country="DE" type="205" subtype="-1" v="-0.2" z="0"/></staticBoard></signal>)");
  const auto& signals = import.network->roads()[0].spec().signals;
  ASSERT_EQ(signals.size(), 3u);
  EXPECT_TRUE(network::IsBoard(signals[0]));
  EXPECT_NEAR(signals[0].width_m, 2.0, 1e-12);
  EXPECT_NEAR(signals[0].height_m, 1.4, 1e-12);
}

}  // namespace
}  // namespace rodeira::opendrive
