// SPDX-License-Identifier: Apache-2.0
// Drivers with a reaction time: what they see late, against closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <memory>
#include <numbers>
#include <vector>

#include "common/traffic/traffic_model.hpp"
#include "tests/common/traffic/digest_of.hpp"
#include "tests/common/traffic/identical.hpp"
#include "tests/common/traffic/ring.hpp"
#include "tests/common/world/lanes/lane_networks.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kStep_s = 0.01;

TrafficSettings With(double reaction_s, std::uint32_t vehicles, double acceleration_mps2 = 1.4) {
  TrafficSettings settings = Identical(vehicles, acceleration_mps2);
  settings.reaction_s = reaction_s;
  return settings;
}

// A vehicle of 60 m that stands on the lane of the agent, so far before its front bumper.
driver::Footprint Wall(const TrafficModel& model, double gap_m) {
  constexpr double kLength_m = 60.0;
  const lanes::Curve& lane = model.graph()[0].curve;
  const Piece& piece = model.agent(0).path.back();
  const double d = model.agent(0).o_m - piece.zero_m + 0.5 * (model.traits(0).length_m + kLength_m) + gap_m;
  const lanes::CurvePoint at = lane.At(d);
  return {9999, at.p_W.x(), at.p_W.y(), std::atan2(at.ahead_W.y(), at.ahead_W.x()), 0.0, kLength_m, 1.8};
}

// One agent alone, at its speed, in the middle of a ring's lane.
TrafficModel Cruising(double reaction_s) {
  TrafficModel model = TrafficModel::Make(With(reaction_s, 1), Ring(2000.0), {}).value();
  for (int i = 0; i < 6000; ++i) model.Step(kStep_s, {});
  while (model.agent(0).o_m - model.agent(0).path.back().zero_m < 300.0 ||
         model.agent(0).o_m - model.agent(0).path.back().zero_m > 1200.0)
    model.Step(kStep_s, {});
  EXPECT_GT(model.poses()[0].speed_mps, 14.0);
  return model;
}

// Until it has seen the obstacle for that long it drives on as if there was none.
TEST(Reaction, BrakesOneReactionTimeLater) {
  for (const double reaction_s : {0.05, 0.5, 1.0}) {
    TrafficModel without = Cruising(reaction_s), with = without;
    const driver::Footprint wall = Wall(with, 40.0);
    const auto late = std::lround(reaction_s / kStep_s);
    for (long i = 0; i < late; ++i) {
      without.Step(kStep_s, {}), with.Step(kStep_s, {&wall, 1});
      ASSERT_EQ(with.poses()[0].p_WB_W, without.poses()[0].p_WB_W) << reaction_s << ": " << i;
      ASSERT_EQ(with.poses()[0].acceleration_mps2, without.poses()[0].acceleration_mps2) << reaction_s << ": " << i;
    }
    without.Step(kStep_s, {}), with.Step(kStep_s, {&wall, 1});
    EXPECT_LT(with.poses()[0].acceleration_mps2, without.poses()[0].acceleration_mps2 - 0.02) << reaction_s;
  }
}

// Before an obstacle that asks for the hardest braking all the way the stop is longer by v τ.
TEST(Reaction, StopIsLongerByTheSpeedTimesTheReactionTime) {
  const auto stop_m = [](double reaction_s, double& speed_mps) {
    TrafficModel model = Cruising(reaction_s);
    const driver::Footprint wall = Wall(model, 8.0);
    const double from_m = model.agent(0).o_m;
    speed_mps = model.agent(0).speed_mps;
    for (int i = 0; i < 1000 && model.agent(0).speed_mps > 0.0; ++i) model.Step(kStep_s, {&wall, 1});
    EXPECT_EQ(model.agent(0).speed_mps, 0.0);
    return model.agent(0).o_m - from_m;
  };
  double speed_mps = 0.0;
  const double at_once_m = stop_m(0.0, speed_mps);
  for (const double reaction_s : {0.2, 0.5, 1.0}) {
    const double late_m = stop_m(reaction_s, speed_mps);
    EXPECT_NEAR(late_m - at_once_m, speed_mps * reaction_s, 0.02) << reaction_s;
  }
}

// The fastest growth of a small disturbance of the IDM at equilibrium where gap and leader are seen τ late. Every
// car n waves exp(i k n + λ t) with k = 2π j / N, and
//   λ² - (f_v + f_l e^{-ik-λτ}) λ + f_s (1 - e^{-ik}) e^{-λτ} = 0.
// The roots are followed from τ = 0 on.
double GrowthRate(const driver::IdmSettings& idm, const Equilibrium& at, std::size_t cars, double reaction_s) {
  const double a = idm.acceleration_mps2, s = at.gap_m, v = at.speed_mps, root = 2.0 * std::sqrt(a * idm.braking_mps2);
  const double wanted = idm.min_gap_m + v * idm.time_gap_s;
  const double f_s = 2.0 * a * wanted * wanted / (s * s * s);
  const double f_l = 2.0 * a * wanted / (s * s) * v / root;
  const double f_v = -4.0 * a * std::pow(v, 3) / std::pow(kRingLimit_mps, 4) -
                     2.0 * a * wanted / (s * s) * (idm.time_gap_s + v / root);
  double fastest = -1e9;
  for (std::size_t j = 1; j < cars; ++j) {
    const std::complex<double> wave =
        std::polar(1.0, -2.0 * std::numbers::pi * static_cast<double>(j) / static_cast<double>(cars));
    const std::complex<double> p = f_v + f_l * wave, q = f_s * (1.0 - wave), half = std::sqrt(p * p - 4.0 * q);
    for (std::complex<double> root_1ps : {0.5 * (p + half), 0.5 * (p - half)}) {
      constexpr int kParts = 50;
      for (int part = 1; part <= kParts; ++part) {
        const double late = reaction_s * part / kParts;
        for (int turn = 0; turn < 20; ++turn) {  // Newton
          const std::complex<double> l = root_1ps, d = std::exp(-l * late);
          const std::complex<double> f = l * l - (f_v + f_l * wave * d) * l + q * d,
                                     slope = 2.0 * l - f_v - f_l * wave * d * (1.0 - late * l) - late * q * d;
          root_1ps -= f / slope;
        }
      }
      fastest = std::max(fastest, root_1ps.real());
    }
  }
  return fastest;
}

double DeviationOf(const TrafficModel& model) {
  double mean = 0.0, squares = 0.0;
  const auto count = static_cast<double>(model.on_road());
  for (const AgentPose& pose : model.poses()) mean += pose.speed_mps / count;
  for (const AgentPose& pose : model.poses()) squares += (pose.speed_mps - mean) * (pose.speed_mps - mean);
  return std::sqrt(squares / count);
}

// A disturbance of a platoon dies away more slowly, as the linear theory with delay says.
TEST(Reaction, ADisturbanceDiesAwayAsTheDelayedLinearTheorySays) {
  constexpr double kRingStep_s = 0.02;
  for (const double reaction_s : {0.5, 1.0}) {
    const TrafficSettings settings = With(reaction_s, 40, 2.0);
    TrafficModel model = TrafficModel::Make(settings, Ring(1000.0), {}).value();
    const Equilibrium at = EquilibriumOf(model, settings.idm);
    const double growth = GrowthRate(settings.idm, at, 40, reaction_s), at_once = GrowthRate(settings.idm, at, 40, 0.0);
    ASSERT_GT(growth, 0.75 * at_once);  // both below 0: otherwise the test shows nothing
    const auto until = [&](double deviation_mps) {
      int steps = 0;
      while (DeviationOf(model) > deviation_mps && steps < 400000) model.Step(kRingStep_s, {}), ++steps;
      return kRingStep_s * steps;
    };
    until(0.01);  // by now the faster waves are gone
    const double measured = -std::log(20.0) / until(0.0005);
    EXPECT_NEAR(measured, growth, 0.1 * std::fabs(growth)) << reaction_s;
  }
}

// Where the theory says that the delay makes a platoon unstable there is stop and go, and not without it.
TEST(Reaction, StopAndGoArisesWhereTheDelayMakesItUnstable) {
  for (const double reaction_s : {0.0, 0.8}) {
    const TrafficSettings settings = With(reaction_s, 60, 2.0);
    TrafficModel model = TrafficModel::Make(settings, Ring(1000.0), {}).value();
    const double growth = GrowthRate(settings.idm, EquilibriumOf(model, settings.idm), 60, reaction_s);
    ASSERT_GT(std::fabs(growth), 0.002);
    for (int i = 0; i < 60000; ++i) model.Step(0.02, {});
    if (growth < 0.0)
      EXPECT_LT(DeviationOf(model), 0.05) << reaction_s;
    else
      EXPECT_GT(DeviationOf(model), 0.3) << reaction_s;
  }
}

// What was seen is part of the state: a model that goes on from there sees it too.
TEST(Reaction, RestoredItGoesOnWithTheSameBits) {
  TrafficSettings settings;
  settings.vehicles = 40, settings.reaction_s = 0.7, settings.decide_s = 0.3;
  const auto network = lanes::MapNetwork("lights");
  TrafficModel a = TrafficModel::Make(settings, network, {}).value();
  for (int i = 0; i < 1511; ++i) a.Step(0.02, {});
  base::StateWriter writer;
  a.Save(writer);
  TrafficModel b = TrafficModel::Make(settings, network, {}).value();
  for (int i = 0; i < 70; ++i) b.Step(0.02, {});  // what it has seen itself is forgotten
  base::StateReader reader(writer.bytes());
  b.Restore(reader);
  ASSERT_TRUE(reader.Finish().ok());
  EXPECT_EQ(DigestOf(a), DigestOf(b));
  for (int i = 0; i < 1500; ++i) {
    a.Step(0.02, {}), b.Step(0.02, {});
    ASSERT_EQ(DigestOf(a), DigestOf(b)) << i;
  }
}

}  // namespace
}  // namespace rodeira::traffic
