// SPDX-License-Identifier: Apache-2.0
// The checks of a study against plain ones: every pair of boxes is compared, and every point is looked for in the
// network itself. States are drawn, with faults among them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "common/driving/driver/footprint.hpp"
#include "common/traffic/check/box_check.hpp"
#include "common/traffic/check/red_check.hpp"
#include "common/traffic/check/road_check.hpp"
#include "common/traffic/results/study.hpp"
#include "common/world/lanes/lights.hpp"
#include "tests/common/world/lanes/lane_networks.hpp"
#include "tests/long_form.hpp"

namespace rodeira::traffic {
namespace {

const std::vector<BodySize> kSizes{BodySize::Of(3.6, 1.6, 2.4), BodySize::Of(4.6, 1.8, 2.7),
                                   BodySize::Of(6.0, 2.1, 3.5), BodySize::Of(12.0, 2.5, 6.0),
                                   BodySize::Of(18.7, 2.55, 6.5)};

Eigen::Quaterniond Turned(double heading_rad, double grade = 0.0) {
  return Eigen::AngleAxisd(heading_rad, Eigen::Vector3d::UnitZ()) *
         Eigen::AngleAxisd(-std::atan(grade), Eigen::Vector3d::UnitY());
}

// Vehicles that are strewn over a square, few or many on two levels; ids with gaps between them.
TEST(BoxCheck, FindsThePairsThatABruteForceComparisonFinds) {
  std::mt19937_64 draws(11);
  const auto between = [&](double low, double high) { return std::uniform_real_distribution(low, high)(draws); };
  std::size_t found = 0, crowded = 0;
  BoxCheck check;
  for (int state = 0; state < BriefOrLong(300, 3000); ++state) {
    const auto count = static_cast<std::size_t>(between(0.0, 200.0));
    const double side_m = std::exp(between(std::log(5.0), std::log(2000.0)));
    std::vector<AgentPose> poses;
    std::vector<BodySize> sizes;
    for (std::size_t i = 0; i < count; ++i) {
      const auto skip = static_cast<std::size_t>(between(1.0, 3.0));
      sizes.resize(sizes.size() + skip, kSizes[static_cast<std::size_t>(between(0.0, 4.999))]);
      AgentPose pose;
      pose.id = static_cast<std::uint32_t>(sizes.size() - 1);
      pose.p_WB_W = {between(-side_m, side_m), between(-side_m, side_m), between(0.0, 1.0) < 0.5 ? 0.0 : 5.0};
      pose.p_WB_W.z() += between(-0.9, 0.9);
      pose.q_WB = Turned(between(-4.0, 4.0), between(-0.1, 0.1));
      poses.push_back(pose);
    }
    std::vector<BoxCheck::Pair> expected;
    for (std::size_t i = 0; i < poses.size(); ++i) {
      for (std::size_t k = i + 1; k < poses.size(); ++k) {
        if (std::fabs(poses[i].p_WB_W.z() - poses[k].p_WB_W.z()) > network::Network::kLevel_m) continue;
        AgentTraits a, b;
        a.length_m = sizes[poses[i].id].length_m, a.width_m = sizes[poses[i].id].width_m;
        b.length_m = sizes[poses[k].id].length_m, b.width_m = sizes[poses[k].id].width_m;
        if (driver::Overlap(FootprintOf(poses[i], a), FootprintOf(poses[k], b)))
          expected.emplace_back(poses[i].id, poses[k].id);
      }
    }
    std::sort(expected.begin(), expected.end());
    ASSERT_EQ(check.Find(poses, sizes), expected) << "state " << state;
    found += expected.size();
    crowded += expected.size() > 50 ? 1 : 0;
  }
  EXPECT_GT(found, 1000u);
  EXPECT_GT(crowded, 5u);
}

// What the network itself says of a point, without corridors.
class PlainRoad {
 public:
  explicit PlainRoad(const lanes::Graph& graph) : graph_(graph) {}

  bool IsOnDrivableLane(const Eigen::Vector3d& p_W) const {
    const network::Lane* lane = LaneAt(p_W);
    return lane != nullptr && network::IsDrivable(lane->type);
  }
  bool IsForVehicles(const Eigen::Vector3d& p_W) const {
    const network::Lane* lane = LaneAt(p_W);
    if (lane != nullptr && (network::IsDrivable(lane->type) || lane->type == network::LaneType::kShoulder)) return true;
    for (const lanes::Graph::Beside& beside : graph_.TracksAt(p_W.head<2>(), 4.0)) {
      const lanes::Curve& curve = graph_[beside.track].curve;
      if (std::fabs(beside.foot.offset_m) <= 0.5 * curve.WidthAt(beside.foot.d_m) + 1e-3 &&
          std::fabs(curve.At(beside.foot.d_m).p_W.z() - p_W.z()) < network::Network::kLevel_m)
        return true;
    }
    return false;
  }

 private:
  const network::Lane* LaneAt(const Eigen::Vector3d& p_W) const {
    const auto place = graph_.network().Locate(p_W.x(), p_W.y(), p_W.z());
    return place && place->distance_m <= 1e-3 ? graph_.network().Find(place->lane) : nullptr;
  }

  const lanes::Graph& graph_;
};

// Vehicles go along lanes, beside their middles, swaying from one lane to the next and off the road, for many looks, so
// that what a look remembers is used in the next one. Now and then one appears elsewhere.
TEST(RoadCheck, FindsWhatThePlainSearchFinds) {
  std::size_t looks = 0, beside = 0, wheels = 0;
  std::vector<std::shared_ptr<const network::Network>> networks;
  for (const std::string& name : lanes::MapNames()) networks.push_back(lanes::MapNetwork(name));
  for (const auto& file : lanes::RealFiles()) {
    auto read = opendrive::LoadNetwork(file);
    if (read) networks.push_back(read.value());
  }
  std::uint64_t seed = 0;
  for (const auto& network : networks) {
    const lanes::Graph graph(*network);
    if (graph.tracks().empty()) continue;
    const PlainRoad plain(graph);
    constexpr std::size_t kVehicles = 5;
    RoadCheck check(graph, kVehicles);
    std::mt19937_64 draws(++seed);
    const auto between = [&](double low, double high) { return std::uniform_real_distribution(low, high)(draws); };
    for (std::size_t vehicle = 0; vehicle < kVehicles; ++vehicle) {
      const BodySize& size = kSizes[vehicle];
      std::uint32_t track = 0;
      double d = 1e18, phase = 0.0, sway_m = 0.0;
      for (int look = 0; look < BriefOrLong(300, 3000); ++look) {
        if (d > graph[track].length_m()) {
          const auto& next = graph[track].next;
          const bool goes_on = d < 1e17 && !next.empty() && between(0.0, 1.0) < 0.9;
          d = goes_on ? d - graph[track].length_m() : 0.0;
          const auto choice = [&](std::size_t of) {
            return static_cast<std::size_t>(between(0.0, static_cast<double>(of) - 1e-9));
          };
          track = goes_on ? next[choice(next.size())].to : static_cast<std::uint32_t>(choice(graph.tracks().size()));
          d = std::min(d, graph[track].length_m());
          sway_m = between(0.0, 1.0) < 0.5 ? 0.1 : between(0.0, 4.0);
        }
        const lanes::CurvePoint at = graph[track].curve.At(d);
        phase += 0.05;
        AgentPose pose;
        pose.id = static_cast<std::uint32_t>(vehicle);
        pose.p_WB_W = at.p_W;
        pose.p_WB_W.head<2>() += sway_m * std::sin(phase) * at.left_W();
        pose.p_WB_W.z() += at.bank * sway_m * std::sin(phase);
        pose.q_WB = Turned(std::atan2(at.ahead_W.y(), at.ahead_W.x()) + 0.1 * sway_m * std::cos(phase), at.grade);
        const RoadCheck::Finding found = check.Find(pose, size);
        ASSERT_EQ(found.beside_m.has_value(), !plain.IsOnDrivableLane(pose.p_WB_W))
            << network->name() << " road '" << network->roads()[graph[track].lane.road].id() << "' d " << d << " look "
            << look << " at " << pose.p_WB_W.transpose();
        std::vector<Eigen::Vector3d> expected;
        for (const double along : {-0.5, 0.5}) {
          for (const double aside : {-1.0, 1.0}) {
            const Eigen::Vector3d wheel_W =
                pose.p_WB_W +
                pose.q_WB * Eigen::Vector3d(along * size.wheelbase_m, aside * (0.5 * size.width_m - 0.1), 0.0);
            if (!plain.IsForVehicles(wheel_W)) expected.push_back(wheel_W);
          }
        }
        ASSERT_EQ(found.wheels_W.size(), expected.size())
            << network->name() << " road '" << network->roads()[graph[track].lane.road].id() << "' d " << d << " of "
            << graph[track].length_m() << " look " << look << " vehicle " << vehicle << " at "
            << pose.p_WB_W.transpose();
        for (std::size_t i = 0; i < expected.size(); ++i)
          EXPECT_LT((found.wheels_W[i] - expected[i]).norm(), 1e-9) << network->name();
        ++looks;
        beside += found.beside_m ? 1 : 0, wheels += expected.size();
        d += between(0.0, 2.0);
      }
    }
  }
  EXPECT_GT(looks, 5000u);
  EXPECT_GT(beside, 100u);
  EXPECT_GT(wheels, 500u);
}

// A front is driven over the lines of the crossing with lights at drawn times. It is a fault if the light is red or red
// and amber at the last look before the line and at the first one behind it.
TEST(RedCheck, FindsFrontsThatPassAtRed) {
  const auto network = lanes::MapNetwork("lights");
  const lanes::Graph graph(*network);
  std::vector<lanes::LightPlace> lights;
  for (std::uint32_t track = 0; track < graph.tracks().size(); ++track) {
    for (const lanes::LightPlace& light : lanes::LightsOf(graph, track)) lights.push_back(light);
  }
  ASSERT_GE(lights.size(), 4u);
  RedCheck check(graph, 1);
  ASSERT_TRUE(check.any_lights());
  std::mt19937_64 draws(3);
  const auto between = [&](double low, double high) { return std::uniform_real_distribution(low, high)(draws); };
  const auto controllers = network->controllers();
  int faults = 0, passed = 0;
  for (std::uint32_t trip = 0; trip < 400; ++trip) {
    const lanes::LightPlace& light = lights[trip % lights.size()];
    Path path(1);
    path[0].track = light.track, path[0].zero_m = between(-50.0, 50.0);
    const double line_m = path[0].zero_m + light.d_m;
    path[0].begin_m = line_m - 30.0;
    double front_m = line_m - between(1.0, 20.0), time_s = between(0.0, 200.0);
    const double speed_mps = between(2.0, 20.0);
    bool was_red = false;
    while (front_m < line_m + 15.0) {
      std::vector<network::LightColour> colours;
      for (const network::Controller& controller : controllers)
        colours.push_back(network::ColourAt(*controller.times, std::llround(time_s * 1e9)));
      const network::LightColour colour = colours[light.controller];
      const bool red = colour == network::LightColour::kRed || colour == network::LightColour::kRedAmber;
      const double step_m = 0.1 * speed_mps;
      const bool passes = front_m > line_m && front_m - step_m <= line_m;
      check.Begin(colours);
      const bool found = check.Passes(0, trip, path, front_m);
      ASSERT_EQ(found, passes && red && was_red) << "trip " << trip << " at " << time_s << " s";
      faults += found ? 1 : 0, passed += passes ? 1 : 0;
      was_red = red;
      front_m += step_m, time_s += 0.1;
    }
  }
  EXPECT_GT(faults, 50);
  EXPECT_GT(passed - faults, 50);
}

// Looking for faults changes nothing of a run.
TEST(Study, IsTheSameWithAndWithoutChecks) {
  StudySettings settings;
  settings.traffic.vehicles = 60;
  settings.duration_s = 60.0, settings.step_s = 0.05;
  const auto network = lanes::MapNetwork("town");
  const StudyResult with = RunStudy(settings, network).value();
  settings.checks = false;
  const StudyResult without = RunStudy(settings, network).value();
  EXPECT_TRUE(with.checked);
  EXPECT_FALSE(without.checked);
  EXPECT_EQ(with.driven_km, without.driven_km);
  EXPECT_EQ(with.fuel_mg, without.fuel_mg);
  EXPECT_EQ(with.standing_s, without.standing_s);
  EXPECT_EQ(with.arrivals, without.arrivals);
  EXPECT_EQ(with.entered, without.entered);
  EXPECT_EQ(with.left, without.left);
}

}  // namespace
}  // namespace rodeira::traffic
