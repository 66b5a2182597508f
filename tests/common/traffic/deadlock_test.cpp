// SPDX-License-Identifier: Apache-2.0
// Three at a crossing of which each keeps the next one out: one that turns right waits for room at its exit, another
// one wants to go straight on behind it, and a third one comes across to the same exit.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <set>
#include <vector>

#include "common/core/base/random.hpp"
#include "common/traffic/traffic_model.hpp"
#include "tests/common/traffic/restored.hpp"
#include "tests/common/world/lanes/closed_grid.hpp"

namespace rodeira::traffic {
namespace {

constexpr std::uint64_t kDrawLink = 103;  // of the draws at branches
constexpr double kStep_s = 0.05, kStreet_m = 50.0, kLine_m = 0.6, kAtLine_m = 0.01, kStands_m = 2.0;

struct Way {
  std::uint32_t from = 0, track = 0, to = 0;  // street, within the crossing, street
  std::size_t choice = 0;
};

class Deadlock : public testing::Test {
 protected:
  static constexpr std::uint32_t kCars = 40;  // of which four are on the road

  Deadlock() {
    settings_.vehicles = kCars;
    network_ = lanes::ClosedGrid::Make(3);
    model_ = std::make_unique<TrafficModel>(TrafficModel::Make(settings_, network_, {}).value());
    for (std::uint32_t street = 0; street < graph().tracks().size() && !nearly_clear_; ++street) {
      if (graph()[street].length_m() < kStreet_m || graph()[street].next.size() != 3) continue;
      const auto right = Turning(street, -1), straight = Turning(street, 0);
      if (!right || !straight) continue;
      right_ = *right, straight_ = *straight;
      nearly_clear_ = NearlyClear();
    }
    for (std::uint32_t other = 0; other < graph().tracks().size(); ++other) {
      if (graph()[other].length_m() < kStreet_m) continue;
      if (const auto way = Turning(other, 0); way && way->to == right_.to) across_ = *way;
    }
  }

  const lanes::Graph& graph() const { return model_->graph(); }
  double Length(std::uint32_t id) const { return model_->traits(id).length_m; }

  std::optional<Way> Turning(std::uint32_t street, int turn) const {
    for (std::size_t i = 0; i < graph()[street].next.size(); ++i) {
      const std::uint32_t track = graph()[street].next[i].to;
      const auto& nodes = graph()[track].curve.nodes();
      const Eigen::Vector2d from = nodes.front().along_W.head<2>(), to = nodes.back().along_W.head<2>();
      if (std::lround(from.x() * to.y() - from.y() * to.x()) == turn)
        return Way{street, track, graph()[track].next.front().to, i};
    }
    return std::nullopt;
  }

  // Where the zone of two tracks begins or ends on the first of them.
  double ZoneOf(std::uint32_t track, std::uint32_t other, lanes::ZoneKind kind, bool begins) const {
    for (const lanes::Zone& zone : model_->zones().zones()) {
      for (const std::size_t side : {0u, 1u}) {
        if (zone.kind == kind && zone.track[side] == track && zone.track[1 - side] == other)
          return begins ? zone.in_m[side] : zone.out_m[side];
      }
    }
    ADD_FAILURE() << "no zone";
    return 0.0;
  }
  // Where one that turns right stands at its line, in its way within the crossing.
  double RightLine() const { return FirstZone(right_.track) - kLine_m; }

  std::uint32_t TripFor(std::uint32_t id, const Way& way) const {
    const std::size_t ways = graph()[way.from].next.size();
    for (std::uint32_t trip = 0;; ++trip) {
      if (static_cast<std::size_t>(static_cast<double>(ways) *
                                   base::RandomUniform({settings_.seed, id, kDrawLink, trip, 0})) == way.choice)
        return trip;
    }
  }

  // With its front so far on a track; beyond a street's end on the way that it takes there.
  void Put(std::uint32_t id, std::uint32_t track, double front_m, double speed_mps = 0.0, const Way* way = nullptr) {
    Agent& agent = agents_[id];
    agent.on_road = true;
    agent.speed_mps = speed_mps;
    agent.o_m = front_m - 0.5 * Length(id);
    agent.path = {{track, 0.0, 0.0, 0.0, 0.0, 1.0}};
    if (way == nullptr) return;
    agent.trip = TripFor(id, *way);
    const double end = graph()[track].length_m();
    if (front_m > end) agent.path.push_back({way->track, end, end, 0.0, 0.0, 1.0}), agent.links = 1;
  }

  // One with a rear that, a centimetre before its line, is clear of one that goes straight on but for less than a
  // centimetre.
  std::optional<std::uint32_t> NearlyClear() const {
    const double clear = ZoneOf(right_.track, straight_.track, lanes::ZoneKind::kDiverge, false);
    for (std::uint32_t id = 0; id < kCars; ++id) {
      const double rear = RightLine() - kAtLine_m - Length(id);
      if (rear < clear && rear + kAtLine_m > clear) return id;
    }
    return std::nullopt;
  }

  // The end of the last zone of a way within the crossing.
  double LastZone(std::uint32_t track) const {
    double last = 0.0;
    for (const lanes::ZoneSide& part : model_->zones().ConflictsOf(track)) last = std::max(last, part.out_m);
    return last;
  }
  double FirstZone(std::uint32_t track) const {
    double first = 1e9;
    for (const lanes::ZoneSide& part : model_->zones().ConflictsOf(track)) first = std::min(first, part.in_m);
    return first;
  }

  // Each of them comes to a street beyond the crossing within a minute after the one that blocks the exit drives on,
  // and none touches another.
  void AllGoOn(const std::vector<std::uint32_t>& cars, std::uint32_t blocks, double blocks_until_s) {
    std::set<std::uint32_t> through;
    for (int i = 1; i * kStep_s < blocks_until_s + 60.0; ++i) {
      if (blocks < kCars && std::fabs(i * kStep_s - blocks_until_s) < 0.5 * kStep_s) model_->Release(blocks);
      model_->Step(kStep_s, {});
      const auto& poses = model_->poses();
      for (const AgentPose& a : poses) {
        for (const AgentPose& b : poses) {
          const bool touch = a.id < b.id && driver::Overlap(FootprintOf(a, model_->traits(a.id)),
                                                            FootprintOf(b, model_->traits(b.id)));
          ASSERT_FALSE(touch) << a.id << " and " << b.id << " at " << i * kStep_s;
        }
      }
      for (const std::uint32_t id : cars) {
        const std::uint32_t on = PieceAt(model_->agent(id).path, model_->agent(id).o_m).track;
        if (on == right_.to || on == straight_.to) through.insert(id);
      }
    }
    for (const std::uint32_t id : cars)
      EXPECT_TRUE(through.contains(id)) << id << ", free after " << blocks_until_s << " s";
  }

  TrafficSettings settings_;
  std::shared_ptr<const network::Network> network_;
  std::unique_ptr<TrafficModel> model_;
  std::vector<Agent> agents_ = std::vector<Agent>(kCars);
  Way right_, straight_, across_;
  std::optional<std::uint32_t> nearly_clear_;
};

// No car gets a reservation behind one at a line with its rear in the way, be it by a centimetre that it would still
// have to its line.
TEST_F(Deadlock, NoVehicleIsAdmittedBehindOneThatBlocksItByACentimetre) {
  ASSERT_TRUE(nearly_clear_);
  const std::uint32_t right = *nearly_clear_;
  const std::uint32_t behind = (right + 1) % kCars, blocks = (right + 2) % kCars;
  const double street = graph()[straight_.from].length_m();
  Put(right, right_.track, RightLine() - kAtLine_m);
  Put(behind, straight_.from, street - 20.0, 5.0, &straight_);
  Put(blocks, right_.to, Length(blocks) + 2.0);
  agents_[blocks].brake_mps2 = 2.0;  // the exit is full
  RestoreWith(*model_, agents_);
  for (int i = 1; i * kStep_s < 30.0; ++i) {
    model_->Step(kStep_s, {});
    ASSERT_TRUE(model_->agent(behind).grants.empty()) << i * kStep_s;
  }
  const double front = model_->agent(behind).o_m + 0.5 * Length(behind);
  EXPECT_LT(front, street + FirstZone(straight_.track));
  EXPECT_GT(front, street - 5.0);
}

// As it came about: the exit is full; the one behind comes; the third one has waited longest and goes first when there
// is room. All get through.
TEST_F(Deadlock, ThreeThatWaitForRoomAllGoOn) {
  ASSERT_TRUE(nearly_clear_);
  const std::uint32_t right = *nearly_clear_;
  const std::uint32_t behind = (right + 1) % kCars, blocks = (right + 2) % kCars, across = (right + 3) % kCars;
  Put(right, right_.track, RightLine() - kAtLine_m);
  agents_[right].waited_s = 5.0;
  Put(behind, straight_.from, graph()[straight_.from].length_m() - 20.0, 5.0, &straight_);
  Put(across, across_.from, graph()[across_.from].length_m() + FirstZone(across_.track) - kLine_m - kAtLine_m, 0.0,
      &across_);
  agents_[across].waited_s = 52.0;
  Put(blocks, right_.to, Length(blocks) + 2.0);
  agents_[blocks].brake_mps2 = 2.0;
  for (double until_s = 0.5; until_s < 12.0; until_s += 0.5) {
    RestoreWith(*model_, agents_);
    AllGoOn({right, behind, across}, blocks, until_s);
  }
}

// One that is behind has been let in although it cannot go, and the third one after it, which waits for it: the chain
// is closed, and it gives back what it has not come into.
TEST_F(Deadlock, AReservationThatCannotBeUsedIsRevokedWhereTheCycleCloses) {
  ASSERT_TRUE(nearly_clear_);
  const std::uint32_t right = *nearly_clear_, behind = (right + 1) % kCars, across = (right + 2) % kCars;
  const double street = graph()[straight_.from].length_m(), rear = RightLine() - kAtLine_m - Length(right);
  ASSERT_LT(rear, ZoneOf(right_.track, straight_.track, lanes::ZoneKind::kDiverge, false));
  Put(right, right_.track, RightLine() - kAtLine_m);
  Put(behind, straight_.from, street + rear - kStands_m, 0.0, &straight_);
  Put(across, across_.track,
      ZoneOf(across_.track, straight_.track, lanes::ZoneKind::kCross, true) - kLine_m - kAtLine_m);
  agents_[behind].granted_m = street + LastZone(straight_.track);
  agents_[behind].grants = {{agents_[behind].granted_m, 1, true}};
  agents_[across].granted_m = LastZone(across_.track);
  agents_[across].grants = {{agents_[across].granted_m, 2, true}};
  RestoreWith(*model_, agents_, 3);
  AllGoOn({right, behind, across}, kCars, 0.0);
}

}  // namespace
}  // namespace rodeira::traffic
