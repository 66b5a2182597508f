// A beginner at the keyboard: taps keys that are either down or up, a quarter of a second apart, and keeps the lane.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <deque>

#include "common/driver/lane_path.hpp"
#include "common/driver/speed_plan.hpp"
#include "common/hands/keyboard_driver.hpp"
#include "common/vehicle/vehicle_model.hpp"
#include "tests/common/driver/test_road.hpp"

namespace rodeira::hands {
namespace {

constexpr double kStep_s = 0.001;
constexpr double kHalfLane_m = 1.5;

// Looks a good second ahead, decides four times a second, and the fingers follow a fifth of a second later. Knows nothing
// of angles: left, right or nothing; throttle, brake or nothing.
class Beginner {
 public:
  KeyboardInput Look(const vehicle::VehicleState& state, const driver::LanePath& path, double allowed_mps) {
    const Eigen::Vector3d v_B = state.q_WB.conjugate() * state.v_WB_W;
    const auto place = path.Locate(state.p_WB_W.x(), state.p_WB_W.y());
    if (!place) return {};
    const double ahead_m = std::max(6.0, 1.1 * v_B.x());
    const Eigen::Vector3d target_B = state.q_WB.conjugate() * (path.At(place->d_m + ahead_m).p_W - state.p_WB_W);
    // Where the car will be beside its own axis if nothing changes: the arc of the present turn.
    const double time_s = ahead_m / std::max(v_B.x(), 1.0);
    const double aside_m = target_B.y() - 0.5 * v_B.x() * state.w_WB_B.z() * time_s * time_s;
    KeyboardInput keys;
    const auto press = [&](Action action, bool held) { keys.held[static_cast<std::size_t>(action)] = held; };
    press(Action::kSteerLeft, aside_m > 0.25);
    press(Action::kSteerRight, aside_m < -0.25);
    press(Action::kThrottle, v_B.x() < allowed_mps - 0.5);
    press(Action::kBrake, v_B.x() > allowed_mps + 1.0);
    return keys;
  }
};

TEST(KeyboardRoad, ABeginnerKeepsTheLaneThroughBendsOf35Metres) {
  const auto world = driver::WindingWorld();
  const auto ground = world->MakeGround();
  const driver::LanePath path(world->roads()[0], -1);
  const driver::SpeedPlan plan(path, {.lateral_mps2 = 2.0, .stop_at_end = true});
  auto car = vehicle::LoadVehicle(std::filesystem::path(RODEIRA_SOURCE_DIR) / "configs/vehicles/default.yaml").value();
  const driver::LaneFrame start = path.At(5.0);
  ASSERT_TRUE(
      car->Initialise({.x_m = start.p_W.x(), .y_m = start.p_W.y(), .z_hint_m = start.p_W.z(), .heading_rad = start.heading_rad},
                      *ground)
          .ok());
  const auto settings = LoadKeyboard(std::filesystem::path(RODEIRA_SOURCE_DIR) / "configs/drivers/keyboard.yaml");
  ASSERT_TRUE(settings.ok()) << settings.error().Text();
  KeyboardDriver driver(settings.value());
  Beginner beginner;
  std::deque<KeyboardInput> on_the_way(20);  // 0.2 s at 100 Hz
  KeyboardInput decided;
  double worst_m = 0.0;
  double fastest_mps = 0.0;
  double driven_m = 0.0;
  for (int k = 0; k < 180'000; ++k) {
    if (k % 250 == 0) {
      const auto place = path.Locate(car->state().p_WB_W.x(), car->state().p_WB_W.y());
      ASSERT_TRUE(place.has_value());
      driven_m = place->d_m;
      if (driven_m > path.length_m() - 40.0) break;
      decided = beginner.Look(car->state(), path, plan.At(place->d_m + 5.0).speed_mps);
    }
    if (k % 10 == 0) {
      on_the_way.push_back(decided);
      KeyboardInput input = on_the_way.front();
      on_the_way.pop_front();
      input.speed_mps = (car->state().q_WB.conjugate() * car->state().v_WB_W).x();
      driver.Step(input, 0.01);
      const auto place = path.Locate(car->state().p_WB_W.x(), car->state().p_WB_W.y());
      if (place) worst_m = std::max(worst_m, std::fabs(place->offset_m));
      fastest_mps = std::max(fastest_mps, input.speed_mps);
    }
    car->Step(driver.controls(), *ground, kStep_s);
  }
  EXPECT_GT(driven_m, path.length_m() - 40.0) << "it arrives";
  EXPECT_GT(fastest_mps, 12.0);
  EXPECT_LT(worst_m, kHalfLane_m) << "its middle never leaves the lane";
  RecordProperty("worst_offset_m", std::to_string(worst_m));
  std::printf("worst offset %.2f m, fastest %.1f m/s\n", worst_m, fastest_mps);
}

}  // namespace
}  // namespace rodeira::hands
