// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/run/silent_nodes.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <optional>
#include <string>

#include "launch/rodeira/run/processes.hpp"

namespace rodeira::cli {
namespace {

using namespace std::chrono_literals;

constexpr const char* kSaid = "silent view node 'view' is silent at step 860";

TEST(SilentNodes, TheFateOfAProcessThatTakesItsTimeToEndIsSaidInstead) {
  auto child = Child::Start("view", {"/bin/sh", "-c", "sleep 0.3; kill -9 $$"}, false);
  ASSERT_TRUE(child.ok()) << child.error().Text();
  SilentNodes silent(
      [&](const std::string& node) -> std::optional<std::string> {
        EXPECT_EQ(node, "view");
        child.value().Poll();
        if (!child.value().ended()) return std::nullopt;
        return "node 'view' is dead";
      },
      30s);
  EXPECT_TRUE(silent.Take(kSaid));
  EXPECT_EQ(silent.Reworded("fault node 'view' is silent at step 860"), "fault node 'view' is dead");
  EXPECT_EQ(silent.Reworded("restart view 1 node 'view' is silent at step 860"), "restart view 1 node 'view' is dead");
  EXPECT_EQ(silent.Reworded("fault node 'road' has failed"), "fault node 'road' has failed");
}

TEST(SilentNodes, OfAProcessThatGoesOnTheClocksSentenceStays) {
  SilentNodes silent([](const std::string&) { return std::nullopt; }, 20ms);
  EXPECT_TRUE(silent.Take(kSaid));
  EXPECT_EQ(silent.Reworded("fault node 'view' is silent at step 860"), "fault node 'view' is silent at step 860");
}

TEST(SilentNodes, OtherLinesAreNotTheirs) {
  SilentNodes silent([](const std::string&) { return std::nullopt; }, 20ms);
  EXPECT_FALSE(silent.Take("fault node 'view' is silent"));
  EXPECT_FALSE(silent.Take("silent"));
  EXPECT_FALSE(silent.Take("silent view"));
}

}  // namespace
}  // namespace rodeira::cli
