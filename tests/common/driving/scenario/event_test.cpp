// SPDX-License-Identifier: Apache-2.0
#include "common/driving/scenario/event.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace rodeira::scenario {
namespace {

TEST(Event, APlaceIsReadBackToTheBit) {
  for (const double x : {0.1, -1234.5678901234567, 1e-300, 4.0e7, std::numeric_limits<double>::denorm_min()}) {
    const PlaceChoice place{"ego", x, -x / 3.0, x * 7.0};
    const auto read = ParsePlace(PlaceText(place));
    ASSERT_TRUE(read.ok()) << read.error().Text();
    EXPECT_EQ(read.value().vehicle, "ego");
    EXPECT_EQ(read.value().x_m, place.x_m);
    EXPECT_EQ(read.value().y_m, place.y_m);
    EXPECT_EQ(read.value().z_m, place.z_m);
  }
  const auto flat = ParsePlace("car 12.5 -3.25");
  ASSERT_TRUE(flat.ok());
  EXPECT_FALSE(flat.value().z_m);
}

TEST(Event, WhatIsNoPlaceIsRefused) {
  for (const char* text : {"", "ego", "ego 1", "ego 1 2 3 4", "ego  1 2", " 1 2", "ego 1 nan", "ego inf 2", "ego 1x 2",
                           "ego 1 2 x", "ego 1,5 2", "ego 1 2 "}) {
    const auto read = ParsePlace(text);
    ASSERT_FALSE(read.ok()) << text;
    EXPECT_EQ(read.error().exit_status(), 2);
    EXPECT_NE(read.error().Text().find("is no place; the name of a vehicle node and metres"), std::string::npos)
        << read.error().Text();
  }
}

TEST(Event, AGustIsACarADirectionAndSeconds) {
  const auto gust = ParseGust("ego -45.5 1.5");
  ASSERT_TRUE(gust.ok());
  EXPECT_EQ(gust.value().vehicle, "ego");
  EXPECT_EQ(gust.value().from_deg, -45.5);
  EXPECT_EQ(gust.value().for_s, 1.5);
  for (const char* text :
       {"", "ego", "ego 1", "ego 361 1", "ego 90 0", "ego 90 -1", "ego 90 nan", "ego 90 1 2", " 90 1", "ego 90 4000"}) {
    ASSERT_FALSE(ParseGust(text).ok()) << text;
    EXPECT_EQ(CheckEvent({"vehicle.gust", text, 10.0}).error().id.text(), "scenario.wrong_text") << text;
  }
  EXPECT_TRUE(CheckEvent({"vehicle.gust", "ego 90 1.5", 60.0}));
  EXPECT_EQ(CheckEvent({"vehicle.gust", "ego 90 1.5", 61.0}).error().id.text(), "scenario.wrong_value");
}

TEST(Event, ATyreIsACarAWheelAndSeconds) {
  const auto tyre = ParseTyre("ego rear_left 0.5");
  ASSERT_TRUE(tyre.ok());
  EXPECT_EQ(tyre.value().vehicle, "ego");
  EXPECT_EQ(tyre.value().wheel, 2u);
  EXPECT_EQ(tyre.value().over_s, 0.5);
  for (const char* text : {"", "ego", "ego rear_left", "ego rear 1", "ego rear_left -1", "ego rear_left nan",
                           "ego rear_left 1 2", " rear_left 1", "ego rear_left 4000"}) {
    ASSERT_FALSE(ParseTyre(text).ok()) << text;
    EXPECT_EQ(CheckEvent({"vehicle.tyre_pressure", text, 0.5}).error().id.text(), "scenario.wrong_text") << text;
  }
  EXPECT_NE(ParseTyre("ego rear_lef 1").error().message.find("did you mean 'rear_left'"), std::string::npos);
  EXPECT_TRUE(CheckEvent({"vehicle.tyre_pressure", "ego rear_left 0", 0.0}));
  EXPECT_EQ(CheckEvent({"vehicle.tyre_pressure", "ego rear_left 0", 1.6}).error().id.text(), "scenario.wrong_value");
}

TEST(Event, ACrossingIsARoadAPlaceAndASide) {
  const auto right = ParseCrossing("main 120.5"), left = ParseCrossing("long road 3 left");
  ASSERT_TRUE(right.ok() && left.ok());
  EXPECT_EQ(right.value().road, "main");
  EXPECT_EQ(right.value().s_m, 120.5);
  EXPECT_FALSE(right.value().from_left);
  EXPECT_EQ(left.value().road, "long road");
  EXPECT_EQ(left.value().s_m, 3.0);
  EXPECT_TRUE(left.value().from_left);
  for (const char* text : {"", "main", "120", "main left", "main x left", " 5", "main 12 up", "left", "main nan"}) {
    const auto read = ParseCrossing(text);
    ASSERT_FALSE(read.ok()) << text;
    EXPECT_EQ(read.error().exit_status(), 2);
    EXPECT_EQ(read.error().id.text(), "scenario.wrong_text") << read.error().Text();
  }
}

TEST(Event, AnAgentMayBeMeantAtAPlace) {
  const auto one = ParseAgent("12"), at = ParseAgent("12 at main 350.5"), next = ParseAgent("next at long road 3"),
             all = ParseAgent("all at 7 0");
  ASSERT_TRUE(one.ok() && at.ok() && next.ok() && all.ok());
  EXPECT_FALSE(one.value().at);
  EXPECT_EQ(at.value().kind, AgentChoice::Kind::kOne);
  EXPECT_EQ(at.value().id, 12u);
  EXPECT_EQ(at.value().at->road, "main");
  EXPECT_EQ(at.value().at->s_m, 350.5);
  EXPECT_EQ(next.value().kind, AgentChoice::Kind::kNext);
  EXPECT_EQ(next.value().at->road, "long road");
  EXPECT_EQ(all.value().kind, AgentChoice::Kind::kAll);
  EXPECT_EQ(AgentText("next", *next.value().at), "next at long road 3");
  for (const char* text :
       {"12 at", "12 at ", "12 at main", "12 at main x", "12 at main -3", "12 at  5", "12 at main nan"}) {
    const auto read = ParseAgent(text);
    ASSERT_FALSE(read.ok()) << text;
    EXPECT_EQ(read.error().id.text(), "scenario.wrong_text") << text;
  }
  for (const char* text : {"next", "first at main 3"})
    EXPECT_EQ(ParseAgent(text).error().id.text(), "scenario.wrong_text") << text;
}

TEST(Event, AVehicleAppearsOnALane) {
  const auto read = ParseAgentOnLane("20 at long road:-2 350.5");
  ASSERT_TRUE(read.ok()) << read.error().Text();
  EXPECT_EQ(read.value().id, 20u);
  EXPECT_EQ(read.value().at->road, "long road:-2");
  EXPECT_EQ(read.value().at->s_m, 350.5);
  for (const char* text : {"", "20", "all at main:-1 5", "next at main:-1 5", "20 at main 5", "20 at :-1 5",
                           "20 at main:x 5", "20 at main: 5", "20 at main:-1", "x at main:-1 5"}) {
    const auto refused = ParseAgentOnLane(text);
    ASSERT_FALSE(refused.ok()) << text;
    EXPECT_EQ(refused.error().id.text(), "scenario.wrong_text") << text;
  }
  EXPECT_TRUE(CheckEvent({"traffic.appear", "20 at main:-1 5", 0.0}));
  EXPECT_FALSE(CheckEvent({"traffic.appear", "20 at main:-1 5", 101.0}));
  EXPECT_TRUE(CheckEvent({"traffic.overtake", "next at main 5", 0.0}));
  EXPECT_TRUE(CheckEvent({"traffic.change_lane", "3", -1.0}));
  EXPECT_EQ(CheckEvent({"traffic.change_lane", "3", 0.5}).error().id.text(), "scenario.wrong_value");
}

TEST(Event, WhatCannotBeObeyedIsSaid) {
  EXPECT_TRUE(CheckEvent({"vehicle.place", "ego 1 2", 90.0}));
  EXPECT_TRUE(CheckEvent({"weather", "fog", 5.0}));
  EXPECT_TRUE(CheckEvent({"mark", "anything", 0.0}));
  const auto complaint = [](const Event& event) {
    const auto status = CheckEvent(event);
    return status ? std::string() : status.error().Text();
  };
  const auto id = [](const Event& event) {
    const auto status = CheckEvent(event);
    return status ? std::string() : std::string(status.error().id.text());
  };
  EXPECT_NE(complaint({"vehicle.plce", "ego 1 2", 0.0}).find("did you mean 'vehicle.place'?"), std::string::npos);
  EXPECT_EQ(id({"vehicle.plce", "ego 1 2", 0.0}), "scenario.unknown_event");
  EXPECT_EQ(complaint({"vehicle.place", "ego 1 2", 400.0}),
            "'heading_deg' of 'vehicle.place' is 400; -360 to 360 was expected");
  EXPECT_NE(complaint({"vehicle.place", "ego 1 2", std::numeric_limits<double>::quiet_NaN()}).find("heading_deg"),
            std::string::npos);
  EXPECT_EQ(id({"vehicle.place", "ego", 0.0}), "scenario.wrong_text");
  EXPECT_EQ(id({"weather", "fogg", 5.0}), "world.unknown_weather");
  EXPECT_NE(complaint({"weather", "fogg", 5.0}).find("'fogg'"), std::string::npos);
  EXPECT_EQ(id({"traffic.pedestrian", "main", 0.0}), "scenario.wrong_text");
  EXPECT_EQ(id({"traffic.brake", "nobody", 5.0}), "scenario.wrong_text");
}

}  // namespace
}  // namespace rodeira::scenario
