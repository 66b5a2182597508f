// SPDX-License-Identifier: Apache-2.0
// Identical cars on a ring: equilibrium and stability of the IDM in closed form (Treiber, Kesting, Traffic Flow
// Dynamics, 2013).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <optional>
#include <string>

#include "common/traffic/traffic_model.hpp"
#include "tests/common/traffic/curves.hpp"
#include "tests/common/traffic/identical.hpp"
#include "tests/common/traffic/ring.hpp"
#include "tests/long_form.hpp"

namespace rodeira::traffic {
namespace {

using driver::IdmSettings;

struct Spread {
  double mean_mps = 0.0, deviation_mps = 0.0;
};
Spread SpreadOf(const TrafficModel& model) {
  Spread spread;
  for (const AgentPose& pose : model.poses()) spread.mean_mps += pose.speed_mps / static_cast<double>(model.on_road());
  for (const AgentPose& pose : model.poses()) spread.deviation_mps += std::pow(pose.speed_mps - spread.mean_mps, 2);
  spread.deviation_mps = std::sqrt(spread.deviation_mps / static_cast<double>(model.on_road()));
  return spread;
}

// The fastest growth of a small disturbance: f(s, v, v_l) of the IDM linearised at equilibrium, every car n waves
// exp(i k n + λ t), k = 2π j / N: λ² - (f_v + f_l e^{-ik}) λ + f_s (1 - e^{-ik}) = 0.
double GrowthRate(const IdmSettings& idm, const Equilibrium& at, std::size_t cars) {
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
    fastest = std::max({fastest, (0.5 * (p + half)).real(), (0.5 * (p - half)).real()});
  }
  return fastest;
}

TEST(Ring, CarsOnARingComeToTheEquilibriumSpeedOfTheIdm) {
  const auto network = Ring(1000.0);
  for (const std::uint32_t cars : {20u, 35u, 60u}) {
    const TrafficSettings settings = Identical(cars, 2.0);
    TrafficModel model = TrafficModel::Make(settings, network, {}).value();
    ASSERT_EQ(model.on_road(), cars);
    const Equilibrium at = EquilibriumOf(model, settings.idm);
    ASSERT_LT(GrowthRate(settings.idm, at, cars), -0.002);
    for (int i = 0; i < BriefOrLong(30000, 60000); ++i) model.Step(0.02, {});
    const Spread spread = SpreadOf(model);
    EXPECT_NEAR(spread.mean_mps, at.speed_mps, 0.01) << cars;
    EXPECT_LT(spread.deviation_mps, 0.05) << cars;
  }
}

// How fast a small disturbance dies away, against the linear theory.
TEST(Ring, ADisturbanceOnARingDiesAwayAsTheLinearTheorySays) {
  const auto network = Ring(1000.0);
  for (const std::uint32_t cars : {25u, 40u}) {
    const TrafficSettings settings = Identical(cars, 2.0);
    TrafficModel model = TrafficModel::Make(settings, network, {}).value();
    const double growth = GrowthRate(settings.idm, EquilibriumOf(model, settings.idm), cars);
    const auto until = [&](double deviation_mps) {
      int steps = 0;
      while (SpreadOf(model).deviation_mps > deviation_mps && steps < 400000) model.Step(0.02, {}), ++steps;
      return 0.02 * steps;
    };
    until(0.01);  // by now the faster waves are gone
    const double measured = -std::log(20.0) / until(0.0005);
    EXPECT_NEAR(measured, growth, 0.05 * std::fabs(growth)) << cars;
  }
}

// Stop and go arises where, and only where, the criterion says so.
TEST(Ring, StopAndGoArisesWhereTheIdmIsUnstable) {
  const auto network = Ring(1000.0);
  int stable = 0, unstable = 0;
  for (const double acceleration : {0.4, 0.8, 1.4, 2.0}) {
    for (const std::uint32_t cars : {20u, 40u, 60u}) {
      const TrafficSettings settings = Identical(cars, acceleration);
      TrafficModel model = TrafficModel::Make(settings, network, {}).value();
      const double growth = GrowthRate(settings.idm, EquilibriumOf(model, settings.idm), cars);
      if (std::fabs(growth) < 0.004) continue;  // too near to be told in that time
      for (int i = 0; i < BriefOrLong(25000, 90000); ++i) model.Step(0.02, {});
      const double deviation = SpreadOf(model).deviation_mps;
      growth < 0.0 ? ++stable : ++unstable;
      if (growth < 0.0)
        EXPECT_LT(deviation, 0.02) << cars << " cars, a = " << acceleration << ", growth " << growth;
      else
        EXPECT_GT(deviation, 0.3) << cars << " cars, a = " << acceleration << ", growth " << growth;
    }
  }
  EXPECT_GE(stable, 2);
  EXPECT_GE(unstable, 2);
}

// Sugiyama's experiment (New Journal of Physics 10, 2008): 22 cars on 230 m jam. Where the linear theory says that a
// disturbance grows a jam arises in which cars stand; where it says that it dies away there is none.
TEST(Ring, SugiyamasRingJamsWhereTheTheorySaysSo) {
  const auto network = Ring(230.0 - 2.0 * std::numbers::pi * 1.75);  // its lane lies 1.75 m outside the axis
  for (const double acceleration : {0.5, 0.8, 3.0}) {
    TrafficSettings settings = Identical(22, acceleration);
    TrafficModel model = TrafficModel::Make(settings, network, {}).value();
    while (model.on_road() < 22 && settings.seed < 100) {  // drawn places for all of them
      ++settings.seed;
      model = TrafficModel::Make(settings, network, {}).value();
    }
    ASSERT_EQ(model.on_road(), 22u);
    ASSERT_NEAR(model.graph()[0].length_m(), 230.0, 0.01);
    const double growth = GrowthRate(settings.idm, EquilibriumOf(model, settings.idm), 22);
    ASSERT_GT(std::fabs(growth), 0.004) << acceleration;
    for (int i = 0; i < 60000; ++i) model.Step(0.02, {});
    const Spread spread = SpreadOf(model);
    if (growth < 0.0)
      EXPECT_LT(spread.deviation_mps, 0.02) << acceleration;
    else
      EXPECT_GT(spread.deviation_mps, 0.25 * spread.mean_mps) << acceleration;
    RecordProperty("growth_" + std::to_string(acceleration), std::to_string(growth));
  }
}

// The same ring through pedals, engine, clutch and gears (`physics: full`): the spread of the 22 speeds after so long,
// as a share of their mean.
double SpreadThroughThePowertrain(double acceleration_mps2, double for_s) {
  const auto network = Ring(230.0 - 2.0 * std::numbers::pi * 1.75);
  TrafficSettings settings = Identical(22, acceleration_mps2);
  settings.physics = Physics::kFull;
  std::optional<TrafficModel> model;
  for (; !model || (model->on_road() < 22 && settings.seed < 100); ++settings.seed)
    model.emplace(TrafficModel::Make(settings, network, {}).value());
  EXPECT_EQ(model->on_road(), 22u);
  double sum = 0.0;
  const auto steps = static_cast<int>(std::lround(for_s / 0.01)), looks = steps / 5;  // the last fifth is looked at
  for (int i = 0; i < steps; ++i) {
    model->Step(0.01, {});
    if (i < steps - looks) continue;
    const Spread spread = SpreadOf(*model);
    sum += spread.deviation_mps / std::max(0.1, spread.mean_mps) / looks;
  }
  return sum;
}

// Clear of the boundary that was measured (docs/explanation/traffic.md) on both sides.
TEST(Ring, ThroughThePowertrainItJamsAndDoesNotJamClearOfTheMeasuredBoundary) {
  const double for_s = BriefOrLong(55.0, 400.0);
  EXPECT_GT(SpreadThroughThePowertrain(0.5, for_s), 0.25);
  EXPECT_LT(SpreadThroughThePowertrain(3.0, for_s), 0.05);
}

// RODEIRA_RING: prints that table, beside what the linear theory says of accelerations that are applied exactly. Some
// minutes.
TEST(Ring, TableOfTheBoundaryThroughThePowertrain) {
  if (std::getenv("RODEIRA_RING") == nullptr)
    GTEST_SKIP() << "a table for docs/explanation/traffic.md, with RODEIRA_RING=1";
  PlotCurve spread{"spread of the speeds over their mean, after 15 minutes", "#b03020", {}};
  for (const double acceleration : {0.5, 0.8, 1.0, 1.2, 1.4, 1.6, 1.8, 2.0, 2.5, 3.0}) {
    const TrafficSettings settings = Identical(22, acceleration);
    TrafficSettings placed = settings;
    TrafficModel model = TrafficModel::Make(placed, Ring(230.0 - 2.0 * std::numbers::pi * 1.75), {}).value();
    while (model.on_road() < 22)
      ++placed.seed, model = TrafficModel::Make(placed, Ring(230.0 - 2.0 * std::numbers::pi * 1.75), {}).value();
    const double growth = GrowthRate(settings.idm, EquilibriumOf(model, settings.idm), 22);
    spread.points.emplace_back(acceleration, SpreadThroughThePowertrain(acceleration, 900.0));
    fmt::print("| {} | {:+.4f} | {:.3f} |\n", acceleration, growth, spread.points.back().second);
    std::fflush(stdout);
  }
  const std::string svg = PlotSvg("Sugiyama's ring through the powertrain: 22 cars, 230 m",
                                  "acceleration of the drivers, m/s²", "spread of the speeds", 0.5, 0.25, {spread});
  EXPECT_TRUE(WritePicture("traffic_ring_boundary.svg", svg));
}

}  // namespace
}  // namespace rodeira::traffic
