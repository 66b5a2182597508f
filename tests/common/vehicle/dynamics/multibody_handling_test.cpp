// SPDX-License-Identifier: Apache-2.0
// The prototype's handling against the single-track closed form with its own axles' stiffnesses, measured on a virtual
// rig.
#include "common/vehicle/dynamics/multibody_model.hpp"
#include "tests/common/vehicle/dynamics/handling_rig.hpp"
#include "tests/tree.hpp"

namespace rodeira::dynamics {
namespace {

constexpr double kDegreesPerG = 9.81 * 180.0 / 3.14159265358979323846;

std::unique_ptr<VehicleModel> Car(const std::string& name) {
  auto model = LoadVehicle(std::filesystem::path(SourceDir()) / "configs/vehicles" / name);
  EXPECT_TRUE(model.ok()) << (model.ok() ? "" : model.error().Text());
  return std::move(model).value();
}

// Of a car of its own: a load belongs to one mechanism.
MultibodySettings SettingsOf(const std::string& name) {
  return static_cast<const MultibodyModel&>(*Car(name)).settings();
}

struct Bend {
  double speed_mps = 0.0, yaw_rate_radps = 0.0, sideslip_rad = 0.0;
};

// Steadily, with the steering wheel held and the foot keeping the speed.
Bend DriveRound(VehicleModel& car, double speed_mps, double wheel_rad) {
  ground::PlaneGround ground;
  EXPECT_TRUE(car.Initialise({.speed_mps = speed_mps}, ground).ok());
  Controls controls;
  double integral = 0.0;
  Bend bend;
  constexpr int kSteps = 5000, kMean = 1000;
  for (int i = 0; i < kSteps; ++i) {
    const double off = speed_mps - car.state().speed_mps();
    integral += 0.2 * off * 0.001;
    controls.throttle = std::clamp(0.3 * off + integral, 0.0, 1.0);
    controls.steering_wheel_rad = wheel_rad * std::min(1.0, 0.001 * i);
    car.Step(controls, ground, 0.001);
    if (i < kSteps - kMean) continue;
    const Eigen::Vector3d v = car.state().q_WB.conjugate() * car.state().v_WB_W;
    bend.speed_mps += v.x() / kMean;
    bend.yaw_rate_radps += car.state().w_WB_B.z() / kMean;
    bend.sideslip_rad += v.y() / v.x() / kMean;
  }
  return bend;
}

// Below 1 m/s²: yaw rate over the front wheels' angle V / (L + K V²), sideslip (b - s m V²/Cr) / (L + K V²), where s is
// the rear axle's share of the side force: a/L without aligning moments.
TEST(PrototypeHandling, BendsAsTheClosedFormWithItsAxlesStiffnesses) {
  auto car = Car("prototype.yaml");
  for (const double speed : {10.0, 20.0, 30.0}) {
    const AxleStiffness axles = MeasureAxles(SettingsOf("prototype.yaml"), speed);
    const double gradient = axles.UndersteerGradient();
    const double wheel_rad =
        axles.steering_ratio * 0.6 * (axles.wheelbase_m() + gradient * speed * speed) / (speed * speed);
    const Bend bend = DriveRound(*car, speed, wheel_rad);
    EXPECT_NEAR(bend.yaw_rate_radps * bend.speed_mps, 0.6, 0.1);
    EXPECT_NEAR(bend.speed_mps, speed, 0.01 * speed);
    const double angle = wheel_rad / axles.steering_ratio;
    const double v2 = bend.speed_mps * bend.speed_mps;
    const double denominator = axles.wheelbase_m() + gradient * v2;
    const double gain = bend.speed_mps / denominator;
    EXPECT_NEAR(bend.yaw_rate_radps / angle, gain, 0.05 * gain) << speed;
    // B lies midway between the axles, not at the centre of gravity: its sideslip is r (b - L/2) / V less. Each of the
    // two terms that the sideslip is the difference of holds to 5 %.
    const double to_middle = axles.centre_to_rear_m - 0.5 * axles.wheelbase_m();
    const double to_slip = axles.rear_share * axles.mass_kg * v2 / axles.rear_Nprad;
    const double sideslip = (bend.sideslip_rad + bend.yaw_rate_radps / bend.speed_mps * to_middle) / angle;
    EXPECT_NEAR(sideslip, (axles.centre_to_rear_m - to_slip) / denominator,
                0.05 * (axles.centre_to_rear_m + to_slip) / denominator)
        << speed;
    // An understeering car, and the ratio that its file names.
    EXPECT_GT(gradient * kDegreesPerG, 0.5);
    EXPECT_LT(gradient * kDegreesPerG, 3.0);
    EXPECT_NEAR(axles.steering_ratio, car->dimensions().steering_ratio, 0.01 * axles.steering_ratio);
  }
}

TEST(PrototypeHandling, TheBarLetsTheCarLeanLess) {
  const auto with = Car("prototype.yaml");
  MultibodySettings settings = SettingsOf("prototype.yaml");
  std::erase_if(settings.mechanism.loads, [](const multibody::NamedLoad& load) { return load.name == "front_bar"; });
  MultibodyModel without(settings);
  ASSERT_TRUE(without.Build().ok());
  const auto lean = [](VehicleModel& car, double* front_share) {
    const Bend bend = DriveRound(car, 20.0, 0.35);
    const VehicleState& s = car.state();
    const double front = s.wheels[kFrontRight].load_N - s.wheels[kFrontLeft].load_N;
    const double rear = s.wheels[kRearRight].load_N - s.wheels[kRearLeft].load_N;
    *front_share = front / (front + rear);
    return s.roll_rad() / (bend.yaw_rate_radps * bend.speed_mps);
  };
  double share_with = 0.0, share_without = 0.0;
  const double lean_with = lean(*with, &share_with), lean_without = lean(without, &share_without);
  EXPECT_LT(lean_with, 0.9 * lean_without);
  EXPECT_GT(share_with, share_without + 0.05);  // the front axle bears more of the load's shift
}

}  // namespace
}  // namespace rodeira::dynamics
