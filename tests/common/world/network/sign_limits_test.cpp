// SPDX-License-Identifier: Apache-2.0
// Limits by signs: where they begin and end, and that what lanes and road types say goes before them.
#include "common/world/network/sign_limits.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/common/world/opendrive/sample.hpp"

namespace rodeira::network {
namespace {

using opendrive::Document;
using opendrive::MustRead;
using opendrive::RoadText;

constexpr double kKmh = 1.0 / 3.6;

std::string Sign(const std::string& id, double s_m, const std::string& orientation, const std::string& attributes,
                 const std::string& inside = "") {
  return fmt::format(
      "<signal id=\"{}\" s=\"{}\" t=\"-5\" orientation=\"{}\" dynamic=\"no\" zOffset=\"0\" country=\"DE\" {}>{}"
      "</signal>",
      id, s_m, orientation, attributes, inside);
}
std::string Limit(const std::string& id, double s_m, const std::string& orientation, int kmh,
                  const std::string& inside = "") {
  return Sign(id, s_m, orientation, fmt::format("type=\"274\" subtype=\"-1\" value=\"{}\" unit=\"km/h\"", kmh), inside);
}
RoadText WithSignals(const std::string& signals) {
  RoadText road;
  road.more = "<signals>" + signals + "</signals>";
  return road;
}

// In km/h; nothing where nothing is said.
std::optional<double> LimitAt(const Network& network, const std::string& road_id, int lane, double s_m) {
  const Road& road = network.roads()[network.FindRoad(road_id).value()];
  const auto limit = road.SpeedLimitAt(*road.SectionAt(s_m).Find(lane), s_m);
  return limit ? std::optional(std::round(*limit / kKmh * 1e6) / 1e6) : std::nullopt;
}

TEST(SignLimits, HoldForTheirDirectionFromWhereTheyStandToTheNextOrAnEnd) {
  const auto network =
      MustRead(Document(WithSignals(Limit("a", 20, "+", 70) + Limit("b", 40, "+", 50) +
                                    Sign("c", 60, "+", "type=\"278\" subtype=\"-1\"") + Limit("d", 80, "-", 30) +
                                    Sign("e", 10, "-", "type=\"282\" subtype=\"-1\""))
                            .Text()));
  EXPECT_EQ(LimitAt(*network, "1", -1, 19.9), std::nullopt);
  EXPECT_EQ(LimitAt(*network, "1", -1, 20.0), 70.0);
  EXPECT_EQ(LimitAt(*network, "1", -1, 59.9), 50.0);
  EXPECT_EQ(LimitAt(*network, "1", -1, 60.1), std::nullopt);
  EXPECT_EQ(LimitAt(*network, "1", 1, 80.1), std::nullopt);
  EXPECT_EQ(LimitAt(*network, "1", 1, 79.9), 30.0);
  EXPECT_EQ(LimitAt(*network, "1", 1, 10.1), 30.0);
  EXPECT_EQ(LimitAt(*network, "1", 1, 9.9), std::nullopt);
}

TEST(SignLimits, LanesAndRoadTypesGoBeforeThem) {
  RoadText road = WithSignals(Limit("a", 0, "+", 70) + Limit("b", 100, "-", 70));
  road.more = "<type s=\"50\" type=\"town\"><speed max=\"40\" unit=\"km/h\"/></type>" + road.more;
  road.right =
      "<lane id=\"-1\" type=\"driving\"><width sOffset=\"0\" a=\"3.5\" b=\"0\" c=\"0\" d=\"0\"/>"
      "<speed sOffset=\"80\" max=\"20\" unit=\"km/h\"/></lane>";
  const auto network = MustRead(Document(road.Text()));
  EXPECT_EQ(LimitAt(*network, "1", -1, 49.0), 70.0);
  EXPECT_EQ(LimitAt(*network, "1", -1, 51.0), 40.0);
  EXPECT_EQ(LimitAt(*network, "1", -1, 81.0), 20.0);
  EXPECT_EQ(LimitAt(*network, "1", 1, 99.0), 40.0);
  EXPECT_EQ(LimitAt(*network, "1", 1, 49.0), 70.0);
}

TEST(SignLimits, GoOnOverJointsOfRoadsAndNotIntoJunctions) {
  // Road 2 lies the other way round: its end meets the end of road 1, and its beginning the junction.
  RoadText first = WithSignals(Limit("a", 10, "+", 80)), second, way;
  const auto lane = [](int id, const std::string& link) {
    return fmt::format(
        "<lane id=\"{}\" type=\"driving\"><link>{}</link><width sOffset=\"0\" a=\"3.5\" b=\"0\" c=\"0\" "
        "d=\"0\"/></lane>",
        id, link);
  };
  first.link = R"(<successor elementType="road" elementId="2" contactPoint="end"/>)";
  first.right = lane(-1, R"(<successor id="1"/>)");
  first.left = lane(1, R"(<successor id="-1"/>)");
  second.id = "2";
  second.geometry = R"(<geometry s="0" x="200" y="0" hdg="3.14159265358979" length="100"><line/></geometry>)";
  second.link = R"(<predecessor elementType="junction" elementId="9"/>
      <successor elementType="road" elementId="1" contactPoint="end"/>)";
  second.right = lane(-1, R"(<successor id="1"/>)");
  second.left = lane(1, R"(<successor id="-1"/>)");
  way.id = "3";
  way.attributes = "junction=\"9\"";
  way.geometry = R"(<geometry s="0" x="200" y="0" hdg="0" length="100"><line/></geometry>)";
  way.link = R"(<predecessor elementType="road" elementId="2" contactPoint="start"/>)";
  way.left = "";
  way.right = lane(-1, R"(<predecessor id="1"/>)");
  const auto network = MustRead(
      Document(first.Text() + second.Text() + way.Text() +
               R"(<junction id="9" name=""><connection id="0" incomingRoad="2" connectingRoad="3" contactPoint="start">
      <laneLink from="1" to="-1"/></connection></junction>)"));
  EXPECT_EQ(LimitAt(*network, "1", -1, 99.0), 80.0);
  EXPECT_EQ(LimitAt(*network, "2", 1, 99.0), 80.0);
  EXPECT_EQ(LimitAt(*network, "2", 1, 1.0), 80.0);
  EXPECT_EQ(LimitAt(*network, "2", -1, 50.0), std::nullopt);
  EXPECT_EQ(LimitAt(*network, "3", -1, 50.0), std::nullopt);
}

TEST(SignLimits, OfOneLaneHoldsOnItAloneAndALaneThatOpensHasThatOfTheLaneBeside) {
  RoadText road =
      WithSignals(Limit("a", 5, "+", 100) + Limit("b", 60, "+", 60, R"(<validity fromLane="-2" toLane="-2"/>)"));
  std::string text = road.Text();
  const std::string lanes =
      R"(<laneSection s="50"><center><lane id="0" type="none"/></center><right>
      <lane id="-1" type="driving"><link><predecessor id="-1"/></link>
      <width sOffset="0" a="3.5" b="0" c="0" d="0"/></lane>
      <lane id="-2" type="driving"><width sOffset="0" a="0" b="0.1" c="0" d="0"/></lane>
      <lane id="-3" type="driving"><width sOffset="0" a="0" b="0.1" c="0" d="0"/></lane>
      </right></laneSection>)";
  text.insert(text.find("</lanes>"), lanes);
  const auto network = MustRead(Document(text));
  EXPECT_EQ(LimitAt(*network, "1", -1, 70.0), 100.0);
  EXPECT_EQ(LimitAt(*network, "1", -2, 55.0), 100.0);
  EXPECT_EQ(LimitAt(*network, "1", -2, 70.0), 60.0);
  EXPECT_EQ(LimitAt(*network, "1", -3, 70.0), 100.0);
}

TEST(SignLimits, ARingWithOneSignHasItsLimitAllAround) {
  RoadText road = WithSignals(Limit("a", 50, "+", 30));
  road.length = 200.0;
  road.geometry =
      fmt::format("<geometry s=\"0\" x=\"0\" y=\"0\" hdg=\"0\" length=\"200\"><arc curvature=\"{:.17g}\"/></geometry>",
                  2.0 * std::acos(-1.0) / 200.0);
  road.link = R"(<predecessor elementType="road" elementId="1" contactPoint="end"/>
      <successor elementType="road" elementId="1" contactPoint="start"/>)";
  road.left = "";
  road.right =
      "<lane id=\"-1\" type=\"driving\"><link><predecessor id=\"-1\"/><successor id=\"-1\"/></link>"
      "<width sOffset=\"0\" a=\"3.5\" b=\"0\" c=\"0\" d=\"0\"/></lane>";
  const auto network = MustRead(Document(road.Text()));
  EXPECT_EQ(LimitAt(*network, "1", -1, 10.0), 30.0);
  EXPECT_EQ(LimitAt(*network, "1", -1, 150.0), 30.0);
}

TEST(SignLimits, UnitsAreThoseOfTheSignAndMphWhereItsCountryCountsMiles) {
  Signal sign;
  sign.type = "274";
  sign.value = 60.0;
  EXPECT_NEAR(SignLimitOf(sign)->speed_mps.value(), 60.0 * kKmh, 1e-12);
  sign.unit = "mph";
  EXPECT_NEAR(SignLimitOf(sign)->speed_mps.value(), 60.0 * 0.44704, 1e-12);
  sign.unit = "m/s", sign.value = 13.9;
  EXPECT_EQ(SignLimitOf(sign)->speed_mps, 13.9);
  sign.value.reset(), sign.unit.clear(), sign.subtype = "57";
  EXPECT_NEAR(SignLimitOf(sign)->speed_mps.value(), 70.0 * kKmh, 1e-12);
  sign.subtype = "-1";
  EXPECT_FALSE(SignLimitOf(sign)) << "no number is shown";
  sign.value = 5000.0;
  EXPECT_FALSE(SignLimitOf(sign));
  Signal named;
  named.type = "-1", named.name = "Sign_SpeedLimit_25";
  EXPECT_NEAR(SignLimitOf(named)->speed_mps.value(), 25.0 * 0.44704, 1e-12);
  named.name = "Sign_Stop";
  EXPECT_FALSE(SignLimitOf(named));
}

// Speeds of a value without a unit: miles an hour on signs of the United Kingdom (TSRGD 670) and the United States
// (MUTCD R2-1), km/h in China (GB 5768.2).
TEST(SignLimits, OfOtherCataloguesAreInTheirCountrysUnit) {
  const auto limit = [](const char* country, const char* type, double value) {
    Signal sign;
    sign.country = country, sign.type = type, sign.subtype = "-1", sign.value = value;
    return SignLimitOf(sign);
  };
  constexpr double kMph = 0.44704;
  EXPECT_NEAR(limit("GB", "670", 30.0)->speed_mps.value(), 30.0 * kMph, 1e-12);
  EXPECT_NEAR(limit("US", "R2-1", 55.0)->speed_mps.value(), 55.0 * kMph, 1e-12);
  EXPECT_NEAR(limit("usa", "r2-1", 55.0)->speed_mps.value(), 55.0 * kMph, 1e-12);
  EXPECT_NEAR(limit("CN", "禁38", 40.0)->speed_mps.value(), 40.0 * kKmh, 1e-12);
  for (const auto& [country, type] : {std::pair("GB", "671"), std::pair("CN", "禁39")}) {
    ASSERT_TRUE(limit(country, type, 40.0)) << type;
    EXPECT_FALSE(limit(country, type, 40.0)->speed_mps) << type;
  }
  EXPECT_FALSE(limit("GB", "610", 40.0));
  EXPECT_FALSE(limit("US", "W13-1", 35.0)) << "advice is no limit";
}

}  // namespace
}  // namespace rodeira::network
