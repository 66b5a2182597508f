// SPDX-License-Identifier: Apache-2.0
// What a window shows from picture to picture: the clock, the history of poses and the cameras together.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "common/core/base/random.hpp"
#include "common/view/scene/camera/camera.hpp"
#include "common/view/scene/playback/display_clock.hpp"
#include "common/view/scene/playback/picture_pace.hpp"
#include "common/world/road/world.hpp"
#include "tests/tree.hpp"

namespace rodeira::scene {
namespace {

using Eigen::Vector3d;

constexpr double kSpeed_mps = 30.0;
constexpr double kSettled_s = 8.0, kEnd_s = 16.0;
constexpr double kLate_s = 0.001;  // samples come up to so much late

struct Display {
  double rate_Hz, period_s;
};

Vector3d CarAt(double time_s) { return {kSpeed_mps * time_s, 0.0, 0.0}; }

// A car and one of the traffic before it, as fast.
SceneSnapshot At(double time_s) {
  SceneSnapshot moment;
  moment.time_ns = std::llround(time_s * 1e9);
  CarPose car;
  car.p_WB_W = CarAt(time_s);
  car.speed_mps = kSpeed_mps;
  moment.cars.push_back(car);
  AgentPose agent;
  agent.p_WB_W = car.p_WB_W + Vector3d(25.0, 3.0, 0.0);
  agent.speed_mps = kSpeed_mps;
  moment.agents.push_back(agent);
  return moment;
}

// When a window begins its pictures: it draws for so long, shows, which waits for the display's next refresh where that
// holds it, and for its pace. `refresh_Hz`: the display's, 0 where showing never waits, whatever it says of itself. It
// wakes a tenth of a millisecond late.
std::vector<double> BeginsOf(const DisplayBeat& beat, double refresh_Hz, double drawing_s) {
  constexpr double kWakes_s = 1e-4;
  PicturePace pace;
  std::vector<double> begins;
  double begin_s = 0.0;
  while (begin_s < kEnd_s) {
    begins.push_back(begin_s);
    double shown_s = begin_s + drawing_s;
    if (refresh_Hz > 0.0) shown_s = std::ceil(shown_s * refresh_Hz - 1e-6) / refresh_Hz;
    const double next_s = pace.Next(begin_s, beat);
    begin_s = next_s > shown_s ? next_s + kWakes_s : shown_s;
  }
  return begins;
}

// Calls seen(wall time, moment) for each picture of a display, as the stage does.
template <class Seen>
void Watch(const Display& display, Seen seen) {
  DisplayClock clock;
  PoseHistory history;
  int k = 0;
  const auto arrival = [&](int i) {
    return i * display.period_s + kLate_s * base::RandomUniform({5, static_cast<std::uint64_t>(i)});
  };
  for (const double wall_s : BeginsOf({display.rate_Hz, true}, display.rate_Hz, 0.7 / display.rate_Hz)) {
    for (; arrival(k) <= wall_s; ++k) {
      history.Add(At(k * display.period_s));
      clock.Arrived(arrival(k), static_cast<double>(history.newest_ns()) * 1e-9,
                    static_cast<double>(history.interval_ns()) * 1e-9);
    }
    if (!history.empty()) seen(wall_s, history.At(clock.Now(wall_s) * 1e9));
  }
}

class Motion : public ::testing::TestWithParam<Display> {};

// A hundredth of the way between two pictures, and at most one period and one picture behind what is known.
TEST_P(Motion, IsEvenAndNotLate) {
  const Display display = GetParam();
  const double step_m = kSpeed_mps / display.rate_Hz;
  double before_m = 0.0, worst = 0.0, latest_s = 0.0;
  int pictures = 0;
  Watch(display, [&](double wall_s, const SceneSnapshot& moment) {
    const double x_m = moment.cars[0].p_WB_W.x();
    if (wall_s > kSettled_s) {
      worst = std::max(worst, std::fabs(x_m - before_m - step_m) / step_m);
      latest_s = std::max(latest_s, wall_s - x_m / kSpeed_mps);
      ++pictures;
    }
    before_m = x_m;
  });
  EXPECT_GT(pictures, 0.9 * (kEnd_s - kSettled_s) * display.rate_Hz);
  EXPECT_LT(worst, 0.01);
  EXPECT_LT(latest_s, display.period_s + 1.0 / display.rate_Hz);
}

// Camera, car and traffic are of one moment: between them nothing moves, to a millimetre, while the car drives.
TEST_P(Motion, CameraCarAndTrafficMoveTogether) {
  const auto world = road::World::Load(SourceDir() + "/configs/worlds/plane.yaml").value();
  for (const CameraKind kind : {CameraKind::kChase, CameraKind::kDriver, CameraKind::kBonnet, CameraKind::kOrbit}) {
    double worst_m = 0.0, driven_m = 0.0;
    int pictures = 0;
    std::optional<Vector3d> eye, agent;
    Watch(GetParam(), [&](double, const SceneSnapshot& moment) {
      const Body body = *BodyAt(moment, 0);
      const Vector3d to_eye = MakeCamera(kind, body, {}, *world).eye_W - body.p_WB_W,
                     to_agent = moment.agents[0].p_WB_W - body.p_WB_W;
      if (!eye) eye = to_eye, agent = to_agent;
      worst_m = std::max({worst_m, (to_eye - *eye).norm(), (to_agent - *agent).norm()});
      driven_m = std::max(driven_m, body.p_WB_W.x());
      ++pictures;
    });
    EXPECT_GT(pictures, 0.9 * kEnd_s * GetParam().rate_Hz) << static_cast<int>(kind);
    EXPECT_GT(driven_m, 0.9 * kEnd_s * kSpeed_mps) << static_cast<int>(kind);
    EXPECT_LT(worst_m, 0.001) << static_cast<int>(kind);
  }
}

// Each refresh has its picture, of displays as slow and as fast as they are sold.
TEST(PicturePace, AWindowThatTheDisplayHoldsMissesNoRefresh) {
  for (const double rate_Hz : {50.0, 60.0, 75.0, 144.0, 240.0}) {
    for (const double share : {0.05, 0.5, 0.95}) {
      for (const double said_Hz : {rate_Hz - 0.9, rate_Hz, rate_Hz + 0.9}) {  // whole numbers are said
        const auto begins = BeginsOf({said_Hz, true}, rate_Hz, share / rate_Hz);
        ASSERT_NEAR(static_cast<double>(begins.size()), kEnd_s * rate_Hz, 1.5)
            << rate_Hz << " Hz, drawing takes " << share << " of a period";
        for (std::size_t i = 1; i < begins.size(); ++i) EXPECT_NEAR(begins[i] - begins[i - 1], 1.0 / rate_Hz, 1e-9);
      }
    }
  }
}

TEST(PicturePace, WithoutTheDisplaysHoldAWindowKeepsItsRate) {
  for (const double rate_Hz : {60.0, 144.0}) {
    EXPECT_NEAR(static_cast<double>(BeginsOf({rate_Hz, false}, 0.0, 0.003).size()), kEnd_s * rate_Hz, 2.0)
        << "although it wakes late each time";
  }
  for (const double unknown_Hz : {0.0, 1.0, 65535.0})
    EXPECT_NEAR(static_cast<double>(BeginsOf({unknown_Hz, false}, 0.0, 0.003).size()), kEnd_s * 60.0, 2.0);
}

TEST(PicturePace, ADisplayThatDoesNotKeepItsWordCostsATenthMore) {
  const auto pictures = static_cast<double>(BeginsOf({60.0, true}, 0.0, 0.003).size());
  EXPECT_LE(pictures, kEnd_s * 60.0 / PicturePace::kHeldShare);
  EXPECT_GE(pictures, kEnd_s * 60.0);
}

TEST(PicturePace, ASlowRendererWaitsForNothing) {
  EXPECT_NEAR(static_cast<double>(BeginsOf({60.0, false}, 0.0, 0.03).size()), kEnd_s / 0.03, 1.5);
  EXPECT_NEAR(static_cast<double>(BeginsOf({60.0, false}, 0.0, 0.02).size()), kEnd_s / 0.02, 1.5);
  PicturePace pace;
  EXPECT_NEAR(pace.Next(5.0, {100.0, false}), 5.01, 1e-12);
  EXPECT_NEAR(pace.Next(7.0, {100.0, false}), 7.01, 1e-12) << "what was missed is not made up for";
}

INSTANTIATE_TEST_SUITE_P(Displays, Motion,
                         ::testing::Values(Display{60.0, 0.007}, Display{60.0, 0.010}, Display{60.0, 0.020},
                                           Display{144.0, 0.007}, Display{144.0, 0.010}, Display{144.0, 0.020}));

}  // namespace
}  // namespace rodeira::scene
