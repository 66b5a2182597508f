// SPDX-License-Identifier: Apache-2.0
// Signs that contradict the limits of lanes and road types are told, once a kind.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/common/world/opendrive/sample.hpp"

namespace rodeira::opendrive {
namespace {

using testing::IsEmpty;

std::string Sign(int id, double s_m, const std::string& orientation, int kmh) {
  return fmt::format(
      "<signal id=\"{}\" s=\"{}\" t=\"-5\" orientation=\"{}\" dynamic=\"no\" zOffset=\"0\" country=\"DE\" "
      "type=\"274\" subtype=\"-1\" value=\"{}\" unit=\"km/h\"/>",
      id, s_m, orientation, kmh);
}

// Lane -1 says 70 km/h from 40 m on, and the road's type 50 km/h.
std::vector<Finding> Told(const std::string& signals) {
  RoadText road;
  road.right =
      "<lane id=\"-1\" type=\"driving\"><width sOffset=\"0\" a=\"3.5\" b=\"0\" c=\"0\" d=\"0\"/>"
      "<speed sOffset=\"40\" max=\"70\" unit=\"km/h\"/></lane>";
  road.more = "<type s=\"0\" type=\"town\"><speed max=\"50\" unit=\"km/h\"/></type><signals>" + signals + "</signals>";
  auto told = MustImport(Document(road.Text())).warnings;
  std::erase_if(told, [](const Finding& finding) { return !finding.rule.starts_with("rodeira.signal.limit"); });
  return told;
}

TEST(SignLimits, ContradictionsAreToldOnceAKind) {
  const auto kinds =
      OneEachKind(Told(Sign(1, 20, "+", 30) + Sign(2, 80, "+", 30) + Sign(3, 90, "+", 60) + Sign(4, 90, "-", 70)));
  ASSERT_EQ(kinds.size(), 2u);
  EXPECT_EQ(kinds[0].rule, "rodeira.signal.limit_of_type");
  EXPECT_EQ(kinds[0].lane, -1);
  EXPECT_EQ(kinds[0].s_m, 20.0);
  EXPECT_THAT(kinds[0].message, testing::HasSubstr("(2 of this kind)"));
  EXPECT_EQ(kinds[1].rule, "rodeira.signal.limit_of_lane");
  EXPECT_EQ(kinds[1].s_m, 80.0);
  EXPECT_THAT(kinds[1].message, testing::HasSubstr("(2 of this kind)"));
}

TEST(SignLimits, ASignThatAgreesOrStandsAFewMetresFromTheChangeIsNotTold) {
  EXPECT_THAT(Told(Sign(1, 20, "+", 50) + Sign(2, 36, "+", 70) + Sign(3, 80, "+", 70) + Sign(4, 90, "-", 50)),
              IsEmpty());
}

}  // namespace
}  // namespace rodeira::opendrive
