// SPDX-License-Identifier: Apache-2.0
// A queue that discharges: the IDM integrated apart, and the published saturation flow.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "common/traffic/traffic_model.hpp"
#include "tests/common/driving/driver/test_road.hpp"
#include "tests/common/traffic/curves.hpp"
#include "tests/common/traffic/identical.hpp"
#include "tests/lane_path.hpp"

namespace rodeira::traffic {
namespace {

using driver::IdmSettings;

// When the fronts of the first cars of a queue pass its line: measured, and by the IDM apart.
struct Discharged {
  std::vector<double> passes_s, idm_s;

  double Flow_ph() const { return 3600.0 * 20.0 / (passes_s[24] - passes_s[4]); }  // from the fifth car on
};

// A queue before a barrier that is taken away, against the IDM integrated here with accelerations that change by 3 m/s³
// at most. Coarse steps are compared with the finest one only. `standing` is the queue that stands there: made where it
// is empty, restored otherwise.
Discharged Discharge(double time_gap_s, base::Bytes& standing, double step_s = 0.01) {
  constexpr double kLimit_mps = 50.0 / 3.6, kLine_m = 800.0;
  const road::RoadSpec spec = driver::StraightRoad(2000.0, kLimit_mps);
  const Version1Road road(spec);
  const auto world = driver::WorldOf(spec);
  const driver::LanePath path(road, -1);
  const driver::LaneFrame frame = path.At(kLine_m + 2.0);
  const std::vector<driver::Footprint> barrier{{1000, frame.p_W.x(), frame.p_W.y(), frame.heading_rad, 0.0, 4.0, 1.7}};
  TrafficSettings settings = Identical(120, 1.4);
  settings.idm.time_gap_s = time_gap_s;
  TrafficModel model = TrafficModel::Make(settings, world, barrier).value();
  if (standing.empty()) {
    for (int i = 0; i < 15000; ++i) model.Step(0.02, barrier);
    base::StateWriter writer;
    model.Save(writer);
    standing = writer.bytes();
  } else {
    base::StateReader reader(standing);
    model.Restore(reader);
    EXPECT_TRUE(reader.Finish().ok());
  }
  struct Car {
    std::uint32_t id;
    double front_m, speed_mps, length_m, passes_s, acceleration_mps2;
  };
  std::vector<Car> queue;
  const auto front_of = [&](const AgentPose& pose) {
    return path.Locate(pose.p_WB_W.x(), pose.p_WB_W.y())->d_m + 0.5 * model.traits(pose.id).length_m;
  };
  for (const AgentPose& pose : model.poses()) {
    if (pose.lane == -1 && front_of(pose) < kLine_m)
      queue.push_back(
          {pose.id, front_of(pose), pose.speed_mps, model.traits(pose.id).length_m, -1.0, pose.acceleration_mps2});
  }
  std::sort(queue.begin(), queue.end(), [](const Car& a, const Car& b) { return a.front_m > b.front_m; });
  EXPECT_GE(queue.size(), 25u);
  queue.resize(25);
  std::vector<Car> here = queue;
  const IdmSettings idm = settings.idm;
  const auto rates = [&](const std::vector<Car>& cars) {
    std::vector<double> rate;
    for (std::size_t n = 0; n < cars.size(); ++n) {
      const double v = cars[n].speed_mps;
      double s = 1e9, dv = 0.0;
      if (n > 0) s = cars[n - 1].front_m - cars[n - 1].length_m - cars[n].front_m, dv = v - cars[n - 1].speed_mps;
      const double wanted =
          idm.min_gap_m +
          std::max(0.0, v * idm.time_gap_s + v * dv / (2.0 * std::sqrt(idm.acceleration_mps2 * idm.braking_mps2)));
      rate.push_back(idm.acceleration_mps2 * (1.0 - std::pow(v / kLimit_mps, 4) - std::pow(wanted / s, 2)));
    }
    return rate;
  };
  constexpr double kStep_s = 0.002, kJerk_mps3 = 3.0;
  for (int i = 0; i < 60000 && here.back().passes_s < 0.0; ++i) {
    const std::vector<double> wanted = rates(here);
    for (std::size_t n = 0; n < here.size(); ++n) {
      Car& car = here[n];
      car.acceleration_mps2 = std::clamp(wanted[n], car.acceleration_mps2 - kStep_s * kJerk_mps3,
                                         car.acceleration_mps2 + kStep_s * kJerk_mps3);
      car.acceleration_mps2 = std::max(car.acceleration_mps2,
                                       -std::sqrt(2.0 * kJerk_mps3 * car.speed_mps));  // comes to rest without a jerk
      const double after = std::max(0.0, car.speed_mps + kStep_s * car.acceleration_mps2);
      car.front_m += 0.5 * kStep_s * (car.speed_mps + after);
      car.speed_mps = after;
      if (car.passes_s < 0.0 && car.front_m >= kLine_m) car.passes_s = (i + 1) * kStep_s;
    }
  }
  const auto passed = [](const Car& car) { return car.passes_s >= 0.0; };
  for (int i = 0; i * step_s < 120.0 && !std::ranges::all_of(queue, passed); ++i) {
    model.Step(step_s, {});
    for (const AgentPose& pose : model.poses()) {
      const auto car = std::find_if(queue.begin(), queue.end(), [&](const Car& c) { return c.id == pose.id; });
      if (car == queue.end() || car->passes_s >= 0.0 || front_of(pose) < kLine_m) continue;
      car->passes_s = step_s * (i + 1) - (front_of(pose) - kLine_m) / std::max(1.0, pose.speed_mps);
    }
  }
  Discharged discharged;
  for (std::size_t n = 0; n < queue.size(); ++n) {
    EXPECT_GT(queue[n].passes_s, 0.0) << n;
    discharged.passes_s.push_back(queue[n].passes_s), discharged.idm_s.push_back(here[n].passes_s);
    if (step_s > 0.01) continue;
    EXPECT_NEAR(queue[n].passes_s, here[n].passes_s, 0.1) << n;
  }
  return discharged;
}

// The usual settings keep 1.5 s, more than drivers at lights do: their queue discharges more slowly. With 1.0 s it is
// within what is measured at lights (1 800 to 2 000 an hour and lane).
TEST(Queue, AQueueDischargesAsTheIdmSays) {
  base::Bytes of_usual, of_brisk;
  const double usual = Discharge(1.5, of_usual).Flow_ph(), brisk = Discharge(1.0, of_brisk).Flow_ph();
  EXPECT_GT(usual, 1400.0);
  EXPECT_LT(usual, 3600.0 / 1.5);
  EXPECT_GT(brisk, 1800.0);
  EXPECT_LT(brisk, 2000.0);
  RecordProperty("usual_per_h", std::to_string(usual));
  RecordProperty("brisk_per_h", std::to_string(brisk));
}

// The time between each car and the one before it, at the time at which it passes.
std::vector<std::pair<double, double>> Headways(const std::vector<double>& passes_s) {
  std::vector<std::pair<double, double>> headways;
  for (std::size_t n = 1; n < passes_s.size(); ++n) headways.emplace_back(passes_s[n], passes_s[n] - passes_s[n - 1]);
  return headways;
}

// SUMO 1.15 discharges 1868 an hour with steps of 1 s and 2235 with 0.1 s (Krauss). The flow that is asked: 1750 to
// 1950 an hour.
TEST(Queue, ItsFlowDoesNotDependOnTheStep) {
  constexpr double kLeast_ph = 1750.0, kMost_ph = 1950.0;
  base::Bytes standing;
  const Discharged fine = Discharge(1.0, standing);
  EXPECT_GT(fine.Flow_ph(), kLeast_ph);
  EXPECT_LT(fine.Flow_ph(), kMost_ph);
  Discharged coarse;
  for (const double step_s : {0.02, 0.05, 0.1}) {
    coarse = Discharge(1.0, standing, step_s);
    EXPECT_NEAR(coarse.Flow_ph(), fine.Flow_ph(), 0.02 * fine.Flow_ph()) << step_s;
  }
  const double end_s = fine.passes_s.back();
  const std::string svg =
      PlotSvg("A queue that starts", "since the way is free, s", "behind the car before, s", 5.0, 0.5,
              {{"steps of 0.1 s", "#d89030", Headways(coarse.passes_s)},
               {"steps of 0.01 s", "#b03020", Headways(fine.passes_s)},
               {"the IDM integrated apart", "#1f5f8b", Headways(fine.idm_s), true},
               {"between 1750 an hour", "#707070", {{0.0, 3600.0 / kLeast_ph}, {end_s, 3600.0 / kLeast_ph}}, true},
               {"and 1950 is asked", "#707070", {{0.0, 3600.0 / kMost_ph}, {end_s, 3600.0 / kMost_ph}}, true}});
  EXPECT_TRUE(WritePicture("traffic_saturation.svg", svg));
}

}  // namespace
}  // namespace rodeira::traffic
