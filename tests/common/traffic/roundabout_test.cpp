// SPDX-License-Identifier: Apache-2.0
// A roundabout's entry at which a queue waits, and traffic that circulates past it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "common/traffic/traffic_model.hpp"
#include "tests/common/traffic/curves.hpp"
#include "tests/common/world/lanes/lane_networks.hpp"
#include "tests/tree.hpp"

namespace rodeira::traffic {
namespace {

// A roundabout's arms in the order in which its traffic passes them: where it is entered, and left.
struct Arm {
  double angle_rad = 0.0;
  std::string entry, exit;
};

std::vector<Arm> ArmsOf(const lanes::Graph& graph) {
  const auto name = [&](const lanes::Track& track) { return graph.network().roads()[track.lane.road].id(); };
  const auto angle = [](const lanes::Track& track, double d_m) {
    const Eigen::Vector3d at = track.curve.At(d_m).p_W;
    return std::atan2(at.y(), at.x());
  };
  std::vector<Arm> arms;
  for (const lanes::Track& track : graph.tracks()) {
    if (track.entry) arms.push_back({angle(track, 0.0), name(track), ""});
  }
  std::sort(arms.begin(), arms.end(), [](const Arm& a, const Arm& b) { return a.angle_rad < b.angle_rad; });
  for (const lanes::Track& track : graph.tracks()) {
    if (!track.next.empty()) continue;
    const auto off = [&](const Arm& arm) {
      return std::fabs(std::remainder(arm.angle_rad - angle(track, track.length_m()), 6.283185307179586));
    };
    std::min_element(arms.begin(), arms.end(), [&](const Arm& a, const Arm& b) { return off(a) < off(b); })->exit =
        name(track);
  }
  return arms;
}

struct Passed {
  double circulating_per_h = 0.0, entered_per_h = 0.0, max_deceleration_mps2 = 0.0;
};

// Of two arms after each other in turn: the one sends so many past the next, at which so many wish to enter; both leave
// at the one after.
Passed Measure(double circulating_per_h, double entering_per_h, const std::string& drivers = "brisk") {
  constexpr double kStep_s = 0.1, kWarm_s = 200.0, kFor_s = 1000.0, kPer_h = 3600.0 / kFor_s / 2.0;
  const auto network = lanes::MapNetwork("roundabout");
  const lanes::Graph graph(*network);
  const std::vector<Arm> arms = ArmsOf(graph);
  EXPECT_EQ(arms.size(), 4u);
  Passed passed;
  for (const std::size_t arm : {0u, 1u}) {
    TrafficSettings settings;
    if (drivers.empty())
      settings.seed = 3 + arm;
    else
      settings =
          LoadTraffic(std::filesystem::path(SourceDir()) / "configs/traffic" / (drivers + ".yaml"), 3 + arm).value();
    settings.vehicles = 100;
    const std::string& out = arms[arm + 2].exit;
    settings.demand.routes = {{"out", {out}, "here"}};
    FlowSettings past, queue;
    past.lane = arms[arm].entry + ":-1", queue.lane = arms[arm + 1].entry + ":-1";
    past.route = queue.route = "out";
    past.per_h = {circulating_per_h}, queue.per_h = {entering_per_h};
    settings.demand.flows = {past, queue};
    TrafficModel model = TrafficModel::Make(settings, network, {}).value();
    std::set<std::pair<std::int32_t, std::uint32_t>> seen;  // on the road out, by flow and number
    for (int i = 1; i * kStep_s < kWarm_s + kFor_s; ++i) {
      model.Step(kStep_s, {});
      for (const AgentPose& pose : model.poses()) {
        const Agent& agent = model.agent(pose.id);
        passed.max_deceleration_mps2 = std::max(passed.max_deceleration_mps2, -pose.acceleration_mps2);
        if (network->roads()[static_cast<std::size_t>(pose.road)].id() != out ||
            !seen.insert({agent.flow, agent.arrival}).second)
          continue;
        if (i * kStep_s > kWarm_s) (agent.flow == 0 ? passed.circulating_per_h : passed.entered_per_h) += kPer_h;
      }
    }
  }
  return passed;
}

// Highway Capacity Manual (2016): 1380 exp(-0.00102 q).
double Handbook(double circulating_per_h) { return 1380.0 * std::exp(-0.00102 * circulating_per_h); }

// Up to 800 circulating; what it is beyond is in docs/performance.md. A circulating car goes first: a queue at the
// entry takes nothing from it.
TEST(Roundabout, ItsEntryCarriesWhatTheHandbookSays) {
  PlotCurve measured{"measured on roundabout.motors", "#b03020", {}},
      handbook{"1380 exp(-0.00102 q)", "#1f5f8b", {}, true};
  for (const double past_per_h : {0.0, 200.0, 400.0, 600.0, 800.0}) {
    const Passed alone = Measure(past_per_h, 0.0), beside = Measure(past_per_h, 2000.0);
    EXPECT_NEAR(beside.circulating_per_h, alone.circulating_per_h, 0.03 * alone.circulating_per_h + 4.0);
    EXPECT_NEAR(beside.entered_per_h, Handbook(beside.circulating_per_h), 0.15 * Handbook(beside.circulating_per_h))
        << beside.circulating_per_h;
    EXPECT_LE(beside.max_deceleration_mps2, 3.0);
    measured.points.emplace_back(beside.circulating_per_h, beside.entered_per_h);
    RecordProperty("past_" + std::to_string(std::lround(beside.circulating_per_h)),
                   std::to_string(std::lround(beside.entered_per_h)));
  }
  for (double q = 0.0; q <= 1000.0; q += 20.0) handbook.points.emplace_back(q, Handbook(q));
  const std::string svg = PlotSvg("A roundabout's entry", "circulating, vehicles an hour", "entering, vehicles an hour",
                                  200.0, 250.0, {measured, handbook});
  EXPECT_TRUE(WritePicture("traffic_entry.svg", svg));
}

// What stands in docs/performance.md, of both kinds of drivers and beyond what is asked above.
TEST(Roundabout, TableOfItsEntry) {
  if (std::getenv("RODEIRA_ROUNDABOUT") == nullptr)
    GTEST_SKIP() << "RODEIRA_ROUNDABOUT=1 measures and prints the table";
  for (const std::string drivers : {"brisk", ""}) {
    for (const double past_per_h : {0.0, 200.0, 400.0, 600.0, 800.0, 1000.0, 1200.0}) {
      const Passed passed = Measure(past_per_h, 2000.0, drivers);
      const double handbook = Handbook(passed.circulating_per_h);
      std::printf("%s: %.0f circulate, %.0f enter, by the handbook %.0f: %+.0f %%\n",
                  drivers.empty() ? "usual drivers" : drivers.c_str(), passed.circulating_per_h, passed.entered_per_h,
                  handbook, 100.0 * (passed.entered_per_h / handbook - 1.0));
      EXPECT_GT(passed.entered_per_h, 0.0);
    }
  }
}

}  // namespace
}  // namespace rodeira::traffic
