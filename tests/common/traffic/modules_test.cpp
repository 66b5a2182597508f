// SPDX-License-Identifier: Apache-2.0
// Modules of the traffic alone, on a small store made by hand: no model, no step.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "common/traffic/following/car_following.hpp"
#include "common/traffic/following/speed_limits.hpp"
#include "common/traffic/motion/paths.hpp"
#include "common/traffic/perception/neighbours.hpp"
#include "common/traffic/perception/seen.hpp"
#include "common/traffic/perception/ways.hpp"
#include "tests/common/traffic/identical.hpp"
#include "tests/common/traffic/ring.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kRing_m = 300.0;

// Two vehicles on a ring of one lane, at 40 m and at 100 m of the same track.
class TwoOnARing : public testing::Test {
 protected:
  TwoOnARing() : settings_(Identical(2, 1.4)), map_(Ring(kRing_m), settings_), agents_(2), seen_(2, tracks()) {
    for (std::uint32_t id = 0; id < 2; ++id) {
      traits_.push_back(TraitsOf(settings_, id));
      agents_[id].on_road = true;
      agents_[id].o_m = id == 0 ? 40.0 : 100.0;
      agents_[id].speed_mps = id == 0 ? 10.0 : 4.0;
      agents_[id].path = {{0, 0.0, 0.0, 0.0, 0.0, 1.0}};
    }
  }

  std::size_t tracks() const { return map_.graph.tracks().size(); }
  double Half(std::uint32_t id) const { return 0.5 * traits_[id].length_m; }

  void SeeBoth(double range_m) {
    Ways ways{{settings_, map_, agents_, traits_}, {seen_.stretches, seen_.way_keys, seen_.way_numbers}};
    for (std::uint32_t id = 0; id < 2; ++id) {
      ways.FindRouteSegments(id, range_m);
      seen_.occupants.Add(0, {id, -1, agents_[id].o_m - Half(id), agents_[id].o_m + Half(id)});
    }
    seen_.occupants.Sort();
  }
  Neighbours MakeNeighbours() const {
    return Neighbours({settings_, map_, agents_, traits_, longest_half_m_, seen_.stretches, seen_.occupants,
                       seen_.parts, seen_.blocks, seen_.any_block, seen_.any_overtaking});
  }
  SpeedLimits MakeLimits() const {
    return SpeedLimits({settings_, map_, agents_, traits_, seen_.stretches, seen_.below, known_});
  }

  TrafficSettings settings_;
  TrafficMap map_;
  std::vector<AgentTraits> traits_;
  std::vector<Agent> agents_;
  Seen seen_;
  double longest_half_m_ = 5.0;
  std::vector<std::array<PlannedAt, 2>> known_ = std::vector<std::array<PlannedAt, 2>>(2);
};

// From bumper to bumper: 60 m between the middles, less half of both lengths; round the ring the rest of it.
TEST_F(TwoOnARing, LeaderIsTheNextVehicleOnTheWay) {
  SeeBoth(kRing_m);
  const Neighbours neighbours = MakeNeighbours();
  const Leader before_first = neighbours.FindLeader(0), before_second = neighbours.FindLeader(1);
  ASSERT_TRUE(before_first.any);
  EXPECT_EQ(before_first.id, 1);
  EXPECT_NEAR(before_first.gap_m, 60.0 - Half(0) - Half(1), 1e-9);
  EXPECT_EQ(before_first.speed_mps, 4.0);
  ASSERT_TRUE(before_second.any);
  EXPECT_EQ(before_second.id, 0);
  EXPECT_NEAR(before_second.gap_m, map_.graph[0].length_m() - 60.0 - Half(0) - Half(1), 1e-9);
}

TEST_F(TwoOnARing, LeaderOutOfSightIsNone) {
  SeeBoth(10.0);
  seen_.occupants.Clear();
  EXPECT_FALSE(MakeNeighbours().FindLeader(0).any);
}

// The follower of a rectangle at 95 m, with its rear at 93 m, is the vehicle at 40 m.
TEST_F(TwoOnARing, FollowerIsTheNextVehicleBehind) {
  SeeBoth(kRing_m);
  const Follower follower = MakeNeighbours().FindFollower(7, 0, 95.0, 93.0);
  ASSERT_TRUE(follower.any);
  EXPECT_EQ(follower.id, 0);
  EXPECT_NEAR(follower.gap_m, 93.0 - 40.0 - Half(0), 1e-9);
}

// On a free road a (1 - (v/v0)^4) (Treiber, Hennecke, Helbing 2000), with the road's limit as v0.
TEST_F(TwoOnARing, FreeAccelerationIsThatOfTheIdm) {
  SeeBoth(kRing_m);
  const SpeedLimits limits = MakeLimits();
  const CarFollowing following({settings_, agents_, traits_, limits});
  EXPECT_EQ(limits.LimitOn(0, 50.0), kRingLimit_mps);
  EXPECT_NEAR(limits.Desired_mps(0), kRingLimit_mps, 1e-12);
  const double a = traits_[0].idm.acceleration_mps2;
  EXPECT_NEAR(following.Following(0, kRingLimit_mps, false, 0.0, 0.0), a * (1.0 - std::pow(10.0 / kRingLimit_mps, 4)),
              1e-9);
}

// Where the front bumper passes the end of the track, the path goes on with the next one; a piece that lies more than a
// metre behind the rear bumper is forgotten.
TEST_F(TwoOnARing, PathGrowsAtTheFrontAndIsForgottenBehind) {
  Paths paths{{settings_, map_, traits_, seen_.below}, {agents_}};
  const double end = map_.graph[0].length_m();
  EXPECT_EQ(paths.Follow(0), 0u);
  EXPECT_EQ(agents_[0].path.size(), 1u);
  agents_[0].o_m = end - Half(0) + 0.1;
  EXPECT_EQ(paths.Follow(0), 0u);
  ASSERT_EQ(agents_[0].path.size(), 2u);
  EXPECT_NEAR(agents_[0].path[1].begin_m, end, 1e-9);
  EXPECT_EQ(agents_[0].links, 1u);
  agents_[0].o_m = end + Half(0) + 1.5;
  (void)paths.Follow(0);
  EXPECT_EQ(agents_[0].path.size(), 1u);
  EXPECT_FALSE(paths.AtTheEnd(0));
}

}  // namespace
}  // namespace rodeira::traffic
