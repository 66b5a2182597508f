// SPDX-License-Identifier: Apache-2.0
// Statistics of lanes: Edie's identity, what is conserved, steady flow in closed form, fuel.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>

#include "common/traffic/motion/car_of.hpp"
#include "common/traffic/motion/drivetrain.hpp"
#include "common/traffic/results/study.hpp"
#include "tests/common/traffic/identical.hpp"
#include "tests/common/traffic/ring.hpp"
#include "tests/common/world/lanes/lane_networks.hpp"

namespace rodeira::traffic {
namespace {

// Planar cars of all kinds: what the tank has lost on a trip is the integral of the flow of engines that turn as is
// told, to 1e-9; none in overrun, which there is, and some wherever the throttle is open.
TEST(PlanarFuel, IsTheIntegralOfItsFlowAndNoneInOverrun) {
  TrafficSettings settings;
  settings.vehicles = 30;
  settings.mix.shares = {0.6, 0.1, 0.2, 0.1};
  TrafficModel model = TrafficModel::Make(settings, lanes::MapNetwork("overpass"), {}).value();
  constexpr double kStep_s = 0.02;
  std::vector<double> burnt_mg(settings.vehicles, 0.0);
  std::vector<std::uint32_t> trips(settings.vehicles, 0);
  int overruns = 0, driven = 0;
  for (int i = 0; i < 6000; ++i) {
    std::vector<bool> was_there;
    for (std::uint32_t id = 0; id < settings.vehicles; ++id) was_there.push_back(model.agent(id).on_road);
    model.Step(kStep_s, {});
    for (std::uint32_t id = 0; id < settings.vehicles; ++id) {
      const Agent& agent = model.agent(id);
      if (!agent.on_road) continue;
      if (!was_there[id] || trips[id] != agent.trip) {  // it has entered in this step, and not driven yet
        trips[id] = agent.trip;
        burnt_mg[id] = 0.0;
        EXPECT_EQ(agent.fuel_mg, 0.0);
        continue;
      }
      const double flow_mgps = FuelFlow_mgps(CarOfBody(model.traits(id).body), agent.driving);
      burnt_mg[id] += flow_mgps * kStep_s;
      ASSERT_NEAR(agent.fuel_mg, burnt_mg[id], 1e-9 * (1.0 + burnt_mg[id])) << id << " at " << i;
      const bool overrun = agent.driving.throttle == 0.0 && agent.driving.clutch == 0.0 && agent.speed_mps > 5.0;
      overruns += overrun ? 1 : 0;
      driven += agent.driving.throttle > 0.0 ? 1 : 0;
      EXPECT_TRUE(!overrun || flow_mgps == 0.0) << id;
      EXPECT_TRUE(agent.driving.throttle == 0.0 || flow_mgps > 0.0) << id;
    }
  }
  EXPECT_GT(overruns, 1000);
  EXPECT_GT(driven, 10000);
}

// In a town where cars come, go and queue: q = k v in every cell to 1e-9; all cells together have the vehicle seconds
// and the way that were there; and none comes or goes uncounted.
TEST(LaneStatistics, SumsAreWhatWasDriven) {
  TrafficSettings settings;
  settings.vehicles = 90;
  settings.seed = 7;
  TrafficModel model = TrafficModel::Make(settings, lanes::MapNetwork("town"), {}).value();
  LaneStatistics statistics(model);
  constexpr double kStep_s = 0.02;
  double vehicle_s = 0.0, way_m = 0.0, fuel_mg = 0.0;
  std::vector<double> before(settings.vehicles), before_mg(settings.vehicles);
  std::vector<std::uint32_t> trips(settings.vehicles);
  std::vector<bool> there(settings.vehicles);
  std::int64_t left = 0, entered = 0, began = static_cast<std::int64_t>(model.on_road());
  for (int i = 0; i <= 9000; ++i) {
    if (i > 0) {
      model.Step(kStep_s, {});
      statistics.Add(model, kStep_s);
      if (i % 10 == 0) statistics.LookAtQueues(model);
    }
    for (std::uint32_t id = 0; id < settings.vehicles; ++id) {
      const Agent& agent = model.agent(id);
      const bool same = there[id] && agent.on_road && trips[id] == agent.trip;
      if (i > 0 && there[id] && !same) ++left;
      if (i > 0 && agent.on_road && !same) ++entered;
      if (same) {
        vehicle_s += kStep_s, way_m += agent.o_m - before[id];
        fuel_mg += agent.fuel_mg - before_mg[id];
      }
      there[id] = agent.on_road, trips[id] = agent.trip, before[id] = agent.o_m, before_mg[id] = agent.fuel_mg;
    }
    ASSERT_EQ(statistics.began() + statistics.entered() - statistics.left(), static_cast<std::int64_t>(model.on_road()))
        << i;
  }
  EXPECT_EQ(statistics.began(), began);
  EXPECT_EQ(statistics.entered(), entered);
  EXPECT_EQ(statistics.left(), left);
  EXPECT_EQ(statistics.there(), static_cast<std::int64_t>(model.on_road()));
  EXPECT_GT(left, 20);
  LaneCell sum;
  int visited = 0;
  for (std::uint32_t track = 0; track < model.graph().tracks().size(); ++track) {
    const double length = statistics.CellLength_m(track);
    for (const LaneCell& cell : statistics.CellsOf(track)) {
      sum.distance_m += cell.distance_m, sum.time_s += cell.time_s, sum.fuel_mg += cell.fuel_mg;
      ASSERT_GE(cell.distance_m, 0.0);
      ASSERT_GE(cell.time_s, 0.0);
      const double q = cell.Flow_vehps(length, 180.0), k = cell.Density_vehpm(length, 180.0);
      ASSERT_NEAR(q, k * cell.Speed_mps(), 1e-9);
      if (cell.time_s > 0.0) ++visited;
    }
  }
  EXPECT_NEAR(sum.time_s, vehicle_s, 1e-9 * vehicle_s);
  EXPECT_NEAR(sum.distance_m, way_m, 1e-9 * way_m);
  EXPECT_NEAR(sum.fuel_mg, fuel_mg, 1e-9 * fuel_mg);
  EXPECT_NEAR(std::accumulate(statistics.fuel_mg().begin(), statistics.fuel_mg().end(), 0.0), fuel_mg, 1e-9 * fuel_mg);
  EXPECT_GT(visited, 1000);
  for (const LaneTrip& trip : statistics.trips()) EXPECT_GT(trip.took_s, 3.0);
}

// Each cell's time is, within a step a visit, that of the steps with a vehicle's middle in it at the end, on lanes
// that are changed, in a ring and at merges; and a query in the middle of it all finds as much there, and changes
// nothing.
TEST(LaneStatistics, EachCellHasItsOwn) {
  constexpr double kStep_s = 0.02;
  for (const char* name : {"ramp", "roundabout", "crossing"}) {
    for (const double cell_m : {1.0, 7.0}) {
      TrafficSettings settings;
      settings.vehicles = 40;
      TrafficModel model = TrafficModel::Make(settings, lanes::MapNetwork(name), {}).value();
      LaneStatistics statistics(model, cell_m), asked(model, cell_m);
      std::vector<std::vector<double>> time_s, visits;
      for (std::uint32_t track = 0; track < model.graph().tracks().size(); ++track) {
        time_s.emplace_back(statistics.CellsOf(track).size(), 0.0);
        visits.emplace_back(statistics.CellsOf(track).size(), 0.0);
      }
      struct Place {
        std::int64_t trip = -1;
        std::uint32_t track = 0;
        std::size_t cell = 0;
      };
      std::vector<Place> before(settings.vehicles);
      for (int i = 0; i <= 4000; ++i) {
        if (i > 0) model.Step(kStep_s, {}), statistics.Add(model, kStep_s), asked.Add(model, kStep_s);
        for (const AgentPose& pose : model.poses()) {
          const Agent& agent = model.agent(pose.id);
          const Piece& piece = PieceAt(agent.path, agent.o_m);
          const double cell = std::floor((agent.o_m - piece.zero_m) / statistics.CellLength_m(piece.track));
          const Place now{
              pose.trip, piece.track,
              static_cast<std::size_t>(std::clamp(cell, 0.0, static_cast<double>(time_s[piece.track].size() - 1)))};
          Place& last = before[pose.id];
          if (last.trip == now.trip) time_s[now.track][now.cell] += kStep_s;
          if (last.trip != now.trip || last.track != now.track || last.cell != now.cell) ++visits[now.track][now.cell];
          last = now;
        }
        if (i % 400 != 200) continue;
        for (std::uint32_t track = 0; track < time_s.size(); ++track) {
          const auto cells = asked.CellsOf(track);
          for (std::size_t cell = 0; cell < cells.size(); ++cell) {
            ASSERT_NEAR(cells[cell].time_s, time_s[track][cell], kStep_s * (visits[track][cell] + 1.0))
                << name << " " << track << " " << cell << " after " << i * kStep_s << " s";
          }
        }
      }
      for (std::uint32_t track = 0; track < time_s.size(); ++track) {
        const auto cells = statistics.CellsOf(track), same = asked.CellsOf(track);
        for (std::size_t cell = 0; cell < cells.size(); ++cell) {
          ASSERT_NEAR(cells[cell].time_s, time_s[track][cell], kStep_s * (visits[track][cell] + 1.0))
              << name << " " << track << " " << cell;
          ASSERT_NEAR(cells[cell].time_s, same[cell].time_s, 1e-9 * (1.0 + same[cell].time_s));
          ASSERT_NEAR(cells[cell].distance_m, same[cell].distance_m, 1e-9 * (1.0 + same[cell].distance_m));
          ASSERT_NEAR(cells[cell].fuel_mg, same[cell].fuel_mg, 1e-9 * (1.0 + same[cell].fuel_mg));
        }
      }
    }
  }
}

// Thirty cars in equilibrium on a ring: everywhere the density N / L, the speed of the IDM, and their product the flow.
TEST(LaneStatistics, SteadyFlowIsThatOfTheEquilibrium) {
  const TrafficSettings settings = Identical(30, 2.0);
  TrafficModel model = TrafficModel::Make(settings, Ring(1000.0), {}).value();
  for (int i = 0; i < 60000; ++i) model.Step(0.02, {});
  const double speed = EquilibriumOf(model, settings.idm).speed_mps, length_m = model.graph()[0].length_m();
  LaneStatistics statistics(model, 10.0);
  const double round_s = length_m / speed;  // each car comes through each cell as often
  const int steps = static_cast<int>(std::lround(20.0 * round_s / 0.02));
  for (int i = 0; i < steps; ++i) model.Step(0.02, {}), statistics.Add(model, 0.02);
  ASSERT_EQ(statistics.CellsOf(0).size(), static_cast<std::size_t>(std::lround(0.1 * length_m)));
  for (const LaneCell& cell : statistics.CellsOf(0)) {
    const double k = cell.Density_vehpm(statistics.CellLength_m(0), statistics.watched_s()),
                 q = cell.Flow_vehps(statistics.CellLength_m(0), statistics.watched_s());
    EXPECT_NEAR(k, 30.0 / length_m, 0.002 * k);
    EXPECT_NEAR(cell.Speed_mps(), speed, 0.01);
    EXPECT_NEAR(q, 30.0 / length_m * speed, 0.002 * q);
  }
  EXPECT_EQ(statistics.entered(), 0);
  EXPECT_EQ(statistics.left(), 0);
}

// The speed of a vehicle without another in its way: √(a R) on a ring too narrow for its limit, the limit on a
// wide one.
TEST(LaneStatistics, FreeSpeedIsThatOfBendAndLimit) {
  TrafficSettings settings = Identical(3, 1.4);
  for (const double round_m : {200.0, 2000.0}) {
    const TrafficModel model = TrafficModel::Make(settings, Ring(round_m), {}).value();
    const LaneStatistics statistics(model);
    const double radius = model.graph()[0].length_m() / (2.0 * std::numbers::pi),
                 bend = std::sqrt(settings.speed.lateral_mps2 * radius);
    EXPECT_EQ(bend < kRingLimit_mps, round_m < 1000.0);
    for (std::size_t cell = 0; cell < statistics.CellsOf(0).size(); ++cell)
      EXPECT_NEAR(statistics.FreeSpeed_mps(0, cell), std::min(bend, kRingLimit_mps), 1e-3) << round_m;
  }
}

// A jam behind a car that stands: cells before it are slow and dense, and the queue is counted.
TEST(LaneStatistics, AQueueIsCounted) {
  TrafficSettings settings = Identical(20, 1.4);
  TrafficModel model = TrafficModel::Make(settings, Ring(600.0), {}).value();
  LaneStatistics statistics(model);
  model.Brake(7, 2.0);
  for (int i = 0; i < 12000; ++i) {
    model.Step(0.01, {});
    statistics.Add(model, 0.01);
    if (i > 11000) statistics.LookAtQueues(model);
  }
  EXPECT_EQ(statistics.LongestQueue(0), 20);
  EXPECT_NEAR(statistics.MeanQueue(0), 20.0, 0.01);
}

// On the straight arms of the crossing, told apart from the model: each step's way from where its car was seen before
// and is seen now, its fuel from what the car says that it has burnt, shared out among the metres between the two
// places. Every metre of an arm has that distance, time and fuel.
TEST(LaneStatistics, CellsHaveWhatThePosesSay) {
  constexpr double kStep_s = 0.02;
  TrafficSettings settings;
  settings.vehicles = 20;
  TrafficModel model = TrafficModel::Make(settings, lanes::MapNetwork("crossing"), {}).value();
  LaneStatistics statistics(model);
  const lanes::Graph& graph = model.graph();
  std::map<std::pair<std::int32_t, std::int32_t>, std::uint32_t> arms;  // road and lane, and the track
  for (std::uint32_t track = 0; track < graph.tracks().size(); ++track) {
    if (graph[track].curve.straight() && graph[track].length_m() > 50.0)
      arms[{static_cast<std::int32_t>(graph[track].lane.road), graph[track].lane.lane}] = track;
  }
  ASSERT_EQ(arms.size(), 8u);
  std::map<std::uint32_t, std::vector<LaneCell>> told;
  for (const auto& [lane, track] : arms) told[track].resize(statistics.CellsOf(track).size());
  struct Before {
    std::int64_t trip = -1;
    Eigen::Vector2d p_W;
    double fuel_mg = 0.0;
  };
  std::vector<Before> before(settings.vehicles);
  const auto look = [&](bool shares) {
    for (const AgentPose& pose : model.poses()) {
      const double fuel_mg = model.agent(pose.id).fuel_mg;
      Before& last = before[pose.id];
      const auto arm = arms.find({pose.road, pose.lane});
      if (shares && last.trip == static_cast<std::int64_t>(pose.trip) && arm != arms.end()) {
        const auto& nodes = graph[arm->second].curve.nodes();
        const Eigen::Vector2d begin = nodes.front().p_W.head<2>(),
                              along = (nodes.back().p_W.head<2>() - begin).normalized();
        const double from = along.dot(last.p_W - begin), to = along.dot(pose.p_WB_W.head<2>() - begin),
                     length = statistics.CellLength_m(arm->second);
        auto& cells = told[arm->second];
        for (std::size_t i = 0; i < cells.size(); ++i) {
          const double low = static_cast<double>(i) * length, high = low + length;
          const double way = std::min(to, high) - std::max(from, low);
          const bool stands = to <= from && to >= low && to < high;
          if (way <= 0.0 && !stands) continue;
          const double share = stands ? 1.0 : way / (to - from);
          cells[i].distance_m += stands ? 0.0 : way;
          cells[i].time_s += share * kStep_s;
          cells[i].fuel_mg += share * (fuel_mg - last.fuel_mg);
        }
      }
      last = {pose.trip, pose.p_WB_W.head<2>(), fuel_mg};
    }
  };
  look(false);
  for (int i = 0; i < 15000; ++i) {
    model.Step(kStep_s, {});
    statistics.Add(model, kStep_s);
    look(true);
  }
  double driven_m = 0.0, burnt_mg = 0.0;
  for (const auto& [track, cells] : told) {
    for (std::size_t i = 3; i + 3 < cells.size(); ++i) {  // not where a step leads from one lane to another
      const LaneCell& cell = statistics.CellsOf(track)[i];
      ASSERT_NEAR(cell.distance_m, cells[i].distance_m, 1e-6 * (1.0 + cells[i].distance_m)) << track << " " << i;
      ASSERT_NEAR(cell.time_s, cells[i].time_s, 1e-6 * (1.0 + cells[i].time_s)) << track << " " << i;
      ASSERT_NEAR(cell.fuel_mg, cells[i].fuel_mg, 1e-6 * (1.0 + cells[i].fuel_mg)) << track << " " << i;
      driven_m += cell.distance_m, burnt_mg += cell.fuel_mg;
    }
  }
  EXPECT_GT(driven_m, 5000.0);
  EXPECT_GT(burnt_mg, 1e5);
}

}  // namespace
}  // namespace rodeira::traffic
