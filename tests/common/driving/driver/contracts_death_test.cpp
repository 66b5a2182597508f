// SPDX-License-Identifier: Apache-2.0
// Promises of callers of the driver: a route has legs, a search has points, a step has a length.
#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "common/driving/driver/autopilot.hpp"
#include "common/driving/driver/point_boxes.hpp"
#include "common/driving/driver/route_path.hpp"
#include "tests/common/world/opendrive/sample.hpp"

namespace rodeira::driver {
namespace {

TEST(ContractsDeathTest, ARouteHasLegs) {
  const auto network = opendrive::MustRead(opendrive::Document(opendrive::RoadText().Text()));
  EXPECT_GT(RoutePath(*network, StraightOn(*network, {0, 0, -1}, 1000.0)).length_m(), 0.0);
  EXPECT_DEATH(RoutePath(*network, {}), "!legs_.empty\\(\\)");
}

TEST(ContractsDeathTest, ASearchHasPoints) {
  EXPECT_DEATH(PointBoxes(std::vector<Eigen::Vector3d>()), "!points_W_.empty\\(\\)");
}

TEST(ContractsDeathTest, AStepIsLongerThanNothing) {
  const auto network = opendrive::MustRead(opendrive::Document(opendrive::RoadText().Text()));
  Autopilot autopilot(AutopilotSettings(),
                      std::make_unique<RoutePath>(*network, StraightOn(*network, {0, 0, -1}, 1000.0)));
  const dynamics::VehicleState own;
  const dynamics::VehicleDimensions dimensions;
  for (const double dt_s : {0.0, -0.01})
    EXPECT_DEATH((void)autopilot.Step({own, dimensions, {}}, dt_s), "autopilot.cpp.*dt_s > 0.0");
}

}  // namespace
}  // namespace rodeira::driver
