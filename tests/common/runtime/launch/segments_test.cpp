// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/launch/segments.hpp"

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

namespace rodeira::launch {
namespace {

constexpr std::uint32_t kDefault = TransportSettings::kSegmentKib;

constexpr const char* kDrive = R"(rodeira: launch/1
nodes:
  road: {kind: road}
  driver: {kind: input, config: {source: script}}
  ego: {kind: vehicle}
  traffic: {kind: traffic}
  recorder: {kind: recorder}
)";

Launch Drive(const Overrides& overrides = {}) { return Launch::Parse(kDrive, "dir/drive.yaml", overrides).value(); }

// Of each node in a process of its own, and of the clock.
std::map<std::string, std::uint32_t> SegmentsOf(const Launch& launch) {
  std::map<std::string, std::uint32_t> segments{{"clock", SegmentKibOf(launch, {})}};
  for (lockstep::NodeIndex node = 0; node < launch.nodes().size(); ++node)
    segments[launch.node(node).name] = SegmentKibOf(launch, std::span(&node, 1));
  return segments;
}

TEST(Segments, ProcessesThatSendLittleTakeLessSharedMemory) {
  const auto segments = SegmentsOf(Drive());
  ASSERT_EQ(segments.size(), 6u);
  EXPECT_EQ(segments.at("traffic"), kDefault);
  EXPECT_LT(segments.at("ego"), kDefault);
  for (const char* name : {"clock", "road", "driver", "recorder"}) EXPECT_LT(segments.at(name), segments.at("ego"));
}

TEST(Segments, ASharedProcessTakesThatOfItsLargestNode) {
  const Launch launch = Drive();
  const std::vector<lockstep::NodeIndex> small{0, 2}, all{0, 1, 2, 3, 4};
  EXPECT_EQ(SegmentKibOf(launch, small), SegmentsOf(launch).at("ego"));
  EXPECT_EQ(SegmentKibOf(launch, all), kDefault);
}

// Joint forces are some kilobytes a millisecond.
TEST(Segments, OutputsOnRequestTakeTheDefault) {
  EXPECT_EQ(SegmentsOf(Drive({{"nodes.ego.outputs", "[joint_forces]"}})).at("ego"), kDefault);
}

TEST(Segments, AGivenSizeIsTheMostAndALargeOneThatOfAll) {
  const auto little = SegmentsOf(Drive({{"transport", "{kind: shared_memory, segment_kib: 600}"}}));
  for (const auto& [name, segment_kib] : little) EXPECT_EQ(segment_kib, 600u) << name;
  const auto less = SegmentsOf(Drive({{"transport", "{kind: shared_memory, segment_kib: 4096}"}}));
  EXPECT_EQ(less.at("traffic"), 4096u);
  EXPECT_EQ(less.at("road"), SegmentsOf(Drive()).at("road"));
  const auto large = SegmentsOf(Drive({{"transport", "{kind: shared_memory, segment_kib: 16384}"}}));
  for (const auto& [name, segment_kib] : large) EXPECT_EQ(segment_kib, 16384u) << name;
}

// A recorder sends a node that is started again the samples of all others.
TEST(Segments, WithRestartsEveryProcessTakesTheDefault) {
  for (const auto& [name, segment_kib] : SegmentsOf(Drive({{"recovery", "restart"}})))
    EXPECT_EQ(segment_kib, kDefault) << name;
}

}  // namespace
}  // namespace rodeira::launch
