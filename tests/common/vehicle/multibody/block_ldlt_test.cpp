// SPDX-License-Identifier: Apache-2.0
// The sparse factorisation against Eigen's dense one.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <vector>

#include "common/core/base/random.hpp"
#include "common/vehicle/multibody/block_ldlt.hpp"

namespace rodeira::multibody {
namespace {

double Draw(std::uint64_t seed, std::uint64_t k) { return base::RandomUniform({seed, k, 7}, -1.0, 1.0); }

struct Problem {
  BlockLdlt matrix;
  Eigen::MatrixXd dense;
};

// A sum of outer products over small groups of entities, and a diagonal: what constraints and masses make.
Problem Random(std::uint64_t seed, int entities, double diagonal) {
  Problem problem;
  std::vector<int> free;
  for (int i = 0; i < entities; ++i) {
    if (i % 7 != 3) free.push_back(i);
  }
  std::vector<std::vector<int>> groups;
  std::vector<std::pair<int, int>> couples;
  for (int g = 0; g < 2 * entities; ++g) {
    std::vector<int> group;
    for (std::uint64_t k = 0; k < 3; ++k) {
      const auto at =
          static_cast<std::size_t>(base::RandomBits({seed, static_cast<std::uint64_t>(g), k}) % free.size());
      if (std::find(group.begin(), group.end(), free[at]) == group.end()) group.push_back(free[at]);
    }
    for (const int a : group) {
      for (const int b : group) couples.emplace_back(a, b);
    }
    groups.push_back(group);
  }
  problem.matrix.Analyse(entities, free, couples);
  problem.dense = Eigen::MatrixXd::Identity(3 * entities, 3 * entities);
  std::uint64_t k = 0;
  for (const auto& group : groups) {
    std::vector<Triple> gradients;
    Eigen::VectorXd g = Eigen::VectorXd::Zero(3 * entities);
    for (const int entity : group) {
      Triple triple;
      for (int c = 0; c < 3; ++c) g[3 * entity + c] = triple.v[static_cast<std::size_t>(c)] = Draw(seed, k++);
      gradients.push_back(triple);
    }
    AddOuter(OuterPairs(problem.matrix, group), gradients.data(), 2.5, problem.matrix.values().data());
    problem.dense += 2.5 * g * g.transpose();
  }
  for (const int entity : free) {
    Block& block = problem.matrix.values()[static_cast<std::size_t>(problem.matrix.Find(entity, entity).block)];
    for (int c = 0; c < 3; ++c) {
      block.At(c, c) += diagonal;
      problem.dense(3 * entity + c, 3 * entity + c) += diagonal - 1.0;
    }
  }
  return problem;
}

TEST(BlockLdlt, SolvesAsTheDenseOneDoes) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const int entities = 5 + static_cast<int>(3 * seed);
    Problem problem = Random(seed, entities, 0.1);
    Eigen::VectorXd right(3 * entities);
    for (int i = 0; i < right.size(); ++i) right[i] = Draw(seed + 100, static_cast<std::uint64_t>(i));
    const Eigen::VectorXd expected = problem.dense.ldlt().solve(right);
    ASSERT_TRUE(problem.matrix.Factorise());
    Eigen::VectorXd found = expected;  // entities without a row stay as they are
    problem.matrix.Solve(right.data(), found.data());
    for (int i = 0; i < entities; ++i) {
      if (!problem.matrix.IsFree(i)) continue;
      EXPECT_LT((found - expected).segment<3>(3 * i).norm(), 1e-10 * expected.norm()) << seed << " " << i;
    }
  }
}

TEST(BlockLdlt, ASingularOneIsRefused) {
  Problem problem = Random(1, 12, 0.1);
  for (Block& block : problem.matrix.values()) block = {};
  EXPECT_FALSE(problem.matrix.Factorise());
  Problem negative = Random(2, 12, -50.0);
  EXPECT_FALSE(negative.matrix.Factorise());
  Problem broken = Random(3, 12, 0.1);
  broken.matrix.values()[0].At(0, 0) = std::nan("");
  EXPECT_FALSE(broken.matrix.Factorise());
}

}  // namespace
}  // namespace rodeira::multibody
