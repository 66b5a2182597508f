// SPDX-License-Identifier: Apache-2.0
// How far it is to the leader, which vehicles touch and which looks cross: each against a search through all pairs.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "common/core/base/random.hpp"
#include "common/traffic/motors/motors_driver.hpp"
#include "common/traffic/motors/motors_looks.hpp"
#include "common/traffic/network/road_network.hpp"
#include "common/traffic/results/study.hpp"
#include "common/world/road/world.hpp"
#include "tests/common/traffic/restored.hpp"
#include "tests/common/world/lanes/closed_grid.hpp"
#include "tests/common/world/lanes/lane_networks.hpp"
#include "tests/tree.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kStep_s = 0.05, kSame_m = 1e-6, kNoLeader_m = 1e9, kLookedAt_m = 200.0;

// A track on a vehicle's way, in its odometer.
struct Part {
  std::uint32_t track = 0;
  double zero_m = 0.0, begin_m = 0.0;
};

// A vehicle at one moment.
struct Car {
  std::uint32_t id = 0, trip = 0;
  double o_m = 0.0, half_m = 0.0, speed_mps = 0.0;
  bool changing = false;
  driver::IdmSettings idm;

  double front_m() const { return o_m + half_m; }
  double rear_m() const { return o_m - half_m; }
};

// A whole drive: every moment, what was said of it, and each car's way as it turned out to be. Where a vehicle goes on
// is so not asked of the model, but read from where it was seen to go later.
class Drive {
 public:
  struct Instant {
    std::vector<Car> cars;
    std::map<std::uint32_t, double> said;  // by those that drive on: the gap before them
  };

  Drive(TrafficModel& model, int steps) : model_(model), diverging_(model.graph().tracks().size()) {
    for (const lanes::Zone& zone : model.zones().zones()) {
      if (zone.kind == lanes::ZoneKind::kDiverge)
        diverging_[zone.track[0]].push_back({&zone, 0}), diverging_[zone.track[1]].push_back({&zone, 1});
    }
    for (int i = 0; i < steps; ++i) {
      Instant moment;
      for (const AgentPose& pose : model.poses()) {
        const Agent& agent = model.agent(pose.id);
        moment.cars.push_back({pose.id, pose.trip, agent.o_m, 0.5 * model.traits(pose.id).length_m, pose.speed_mps,
                               agent.change.side != 0, model.traits(pose.id).idm});
        auto& way = ways_[{pose.id, pose.trip}];
        for (const Piece& piece : agent.path) {
          if (way.empty() || piece.begin_m > way.back().begin_m)
            way.push_back({piece.track, piece.zero_m, piece.begin_m});
        }
      }
      model.Step(kStep_s, {});
      for (Car& car : moment.cars) {
        const Agent& agent = model.agent(car.id);
        if (!agent.on_road || agent.trip != car.trip) continue;
        moment.said[car.id] = model.GapAhead(car.id);
        car.changing = car.changing || agent.change.side != 0;  // begun in this step: seen by some and not by others
      }
      moments_.push_back(std::move(moment));
    }
  }

  const std::vector<Instant>& moments() const { return moments_; }
  const lanes::Graph& graph() const { return model_.graph(); }
  // The zones in which other tracks part from one, and which of their sides that one is.
  struct Diverging {
    const lanes::Zone* zone;
    std::size_t side;
  };
  const std::vector<Diverging>& DivergingFrom(std::uint32_t track) const { return diverging_[track]; }
  const std::vector<Part>& WayOf(const Car& car) const { return ways_.at({car.id, car.trip}); }
  double EndOf(const Part& part) const { return part.zero_m + graph()[part.track].length_m(); }
  // Up to where the part is driven: where the next one begins.
  double LeftAt(const std::vector<Part>& way, std::size_t i) const {
    return i + 1 < way.size() ? way[i + 1].begin_m : EndOf(way[i]);
  }

 private:
  TrafficModel& model_;
  std::vector<std::vector<Diverging>> diverging_;
  std::vector<Instant> moments_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<Part>> ways_;
};

struct Found {
  double gap_m = kNoLeader_m, speed_mps = 0.0;
  std::int64_t id = -1;
};

// What a full search says of one car. `unsure`: a vehicle changes lanes near by, or the way is not known so
// far.
struct Verdict {
  Found ahead;
  std::vector<double> others_m;  // what else it could mean: one ahead on its way, and one that parts from it
  double known_m = kNoLeader_m;  // of its way before its front
  bool unsure = false;
};

// The parts of a way on which a car's rectangle stands; tell(part, from): `from` is the track by which it came there,
// or -1.
template <class Tell>
void EachUnder(const Drive& drive, const Car& car, const Tell& tell) {
  const auto& way = drive.WayOf(car);
  for (std::size_t i = 0; i < way.size(); ++i) {
    if (way[i].begin_m < car.front_m() && drive.LeftAt(way, i) > car.rear_m())
      tell(way[i], i > 0 ? static_cast<std::int64_t>(way[i - 1].track) : -1);
  }
}

Verdict LeaderOf(const Drive& drive, const Drive::Instant& moment, const Car& me) {
  Verdict verdict;
  std::vector<std::pair<double, Found>> partings;  // with where the lane of the way begins that they part from
  const auto& way = drive.WayOf(me);
  // A change of lanes later on is not known to one that drives now: it looks along its lane, which is its only way on.
  std::vector<Part> looked;
  for (const Part& part : way) {
    if (!looked.empty() && part.begin_m < drive.EndOf(looked.back()) - kSame_m && part.begin_m > me.front_m()) break;
    looked.push_back(part);
  }
  while (drive.EndOf(looked.back()) < me.front_m() + kLookedAt_m &&
         drive.graph()[looked.back().track].next.size() == 1) {
    const lanes::Link& on = drive.graph()[looked.back().track].next.front();
    const double end = drive.EndOf(looked.back());
    looked.push_back({on.to, end - on.from_d_m, end});
  }
  if (!drive.graph()[looked.back().track].next.empty()) verdict.known_m = drive.EndOf(looked.back()) - me.front_m();
  std::vector<double> changing;  // how far ahead a vehicle changes lanes on this way or beside it
  for (std::size_t i = 0; i < looked.size(); ++i) {
    const Part& mine = looked[i];
    const double left = i + 1 < looked.size() ? looked[i + 1].begin_m : drive.EndOf(mine);
    if (left < me.o_m) continue;
    const std::int64_t before = i > 0 ? static_cast<std::int64_t>(looked[i - 1].track) : -1;
    for (const Car& other : moment.cars) {
      if (other.id == me.id) continue;
      EachUnder(drive, other, [&](const Part& theirs, std::int64_t from) {
        const lanes::Track& track = drive.graph()[mine.track];
        const double shift =
            mine.zero_m - theirs.zero_m;  // from their odometer to mine, where the two tracks lie beside each other
        if (other.changing && (theirs.track == mine.track || track.left == theirs.track || track.right == theirs.track))
          changing.push_back(shift + other.rear_m() - me.front_m());
        if (shift + other.o_m <= me.o_m) return;
        if (theirs.track == mine.track) {
          double rear = shift + other.rear_m();
          if (before >= 0 && from >= 0 && from != before) rear = std::max(rear, mine.begin_m);  // comes in from beside
          if (rear - me.front_m() < verdict.ahead.gap_m)
            verdict.ahead = {rear - me.front_m(), other.speed_mps, other.id};
          return;
        }
        // On a track that parts from this one, not clear of it yet.
        for (const auto& [zone, side] : drive.DivergingFrom(mine.track)) {
          if (zone->track[1 - side] != theirs.track || me.rear_m() > mine.zero_m + zone->out_m[side]) continue;
          if (other.rear_m() - theirs.zero_m >= zone->out_m[1 - side] ||
              other.front_m() - theirs.zero_m <= zone->in_m[1 - side])
            continue;
          const double gap = shift + other.rear_m() - me.front_m();
          partings.push_back({mine.begin_m - me.front_m(), {gap, other.speed_mps, other.id}});
        }
      });
    }
  }
  const auto lets = [&](const Found& found) {
    return driver::IdmAcceleration(me.idm, me.speed_mps, 1e3, found.gap_m, found.speed_mps);
  };
  Found parting;
  verdict.others_m.push_back(verdict.ahead.gap_m);
  for (const auto& [begins_m, found] : partings) verdict.others_m.push_back(found.gap_m);
  for (const auto& [begins_m, found] : partings) {  // beyond the leader none is looked for
    if (begins_m <= verdict.ahead.gap_m + 10.0 && (parting.id < 0 || lets(found) < lets(parting))) parting = found;
  }
  if (parting.id >= 0 && (verdict.ahead.id < 0 || lets(parting) < lets(verdict.ahead))) verdict.ahead = parting;
  for (const double gap : changing)
    verdict.unsure = verdict.unsure || (gap < verdict.ahead.gap_m + 20.0 && gap > -60.0);
  return verdict;
}

// How far the model looks at least.
double Sight_m(double speed_mps) { return std::min(kLookedAt_m, speed_mps * speed_mps / 3.0 + 3.0 * speed_mps + 60.0); }

struct Compared {
  int ahead = 0, without_leader = 0, another = 0,
      unsure = 0;  // another: not the one that lets it drive on least, but one of them
};

Compared Compare(const std::string& name, TrafficModel& model) {
  constexpr int kSteps = 1300, kFrom = 100, kTo = 700, kEvery = 2;  // the last 30 s only tell which ways were gone
  const Drive drive(model, kSteps);
  Compared compared;
  for (int i = kFrom; i < kTo; i += kEvery) {
    const Drive::Instant& moment = drive.moments()[static_cast<std::size_t>(i)];
    for (const Car& me : moment.cars) {
      const auto said = moment.said.find(me.id);
      if (said == moment.said.end() || me.changing) continue;
      const auto told = [&] { return fmt::format("{}: car {} after {:.2f} s", name, me.id, kStep_s * i); };
      const Verdict verdict = LeaderOf(drive, moment, me);
      const double range_m = std::min(Sight_m(me.speed_mps), verdict.known_m);
      const auto is_said = [&](double gap_m) { return std::fabs(said->second - gap_m) < kSame_m; };
      if (verdict.unsure)
        ++compared.unsure;
      else if (verdict.ahead.gap_m <= range_m && is_said(verdict.ahead.gap_m))
        ++compared.ahead;
      else if (verdict.ahead.gap_m > range_m && said->second > range_m - kSame_m)
        ++compared.without_leader;
      else if (std::any_of(verdict.others_m.begin(), verdict.others_m.end(), is_said))
        ++compared.another;
      else
        ADD_FAILURE() << told() << ": " << said->second << " m to who is ahead; " << verdict.ahead.gap_m << " m to car "
                      << verdict.ahead.id << " was expected";
    }
  }
  return compared;
}

TEST(Neighbours, AreThoseThatAFullSearchFinds) {
  for (const char* name : {"crossing", "roundabout", "town", "ramp"}) {
    TrafficSettings settings;
    settings.vehicles = std::string(name) == "town" ? 60 : 30;
    settings.seed = 5;
    settings.changes_lanes = false;
    settings.overtaking.allowed = false;
    settings.mix.shares = {0.7, 0.1, 0.1, 0.1};
    TrafficModel model = TrafficModel::Make(settings, lanes::MapNetwork(name), {}).value();
    const Compared compared = Compare(name, model);
    EXPECT_EQ(compared.unsure, 0) << name;
    EXPECT_GT(compared.ahead, 1500) << name;
    EXPECT_GT(compared.without_leader, 200) << name;
    EXPECT_EQ(compared.another, 0) << name;
  }
}

TEST(Neighbours, OnTheMotorwayAreThoseThatAFullSearchFinds) {
  const auto world = road::World::Load(std::filesystem::path(SourceDir()) / "configs/worlds/motorway.yaml");
  ASSERT_TRUE(world.ok()) << world.error().Text();
  TrafficSettings settings;
  settings.vehicles = 120;
  settings.seed = 2;
  TrafficModel model = TrafficModel::Make(settings, NetworkOf(world.value()), {}).value();
  const Compared compared = Compare("motorway", model);
  EXPECT_GT(compared.ahead, 4000);
  EXPECT_LT(compared.unsure, compared.ahead / 2);
  EXPECT_EQ(compared.another, 0);
}

// Two turn off to different sides: one drives away, the other one stands a little farther on. One that goes straight on
// between them stops for the one that stands, all the time, and not in an emergency.
TEST(Neighbours, OfTwoThatTurnOffTheOneThatSlowsMostCounts) {
  constexpr std::uint32_t kMe = 0, kDrives = 1, kStands = 2;
  constexpr std::uint64_t kDrawLink = 103;  // of the draws at branches
  constexpr double kStreet_m = 50.0;
  TrafficSettings settings;
  settings.vehicles = 3;
  TrafficModel model = TrafficModel::Make(settings, lanes::ClosedGrid::Make(3), {}).value();
  const lanes::Graph& graph = model.graph();
  std::uint32_t street = 0;
  while (graph[street].length_m() < kStreet_m || graph[street].next.size() != 3) ++street;
  std::array<std::size_t, 3> way{};  // to the right, straight on, to the left
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& nodes = graph[graph[street].next[i].to].curve.nodes();
    const Eigen::Vector2d from = nodes.front().along_W.head<2>(), to = nodes.back().along_W.head<2>();
    way[static_cast<std::size_t>(1 + std::lround(from.x() * to.y() - from.y() * to.x()))] = i;
  }
  const auto track = [&](std::size_t turn) { return graph[street].next[way[turn]].to; };
  std::array<Agent, 3> agents;
  const auto put = [&](std::uint32_t id, std::uint32_t on, double rear_m, double speed_mps) {
    agents[id].on_road = true;
    agents[id].speed_mps = speed_mps;
    agents[id].o_m = rear_m + 0.5 * model.traits(id).length_m;
    agents[id].path = {{on, 0.0, 0.0, 0.0, 0.0, 1.0}};
    agents[id].granted_m = on == street ? graph[street].length_m() + graph[track(1)].length_m() : graph[on].length_m();
    agents[id].grants = {{agents[id].granted_m, id + 1, true}};
  };
  const double end = graph[street].length_m(), stands_m = 7.0,
               before_m = 20.0;  // in the way of one that goes straight on, and of no other
  put(kMe, street, end + stands_m - before_m - model.traits(kMe).length_m, 5.0);
  while (static_cast<std::size_t>(3.0 * base::RandomUniform({settings.seed, kMe, kDrawLink, agents[kMe].trip, 0})) !=
         way[1])
    ++agents[kMe].trip;
  put(kDrives, track(2), 0.5, 4.0);
  put(kStands, track(0), stands_m, 0.0);
  agents[kStands].brake_mps2 = 2.0;
  RestoreWith(model, agents, 4);
  for (int i = 0; i < 200; ++i) {
    const double gap = end + stands_m - model.agent(kMe).o_m - 0.5 * model.traits(kMe).length_m;
    model.Step(kStep_s, {});
    ASSERT_NEAR(model.GapAhead(kMe), gap, kSame_m) << kStep_s * i;
    ASSERT_FALSE(model.Hurries(kMe)) << kStep_s * i;
  }
  EXPECT_LT(model.agent(kMe).speed_mps, 0.05);
}

// The study looks at neighbours in cells alone. Vehicles of the source's driver model run into others.
TEST(Neighbours, EveryContactOfAStudyIsOneOfAllPairs) {
  StudySettings settings;
  settings.traffic.vehicles = 20;
  settings.traffic.seed = 4;
  settings.traffic.driver = DriverKind::kMotors;
  settings.traffic.physics = Physics::kFull;
  settings.duration_s = 40.0;
  std::set<std::pair<std::uint32_t, std::uint32_t>> touching;
  std::int64_t contacts = 0;
  const StudyResult result =
      RunStudy(settings, lanes::MapNetwork("crossing"), [&](const StudyMoment& moment) {
        std::set<std::pair<std::uint32_t, std::uint32_t>> now;
        for (const AgentPose& a : moment.model.poses()) {
          for (const AgentPose& b : moment.model.poses()) {
            if (a.id >= b.id || std::fabs(a.p_WB_W.z() - b.p_WB_W.z()) > network::Network::kLevel_m) continue;
            if (driver::Overlap(FootprintOf(a, moment.model.traits(a.id)), FootprintOf(b, moment.model.traits(b.id))))
              now.insert({a.id, b.id});
          }
        }
        for (const auto& pair : now) contacts += touching.contains(pair) ? 0 : 1;
        touching = std::move(now);
      }).value();
  EXPECT_GT(contacts, 3);
  EXPECT_EQ(result.collisions, contacts);
}

// Short and long looks in a small place, some of them along one line, upright, or of no length; on two levels.
TEST(Neighbours, EveryCrossingOfTwoLooksIsOneOfAllPairs) {
  std::mt19937_64 draws(7);
  std::size_t crossings = 0;
  for (int round = 0; round < 200; ++round) {
    const auto draw = [&](int range) {
      return static_cast<double>(draws() % static_cast<std::uint64_t>(2 * range + 1)) - range;
    };
    std::vector<MotorsLook> looks;
    for (std::uint32_t id = 0; id < 40; ++id) {
      const int reach = round % 2 == 0 ? 4 : 40;
      const Eigen::Vector2d from(draw(30), draw(30));
      looks.push_back({from, from + Eigen::Vector2d(draw(reach), draw(reach)), draws() % 2 == 0 ? 0.0 : 6.0, id});
    }
    std::multiset<std::pair<std::uint32_t, std::uint32_t>> all, told;
    for (const MotorsLook& a : looks) {
      for (const MotorsLook& b : looks) {
        if (a.id < b.id && a.z_m == b.z_m && SegmentsCross(a.from, a.to, b.from, b.to)) all.insert({a.id, b.id});
      }
    }
    EachCrossing(looks, [&](const MotorsLook& a, const MotorsLook& b) {
      told.insert({std::min(a.id, b.id), std::max(a.id, b.id)});
    });
    EXPECT_EQ(told, all) << round;
    crossings += all.size();
  }
  EXPECT_GT(crossings, 1000u);
}

}  // namespace
}  // namespace rodeira::traffic
