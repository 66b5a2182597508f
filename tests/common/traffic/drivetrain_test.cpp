// SPDX-License-Identifier: Apache-2.0
// Pedals, gears and fuel of planar cars.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "common/traffic/motion/car_of.hpp"
#include "common/traffic/motion/drivetrain.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kRpm = 2.0 * std::numbers::pi / 60.0;

dynamics::BicycleSettings Car() {
  AgentTraits car;
  car.mass_kg = 1050.0;
  car.wheel_radius_m = 0.29;
  return CarOf(car);
}
constexpr double kRadius_m = 0.97 * 0.29;  // on which it rolls

// MOTORS, A.19, and this project's drag torque 14 N m + 0.012 N m s.
double FullLoad(double radps) {
  constexpr std::array<std::array<double, 2>, 3> kCurve{{{1000.0, 87.5}, {3500.0, 115.5}, {6499.0, 62.5}}};
  const double rpm = radps / kRpm;
  if (rpm < kCurve[0][0]) return kCurve[0][1] * rpm / kCurve[0][0];
  for (std::size_t i = 1; i < kCurve.size(); ++i) {
    if (rpm <= kCurve[i][0])
      return std::lerp(kCurve[i - 1][1], kCurve[i][1], (rpm - kCurve[i - 1][0]) / (kCurve[i][0] - kCurve[i - 1][0]));
  }
  return kCurve.back()[1];
}

// Newton's second law: what the engine gives through the gears less air, rolling and slope is m a, wherever clutch and
// brake are shut and the throttle is neither.
TEST(Drivetrain, TheEngineMovesTheCar) {
  constexpr std::array<double, 5> kGears{3.46, 1.96, 1.39, 1.03, 0.85};
  const dynamics::BicycleSettings car = Car();
  int compared = 0, overrun = 0;
  for (double v = 0.5; v < 45.0; v += 0.25) {
    for (double a = -3.0; a <= 1.6; a += 0.1) {
      for (const double grade : {-0.06, 0.0, 0.08}) {
        const Driving d = DrivingFor(car, v, a, grade);
        ASSERT_TRUE(d.gear >= 1 && d.gear <= 5);
        EXPECT_FALSE(d.throttle > 0.0 && d.brake > 0.0);
        const double ratio = 4.19 * kGears[static_cast<std::size_t>(d.gear - 1)];
        if (d.clutch == 0.0) {
          EXPECT_NEAR(d.engine_radps, v / kRadius_m * ratio, 1e-9 * d.engine_radps);
          EXPECT_LE(d.engine_radps, 6500.0 * kRpm);
        }
        const double slope = std::atan(grade);
        if (d.throttle < 1.0 && d.brake < 1.0)
          EXPECT_NEAR(AccelerationOf(car, d, v, grade), a, 1e-12);
        else
          EXPECT_LT(AccelerationOf(car, d, v, grade), a);
        const double wanted =
            1050.0 * (a + 9.81 * (std::sin(slope) + 0.012 * std::cos(slope))) + 0.5 * 1.2 * 0.5 * v * v;
        if (d.throttle == 0.0) {
          ++overrun;
          EXPECT_LT(wanted, 0.0);
          continue;
        }
        if (d.clutch > 0.0 || d.throttle >= 1.0) continue;
        const double drag = 14.0 + 0.012 * d.engine_radps;
        const double net = d.throttle * (FullLoad(d.engine_radps) + drag) - drag;
        const double force = net * ratio / kRadius_m * (net > 0.0 ? 0.93 : 1.07);
        EXPECT_NEAR(force, wanted, 1e-6 * (1.0 + std::fabs(wanted))) << v << " m/s, " << a << " m/s2, " << grade;
        ++compared;
      }
    }
  }
  EXPECT_GT(compared, 5000);
  EXPECT_GT(overrun, 1000);
}

// Where a lower gear could pull harder no gear is kept that cannot: full throttle only at the engine's end.
TEST(Drivetrain, ShiftsDownWhereTheEngineIsTooWeak) {
  const dynamics::BicycleSettings car = Car();
  const Driving easy = DrivingFor(car, 20.0, 0.0, 0.0), hard = DrivingFor(car, 20.0, 1.4, 0.05);
  EXPECT_EQ(easy.gear, 5);
  EXPECT_LT(hard.gear, 4);
  EXPECT_LE(hard.throttle, 1.0);
  const Driving standing = DrivingFor(car, 0.0, 0.0, 0.05);
  EXPECT_EQ(standing.throttle, 0.0);
  EXPECT_GT(standing.brake, 0.05);
  EXPECT_EQ(standing.clutch, 1.0);
}

// Changes of gear of a car that drives on by 10 ms: when, and by how many gears.
struct Changes {
  std::vector<double> at_s;
  std::vector<int> by;

  void Add(double t_s, int gears) {
    if (gears != 0) at_s.push_back(t_s), by.push_back(gears);
  }
  // How often a change up has been undone within a second.
  int Hunts() const {
    int hunts = 0;
    for (std::size_t i = 1; i < by.size(); ++i) hunts += by[i - 1] > 0 && by[i] < 0 && at_s[i] - at_s[i - 1] < 1.0;
    return hunts;
  }
};

// No change up is undone within a second while the demand stays: neither where the engine is at its limit uphill, nor
// where a foot that trembles by 0.02 m/s² and a speed that swings by two parts in a hundred come and go over the bounds
// of a gear, in no body on no grade.
TEST(Drivetrain, DoesNotHuntBetweenGears) {
  constexpr double kStep_s = 0.01;
  int up = 0, down = 0;
  for (std::uint32_t body = 0; body < kBodies; ++body) {
    const dynamics::BicycleSettings& car = CarOfBody(body);
    for (const double grade : {-0.04, 0.0, 0.03, 0.06, 0.1}) {
      for (double wanted = 0.2; wanted < 2.0; wanted += 0.3) {  // as far as it comes
        Driving driving;
        Changes changes;
        double v = 0.1;
        for (int i = 0; i < 6000 && v < 40.0; ++i) {
          const Driving next = DriveOn(car, driving, v, wanted, grade, kStep_s);
          if (i > 0) changes.Add(i * kStep_s, next.gear - driving.gear);
          driving = next;
          v = std::max(0.1, v + AccelerationOf(car, driving, v, grade) * kStep_s);
        }
        EXPECT_EQ(changes.Hunts(), 0) << "body " << body << ", grade " << grade << ", " << wanted << " m/s2";
        for (const int by : changes.by) ++(by > 0 ? up : down);
      }
      for (double mean = 3.0; mean < 25.0; mean += 0.25) {  // about a speed
        Driving driving;
        Changes changes;
        for (int i = 0; i < 2000; ++i) {
          const double phase = 2.0 * std::numbers::pi * i * kStep_s;
          const Driving next = DriveOn(car, driving, mean * (1.0 + 0.02 * std::sin(1.9 * phase)),
                                       0.3 + 0.02 * std::sin(1.3 * phase), grade, kStep_s);
          if (i > 0) changes.Add(i * kStep_s, next.gear - driving.gear);
          driving = next;
        }
        EXPECT_EQ(changes.Hunts(), 0) << "body " << body << ", grade " << grade << " about " << mean << " m/s";
      }
    }
  }
  EXPECT_GT(up, 100);
  EXPECT_GT(down, 0);
}

// A foot that is lifted for a moment changes no gear; one that stays on the throttle comes to the highest gear after
// the pause.
TEST(Drivetrain, ALiftedFootChangesNoGear) {
  const dynamics::BicycleSettings car = Car();
  Driving driving = DrivingFor(car, 12.0, 1.2, 0.0);
  const int pulls = driving.gear;
  ASSERT_LT(pulls, DrivingFor(car, 12.0, -1.5, 0.0).gear);
  for (int i = 0; i < 300; ++i) driving = DriveOn(car, driving, 12.0, -1.5, 0.0, 0.01);
  EXPECT_EQ(driving.gear, pulls);
  EXPECT_EQ(driving.throttle, 0.0);
  for (int i = 0; i < 300; ++i) driving = DriveOn(car, driving, 12.0, 0.0, 0.0, 0.01);
  EXPECT_EQ(driving.gear, DrivingFor(car, 12.0, 0.0, 0.0).gear);
  driving = DriveOn(car, driving, 12.0, 1.2, 0.0, 0.01);  // and down at once, where the engine is too weak
  EXPECT_EQ(driving.gear, pulls);
}

// Willans' line through the engine: burnt power = (net + drag) / efficiency, with the drag alone while idling, and
// nothing in overrun.
TEST(Drivetrain, FuelIsWillansLine) {
  const dynamics::BicycleSettings car = Car();
  const double at_50 = [&] {
    const double v = 50.0 / 3.6, force = 1050.0 * 9.81 * 0.012 + 0.3 * v * v;
    const Driving d = DrivingFor(car, v, 0.0, 0.0);
    const double power_W = force * v / 0.93 + (14.0 + 0.012 * d.engine_radps) * d.engine_radps;
    EXPECT_NEAR(FuelFlow_mgps(car, d), 1e6 * power_W / (0.35 * 42.7e6), 1e-6 * FuelFlow_mgps(car, d));
    return 100e3 / v * FuelFlow_mgps(car, d) / kFuelDensity_mgpl;
  }();
  EXPECT_GT(at_50, 3.0);  // litres a hundred kilometres: small cars in top gear take three to five
  EXPECT_LT(at_50, 5.0);
  const Driving idling = DrivingFor(car, 0.0, 0.0, 0.0);
  EXPECT_NEAR(FuelFlow_mgps(car, idling), 1e6 * (14.0 + 0.012 * 89.0) * 89.0 / (0.35 * 42.7e6), 1e-9);
  for (double v = 5.0; v < 40.0; v += 1.0) EXPECT_EQ(FuelFlow_mgps(car, DrivingFor(car, v, -1.5, 0.0)), 0.0) << v;
  const AgentTraits lorry = TraitsOfBody(6);
  ASSERT_EQ(lorry.mass_kg, 11000.0);
  const dynamics::BicycleSettings heavy = CarOfBody(6);
  const double per_100_km = FuelFlow_mgps(heavy, DrivingFor(heavy, 20.0, 0.0, 0.0)) / 832e3 / 20.0 * 1e5;  // diesel
  EXPECT_GT(per_100_km, 12.0);  // lorries of this size take 15 to 25 litres
  EXPECT_LT(per_100_km, 30.0);
}

}  // namespace
}  // namespace rodeira::traffic
