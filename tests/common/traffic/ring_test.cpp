// Identical cars on a ring: equilibrium and stability of the IDM in closed form (Treiber, Kesting, Traffic Flow Dynamics, 2013).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "common/traffic/traffic_model.hpp"
#include "tests/common/opendrive/sample.hpp"
#include "tests/common/traffic/identical.hpp"

namespace rodeira::traffic {
namespace {

using driver::IdmSettings;

constexpr double kRing_m = 1000.0;
constexpr double kRingLimit_mps = 15.0;

// One lane around a circle, going on into itself.
std::shared_ptr<const network::Network> Ring() {
  opendrive::RoadText road;
  road.length = kRing_m;
  road.link = "<predecessor elementType=\"road\" elementId=\"1\" contactPoint=\"end\"/>"
              "<successor elementType=\"road\" elementId=\"1\" contactPoint=\"start\"/>";
  road.geometry = fmt::format("<geometry s=\"0\" x=\"0\" y=\"0\" hdg=\"0\" length=\"{0}\"><arc curvature=\"{1:.17g}\"/></geometry>", kRing_m,
                              2.0 * std::numbers::pi / kRing_m);
  road.left = "";
  road.right = fmt::format("<lane id=\"-1\" type=\"driving\"><link><predecessor id=\"-1\"/><successor id=\"-1\"/></link>"
                           "<width sOffset=\"0\" a=\"3.5\" b=\"0\" c=\"0\" d=\"0\"/><speed sOffset=\"0\" max=\"{}\" unit=\"m/s\"/></lane>", kRingLimit_mps);
  return opendrive::MustRead(opendrive::Document(road.Text()));
}

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

// The gap that is left to each car, and the speed at which (s0 + v T) / sqrt(1 - (v/v0)^4) is that gap.
struct Equilibrium {
  double gap_m = 0.0, speed_mps = 0.0;
};
Equilibrium EquilibriumOf(const TrafficModel& model, const IdmSettings& idm) {
  double length = model.graph()[0].length_m();
  for (const AgentPose& pose : model.poses()) length -= model.traits(pose.id).length_m;
  Equilibrium at{length / static_cast<double>(model.on_road()), 0.0};
  double low = 0.0, high = kRingLimit_mps;
  for (int i = 0; i < 60; ++i) {
    at.speed_mps = 0.5 * (low + high);
    const double gap = (idm.standing_gap_m + at.speed_mps * idm.time_gap_s) / std::sqrt(1.0 - std::pow(at.speed_mps / kRingLimit_mps, 4));
    (gap < at.gap_m ? low : high) = at.speed_mps;
  }
  return at;
}

// The fastest growth of a small disturbance: f(s, v, v_l) of the IDM linearised at equilibrium, every car n waves
// exp(i k n + λ t), k = 2π j / N: λ² - (f_v + f_l e^{-ik}) λ + f_s (1 - e^{-ik}) = 0.
double GrowthRate(const IdmSettings& idm, const Equilibrium& at, std::size_t cars) {
  const double a = idm.acceleration_mps2, s = at.gap_m, v = at.speed_mps, root = 2.0 * std::sqrt(a * idm.braking_mps2);
  const double wanted = idm.standing_gap_m + v * idm.time_gap_s;
  const double f_s = 2.0 * a * wanted * wanted / (s * s * s);
  const double f_l = 2.0 * a * wanted / (s * s) * v / root;
  const double f_v = -4.0 * a * std::pow(v, 3) / std::pow(kRingLimit_mps, 4) - 2.0 * a * wanted / (s * s) * (idm.time_gap_s + v / root);
  double fastest = -1e9;
  for (std::size_t j = 1; j < cars; ++j) {
    const std::complex<double> wave = std::polar(1.0, -2.0 * std::numbers::pi * static_cast<double>(j) / static_cast<double>(cars));
    const std::complex<double> p = f_v + f_l * wave, q = f_s * (1.0 - wave), half = std::sqrt(p * p - 4.0 * q);
    fastest = std::max({fastest, (0.5 * (p + half)).real(), (0.5 * (p - half)).real()});
  }
  return fastest;
}

TEST(Ring, CarsOnARingComeToTheEquilibriumSpeedOfTheIdm) {
  const auto network = Ring();
  for (const std::uint32_t cars : {20u, 35u, 60u}) {
    const TrafficSettings settings = Identical(cars, 2.0);
    TrafficModel model = TrafficModel::Make(settings, network, {}).value();
    ASSERT_EQ(model.on_road(), cars);
    const Equilibrium at = EquilibriumOf(model, settings.idm);
    ASSERT_LT(GrowthRate(settings.idm, at, cars), -0.002);
    for (int i = 0; i < 60000; ++i) model.Step(0.02, {});
    const Spread spread = SpreadOf(model);
    EXPECT_NEAR(spread.mean_mps, at.speed_mps, 0.01) << cars;
    EXPECT_LT(spread.deviation_mps, 0.05) << cars;
  }
}

// How fast a small disturbance dies away, against the linear theory.
TEST(Ring, ADisturbanceOnARingDiesAwayAsTheLinearTheorySays) {
  const auto network = Ring();
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
  const auto network = Ring();
  int stable = 0, unstable = 0;
  for (const double acceleration : {0.4, 0.8, 1.4, 2.0}) {
    for (const std::uint32_t cars : {20u, 40u, 60u}) {
      const TrafficSettings settings = Identical(cars, acceleration);
      TrafficModel model = TrafficModel::Make(settings, network, {}).value();
      const double growth = GrowthRate(settings.idm, EquilibriumOf(model, settings.idm), cars);
      if (std::fabs(growth) < 0.004) continue;  // too near to be told in half an hour
      for (int i = 0; i < 90000; ++i) model.Step(0.02, {});
      const double deviation = SpreadOf(model).deviation_mps;
      growth < 0.0 ? ++stable : ++unstable;
      if (growth < 0.0) EXPECT_LT(deviation, 0.02) << cars << " cars, a = " << acceleration << ", growth " << growth;
      else EXPECT_GT(deviation, 0.3) << cars << " cars, a = " << acceleration << ", growth " << growth;
    }
  }
  EXPECT_GE(stable, 2);
  EXPECT_GE(unstable, 2);
}

}  // namespace
}  // namespace rodeira::traffic
