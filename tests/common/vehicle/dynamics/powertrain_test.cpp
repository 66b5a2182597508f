// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/dynamics/powertrain.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <vector>

#include "common/core/base/random.hpp"
#include "common/core/geometry/angle.hpp"
#include "common/vehicle/dynamics/friction.hpp"
#include "common/vehicle/dynamics/powertrain_array.hpp"
#include "tests/common/vehicle/dynamics/test_car.hpp"

namespace rodeira::dynamics {
namespace {

constexpr double kRpm = geometry::kPi / 30.0;

TEST(Engine, FollowsTheThesisSamplesLinearlyBetween) {
  const EngineSettings engine = DefaultSettings().powertrain.engine;
  EXPECT_NEAR(FullLoadTorque(engine, 1000 * kRpm), 87.5, 1e-9);
  EXPECT_NEAR(FullLoadTorque(engine, 3500 * kRpm), 115.5, 1e-9);
  EXPECT_NEAR(FullLoadTorque(engine, 6499 * kRpm), 62.5, 1e-9);
  EXPECT_NEAR(FullLoadTorque(engine, 1250 * kRpm), 91.25, 1e-9);
  EXPECT_EQ(FullLoadTorque(engine, 0.0), 0.0);
}

// An engine by itself: nothing in gear.
void Spin(Engine& engine, const EngineSettings& settings, double throttle, bool starter, double seconds) {
  for (int i = 0; i < static_cast<int>(seconds / kStep_s); ++i) {
    engine.Prepare(settings, throttle, starter);
    const DrivelineMotion motion = StepDriveline(settings, engine, DrivelineLoads{}, kStep_s);
    engine.Finish(settings, motion.engine_radps, kStep_s);
  }
}

// Smooth: through the samples, with one slope from both sides, never beyond its two samples, and straight where they
// are.
TEST(Engine, ASmoothCurveGoesThroughItsSamplesWithoutOvershoot) {
  EngineSettings engine;
  engine.full_load = {{100.0, 80.0}, {200.0, 110.0}, {300.0, 112.0}, {400.0, 112.0}, {500.0, 90.0}, {650.0, 20.0}};
  engine.full_load_Nmspr = SmoothSlopes(engine.full_load);
  for (std::size_t i = 0; i < engine.full_load.size(); ++i) {
    const auto& [speed, torque] = engine.full_load[i];
    EXPECT_NEAR(FullLoadTorque(engine, speed), torque, 1e-12);
    if (i == 0 || i + 1 == engine.full_load.size()) continue;
    constexpr double kProbe = 1e-5;
    const double before = (torque - FullLoadTorque(engine, speed - kProbe)) / kProbe,
                 after = (FullLoadTorque(engine, speed + kProbe) - torque) / kProbe;
    EXPECT_NEAR(before, after, 1e-5) << speed;
    const auto [low, high] = std::minmax(torque, engine.full_load[i + 1].torque_Nm);
    for (double share = 0.0; share <= 1.0; share += 0.01) {
      const double between = FullLoadTorque(engine, speed + share * (engine.full_load[i + 1].speed_radps - speed));
      EXPECT_GE(between, low - 1e-9);
      EXPECT_LE(between, high + 1e-9);
    }
  }
  EngineSettings line;
  line.full_load = {{100.0, 50.0}, {220.0, 62.0}, {500.0, 90.0}};
  line.full_load_Nmspr = SmoothSlopes(line.full_load);
  for (double speed = 100.0; speed < 500.0; speed += 7.0)
    EXPECT_NEAR(FullLoadTorque(line, speed), 40.0 + 0.1 * speed, 1e-9);
}

// The source's: proportional to the throttle, whatever the engine gives for it.
TEST(Engine, FuelInProportionToTheThrottleIsAnOption) {
  EngineSettings settings = DefaultSettings().powertrain.engine;
  settings.throttle_fuel_kgps = 0.004;
  Engine engine;
  engine.Start(300.0);
  for (const double throttle : {0.5, 1.0}) {
    engine.Prepare(settings, throttle, false);
    engine.Finish(settings, 300.0, 0.001);
    EXPECT_DOUBLE_EQ(engine.fuel_rate_kgps(), 0.004 * throttle);
  }
  EXPECT_NEAR(engine.fuel_kg(), 0.001 * 0.006, 1e-15);
}

TEST(Engine, IdlesAtItsSpeedOnFuelOfWillansLine) {
  const EngineSettings settings = DefaultSettings().powertrain.engine;
  Engine engine;
  engine.Start(300.0);
  Spin(engine, settings, 0.0, false, 20.0);
  EXPECT_NEAR(engine.speed_radps(), 850 * kRpm, 0.01);
  const double drag_W = DragTorque(settings, engine.speed_radps()) * engine.speed_radps();
  EXPECT_NEAR(engine.fuel_rate_kgps(), drag_W / (0.35 * 43e6), 1e-9);
  // A small petrol engine idles on about half a litre to a litre an hour.
  const double litres_per_hour = engine.fuel_rate_kgps() * 3600 / 0.745;
  EXPECT_GT(litres_per_hour, 0.3);
  EXPECT_LT(litres_per_hour, 1.2);
}

TEST(Engine, TheLimiterCutsAt6500AndResumesAt6300) {
  const EngineSettings settings = DefaultSettings().powertrain.engine;
  Engine engine;
  engine.Start(600.0);
  double most = 0.0, least_after = 1e9;
  bool reached = false;
  for (int i = 0; i < 5000; ++i) {
    Spin(engine, settings, 1.0, false, kStep_s);
    most = std::max(most, engine.speed_radps());
    reached = reached || engine.speed_radps() >= 6500 * kRpm;
    if (reached) least_after = std::min(least_after, engine.speed_radps());
  }
  EXPECT_TRUE(reached);
  EXPECT_LT(most, 6510 * kRpm);
  EXPECT_NEAR(least_after, 6300 * kRpm, 10 * kRpm);
}

TEST(Engine, StallsUnderLoadAndIsStartedAgain) {
  const EngineSettings settings = DefaultSettings().powertrain.engine;
  Engine engine;
  engine.Start(89.0);
  DrivelineLoads load;  // in gear against a wall
  load.ratio = 14.5;
  load.clutch_capacity_Nm = 200.0;
  load.friction_torque_Nm = {1e4, 1e4};
  for (int i = 0; i < 500; ++i) {
    engine.Prepare(settings, 0.0, false);
    engine.Finish(settings, StepDriveline(settings, engine, load, kStep_s).engine_radps, kStep_s);
  }
  EXPECT_FALSE(engine.running());
  EXPECT_NEAR(engine.speed_radps(), 0.0, 1e-6);
  const double burnt = engine.fuel_kg();
  Spin(engine, settings, 1.0, false, 1.0);
  EXPECT_FALSE(engine.running());
  EXPECT_EQ(engine.fuel_kg(), burnt);
  Spin(engine, settings, 0.0, true, 1.5);
  EXPECT_TRUE(engine.running());
  Spin(engine, settings, 0.0, false, 10.0);
  EXPECT_NEAR(engine.speed_radps(), 850 * kRpm, 0.1);
}

TEST(Engine, NothingIsBurntInOverrun) {
  const EngineSettings settings = DefaultSettings().powertrain.engine;
  Engine engine;
  engine.Start(400.0);
  engine.Prepare(settings, 0.0, false);
  EXPECT_NEAR(engine.net_torque_Nm(), -DragTorque(settings, 400.0), 1e-12);
  engine.Finish(settings, 400.0, kStep_s);
  EXPECT_EQ(engine.fuel_rate_kgps(), 0.0);
}

// Kinetic energy of the three rotors against the work of all torques at mean speeds.
RC_GTEST_PROP(Driveline, WorkBalances, (std::uint32_t seed)) {
  const EngineSettings settings = DefaultSettings().powertrain.engine;
  const auto draw = [&](std::uint64_t what, double low, double high) {
    return base::RandomUniform({seed, what}, low, high);
  };
  DrivelineLoads loads;
  loads.ratio = draw(0, -15, 15);
  loads.clutch_capacity_Nm = draw(1, 0, 200);
  loads.wheel_radps = {draw(2, -100, 100), draw(3, -100, 100)};
  loads.road_torque_Nm = {draw(4, -1000, 1000), draw(5, -1000, 1000)};
  loads.friction_torque_Nm = {draw(6, 0, 1500), draw(7, 0, 1500)};
  loads.locking_torque_Nm = std::max(0.0, draw(10, -500, 1500));
  Engine engine;
  engine.Start(draw(8, 50, 650));
  engine.Prepare(settings, draw(9, 0, 1), false);
  double worst = 0.0, scale = 0.0, heat_least = 0.0;
  for (int i = 0; i < 300; ++i) {
    const double w0 = engine.speed_radps();
    const auto wheels0 = loads.wheel_radps;
    engine.Prepare(settings, 0.5, false);
    const DrivelineMotion m = StepDriveline(settings, engine, loads, kStep_s);
    const double j = loads.wheel_inertia_kgm2;
    double change = 0.5 * settings.inertia_kgm2 * (m.engine_radps * m.engine_radps - w0 * w0);
    const double drag_Nm =
        settings.inertia_kgm2 * (m.engine_radps - w0) / kStep_s - engine.driving_Nm() + m.clutch_torque_Nm;
    double work = (engine.driving_Nm() + drag_Nm) * 0.5 * (w0 + m.engine_radps) - m.clutch_heat_W - m.locking_heat_W;
    for (std::size_t k = 0; k < 2; ++k) {
      change += 0.5 * j * (m.wheel_radps[k] * m.wheel_radps[k] - wheels0[k] * wheels0[k]);
      work += (loads.road_torque_Nm[k] + m.friction_torque_Nm[k]) * 0.5 * (wheels0[k] + m.wheel_radps[k]);
      RC_ASSERT(std::fabs(m.friction_torque_Nm[k]) <= loads.friction_torque_Nm[k] * (1 + 1e-9));
    }
    RC_ASSERT(std::fabs(drag_Nm) <= engine.drag_Nm() * (1 + 1e-6));
    RC_ASSERT(std::fabs(m.clutch_torque_Nm) <= loads.clutch_capacity_Nm * (1 + 1e-9));
    RC_ASSERT(std::fabs(m.locking_torque_Nm) <= loads.locking_torque_Nm * (1 + 1e-9));
    worst = std::max(worst, std::fabs(change / kStep_s - work));
    scale = std::max({scale, std::fabs(change / kStep_s), std::fabs(m.clutch_in_W), std::fabs(m.clutch_out_W)});
    heat_least = std::min(heat_least, m.clutch_heat_W);
    engine.Finish(settings, m.engine_radps, kStep_s);
    loads.wheel_radps = m.wheel_radps;
  }
  RC_ASSERT(worst <= 1e-6 * scale);
}

// Slip falls to zero and stays; from then on power in = power out, as the locked clutch has no heat.
TEST(Driveline, TheClutchLocksAndThenPassesAllPower) {
  const EngineSettings settings = DefaultSettings().powertrain.engine;
  Engine engine;
  engine.Start(300.0);
  DrivelineLoads loads;
  loads.ratio = 14.5;
  loads.wheel_inertia_kgm2 = 40.0;  // half a car each
  loads.clutch_capacity_Nm = 150.0;
  double before = 1e9, heat_J = 0.0, locked_power = 0.0;
  bool locked = false;
  for (int i = 0; i < 4000; ++i) {
    engine.Prepare(settings, 0.6, false);
    const DrivelineMotion m = StepDriveline(settings, engine, loads, kStep_s);
    EXPECT_GE(m.clutch_slip_radps, -1e-9);
    EXPECT_LE(m.clutch_slip_radps, before + 1e-9);
    if (locked) {
      EXPECT_NEAR(m.clutch_slip_radps, 0.0, 1e-9);
      EXPECT_NEAR(m.clutch_in_W, m.clutch_out_W, 1e-6 * std::fabs(m.clutch_in_W));
      locked_power = m.clutch_out_W;
    } else {
      EXPECT_GE(m.clutch_heat_W, 0.0);
      heat_J += m.clutch_heat_W * kStep_s;
    }
    locked = locked || m.clutch_slip_radps < 1e-9;
    before = m.clutch_slip_radps;
    engine.Finish(settings, m.engine_radps, kStep_s);
    loads.wheel_radps = m.wheel_radps;
  }
  EXPECT_TRUE(locked);
  EXPECT_GT(heat_J, 1000.0);
  EXPECT_GT(locked_power, 1000.0);
}

DrivelineMotion OneStep(double engine_radps, double throttle, const DrivelineLoads& loads) {
  const EngineSettings settings = DefaultSettings().powertrain.engine;
  Engine engine;
  engine.Start(engine_radps);
  engine.Prepare(settings, throttle, false);
  return StepDriveline(settings, engine, loads, kStep_s);
}

TEST(Driveline, TorquePassesBothWaysAndHalvesAtTheDifferential) {
  DrivelineLoads loads;
  loads.ratio = 8.0;
  loads.clutch_capacity_Nm = 200.0;
  loads.wheel_radps = {30.0, 20.0};  // the road drives: 8 · 25 = 200
  loads.road_torque_Nm = {100.0, 100.0};
  const DrivelineMotion m = OneStep(200.0, 0.0, loads);
  EXPECT_LT(m.clutch_torque_Nm, 0.0);
  EXPECT_NEAR(m.drive_torque_Nm, 0.5 * 8.0 * m.clutch_torque_Nm, 1e-12);
  EXPECT_NEAR(m.engine_radps, 4.0 * (m.wheel_radps[0] + m.wheel_radps[1]), 1e-9);
  EXPECT_NEAR(m.wheel_radps[0] - m.wheel_radps[1], 10.0, 1e-9);  // open: the difference is free
}

// The left wheel spins on ice, the right one is held by the road: what the shafts differ by is what the plates bear,
// and it heats them.
TEST(Driveline, PlatesCarryTheirTorqueToTheSlowerWheel) {
  DrivelineLoads loads;
  loads.ratio = 10.0;
  loads.clutch_capacity_Nm = 200.0;
  loads.wheel_radps = {50.0, 10.0};
  loads.road_torque_Nm = {-30.0, -30.0};
  loads.locking_torque_Nm = 240.0;
  const DrivelineMotion m = OneStep(300.0, 0.5, loads);
  const auto shafts = m.shaft_torque_Nm();
  EXPECT_NEAR(shafts[0] - shafts[1], -240.0, 1e-9);
  EXPECT_NEAR(shafts[0] + shafts[1], 10.0 * m.clutch_torque_Nm, 1e-9);
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_NEAR(m.wheel_radps[i], loads.wheel_radps[i] + kStep_s * (shafts[i] - 30.0) / loads.wheel_inertia_kgm2, 1e-9);
  EXPECT_NEAR(m.locking_heat_W, 120.0 * 0.5 * (40.0 + m.wheel_radps[0] - m.wheel_radps[1]), 1e-6);
}

// Two wheels and the plates' friction alone: the difference falls by locking torque / inertia a second, to nothing and
// stays there.
TEST(Driveline, PlatesWearADifferenceAwayAndThenHoldIt) {
  const EngineSettings settings = DefaultSettings().powertrain.engine;
  Engine engine;
  engine.Start(100.0);
  DrivelineLoads loads;  // in neutral
  loads.wheel_radps = {21.0, 20.0};
  loads.locking_torque_Nm = 4.0;
  for (int i = 1; i <= 400; ++i) {
    engine.Prepare(settings, 0.0, false);
    const DrivelineMotion m = StepDriveline(settings, engine, loads, kStep_s);
    EXPECT_NEAR(m.wheel_radps[0] - m.wheel_radps[1], std::max(0.0, 1.0 - 4.0 * kStep_s * i), 1e-8);
    EXPECT_NEAR(m.wheel_radps[0] + m.wheel_radps[1], 41.0, 1e-9);
    engine.Finish(settings, m.engine_radps, kStep_s);
    loads.wheel_radps = m.wheel_radps;
  }
  loads.road_torque_Nm = {1.9, -1.9};  // 3.8 of 4: held
  engine.Prepare(settings, 0.0, false);
  const DrivelineMotion m = StepDriveline(settings, engine, loads, kStep_s);
  EXPECT_NEAR(m.wheel_radps[0], m.wheel_radps[1], 1e-6);
  EXPECT_NEAR(m.locking_torque_Nm, -3.8, 1e-4);
}

TEST(Differential, LocksByPreloadAndByTheTorqueOfItsDirection) {
  const DifferentialSettings settings{40.0, 0.4, 0.1};
  EXPECT_EQ(LockingTorque(settings, 0.0), 40.0);
  EXPECT_EQ(LockingTorque(settings, 500.0), 240.0);
  EXPECT_EQ(LockingTorque(settings, -500.0), 90.0);
  EXPECT_EQ(LockingTorque({}, 500.0), 0.0);
}

// The complementarity conditions themselves are the oracle.
template <int kElements>
void ExpectStickingOrSliding(std::uint32_t seed) {
  const auto draw = [&](std::uint64_t what, double low, double high) {
    return base::RandomUniform({seed, what}, low, high);
  };
  FrictionMatrix<kElements> root;
  for (int i = 0; i < kElements * kElements; ++i)
    root(i / kElements, i % kElements) = draw(static_cast<std::uint64_t>(i), -1, 1);
  const FrictionMatrix<kElements> a = root * root.transpose() + 0.01 * FrictionMatrix<kElements>::Identity();
  FrictionVector<kElements> s, bound;
  for (int i = 0; i < kElements; ++i) {
    s[i] = draw(140 + static_cast<std::uint64_t>(i), -2, 2);
    bound[i] = std::max(0.0, draw(150 + static_cast<std::uint64_t>(i), -0.5, 3));
  }
  const FrictionVector<kElements> p = SolveFriction<kElements>(a, s, bound);
  const FrictionVector<kElements> slide = s + a * p;
  for (int i = 0; i < kElements; ++i) {
    RC_ASSERT(std::fabs(p[i]) <= bound[i]);
    if (std::fabs(slide[i]) > 1e-9) RC_ASSERT(std::fabs(p[i] + std::copysign(bound[i], slide[i])) < 1e-12);
  }
}

RC_GTEST_PROP(Friction, TheSolutionSticksOrSlides, (std::uint32_t seed)) { ExpectStickingOrSliding<5>(seed); }

RC_GTEST_PROP(Friction, TheSolutionOfTwoDrivenAxlesSticksOrSlides, (std::uint32_t seed)) {
  ExpectStickingOrSliding<9>(seed);
}

TEST(Gearbox, RatiosAreTheThesis) {
  const GearboxSettings gearbox = DefaultSettings().powertrain.gearbox;
  EXPECT_NEAR(TotalRatio(gearbox, 1), 3.46 * 4.19, 1e-12);
  EXPECT_NEAR(TotalRatio(gearbox, 5), 0.85 * 4.19, 1e-12);
  EXPECT_EQ(TotalRatio(gearbox, 0), 0.0);
  EXPECT_LT(TotalRatio(gearbox, -1), 0.0);
  EXPECT_EQ(TotalRatio(gearbox, 9), TotalRatio(gearbox, 5));
}

TEST(Gearbox, ByHandAGearNeedsTheClutchAndReverseNeedsPatience) {
  const GearboxSettings gearbox = DefaultSettings().powertrain.gearbox;
  EXPECT_EQ(ShiftByHand(gearbox, 1, 2, 0.0, 5.0), 1);
  EXPECT_EQ(ShiftByHand(gearbox, 1, 2, 1.0, 5.0), 2);
  EXPECT_EQ(ShiftByHand(gearbox, 1, 0, 0.0, 5.0), 0);
  EXPECT_EQ(ShiftByHand(gearbox, 0, -1, 1.0, 5.0), 0);
  EXPECT_EQ(ShiftByHand(gearbox, 0, -1, 1.0, 0.5), -1);
  EXPECT_EQ(ShiftByHand(gearbox, -1, 1, 1.0, -5.0), 0);
}

// Forty cars of two kinds in one array, and each by itself, backward through the array: the same bits, whatever stands
// beside it.
TEST(PowertrainArray, EachCarHasTheBitsThatItHasAlone) {
  constexpr std::size_t kCars = 40;
  const PowertrainSettings usual = DefaultSettings().powertrain;
  PowertrainSettings lame = usual;
  for (TorqueSample& sample : lame.engine.full_load) sample.torque_Nm *= 0.6;
  lame.differential.preload_Nm = 40.0;
  std::vector<const PowertrainSettings*> settings;
  std::vector<Powertrain> together(kCars);
  for (std::size_t i = 0; i < kCars; ++i) {
    settings.push_back(i % 3 == 0 ? &lame : &usual);
    together[i].Start(*settings[i], static_cast<double>(i));
  }
  std::vector<Powertrain> alone = together;
  std::vector<Controls> controls(kCars);
  std::vector<PowertrainInput> inputs(kCars);
  const auto bits = [](const Powertrain& car) {
    base::StateWriter writer(base::StateWriter::Names::kWithout);
    car.Save(writer);
    return writer.digest();
  };
  for (int step = 0; step < 2000; ++step) {
    for (std::size_t i = 0; i < kCars; ++i) {
      const auto draw = [&](std::uint64_t what, double low, double high) {
        return base::RandomUniform({what, i, static_cast<std::uint64_t>(step / 100)}, low, high);
      };
      controls[i].throttle = draw(0, 0.0, 1.0);
      controls[i].gearbox = i % 4 == 0 ? GearboxMode::kManual : GearboxMode::kAutomatic;
      controls[i].gear = static_cast<std::int32_t>(draw(1, -1.5, 3.0));
      controls[i].clutch = draw(2, 0.0, 1.0);
      inputs[i].wheel_radps = together[i].motion().wheel_radps;
      inputs[i].road_torque_Nm = {draw(3, -300.0, 100.0), draw(4, -300.0, 100.0)};
      inputs[i].friction_torque_Nm = {20.0, draw(5, 10.0, 200.0)};
      inputs[i].speed_mps = 0.28 * inputs[i].wheel_radps[0];
    }
    StepPowertrains(settings, controls, inputs, kStep_s, together);
    for (std::size_t i = kCars; i-- > 0;) (void)alone[i].Step(*settings[i], controls[i], inputs[i], kStep_s);
    for (std::size_t i = 0; i < kCars; ++i) ASSERT_EQ(bits(together[i]), bits(alone[i])) << i << " at step " << step;
  }
  EXPECT_NE(bits(together[1]), bits(together[4])) << "two cars of a kind were driven differently";
}

}  // namespace
}  // namespace rodeira::dynamics
