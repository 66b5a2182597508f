// SPDX-License-Identifier: Apache-2.0
#include "common/view/sound/synth.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rodeira::sound {
namespace {

// `seconds` of it, asked for in blocks of 10 ms; the first tenth of a second, in which it begins, is left out.
std::vector<float> Played(const Heard& heard, double seconds, std::size_t block = 480) {
  Synth synth;
  std::vector<float> begin(2 * 4800), all(2 * static_cast<std::size_t>(seconds * kRate_Hz));
  synth.Render(heard, begin);
  for (std::size_t at = 0; at < all.size(); at += 2 * block)
    synth.Render(heard, std::span(all).subspan(at, std::min(2 * block, all.size() - at)));
  return all;
}
// Amplitude at a frequency (Goertzel's sum) of one side.
double At(const std::vector<float>& stereo, double frequency_Hz, int side = 0) {
  double cosine = 0.0, sine = 0.0;
  const std::size_t count = stereo.size() / 2;
  for (std::size_t i = 0; i < count; ++i) {
    const double angle = 2.0 * std::numbers::pi * frequency_Hz * static_cast<double>(i) / kRate_Hz,
                 value = static_cast<double>(stereo[2 * i + static_cast<std::size_t>(side)]);
    cosine += value * std::cos(angle);
    sine += value * std::sin(angle);
  }
  return 2.0 * std::hypot(cosine, sine) / static_cast<double>(count);
}
double Loudness(const std::vector<float>& stereo, int side = 0) {
  double sum = 0.0;
  for (std::size_t i = static_cast<std::size_t>(side); i < stereo.size(); i += 2)
    sum += static_cast<double>(stereo[i]) * static_cast<double>(stereo[i]);
  return std::sqrt(2.0 * sum / static_cast<double>(stereo.size()));
}
Heard Engine(double rpm, double load) {
  Heard heard;
  heard.own.engine_rpm = rpm;
  heard.own.load = load;
  return heard;
}

// Four cylinders of a four-stroke engine fire twice a turn: rpm / 30 Hz.
TEST(Synth, TheEngineSoundsAtItsFiringFrequency) {
  for (const double rpm : {900.0, 1500.0, 3000.0, 6000.0}) {
    const std::vector<float> sound = Played(Engine(rpm, 0.5), 2.0);
    const double firing = At(sound, rpm / 30.0);
    EXPECT_GT(firing, 0.02) << rpm;
    for (int k = 1; k <= kHarmonics; ++k) {
      EXPECT_LE(At(sound, k * rpm / 120.0), firing) << rpm << " " << k;
    }
    EXPECT_LT(At(sound, 1.37 * rpm / 30.0), 0.02 * firing) << "between the harmonics there is nothing";
  }
}

// Two notes and their overtones, and nothing between; let go of, it is silent.
TEST(Synth, TheHornHasTwoNotes) {
  Heard heard;
  heard.own.horn = 1.0;
  const std::vector<float> sound = Played(heard, 2.0);
  const double low = At(sound, kLowHorn_Hz), high = At(sound, kHighHorn_Hz);
  EXPECT_GT(low, 0.1);
  EXPECT_NEAR(high / low, 1.0, 0.1);
  EXPECT_GT(At(sound, 2.0 * kLowHorn_Hz), 0.2 * low);
  EXPECT_LT(At(sound, 455.0), 0.02 * low);
  EXPECT_GT(low, 20.0 * At(Played(Engine(900.0, 0.0), 2.0), kLowHorn_Hz));
  EXPECT_LT(*std::max_element(sound.begin(), sound.end()), 1.0F);
}

TEST(Synth, UnderLoadItIsLouderAndBrighter) {
  const std::vector<float> coasting = Played(Engine(3000.0, 0.0), 1.0), pulling = Played(Engine(3000.0, 1.0), 1.0);
  EXPECT_GT(Loudness(pulling), 1.5 * Loudness(coasting));
  EXPECT_GT(At(pulling, 500.0) / At(pulling, 100.0), 1.5 * At(coasting, 500.0) / At(coasting, 100.0));
}

TEST(Synth, WhatStandsIsSilent) {
  const std::vector<float> silence = Played({}, 0.5);
  EXPECT_EQ(*std::max_element(silence.begin(), silence.end()), 0.0F);
  EXPECT_EQ(*std::min_element(silence.begin(), silence.end()), 0.0F);
}

TEST(Synth, RoadAndWindGrowWithTheSpeed) {
  double before = 0.0;
  for (const double speed_mps : {5.0, 15.0, 30.0, 45.0}) {
    Heard heard;
    heard.own.speed_mps = speed_mps;
    const double loud = Loudness(Played(heard, 1.0));
    EXPECT_GT(loud, 1.3 * before) << speed_mps;
    before = loud;
  }
}

TEST(Synth, OnlySlidingTyresSqueal) {
  Heard rolling, sliding;
  rolling.own.speed_mps = sliding.own.speed_mps = 20.0;
  sliding.own.sliding = 1.0;
  const auto squeal = [](const Heard& heard) {
    const std::vector<float> sound = Played(heard, 2.0);
    double most = 0.0;
    for (double frequency = 780.0; frequency <= 920.0; frequency += 5.0) most = std::max(most, At(sound, frequency));
    return most;
  };
  EXPECT_GT(squeal(sliding), 5.0 * squeal(rolling));
}

TEST(Synth, ACarOnTheLeftIsHeardThereAndAFarOneIsFaint) {
  Heard near, far;
  near.others[7] = {2000.0, 0.5, 10.0, 0.0, 0.5, -1.0};
  far.others[7] = {2000.0, 0.5, 10.0, 0.0, 0.05, -1.0};
  const std::vector<float> left = Played(near, 1.0);
  EXPECT_GT(Loudness(left, 0), 0.01);
  EXPECT_LT(Loudness(left, 1), 1e-6);
  EXPECT_LT(Loudness(Played(far, 1.0)), 0.15 * Loudness(left));
}

TEST(Synth, ABlowIsHeardAndFades) {
  Synth synth;
  Heard blow;
  blow.crash = 1.0;
  std::vector<float> first(2 * 4800), later(2 * 48000), last(2 * 4800);
  synth.Render(blow, first);
  synth.Render({}, later);
  synth.Render({}, last);
  EXPECT_GT(Loudness(first), 0.2);
  EXPECT_LT(Loudness(last), 0.02 * Loudness(first));
}

// However it is asked for: the same samples.
TEST(Synth, BlocksDoNotMatter) {
  Heard heard = Engine(2500.0, 0.7);
  heard.own.speed_mps = 25.0;
  heard.others[1] = {1500.0, 0.2, 15.0, 0.3, 0.4, 0.5};
  heard.rain = 0.5;
  EXPECT_EQ(Played(heard, 0.5, 480), Played(heard, 0.5, 1000));
}

// Engines that rev, cars that come and go, full volume at once: no step from sample to sample that was not there
// before.
TEST(Synth, NothingClicks) {
  Synth synth;
  std::vector<float> block(2 * 800);
  float before = 0.0F, steepest = 0.0F;
  for (int i = 0; i < 120; ++i) {
    Heard heard = Engine(900.0 + 50.0 * i, i % 40 < 20 ? 1.0 : 0.0);
    heard.volume = i % 30 < 15 ? 1.0 : 0.2;
    if (i % 7 < 3) heard.others[static_cast<std::uint64_t>(i / 7)] = {2000.0, 0.5, 0.0, 0.0, 0.6, 0.3};
    synth.Render(heard, block);
    for (std::size_t k = 0; k < block.size(); k += 2) {
      ASSERT_LE(std::fabs(block[k]), 1.0F);
      steepest = std::max(steepest, std::fabs(block[k] - before));
      before = block[k];
    }
  }
  const std::vector<float> steady = Played(Engine(6850.0, 1.0), 1.0);
  float usual = 0.0F;
  for (std::size_t k = 2; k < steady.size(); k += 2) usual = std::max(usual, std::fabs(steady[k] - steady[k - 2]));
  EXPECT_LT(steepest, 2.5F * usual);
}

}  // namespace
}  // namespace rodeira::sound
