// SPDX-License-Identifier: Apache-2.0
// Programs of lights against the meaning of their letters: https://sumo.dlr.de/docs/Simulation/Traffic_Lights.html,
// "Signal state definitions", and the offset as SUMO counts it: a program begins at its offset.
#include "common/world/sumo/light_program.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace rodeira::sumo {
namespace {

using network::LightColour;

// The letter of a light at a time, by the plain definition.
char LetterAt(const LightProgram& program, int light, double time_s) {
  double cycle_s = 0.0;
  for (const LightPhase& phase : program.phases) cycle_s += phase.duration_s;
  double at_s = std::fmod(time_s - program.offset_s, cycle_s);
  if (at_s < 0.0) at_s += cycle_s;
  for (const LightPhase& phase : program.phases) {
    if (at_s < phase.duration_s) return phase.state[static_cast<std::size_t>(light)];
    at_s -= phase.duration_s;
  }
  return '?';
}

void ExpectSame(const LightProgram& program, int light) {
  const auto times = TimesOf(program, light);
  ASSERT_TRUE(times);
  ASSERT_EQ(network::WrongTimes(*times), nullptr);
  for (int second = 0; second < 400; ++second) {
    const char letter = LetterAt(program, light, second);
    const LightColour expected = letter == 'G' || letter == 'g' ? LightColour::kGreen
                                 : letter == 'y'                ? LightColour::kAmber
                                 : letter == 'u'                ? LightColour::kRedAmber
                                                                : LightColour::kRed;
    ASSERT_EQ(network::ColourAt(*times, std::int64_t(second) * 1'000'000'000), expected)
        << "light " << light << " at " << second << " s";
  }
}

LightProgram Program(double offset_s, std::vector<LightPhase> phases) { return {"a", "static", offset_s, phases}; }

TEST(LightProgram, ShowsWhatTheLettersSayAtEverySecond) {
  for (const double offset_s : {0.0, 17.0, -23.0, 1000.0}) {
    const LightProgram program =
        Program(offset_s, {{20, "Ggrr"}, {3, "yyrr"}, {2, "rruu"}, {31, "rrGg"}, {4, "rryy"}, {1, "uurr"}});
    for (int light = 0; light < 4; ++light) ExpectSame(program, light);
  }
}

// A green that begins at the end of the program and goes on at its beginning is one green; so is one of g and G.
TEST(LightProgram, JoinsAGreenAcrossTheEnd) {
  const LightProgram program = Program(5.0, {{10, "g"}, {3, "y"}, {30, "r"}, {12, "G"}});
  ExpectSame(program, 0);
  EXPECT_DOUBLE_EQ(TimesOf(program, 0)->green_s, 22.0);
}

// Twice the same in one program is a cycle of half the length.
TEST(LightProgram, HalvesACycleOfTwoEqualHalves) {
  const LightProgram program = Program(0.0, {{42, "G"}, {3, "y"}, {42, "G"}, {3, "y"}});
  ExpectSame(program, 0);
  EXPECT_DOUBLE_EQ(TimesOf(program, 0)->cycle_s, 45.0);
}

TEST(LightProgram, KeepsEveryGreenOfACycle) {
  for (const double offset_s : {0.0, 7.0, -40.0}) {
    ExpectSame(Program(offset_s, {{10, "G"}, {3, "y"}, {20, "r"}, {25, "G"}, {4, "y"}, {8, "r"}}), 0);
    ExpectSame(Program(offset_s, {{5, "G"}, {3, "y"}, {2, "u"}, {25, "g"}, {4, "y"}, {8, "r"}, {9, "G"}, {7, "r"}}), 0);
    ExpectSame(Program(offset_s, {{5, "G"}, {3, "r"}, {6, "G"}, {1, "y"}, {9, "r"}, {8, "G"}}), 0);
  }
  const auto times = TimesOf(Program(0.0, {{10, "G"}, {3, "y"}, {20, "r"}, {25, "G"}, {4, "y"}, {8, "r"}}), 0);
  ASSERT_EQ(times->more.size(), 1u);
  EXPECT_EQ(times->more[0], (network::LightGreen{33.0, 25.0, 4.0, 0.0}));
}

TEST(LightProgram, AlwaysGreenNeverGreenAndOff) {
  const LightProgram program = Program(0.0, {{30, "Gro"}, {30, "grO"}});
  EXPECT_EQ(network::ColourAt(*TimesOf(program, 0), 59'999'999'999), LightColour::kGreen);
  for (int second = 0; second < 60; ++second)
    EXPECT_EQ(network::ColourAt(*TimesOf(program, 1), std::int64_t(second) * 1'000'000'000), LightColour::kRed);
  EXPECT_FALSE(TimesOf(program, 2));
  EXPECT_FALSE(TimesOf(Program(0.0, {}), 0));
  EXPECT_FALSE(HasTimes(Program(0.0, {{0.2, "G"}})));
}

// A light that is held is red in that phase; green comes with the next one.
TEST(LightProgram, HoldsAGreen) {
  const LightProgram program = Program(0.0, {{20, "g"}, {10, "G"}, {3, "y"}, {27, "r"}});
  const auto times = TimesOf(program, 0, {true, false, false, false});
  EXPECT_DOUBLE_EQ(times->green_from_s, 20.0);
  EXPECT_DOUBLE_EQ(times->green_s, 10.0);
}

}  // namespace
}  // namespace rodeira::sumo
