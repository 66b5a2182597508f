// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/launch/used_topics.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "idl/topics.hpp"

namespace rodeira::launch {
namespace {

using ::testing::ElementsAre;

const Launch& Demo() {
  static const Launch kLaunch =
      Launch::Parse(
          "rodeira: launch/1\nnodes:\n  road: {kind: road}\n  hands: {kind: input}\n  ego: {kind: vehicle}\n"
          "  others: {kind: traffic}\n  recorder: {kind: recorder}\n",
          "launch.yaml")
          .value();
  return kLaunch;
}

idl::TopicSet Of(const std::string& node) { return UsedTopics(Demo(), Demo().roster().Find(node)); }

TEST(UsedTopics, AreTheNodesPortsAndItsProtocol) {
  EXPECT_THAT(Of("road"), ElementsAre("rodeira/grant", "rodeira/ground_reply", "rodeira/ground_request",
                                      "rodeira/report", "rodeira/world_info"));
  EXPECT_THAT(Of("hands"),
              ElementsAre("rodeira/controls", "rodeira/grant", "rodeira/nack", "rodeira/report",
                          "rodeira/retransmissions", "rodeira/sample_batches/", "rodeira/signals_state",
                          "rodeira/snapshot", "rodeira/traffic_state", "rodeira/vehicle_state", "rodeira/window_keys"));
  EXPECT_THAT(Of("recorder"),
              ElementsAre("rodeira/collisions", "rodeira/controls", "rodeira/grant", "rodeira/nack", "rodeira/report",
                          "rodeira/retransmissions", "rodeira/run_log", "rodeira/sample_batches/",
                          "rodeira/signals_state", "rodeira/snapshot", "rodeira/traffic_details",
                          "rodeira/traffic_state", "rodeira/vehicle_state", "rodeira/world_info"));
}

TEST(UsedTopics, OfEveryNodeHaveAType) {
  ASSERT_FALSE(Demo().nodes().empty());
  for (lockstep::NodeIndex n = 0; n < Demo().nodes().size(); ++n) {
    for (const std::string& topic : UsedTopics(Demo(), n)) EXPECT_NE(idl::TypeOf(topic), nullptr) << topic;
  }
}

// A topic of a kind's ports without a source in this launch is not used.
TEST(UsedTopics, AreThoseThatHaveASource) {
  EXPECT_FALSE(Of("ego").contains("rodeira/weather_state"));
  EXPECT_TRUE(Of("ego").contains("rodeira/traffic_state"));
}

}  // namespace
}  // namespace rodeira::launch
