// SPDX-License-Identifier: Apache-2.0
// The empty node fails where it is told to, and is not restored where it saves nothing.
#include <gtest/gtest.h>

#include <cstdlib>
#include <memory>
#include <string>

#include "common/runtime/launch/launch.hpp"
#include "common/runtime/launch/node_context.hpp"
#include "nodes/empty/empty_node.hpp"
#include "nodes/empty/sudden_end.hpp"

namespace rodeira::nodes {
namespace {

class Context final : public launch::NodeContext {
 public:
  using NodeContext::NodeContext;
  ground::Ground& Ground() override { std::abort(); }
  base::Result<launch::WorldSummary> World() override { return base::Failed("run.no_answer", "no world"); }
};

TEST(ContractsDeathTest, AnAssertionFailsAtItsStep) {
  const auto file = config::File::Parse("{end_at_step: 3, end_by: assertion}", "node.yaml");
  ASSERT_TRUE(file.ok()) << file.error().Text();
  const SuddenEnd end = SuddenEnd::Read(file.value().root());
  EXPECT_TRUE(end.At(2).ok());
  EXPECT_DEATH((void)end.At(3), "cause_ != \"assertion\"");
}

TEST(ContractsDeathTest, OnlyANodeThatSavesIsRestored) {
  for (const bool saves : {true, false}) {
    const auto launch =
        launch::Launch::Parse(std::string("rodeira: launch/1\nnodes:\n  a: {kind: empty, config: {saves: ") +
                                  (saves ? "true" : "false") + "}}\n",
                              "launch.yaml");
    ASSERT_TRUE(launch.ok()) << launch.error().Text();
    Context context(launch.value(), 0);
    const auto node = MakeEmptyNode(context);
    ASSERT_TRUE(node.ok()) << node.error().Text();
    base::StateWriter writer;
    node.value()->Save(writer);
    base::StateReader reader(writer.bytes());
    if (saves)
      node.value()->Restore(reader);
    else
      EXPECT_DEATH(node.value()->Restore(reader), "saves_");
  }
}

}  // namespace
}  // namespace rodeira::nodes
