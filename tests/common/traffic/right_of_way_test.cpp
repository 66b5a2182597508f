// SPDX-License-Identifier: Apache-2.0
// Two cars that would meet: the one with the right of way drives as if it were alone, the other one waits. In
// right-hand and in left-hand traffic.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <string>

#include "common/core/base/random.hpp"
#include "common/traffic/traffic_model.hpp"
#include "tests/common/traffic/identical.hpp"
#include "tests/common/traffic/restored.hpp"
#include "tests/common/world/lanes/mirrored.hpp"

namespace rodeira::traffic {
namespace {

constexpr std::uint64_t kDrawLink = 103;  // of the draws at branches
constexpr double kStep_s = 0.02, kNever_s = 1e9;

// How a vehicle comes: its front so far before the end of its lane, and which way it takes there.
struct Comes {
  std::uint32_t track = 0;
  std::size_t way = 0;
  double before_m = 60.0;
  double speed_mps = 10.0;
};

struct Came {
  double enters_s = kNever_s;  // its front comes to where the two ways meet
  double slowest_mps = 1e9;    // before that
};

// Where a way meets the other one.
struct Meets {
  std::uint32_t track = 0;
  double in_m = 0.0;
};

class Meeting : public testing::TestWithParam<bool> {
 protected:
  void Draw(lanes::Drawn&& drawn) {
    network_ = GetParam() ? drawn.Mirror().Read() : drawn.Read();
    model_ = std::make_unique<TrafficModel>(TrafficModel::Make(settings_, network_, {}).value());
  }
  const lanes::Graph& graph() const { return model_->graph(); }
  static double Up() { return GetParam() ? -1.0 : 1.0; }

  // The lane by which the cars of an arm come, as it lies in right-hand traffic: 0 from the east, 1 from the north, 2
  // from the west, 3 from the south.
  std::uint32_t Arm(int arm) const {
    const double angle = 0.5 * std::numbers::pi * arm;
    for (std::uint32_t track = 0; track < graph().tracks().size(); ++track) {
      const Eigen::Vector2d from = graph()[track].curve.At(0.0).p_W.head<2>();
      if (graph()[track].entry && from.normalized().dot(Eigen::Vector2d(std::cos(angle), Up() * std::sin(angle))) > 0.9)
        return track;
    }
    ADD_FAILURE() << "no arm " << arm;
    return 0;
  }
  // Which of a lane's ways turns so: 1 to the left, 0 straight on, -1 to the right, as it lies in right-hand traffic.
  std::size_t Way(std::uint32_t track, int turn) const {
    for (std::size_t i = 0; i < graph()[track].next.size(); ++i) {
      const auto& nodes = graph()[graph()[track].next[i].to].curve.nodes();
      const Eigen::Vector2d from = nodes.front().along_W.head<2>(), to = nodes.back().along_W.head<2>();
      if (std::lround(Up() * (from.x() * to.y() - from.y() * to.x())) == turn) return i;
    }
    ADD_FAILURE() << "no way " << turn;
    return 0;
  }

  std::uint32_t TripFor(std::uint32_t id, const Comes& comes) const {
    const std::size_t ways = graph()[comes.track].next.size();
    for (std::uint32_t trip = 0;; ++trip) {
      if (static_cast<std::size_t>(static_cast<double>(ways) *
                                   base::RandomUniform({settings_.seed, id, kDrawLink, trip, 0})) == comes.way)
        return trip;
    }
  }

  std::array<Meets, 2> WhereTheyMeet(const Comes& a, const Comes& b) const {
    for (const std::uint32_t one : {a.track, graph()[a.track].next[a.way].to}) {
      for (const std::uint32_t other : {b.track, graph()[b.track].next[b.way].to}) {
        for (const lanes::Zone& zone : model_->zones().zones()) {
          if (zone.kind == lanes::ZoneKind::kDiverge) continue;
          if (zone.track[0] == one && zone.track[1] == other)
            return {Meets{one, zone.in_m[0]}, Meets{other, zone.in_m[1]}};
          if (zone.track[1] == one && zone.track[0] == other)
            return {Meets{one, zone.in_m[1]}, Meets{other, zone.in_m[0]}};
        }
      }
    }
    ADD_FAILURE() << "they do not meet";
    return {};
  }

  std::array<Came, 2> Run(const std::array<std::optional<Comes>, 2>& both, const std::array<Meets, 2>& meets) {
    std::array<Agent, 2> agents;
    std::array<std::uint32_t, 2> trips{};
    for (std::uint32_t id = 0; id < 2; ++id) {
      Agent& agent = agents[id];
      if (both[id]) {
        agent.on_road = true;
        agent.trip = trips[id] = TripFor(id, *both[id]);
        agent.speed_mps = both[id]->speed_mps;
        agent.o_m = graph()[both[id]->track].length_m() - both[id]->before_m - 0.5 * model_->traits(id).length_m;
        agent.path = {{both[id]->track, 0.0, 0.0, 0.0, 0.0, 1.0}};
      }
    }
    RestoreWith(*model_, agents);
    std::array<Came, 2> came;
    for (int i = 1; i * kStep_s < 60.0; ++i) {
      model_->Step(kStep_s, {});
      for (const AgentPose& pose : model_->poses()) {
        const Agent& agent = model_->agent(pose.id);
        if (!both[pose.id] || agent.trip != trips[pose.id] || came[pose.id].enters_s < kNever_s) continue;
        came[pose.id].slowest_mps = std::min(came[pose.id].slowest_mps, pose.speed_mps);
        for (const Piece& piece : agent.path) {
          if (piece.track == meets[pose.id].track &&
              agent.o_m + 0.5 * model_->traits(pose.id).length_m - piece.zero_m > meets[pose.id].in_m)
            came[pose.id].enters_s = i * kStep_s;
        }
      }
      const auto& poses = model_->poses();
      const bool touch = poses.size() == 2 && driver::Overlap(FootprintOf(poses[0], model_->traits(0)),
                                                              FootprintOf(poses[1], model_->traits(1)));
      EXPECT_FALSE(touch) << i * kStep_s;
    }
    return came;
  }

  // As they are numbered, and the other way round.
  void GoesFirst(const Comes& first, const Comes& yields, const std::string& told) {
    for (const bool swapped : {false, true}) {
      const std::size_t a = swapped ? 1 : 0, b = 1 - a;
      std::array<std::optional<Comes>, 2> both, alone;
      both[a] = first, both[b] = yields, alone[a] = first;
      const auto meets = WhereTheyMeet(*both[0], *both[1]);
      const auto together = Run(both, meets), alone_first = Run(alone, meets);
      alone[a].reset(), alone[b] = yields;
      const auto alone_yields = Run(alone, meets);
      EXPECT_NEAR(together[a].enters_s, alone_first[a].enters_s, 0.05) << told;
      EXPECT_LT(together[b].enters_s, kNever_s) << told;
      EXPECT_GT(together[b].enters_s, together[a].enters_s) << told;
      EXPECT_GT(together[b].enters_s, alone_yields[b].enters_s + 0.3) << told;
      yielded_ = together[b];
    }
  }

  const TrafficSettings settings_ = Identical(2, 1.4);
  std::shared_ptr<const network::Network> network_;
  std::unique_ptr<TrafficModel> model_;
  Came yielded_;  // how the one that yielded came
};

TEST_P(Meeting, RightBeforeLeft) {
  Draw(lanes::Drawn(lanes::MapText("lights", false)));
  for (int arm = 0; arm < 4; ++arm) {
    const std::uint32_t mine = Arm(arm), right = Arm((arm + 1) % 4);
    GoesFirst({right, Way(right, 0)}, {mine, Way(mine, 0)}, "arm " + std::to_string(arm));
  }
}

TEST_P(Meeting, ATurnAcrossOncomingTrafficYields) {
  Draw(lanes::Drawn(lanes::MapText("lights", false)));
  for (int arm = 0; arm < 4; ++arm) {
    const std::uint32_t mine = Arm(arm), opposite = Arm((arm + 2) % 4);
    GoesFirst({opposite, Way(opposite, 0), 80.0}, {mine, Way(mine, 1)}, "arm " + std::to_string(arm));
  }
}

TEST_P(Meeting, AGiveWaySignYieldsToTheLeftToo) {
  for (int arm = 0; arm < 4; ++arm) {
    lanes::Drawn drawn(lanes::MapText("lights", false));
    Draw(std::move(drawn.Sign(std::to_string(2 * ((arm + 1) % 4) + 1), "205")));
    const std::uint32_t mine = Arm(arm), right = Arm((arm + 1) % 4);
    GoesFirst({mine, Way(mine, 0)}, {right, Way(right, 0)}, "arm " + std::to_string(arm));
  }
}

TEST_P(Meeting, ACarAtAStopSignComesToRestAndYields) {
  for (int arm = 0; arm < 4; ++arm) {
    lanes::Drawn drawn(lanes::MapText("lights", false));
    Draw(std::move(drawn.Sign(std::to_string(2 * ((arm + 1) % 4) + 1), "206")));
    const std::uint32_t mine = Arm(arm), right = Arm((arm + 1) % 4);
    const Comes stops{right, Way(right, 0)};
    // The other one is there soon after the one with the STOP could be.
    Comes goes{mine, Way(mine, 0)};
    const auto meets = WhereTheyMeet(goes, stops);
    const auto alone = Run({std::nullopt, stops}, meets)[1];
    EXPECT_LT(alone.slowest_mps, 0.06);
    while (Run({goes, std::nullopt}, meets)[0].enters_s < alone.enters_s + 0.5) goes.before_m += 5.0;
    GoesFirst(goes, stops, "arm " + std::to_string(arm));
    EXPECT_LT(yielded_.slowest_mps, 0.06);
  }
}

TEST_P(Meeting, ARingHasPriorityOverEntries) {
  constexpr double kRing_m = 16.0;
  Draw(lanes::Drawn(lanes::MapText("roundabout", true, traffic_map::Junctions::kDirect)));
  const auto on_ring = [&](std::uint32_t track) {
    return std::fabs(graph()[track].curve.At(0.5 * graph()[track].length_m()).p_W.head<2>().norm() - kRing_m) < 0.5;
  };
  int met = 0;
  for (std::uint32_t into = 0; into < graph().tracks().size(); ++into) {
    std::optional<std::uint32_t> ring, entry;
    for (const std::uint32_t before : graph()[into].before) (on_ring(before) ? ring : entry) = before;
    if (!on_ring(into) || !ring || !entry) continue;
    const auto way = [&](std::uint32_t track) {
      for (std::size_t i = 0; i < graph()[track].next.size(); ++i) {
        if (graph()[track].next[i].to == into) return i;
      }
      return std::size_t{0};
    };
    ++met;
    // On the ring all of its last lane before the entry lies before it; the other one would be at its end at the same
    // time.
    const double ring_m = graph()[*ring].length_m() - model_->traits(0).length_m - 0.1;
    GoesFirst(
        {*ring, way(*ring), ring_m, 6.0},
        {*entry, way(*entry), std::min(ring_m, graph()[*entry].length_m() - model_->traits(0).length_m - 0.1), 6.0},
        "into track " + std::to_string(into));
  }
  EXPECT_EQ(met, 4);
}

INSTANTIATE_TEST_SUITE_P(Hands, Meeting, testing::Bool(),
                         [](const auto& which) { return which.param ? "LeftHand" : "RightHand"; });

}  // namespace
}  // namespace rodeira::traffic
