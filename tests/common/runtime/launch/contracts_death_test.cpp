// SPDX-License-Identifier: Apache-2.0
// Promises of shared objects with nodes: the entry point gives a node or an error.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "common/runtime/launch/node_library.hpp"
#include "tests/tree.hpp"

namespace rodeira::launch {
namespace {

class Context final : public NodeContext {
 public:
  using NodeContext::NodeContext;
  ground::Ground& Ground() override { std::abort(); }
  base::Result<WorldSummary> World() override { return base::Failed("run.no_answer", "no world"); }
};

TEST(ContractsDeathTest, TheEntryPointOfASharedObjectGivesANodeOrAnError) {
  ASSERT_EQ(::setenv("RODEIRA_TEST_NODE_BUILD", NodeBuild().c_str(), 1), 0);
  const auto factory = LoadNodeLibrary(std::filesystem::path(BinaryDir()) / "bin/rodeira-test-makes-nothing.so");
  ASSERT_TRUE(factory.ok()) << factory.error().Text();
  const auto launch = Launch::Parse("rodeira: launch/1\nnodes:\n  a: {kind: empty}\n", "launch.yaml");
  ASSERT_TRUE(launch.ok()) << launch.error().Text();
  Context context(launch.value(), 0);
  EXPECT_DEATH((void)factory.value()(context), "made\\.has_value\\(\\)");
}

}  // namespace
}  // namespace rodeira::launch
