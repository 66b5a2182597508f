// SPDX-License-Identifier: Apache-2.0
#include "common/world/lights/light_plan.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace rodeira::lights {
namespace {

using network::ColourAt;
using network::LightColour;
using network::LightTimes;
using testing::HasSubstr;

// What ReadLightPlan says of a text, and its first problem.
std::pair<LightPlan, std::string> Read(const std::string& text) {
  const auto file = config::File::Parse(text, "lights.yaml");
  EXPECT_TRUE(file.ok());
  LightPlan plan = ReadLightPlan(file.value().root());
  const auto status = file.value().Finish();
  return {plan, status ? "" : status.error().Text()};
}

// The table of a plan, written by hand: a second of each.
TEST(LightPlan, ShowsWhatItsTableSays) {
  const auto [plan, problem] =
      Read("offset_s: 2\nphases:\n- {green: [a], for_s: 4}\n- {green: [b, c], for_s: 3}\n- {green: [c], for_s: 2}\n");
  ASSERT_EQ(problem, "");
  EXPECT_DOUBLE_EQ(plan.cycle_s(), 24.0);
  const auto row = [&](const char* name) {
    const LightTimes times = *TimesOf(plan, name);
    std::string letters;
    for (int t = 0; t < 24; ++t)
      letters += "rxga"[static_cast<int>(ColourAt(times, t * 1'000'000'000LL + 500'000'000LL))];
    return letters;
  };
  //                      0         1         2
  //                      012345678901234567890123
  EXPECT_EQ(row("a"), "rxggggaaarrrrrrrrrrrrrrr");
  EXPECT_EQ(row("b"), "rrrrrrrrrrxgggaaarrrrrrr");
  EXPECT_EQ(row("c"), "rrrrrrrrrrxggggggggggaaa");
}

TEST(LightPlan, GreenGoesOnRoundTheEndOfTheCycleAndForEver) {
  const auto [plan, problem] =
      Read("phases:\n- {green: [a, all], for_s: 10}\n- {green: [b, all], for_s: 10}\n- {green: [a, all], for_s: 10}\n");
  ASSERT_EQ(problem, "");
  const LightTimes a = *TimesOf(plan, "a"), all = *TimesOf(plan, "all");
  EXPECT_DOUBLE_EQ(a.green_from_s, 30.0);  // the third phase, and the first one of the next cycle
  EXPECT_DOUBLE_EQ(a.green_s, 25.0);
  for (std::int64_t t = 0; t < 45; ++t) EXPECT_EQ(ColourAt(all, t * 1'000'000'000), LightColour::kGreen);
  EXPECT_FALSE(TimesOf(plan, "nobody").has_value());
}

TEST(LightPlan, RefusesWithASentence) {
  for (const auto& [text, sentence] :
       {std::pair("phases: []\n", "'phases' is empty"), std::pair("phases:\n- {green: [a], for_s: 0}\n", "for_s"),
        std::pair("phases:\n- {green: [a], for_s: 5}\n- {green: [b], for_s: 5}\n- {green: [a], for_s: 5}\n- {green: "
                  "[b], for_s: 5}\n",
                  "'a' becomes green more than once in a cycle"),
        std::pair("phases:\n- {green: [a, a], for_s: 5}\n", "'a' is named twice"),
        std::pair("red_amber_s: 9\nphases:\n- {green: [a], for_s: 5}\n", "'red_amber_s' is longer"),
        std::pair("amber: 3\nphases:\n- {green: [a], for_s: 5}\n", "unknown key 'amber'")}) {
    EXPECT_THAT(Read(text).second, HasSubstr(sentence)) << text;
  }
}

TEST(LightTimes, FurtherGreensLieInTheCycleAndOverlapNoOther) {
  using network::WrongTimes;
  const LightTimes good{60.0, 50.0, 15.0, 3.0, 1.0, {{10.0, 5.0, 3.0, 1.0}, {30.0, 10.0, 3.0, 1.0}}};
  EXPECT_EQ(WrongTimes(good), nullptr);
  EXPECT_EQ(ColourAt(good, 4'000'000'000), LightColour::kGreen);  // from 50 s on, over the end of the cycle
  EXPECT_EQ(ColourAt(good, 6'000'000'000), LightColour::kAmber);
  EXPECT_EQ(ColourAt(good, 9'000'000'000), LightColour::kRedAmber);
  EXPECT_EQ(ColourAt(good, 12'000'000'000), LightColour::kGreen);
  EXPECT_EQ(ColourAt(good, 29'500'000'000), LightColour::kRedAmber);
  EXPECT_EQ(ColourAt(good, 45'000'000'000), LightColour::kRed);
  EXPECT_EQ(ColourAt(good, 99'000'000'000), LightColour::kGreen);
  const auto wrong = [&](const auto& change) {
    LightTimes times = good;
    change(times);
    return WrongTimes(times) != nullptr;
  };
  EXPECT_TRUE(wrong([](LightTimes& t) { t.more[0].from_s = 7.0; })) << "in the amber of the first, and red with amber";
  EXPECT_TRUE(wrong([](LightTimes& t) { t.more[1].green_s = 17.0; })) << "into the first one of the next cycle";
  EXPECT_TRUE(wrong([](LightTimes& t) { std::swap(t.more[0], t.more[1]); })) << "out of order";
  EXPECT_TRUE(wrong([](LightTimes& t) { t.more[1].from_s = 61.0; }));
  EXPECT_TRUE(wrong([](LightTimes& t) { t.more[1].green_s = 0.0; }));
  EXPECT_TRUE(wrong([](LightTimes& t) { t.more[1].amber_s = -1.0; }));
}

// Against looking at both lights each tenth of a second for as long as both cycles last together.
TEST(LightTimes, MeetGreenIsWhatOneSees) {
  std::mt19937 random(3);
  int met = 0;
  for (int trial = 0; trial < 400; ++trial) {
    const auto draw = [&](int low, int high) {
      return static_cast<double>(low + static_cast<int>(random() % static_cast<unsigned>(high - low + 1)));
    };
    const double cycle = draw(12, 30);
    LightTimes a{cycle, draw(0, 11), draw(0, 6), draw(1, 3), 1.0}, b{cycle, draw(0, 11), draw(0, 6), draw(1, 3), 1.0};
    if (trial % 20 == 0) a.green_s = cycle;
    // Every other light has a second green, where there is room for one.
    network::LightTimes second = b;
    second.more.push_back({std::fmod(b.green_from_s + b.green_s + b.amber_s + 3.0, cycle), draw(1, 3), 1.0, 1.0});
    if (trial % 2 == 0 && b.green_s > 0.0 && network::WrongTimes(second) == nullptr) b = second;
    bool seen = false;
    for (std::int64_t t = 0; t < static_cast<std::int64_t>(cycle) * 10; ++t) {
      const auto on = [&](const LightTimes& times) {
        const LightColour colour = ColourAt(times, t * 100'000'000 + 50'000'000);
        return colour == LightColour::kGreen || colour == LightColour::kAmber;
      };
      seen = seen || (on(a) && on(b));
    }
    EXPECT_EQ(network::MeetGreen(a, b), seen) << trial;
    met += seen ? 1 : 0;
  }
  EXPECT_GT(met, 50);
  EXPECT_LT(met, 350);
}

}  // namespace
}  // namespace rodeira::lights
