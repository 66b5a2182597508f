// Pedals, gears and fuel of planar cars.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "common/traffic/drivetrain.hpp"
#include "common/traffic/fuel.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kRpm = 2.0 * std::numbers::pi / 60.0;

AgentTraits Car() {
  AgentTraits car;
  car.mass_kg = 1050.0;
  car.wheel_radius_m = 0.29;
  return car;
}

// MOTORS, A.19, and this project's drag torque 14 N m + 0.012 N m s.
double FullLoad(double radps) {
  constexpr std::array<std::array<double, 2>, 3> kCurve{{{1000.0, 87.5}, {3500.0, 115.5}, {6499.0, 62.5}}};
  const double rpm = radps / kRpm;
  if (rpm < kCurve[0][0]) return kCurve[0][1] * rpm / kCurve[0][0];
  for (std::size_t i = 1; i < kCurve.size(); ++i) {
    if (rpm <= kCurve[i][0]) return std::lerp(kCurve[i - 1][1], kCurve[i][1], (rpm - kCurve[i - 1][0]) / (kCurve[i][0] - kCurve[i - 1][0]));
  }
  return kCurve.back()[1];
}

// Newton's second law: what the engine gives through the gears less air, rolling and slope is m a, wherever clutch and brake are shut and
// the throttle is neither.
TEST(Drivetrain, TheEngineMovesTheCar) {
  constexpr std::array<double, 5> kGears{3.46, 1.96, 1.39, 1.03, 0.85};
  const AgentTraits car = Car();
  int compared = 0, overrun = 0;
  for (double v = 0.5; v < 45.0; v += 0.25) {
    for (double a = -3.0; a <= 1.6; a += 0.1) {
      for (const double grade : {-0.06, 0.0, 0.08}) {
        const Driving d = DrivingFor(car, v, a, grade);
        ASSERT_TRUE(d.gear >= 1 && d.gear <= 5);
        EXPECT_FALSE(d.throttle > 0.0 && d.brake > 0.0);
        const double ratio = 4.19 * kGears[static_cast<std::size_t>(d.gear - 1)];
        if (d.clutch == 0.0) {
          EXPECT_NEAR(d.engine_radps, v / car.wheel_radius_m * ratio, 1e-9 * d.engine_radps);
          EXPECT_LE(d.engine_radps, 6500.0 * kRpm);
        }
        const double slope = std::atan(grade);
        const double wanted = car.mass_kg * (a + 9.81 * (std::sin(slope) + 0.012 * std::cos(slope))) + 0.5 * 1.2 * 0.5 * v * v;
        if (d.throttle == 0.0) {
          ++overrun;
          EXPECT_LT(wanted, 0.0);
          continue;
        }
        if (d.clutch > 0.0 || d.throttle >= 1.0) continue;
        const double drag = 14.0 + 0.012 * d.engine_radps;
        const double net = d.throttle * (FullLoad(d.engine_radps) + drag) - drag;
        const double force = net * ratio / car.wheel_radius_m * (net > 0.0 ? 0.93 : 1.0 / 0.93);
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
  const AgentTraits car = Car();
  const Driving easy = DrivingFor(car, 20.0, 0.0, 0.0), hard = DrivingFor(car, 20.0, 1.4, 0.05);
  EXPECT_EQ(easy.gear, 5);
  EXPECT_LT(hard.gear, 4);
  EXPECT_LE(hard.throttle, 1.0);
  const Driving standing = DrivingFor(car, 0.0, 0.0, 0.05);
  EXPECT_EQ(standing.throttle, 0.0);
  EXPECT_GT(standing.brake, 0.05);
  EXPECT_EQ(standing.clutch, 1.0);
}

// Willans' line: a lorry of 11 t (192.5 kW) idles at 24 g/h a rated kW; 239 g/h a kW more; nothing in overrun.
TEST(Fuel, LorriesBurnByTheirEnginesPower) {
  AgentTraits lorry;
  lorry.kind = VehicleKind::kLorry;
  lorry.mass_kg = 11000.0;
  const double idle_gph = 3.6 * FuelFlow_mgps(lorry, 0.0, 0.0);
  EXPECT_NEAR(idle_gph, 24.0 * 192.5, 1.0);
  const double v = 20.0, force = 11000.0 * (0.3 + 0.078) + 3.3 * v * v;
  EXPECT_NEAR(3.6 * FuelFlow_mgps(lorry, v, 0.3) - idle_gph, 239.0 * force * v / 0.93 * 1e-3, 1.0);
  EXPECT_EQ(FuelFlow_mgps(lorry, v, -1.0), 0.0);
  const double per_100_km = FuelFlow_mgps(lorry, v, 0.0) / 832e3 / v * 1e5;  // diesel
  EXPECT_GT(per_100_km, 12.0);  // lorries of this size take 15 to 25 litres
  EXPECT_LT(per_100_km, 30.0);
  EXPECT_EQ(FuelFlow_mgps(Car(), 12.0, 0.4), FuelFlow_mgps(12.0, 0.4));
}

}  // namespace
}  // namespace rodeira::traffic
