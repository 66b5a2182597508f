// SPDX-License-Identifier: Apache-2.0
// What goes on into what, by a small network with visible answers: a road that splits in a junction.
#include <gtest/gtest.h>

#include "tests/common/world/opendrive/sample.hpp"

namespace rodeira::network {
namespace {

using opendrive::Document;
using opendrive::MustRead;
using opendrive::RoadText;

// In (0 to 100), two ways through junction 9: 10 straight on to road 2, and 11 along an arc to the left.
std::string Fork() {
  RoadText in, out, straight, turn;
  in.link = R"(<successor elementType="junction" elementId="9"/>)";
  out.id = "2";
  out.link = R"(<predecessor elementType="junction" elementId="9"/>)";
  out.geometry = R"(<geometry s="0" x="120" y="0" hdg="0" length="100"><line/></geometry>)";
  straight.id = "10";
  straight.attributes = "junction=\"9\"";
  straight.length = 20;
  straight.geometry = R"(<geometry s="0" x="100" y="0" hdg="0" length="20"><line/></geometry>)";
  straight.link =
      R"(<predecessor elementType="road" elementId="1" contactPoint="end"/>
          <successor elementType="road" elementId="2" contactPoint="start"/>)";
  straight.left =
      R"(<lane id="1" type="driving"><link><predecessor id="1"/><successor id="1"/></link>
          <width sOffset="0" a="3.5" b="0" c="0" d="0"/></lane>)";
  straight.right =
      R"(<lane id="-1" type="driving"><link><predecessor id="-1"/><successor id="-1"/></link>
          <width sOffset="0" a="3.5" b="0" c="0" d="0"/></lane>)";
  turn.id = "11";
  turn.attributes = "junction=\"9\"";
  turn.length = 30;
  turn.geometry = R"(<geometry s="0" x="100" y="0" hdg="0" length="30"><arc curvature="0.03"/></geometry>)";
  turn.link = R"(<predecessor elementType="road" elementId="1" contactPoint="end"/>)";
  turn.left = "";
  turn.right =
      R"(<lane id="-1" type="driving"><link><predecessor id="-1"/></link><width sOffset="0" a="3.5" b="0" c="0" d="0"/>
          </lane>)";
  return Document(
      in.Text() + out.Text() + straight.Text() + turn.Text() +
      R"(<junction id="9" name="fork"><connection id="0" incomingRoad="1" connectingRoad="10" contactPoint="start">
          <laneLink from="-1" to="-1"/></connection>
                     <connection id="1" incomingRoad="1" connectingRoad="11" contactPoint="start">
                       <laneLink from="-1" to="-1"/></connection>
                     <connection id="2" incomingRoad="2" connectingRoad="10" contactPoint="end">
                       <laneLink from="1" to="1"/></connection></junction>)");
}

TEST(Links, LeadThroughAJunctionAndBack) {
  const auto network = MustRead(Fork());
  const auto key = [&](const char* road, int lane) { return LaneKey{*network->FindRoad(road), 0, lane}; };
  const auto ends = [](std::span<const LaneEnd> list) { return std::vector<LaneEnd>(list.begin(), list.end()); };
  using List = std::vector<LaneEnd>;
  EXPECT_EQ(ends(network->Successors(key("1", -1))),
            (List{{key("10", -1), End::kStart}, {key("11", -1), End::kStart}}));
  EXPECT_EQ(ends(network->Predecessors(key("2", -1))), (List{{key("10", -1), End::kEnd}}));
  EXPECT_EQ(ends(network->Successors(key("10", -1))), (List{{key("2", -1), End::kStart}}));
  EXPECT_EQ(ends(network->Predecessors(key("11", -1))), (List{{key("1", -1), End::kEnd}}));
  EXPECT_TRUE(network->Successors(key("11", -1)).empty());
  // The other way, against s.
  EXPECT_EQ(ends(network->Successors(key("2", 1))), (List{{key("10", 1), End::kEnd}}));
  EXPECT_EQ(ends(network->Successors(key("10", 1))), (List{{key("1", 1), End::kEnd}}));
  EXPECT_EQ(ends(network->Predecessors(key("1", 1))), (List{{key("10", 1), End::kStart}}));
  EXPECT_TRUE(network->Predecessors(key("1", -1)).empty());
}

TEST(Links, NeighboursPassOverTheCentre) {
  const auto network = MustRead(Document(RoadText().Text()));
  const LaneKey left{0, 0, 1}, right{0, 0, -1};
  EXPECT_EQ(network->Left(right), left);
  EXPECT_EQ(network->Right(left), right);
  EXPECT_FALSE(network->Left(left).has_value());
  EXPECT_FALSE(network->Right(right).has_value());
  EXPECT_NEAR((network->Centre(right, 40.0) - Eigen::Vector3d(40.0, -1.75, 0.0)).norm(), 0.0, 1e-14);
}

// In real networks a link is known from both sides, and what is linked lies in one place.
TEST(Links, MeetOnRealFiles) {
  const auto files = opendrive::RealFiles();
  if (files.empty()) GTEST_SKIP() << "no real .xodr files beside the project";
  std::size_t links = 0;
  for (const auto& file : files) {
    const auto network = opendrive::LoadNetwork(file).value();
    const auto end_of = [&](const LaneEnd& end) {
      const LaneSection& section = network->Section(end.lane);
      return network->Centre(end.lane, end.end == End::kStart ? section.s_m : section.end_s_m);
    };
    for (const LaneKey& key : network->Lanes()) {
      if (!IsDrivable(network->Find(key)->type)) continue;
      for (const LaneEnd& other : network->AtEnd(key)) {
        ++links;
        const auto back = other.end == End::kStart ? network->AtStart(other.lane) : network->AtEnd(other.lane);
        EXPECT_TRUE(std::find(back.begin(), back.end(), LaneEnd{key, End::kEnd}) != back.end());
        EXPECT_LT((end_of({key, End::kEnd}) - end_of(other)).head<2>().norm(), 0.05)
            << file.filename() << " " << network->roads()[key.road].id() << " " << key.lane;
      }
    }
  }
  EXPECT_GT(links, 1000u);
}

}  // namespace
}  // namespace rodeira::network
