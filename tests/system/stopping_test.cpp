// SPDX-License-Identifier: Apache-2.0
// A car that stands in a lane is not touched: the driver's car stopped, its followers stop behind it; the queue blocks
// the lane, and the autopilot stops behind the queue. Read from the recording of a whole run.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <vector>

#include "idl/messages.hpp"
#include "idl/topics.hpp"
#include "tests/launch/rodeira/temporary_folder.hpp"
#include "tests/system/command.hpp"
#include "tests/system/recording.hpp"
#include "tests/tree.hpp"

namespace rodeira::system_test {
namespace {

// A rectangle on the straight road, which runs along x.
struct Box {
  double rear_m, front_m, right_m, left_m, speed_mps;
  bool in_lane() const { return right_m < 0.0 && left_m < 0.5 && left_m > -3.2; }  // lane -1: y from -3.2 to 0
};

double Double(float value) { return static_cast<double>(value); }

Box BoxOf(const msg::VehicleState& car) {
  const double x = car.position_w_m().x(), y = car.position_w_m().y();
  const double front = x + Double(car.front_m());
  return {front - Double(car.length_m()), front, y - 0.5 * Double(car.width_m()), y + 0.5 * Double(car.width_m()),
          car.velocity_w_mps().x()};
}
Box BoxOf(const msg::TrafficAgent& agent) {
  const double x = agent.position_x_m(), y = agent.position_y_m();
  return {x - 0.5 * Double(agent.length_m()), x + 0.5 * Double(agent.length_m()), y - 0.5 * Double(agent.width_m()),
          y + 0.5 * Double(agent.width_m()), agent.speed_mps() * std::cos(Double(agent.heading_rad()))};
}
bool Touch(const Box& a, const Box& b) {
  return a.rear_m < b.front_m && b.rear_m < a.front_m && a.right_m < b.left_m && b.right_m < a.left_m;
}

// All at one time: the wreck, the autopilot's car, the agents.
std::vector<Box> AllBoxes(const msg::VehicleState& wreck, const msg::VehicleState& ego,
                          const msg::TrafficState& traffic) {
  std::vector<Box> boxes{BoxOf(wreck), BoxOf(ego)};
  for (const auto& agent : traffic.agents()) boxes.push_back(BoxOf(agent));
  return boxes;
}

constexpr double kStandingGap_m = 4.5, kRoomToPass_m = 10.5;

TEST(Stopping, ABlockedLaneStopsTrafficAndAutopilotWithoutATouch) {
  const cli::TemporaryFolder folder;
  const std::string recording = (folder.path() / "blocked.mcap").string();
  const Ended ended = RunCommand(
      {Bin("rodeira"), "run", SourceDir() + "/tests/data/blocked_lane.yaml", "--in-process", "--record", recording});
  ASSERT_EQ(ended.status, 0) << ended.out;
  const auto wreck = MessagesOf<msg::VehicleState>(recording, idl::topics::kVehicleState, "wreck");
  const auto ego = MessagesOf<msg::VehicleState>(recording, idl::topics::kVehicleState, "ego");
  const auto traffic = MessagesOf<msg::TrafficState>(recording, idl::topics::kTrafficState);
  ASSERT_EQ(wreck.size(), 90001u);
  ASSERT_EQ(ego.size(), 90001u);
  ASSERT_EQ(traffic.size(), 9001u);

  double fastest = 0.0, hardest = 0.0;
  for (std::size_t k = 0; k < traffic.size(); ++k) {
    const auto all = AllBoxes(wreck[10 * k], ego[10 * k], traffic[k]);
    for (std::size_t i = 0; i < all.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j)
        ASSERT_FALSE(Touch(all[i], all[j])) << i << " and " << j << " at step " << 10 * k;
    }
    ASSERT_NEAR(all[0].front_m, 700.0 + Double(wreck[0].front_m()), 0.1) << "the wreck stands";
    fastest = std::max(fastest, all[1].speed_mps);
    hardest = std::max(hardest, -Double(ego[10 * k].acceleration_w_mps2().x()));
  }
  EXPECT_GT(fastest, 15.0) << "the autopilot has driven";
  EXPECT_LT(hardest, 5.0) << "and saw what was coming";

  // At the end: the wreck, behind it the queue, all at rest, each behind the one before it.
  std::vector<Box> queue;
  for (const Box& box : AllBoxes(wreck.back(), ego.back(), traffic.back())) {
    if (box.in_lane() && box.front_m <= 700.0 + Double(wreck[0].front_m()) + 0.1) queue.push_back(box);
  }
  std::ranges::sort(queue, std::greater<>(), &Box::front_m);
  const Box autopilot = BoxOf(ego.back());
  std::optional<std::size_t> place;
  for (std::size_t i = 0; i < queue.size(); ++i) {
    if (queue[i].front_m == autopilot.front_m) place = i;
  }
  ASSERT_TRUE(place.has_value());
  ASSERT_GE(*place, 2u) << "cars of traffic stand between the wreck and the autopilot";
  for (std::size_t i = 1; i <= *place; ++i) {
    const double gap = queue[i - 1].rear_m - queue[i].front_m;
    EXPECT_LT(std::fabs(queue[i].speed_mps), 0.05) << i;
    EXPECT_GT(gap, 1.0) << i;
    // IDM's minimum gap is 2 m and more where it stops earlier; behind a driver's car it keeps room to pass it.
    EXPECT_LT(gap, i == 1 ? kRoomToPass_m : kStandingGap_m) << i;
  }
  ASSERT_GT(queue.size(), *place + 1) << "and followers have come behind it";
  const Box& follower = queue[*place + 1];
  EXPECT_LT(follower.speed_mps, 0.05);
  EXPECT_GT(autopilot.rear_m - follower.front_m, 1.0);
  EXPECT_LT(autopilot.rear_m - follower.front_m, kRoomToPass_m);
}

}  // namespace
}  // namespace rodeira::system_test
