// SPDX-License-Identifier: Apache-2.0
// Many cars at once: each has the bits that it has alone, on any number of threads, whatever else is there, and from a
// snapshot.
#include "common/vehicle/dynamics/car_array.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "common/core/base/random.hpp"
#include "tests/common/vehicle/dynamics/test_car.hpp"
#include "tests/common/vehicle/dynamics/test_ground.hpp"

namespace rodeira::dynamics {
namespace {

constexpr double kDecision_s = 0.01;
constexpr std::size_t kCars = 21;

static_assert(sizeof(BicycleCar) + sizeof(BicycleFindings) <= 4096, "asked: at most 4 kB a vehicle beyond the map");

// Heavier, driven behind, with the slip curve of the thesis in its tyres.
BicycleSettings Van() {
  BicycleSettings settings = DefaultSettings();
  settings.body.mass_kg = 1900.0;
  settings.body.yaw_inertia_kgm2 = 3200.0;
  settings.powertrain.driven = DrivenWheels::kRear;
  for (TyreSettings& tyre : settings.tyre)
    tyre.slip_curve = SlipCurveSettings{{0.1, 1.0, 0.4, 0.8}, {0.12, 0.95, 0.5, 0.8}};
  return settings;
}

InitialCondition Place(std::size_t car) {
  const auto k = static_cast<double>(car);
  return {.x_m = 11.0 * k, .y_m = 3.0 * std::sin(k), .heading_rad = 0.7 * k, .speed_mps = 1.3 * k};
}

Controls Hands(std::size_t car, int step) {
  const auto draw = [&](std::uint64_t what, double low, double high) {
    return base::RandomUniform({car, what, static_cast<std::uint64_t>(step / 30)}, low, high);
  };
  Controls controls;
  controls.steering_wheel_rad = draw(0, -1.5, 1.5);
  controls.throttle = draw(1, 0.0, 1.0);
  controls.brake = std::max(0.0, draw(2, -2.0, 1.0));
  return controls;
}

// The cars with the given numbers, every third of them a van.
struct Cars {
  explicit Cars(std::vector<std::size_t> of, ground::Ground& on) : numbers(std::move(of)), ground(on) {
    const auto small = array.AddKind(DefaultSettings()), van = array.AddKind(Van());
    for (const std::size_t number : numbers) {
      const auto added = array.Add(number % 3 == 0 ? van.value() : small.value(), Place(number), ground);
      EXPECT_TRUE(added.ok()) << (added.ok() ? "" : added.error().Text());
    }
  }
  void Step(int step, base::ThreadPool* pool = nullptr) {
    controls.clear();
    for (const std::size_t number : numbers) controls.push_back(Hands(number, step));
    array.Step(controls, ground, kDecision_s, pool);
  }
  base::Bytes Of(std::size_t i) const {
    base::StateWriter writer;
    array.car(i).Save(writer);
    return writer.bytes();
  }
  base::Digest digest() const {
    base::StateWriter writer;
    array.Save(writer);
    return writer.digest();
  }

  std::vector<std::size_t> numbers;
  ground::Ground& ground;
  CarArray array;
  std::vector<Controls> controls;
};

std::vector<std::size_t> All() {
  std::vector<std::size_t> numbers(kCars);
  for (std::size_t i = 0; i < kCars; ++i) numbers[i] = i;
  return numbers;
}

TEST(CarArray, EachCarHasTheBitsOfItAlone) {
  HillGround ground(4, {.ice = true});
  Cars cars(All(), ground);
  std::vector<BicycleModel> alone;
  for (std::size_t i = 0; i < kCars; ++i)
    alone.push_back(PlacedCar(i % 3 == 0 ? Van() : DefaultSettings(), ground, Place(i)));
  for (int step = 0; step < 300; ++step) {
    const int before = ground.batches;
    cars.Step(step);
    EXPECT_EQ(ground.batches, before + 1);
    for (std::size_t i = 0; i < kCars; ++i) {
      alone[i].Step(Hands(i, step), ground, kDecision_s);
      base::StateWriter writer;
      alone[i].car().Save(writer);
      ASSERT_EQ(cars.Of(i), writer.bytes()) << "car " << i << " at step " << step;
      ASSERT_EQ(cars.array.p_WB_W(i), alone[i].state().p_WB_W);
    }
  }
  EXPECT_GT(cars.array.car(3).powertrain.gear(), 0);
}

TEST(CarArray, ThreadsAndCompanyChangeNoBit) {
  HillGround ground(5, {});
  base::ThreadPool pair(2), quartet(4), many(30);
  Cars one(All(), ground), two(All(), ground), four(All(), ground), some({13, 2, 7}, ground);
  for (int step = 0; step < 200; ++step) {
    one.Step(step);
    two.Step(step, &pair);
    four.Step(step, &quartet);
    some.Step(step, &many);
    ASSERT_EQ(one.digest(), two.digest()) << step;
    ASSERT_EQ(one.digest(), four.digest()) << step;
  }
  EXPECT_EQ(some.Of(0), one.Of(13));
  EXPECT_EQ(some.Of(1), one.Of(2));
  EXPECT_EQ(some.Of(2), one.Of(7));
}

TEST(CarArray, RestoredItGoesOnWithTheSameBits) {
  HillGround ground(6, {});
  Cars first(All(), ground), second(All(), ground);
  for (int step = 0; step < 150; ++step) first.Step(step);
  base::StateWriter snapshot;
  first.array.Save(snapshot);
  base::StateReader reader(snapshot.bytes());
  second.array.Restore(reader);
  ASSERT_TRUE(reader.Finish().ok());
  for (int step = 150; step < 350; ++step) {
    first.Step(step);
    second.Step(step);
    ASSERT_EQ(first.digest(), second.digest()) << step;
  }
}

// Slopes are felt: on one of 10 % without engine and brakes a car gains g sin less what rolling takes.
TEST(CarArray, RollsDownASlope) {
  ground::PlaneGround ground(Eigen::Vector3d::Zero(), -0.1, 0.0);
  CarArray array;
  const auto kind = array.AddKind(DefaultSettings());
  ASSERT_TRUE(array.Add(kind.value(), {}, ground).ok());
  Controls neutral;
  neutral.gearbox = GearboxMode::kManual;
  neutral.gear = 0;
  const std::vector<Controls> controls{neutral};
  for (int step = 0; step < 200; ++step) array.Step(controls, ground, kDecision_s);
  const BicycleSettings settings = DefaultSettings();
  const double slope = std::atan(0.1);
  const double turning_kg =
      4.0 * settings.wheel.inertia_kgm2 / (settings.wheel.rolling_radius_m * settings.wheel.rolling_radius_m);
  const double wanted = 2.0 * settings.body.mass_kg * kG_mps2 *
                        (std::sin(slope) - settings.wheel.rolling_resistance * std::cos(slope)) /
                        (settings.body.mass_kg + turning_kg);
  EXPECT_NEAR(array.speed_mps(0), wanted, 0.02 * wanted);
}

TEST(CarArray, RefusesWhatIsNoCarAmongMany) {
  CarArray array;
  BicycleSettings ring = DefaultSettings();
  ring.wheel.enveloping = Enveloping::kRing;
  EXPECT_EQ(array.AddKind(ring).error().exit_status(), 2);
  HillGround ground(1, {.edge_m = 50.0});
  const auto kind = array.AddKind(DefaultSettings());
  const auto outside = array.Add(kind.value(), {.x_m = 100.0}, ground);
  ASSERT_FALSE(outside.ok());
  EXPECT_NE(outside.error().Text().find("outside of the world"), std::string::npos);
  EXPECT_EQ(array.size(), 0u);
}

}  // namespace
}  // namespace rodeira::dynamics
