// A closed town that is as full as it may be: it goes on (SUMO 1.15 moves 109 vehicles away there within the same time).
#include <gtest/gtest.h>

#include <cstdlib>

#include "common/traffic/study.hpp"
#include "tests/common/lanes/closed_grid.hpp"

namespace rodeira::traffic {
namespace {

// 45 vehicles a kilometre of lane, streets counted from the middle of a crossing to that of the next, for 1800 s: nobody stands longer than 300 s while there is room at the exit, nobody touches
// anybody, nobody is lost, nobody stands half of the time, and it goes on: so full the flow falls where streets fill one another up in
// a circle (docs/traffic.md), but a quarter of the first third's kilometres are driven in the last.
// RODEIRA_CLOSED_GRID: crossings each way (3; tests/run --endurance takes 10), RODEIRA_CLOSED_GRID_SEED (1).
TEST(ClosedGrid, AsFullAsItMayBeItGoesOn) {
  const char* wish = std::getenv("RODEIRA_CLOSED_GRID");
  const int count = wish == nullptr ? 3 : std::atoi(wish);
  const auto network = lanes::ClosedGrid::Make(count);
  StudySettings settings;
  settings.traffic.vehicles = static_cast<std::uint32_t>(45.0 * lanes::ClosedGrid::Lanes_km(count));
  const char* seed = std::getenv("RODEIRA_CLOSED_GRID_SEED");
  settings.traffic.seed = seed == nullptr ? 1 : std::strtoull(seed, nullptr, 10);
  settings.duration_s = 1800.0;
  settings.step_s = 0.1;
  double driven_m = 0.0, first_m = 0.0, second_m = 0.0;
  const StudyResult r = RunStudy(settings, network, [&](const StudyMoment& moment) {
    driven_m = 0.0;
    for (std::uint32_t id = 0; id < moment.model.vehicles(); ++id) driven_m += moment.model.agent(id).driven_m;
    if (moment.time_s <= 600.0) first_m = driven_m;
    if (moment.time_s <= 1200.0) second_m = driven_m;
  }).value();
  std::string told;
  for (const std::string& incident : r.incidents) told += "\n  " + incident;
  RecordProperty("vehicles", static_cast<int>(settings.traffic.vehicles));
  RecordProperty("driven_km", std::to_string(1e-3 * driven_m));
  RecordProperty("longest_stand_s", std::to_string(r.longest_stand_s));
  RecordProperty("longest_with_room_s", std::to_string(r.longest_with_room_s));
  EXPECT_EQ(r.on_road + r.waiting, settings.traffic.vehicles);
  EXPECT_GT(r.on_road, settings.traffic.vehicles * 9 / 10);
  EXPECT_EQ(r.collisions, 0) << told;
  EXPECT_EQ(r.off_lane, 0) << told;
  // Who comes to rest within a step goes v²/(2 a), up to a dt²/8 less than the mean of both speeds says.
  EXPECT_LT(r.worst_step_m, 1e-3 + r.hardest_mps2 * settings.step_s * settings.step_s / 8.0) << told;
  EXPECT_LT(r.longest_with_room_s, 300.0) << "car " << r.longest_with_room_id << told;
  EXPECT_LT(r.longest_stand_s, 900.0) << "car " << r.longest_stand_id << told;
  EXPECT_GT(driven_m - second_m, 0.25 * first_m) << first_m << " m, " << second_m << " m, " << driven_m << " m";
}

}  // namespace
}  // namespace rodeira::traffic
