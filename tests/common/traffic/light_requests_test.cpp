// SPDX-License-Identifier: Apache-2.0
// What a node outside asks of lights: no colour is left out, lights of ways that cross never let go together, and
// behind it the plan is as it was.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "common/traffic/traffic_requests.hpp"
#include "common/world/network/lights.hpp"
#include "common/world/road/world.hpp"
#include "tests/common/traffic/digest_of.hpp"
#include "tests/common/traffic/scripted.hpp"
#include "tests/tree.hpp"

namespace rodeira::traffic {
namespace {

using network::LightColour;

// Two streets that cross; from 0 s on `cross` is green for 25 s, then `main` for 20 s, each with 3 s of amber.
class LightRequests : public testing::Test {
 protected:
  LightRequests() : model_(TrafficModel::Make(OnlyScripted({kCar, kCar}), World(), {}).value()) {
    for (std::uint32_t i = 0; i < 2; ++i) (Controllers()[i].id.ends_with("main") ? main_ : cross_) = i;
  }
  static std::shared_ptr<const road::World> World() {
    static const auto kWorld = road::World::Load(SourceDir() + "/configs/worlds/lights.yaml").value();
    return kWorld;
  }
  static std::span<const network::Controller> Controllers() { return World()->network()->controllers(); }
  TrafficRequest Light(std::uint32_t controller, const std::string& colour, double duration_s) const {
    TrafficRequest request;
    request.name = "light", request.light = Controllers()[controller].id;
    request.choice = colour, request.duration_s = duration_s;
    return request;
  }
  // Its id; a refusal leaves the state as it was.
  std::string Refusal(const TrafficRequest& request) {
    const base::Digest before = DigestOf(model_);
    const TrafficAnswer answer = Answer(model_, request);
    if (!answer.refusal) return "";
    EXPECT_EQ(DigestOf(model_), before);
    return std::string(answer.refusal->id.text());
  }
  LightColour Colour(std::uint32_t controller) const { return model_.colours()[controller]; }
  LightColour Planned(std::uint32_t controller) const {
    return network::ColourAt(*Controllers()[controller].times, time_ns_);
  }
  // Steps to a time; both are never green or amber together, and no colour follows one that it must not.
  void DriveTo(double time_s) {
    const auto is_lit = [](LightColour colour) {
      return colour == LightColour::kGreen || colour == LightColour::kAmber;
    };
    while (time_ns_ < std::llround(time_s * 1e9)) {
      const std::vector<LightColour> before = model_.colours();
      model_.Step(kStep_s, {});
      time_ns_ += std::llround(kStep_s * 1e9);
      ASSERT_FALSE(is_lit(Colour(0)) && is_lit(Colour(1))) << 1e-9 * static_cast<double>(time_ns_);
      for (std::uint32_t i = 0; i < 2; ++i) {
        const LightColour now = Colour(i);
        if (before[i] == LightColour::kGreen) {
          ASSERT_TRUE(now == before[i] || now == LightColour::kAmber);
        } else if (before[i] == LightColour::kAmber) {
          ASSERT_TRUE(now == before[i] || now == LightColour::kRed);
        } else if (before[i] == LightColour::kRed) {
          ASSERT_NE(now, LightColour::kGreen);
        }
      }
    }
  }

  TrafficModel model_;
  std::uint32_t main_ = 2, cross_ = 2;
  std::int64_t time_ns_ = 0;
};

TEST_F(LightRequests, RedIsShownBehindAmberForItsTimeAndTheOtherKeepsItsPlan) {
  DriveTo(10.0);
  ASSERT_EQ(Colour(cross_), LightColour::kGreen);
  ASSERT_EQ(Refusal(Light(cross_, "red", 100.0)), "");
  DriveTo(12.9);
  EXPECT_EQ(Colour(cross_), LightColour::kAmber);
  for (double t = 13.1; t < 113.0; t += 0.5) {
    DriveTo(t);
    ASSERT_EQ(Colour(cross_), LightColour::kRed) << t;
    ASSERT_EQ(Colour(main_), Planned(main_)) << t;
  }
  for (double t = 170.0; t < 300.0; t += 0.5) {
    DriveTo(t);
    ASSERT_EQ(Colour(cross_), Planned(cross_)) << t;
  }
}

// A car on the street that is kept red stops before the line, and goes on when the plan lets it.
TEST_F(LightRequests, ACarWaitsAtARequestedRed) {
  TrafficRequest car;
  car.name = "add", car.choice = "car", car.speed_mps = 13.0, car.station_m = 40.0;
  const network::Road* west = nullptr;
  for (const network::Road& road : World()->network()->roads()) {
    if (road.id().starts_with("main") && road.Surface(0.0, 0.0).p_W.x() < -250.0) west = &road;
  }
  ASSERT_NE(west, nullptr);
  car.lane = west->id() + ":-1";
  DriveTo(30.0);  // main is green from now on for 20 s
  ASSERT_EQ(Colour(main_), LightColour::kGreen);
  ASSERT_EQ(Refusal(car), "");
  ASSERT_EQ(Refusal(Light(main_, "red", 60.0)), "");
  DriveTo(88.0);
  EXPECT_LT(PoseOf(model_, 0)->speed_mps, 0.1);
  EXPECT_LT(PoseOf(model_, 0)->p_WB_W.x(), -5.0);
  EXPECT_GT(PoseOf(model_, 0)->p_WB_W.x(), -40.0);
  DriveTo(180.0);
  const AgentPose* pose = PoseOf(model_, 0);
  EXPECT_TRUE(pose == nullptr || pose->p_WB_W.x() > 0.0);
}

// Green is refused as long as the other one would let traffic go, too, and granted while that one is kept red.
TEST_F(LightRequests, GreenIsGrantedWhereItMeetsNoOther) {
  DriveTo(10.0);
  EXPECT_EQ(Refusal(Light(main_, "green", 10.0)), "traffic.conflicting_green");
  EXPECT_EQ(Refusal(Light(cross_, "green", 60.0)), "traffic.conflicting_green") << "of main's plan, later";
  EXPECT_EQ(Refusal(Light(cross_, "green", 12.0)), "");
  DriveTo(20.0);
  ASSERT_EQ(Refusal(Light(cross_, "red", 200.0)), "");
  EXPECT_EQ(Refusal(Light(main_, "green", 150.0)), "traffic.conflicting_green") << "the other one shows amber";
  DriveTo(24.0);
  ASSERT_EQ(Refusal(Light(main_, "green", 150.0)), "");
  EXPECT_EQ(Refusal(Light(cross_, "plan", 0.0)), "traffic.conflicting_green") << "the other one is held green";
  DriveTo(26.0);
  for (double t = 26.0; t < 174.0; t += 1.0) {
    DriveTo(t);
    ASSERT_EQ(Colour(main_), LightColour::kGreen) << t;
    ASSERT_EQ(Colour(cross_), LightColour::kRed) << t;
  }
  ASSERT_EQ(Refusal(Light(main_, "plan", 0.0)), "");
  ASSERT_EQ(Refusal(Light(cross_, "plan", 0.0)), "");
  for (double t = 260.0; t < 400.0; t += 0.5) {
    DriveTo(t);
    ASSERT_EQ(Colour(main_), Planned(main_)) << t;
    ASSERT_EQ(Colour(cross_), Planned(cross_)) << t;
  }
}

// Whatever is asked of both at any moments: DriveTo looks at each step.
TEST_F(LightRequests, AnyRequestsInAnyOrderKeepThemApart) {
  int done = 0, refused = 0;
  std::uint64_t draw = 1;
  for (double t = 1.0; t < 1500.0; t += 1.7) {
    DriveTo(t);
    draw = draw * 6364136223846793005ull + 1442695040888963407ull;
    const std::uint64_t drawn = draw >> 33;
    const char* colours[] = {"red", "green", "plan"};
    const double duration_s = 1.0 + static_cast<double>(drawn / 6 % 40);
    (Refusal(Light(static_cast<std::uint32_t>(drawn % 2), colours[drawn / 2 % 3], duration_s)).empty() ? done
                                                                                                       : refused)++;
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(done, 100);
  EXPECT_GT(refused, 100);
}

TEST_F(LightRequests, UnknownLightsAndTimesAreRefused) {
  TrafficRequest request = Light(main_, "red", 5.0);
  request.light += "x";
  EXPECT_EQ(Refusal(request), "traffic.unknown_light");
  EXPECT_EQ(Refusal(Light(main_, "amber", 5.0)), "traffic.wrong_request");
  EXPECT_EQ(Refusal(Light(main_, "red", 0.0)), "traffic.wrong_request");
  EXPECT_EQ(Refusal(Light(main_, "red", 1e9)), "traffic.wrong_request");
  DriveTo(26.0);
  ASSERT_EQ(Colour(cross_), LightColour::kAmber);
  EXPECT_EQ(Refusal(Light(cross_, "green", 5.0)), "traffic.not_now");
}

TEST_F(LightRequests, RestoredWhileALightIsHeldItGoesOnWithTheSameBits) {
  DriveTo(10.0);
  ASSERT_EQ(Refusal(Light(cross_, "red", 30.0)), "");
  DriveTo(20.0);
  base::StateWriter out;
  model_.Save(out);
  TrafficModel restored = TrafficModel::Make(OnlyScripted({kCar, kCar}), World(), {}).value();
  base::StateReader in(out.bytes());
  restored.Restore(in);
  ASSERT_TRUE(in.Finish().ok());
  EXPECT_EQ(restored.colours(), model_.colours());
  for (int i = 0; i < 5000; ++i) {
    model_.Step(kStep_s, {}), restored.Step(kStep_s, {});
    ASSERT_EQ(DigestOf(model_), DigestOf(restored)) << i;
    ASSERT_EQ(restored.colours(), model_.colours()) << i;
  }
}

}  // namespace
}  // namespace rodeira::traffic
