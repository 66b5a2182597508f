// SPDX-License-Identifier: Apache-2.0
// Promises of callers of multibody systems: curves ascend, a step has a length, a block is one that Analyse was told.
#include <gtest/gtest.h>

#include <limits>
#include <utility>
#include <vector>

#include "common/vehicle/multibody/block_ldlt.hpp"
#include "common/vehicle/multibody/bushing.hpp"
#include "common/vehicle/multibody/curve.hpp"
#include "tests/common/vehicle/multibody/run_mechanism.hpp"

namespace rodeira::multibody {
namespace {

TEST(ContractsDeathTest, ACurveHasTwoSamplesThatAscend) {
  EXPECT_DEATH(Curve(std::vector<Curve::Sample>{{0.0, 1.0}}), "samples_.size\\(\\) >= 2");
  EXPECT_DEATH(Curve(std::vector<Curve::Sample>{{1.0, 1.0}, {1.0, 2.0}}), "samples_\\[i\\].x > samples_\\[i - 1\\].x");
  EXPECT_EQ(Curve(std::vector<Curve::Sample>{{0.0, 1.0}, {1.0, 2.0}}).samples().size(), 2U);
}

TEST(ContractsDeathTest, AStepIsLongerThanNothing) {
  Mechanism pendulum = Example("pendulum");
  for (const double dt_s : {0.0, -1e-3, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_DEATH((void)pendulum.system->Step(dt_s), "step.cpp.*dt_s > 0.0");
  EXPECT_TRUE(pendulum.system->Step(1e-4).converged);
}

// Entity 1 is fixed, entities 0 and 3 are no couple.
TEST(ContractsDeathTest, ABlockIsOneThatTheAnalysisKnows) {
  const std::vector<int> free{0, 2, 3};
  const std::vector<std::pair<int, int>> couples{{0, 2}, {2, 3}};
  BlockLdlt matrix;
  matrix.Analyse(4, free, couples);
  EXPECT_GE(matrix.Find(2, 3).block, 0);
  EXPECT_DEATH((void)matrix.Find(0, 1), "p >= 0 && r >= 0");
  EXPECT_DEATH((void)matrix.Find(0, 3), "found != end");
}

TEST(ContractsDeathTest, ABushingToAPointHasNoTorque) {
  Frame frame;
  frame.origin = Single(0);
  for (std::size_t i = 0; i < 3; ++i) frame.axes[i] = Single(static_cast<int>(i) + 1);
  EXPECT_TRUE(Bushing(frame, Single(4), Vector3d::Zero(), {}).Stiffens().size() > 0U);
  for (const BushingSettings& settings : {BushingSettings{.turn_Nmprad = 1.0}, BushingSettings{.turn_Nmsprad = 1.0}})
    EXPECT_DEATH(Bushing(frame, Single(4), Vector3d::Zero(), settings), "settings.turn_Nmprad == 0.0");
}

}  // namespace
}  // namespace rodeira::multibody
