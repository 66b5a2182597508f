// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/launch/shared_process.hpp"

#include <gtest/gtest.h>

#include "tests/launch/rodeira/temporary_folder.hpp"

namespace rodeira::launch {
namespace {

using lockstep::Policy;
using Nodes = std::vector<lockstep::NodeIndex>;

constexpr const char* kDrive = R"(rodeira: launch/1
nodes:
  road: {kind: road}
  driver: {kind: input, config: {source: script}}
  ego: {kind: vehicle}
  traffic: {kind: traffic}
  recorder: {kind: recorder}
)";

Launch Drive(const Overrides& overrides) { return Launch::Parse(kDrive, "dir/drive.yaml", overrides).value(); }
base::Error Refused(const std::string& text, const Overrides& overrides = {}) {
  const auto launch = Launch::Parse(text, "dir/drive.yaml", overrides);
  EXPECT_FALSE(launch.ok());
  return launch.ok() ? base::Error{} : launch.error();
}

TEST(SharedProcess, NodesOfOneNameAreOneProcessAndTheRosterStays) {
  const Launch launch =
      Drive({{"nodes.traffic.process", "cars"}, {"nodes.driver.process", "cars"}, {"nodes.road.process", "other"}});
  const std::vector<NodeProcess> processes = ProcessesOf(launch);
  ASSERT_EQ(processes.size(), 4u);
  EXPECT_EQ(processes[0].name, "other");
  EXPECT_EQ(processes[0].nodes, Nodes{0});
  EXPECT_TRUE(processes[0].is_shared());
  EXPECT_EQ(processes[1].name, "cars");
  EXPECT_EQ(processes[1].nodes, (Nodes{1, 3}));
  EXPECT_FALSE(processes[2].is_shared());
  EXPECT_EQ(processes[2].nodes, Nodes{2});
  EXPECT_EQ(processes[3].nodes, Nodes{4});
  EXPECT_EQ(NodesOfProcess(launch, "cars"), (Nodes{1, 3}));
  EXPECT_EQ(NodesOfProcess(launch, ""), Nodes());
  EXPECT_EQ(NodesBeside(launch, 3), (Nodes{1, 3}));
  EXPECT_EQ(NodesBeside(launch, 2), Nodes{2});
  EXPECT_EQ(launch.roster().hash(), Drive({}).roster().hash()) << "digests are those of separate processes";
}

TEST(SharedProcess, OnTwoHostsItIsRefused) {
  const base::Error error = Refused(kDrive, {{"nodes.driver.process", "cars"},
                                             {"nodes.driver.host", "left"},
                                             {"nodes.ego.process", "cars"},
                                             {"nodes.ego.host", "right"}});
  EXPECT_EQ(error.id.text(), "launch.process_on_two_hosts") << error.Text();
  for (const char* part : {"'cars'", "'driver'", "'left'", "'ego'", "'right'"})
    EXPECT_NE(error.Text().find(part), std::string::npos) << error.Text();
  EXPECT_EQ(Drive({{"nodes.driver.process", "cars"},
                   {"nodes.driver.host", "left"},
                   {"nodes.ego.process", "cars"},
                   {"nodes.ego.host", "left"}})
                .node(1)
                .process,
            "cars");
}

TEST(SharedProcess, AnExternalNodeWithoutSharedObjectIsRefused) {
  const cli::TemporaryFolder folder;
  const std::string manifest =
      folder
          .Write("eye.yaml", "rodeira: node/1\nperiod_s: 0.01\ninputs: [{topic: rodeira/vehicle_state, port: state}]\n")
          .string();
  const std::string text = kDrive + ("  eye: {kind: external, program: eye, process: cars, manifest: " + manifest);
  const base::Error error = Refused(text + "}\n");
  EXPECT_EQ(error.id.text(), "launch.process_without_library") << error.Text();
  EXPECT_NE(error.Text().find("drive.yaml:8"), std::string::npos) << error.Text();
  const auto launch = Launch::Parse(text + ", library: eye.so}\n", "dir/drive.yaml");
  EXPECT_TRUE(launch.ok()) << launch.error().Text();
}

// Nodes of one process are lost together, so what follows is one for all.
TEST(SharedProcess, AllNodesHaveTheStrictestPolicy) {
  const auto policies = [](Overrides overrides) {
    overrides.insert(overrides.end(), {{"nodes.driver.process", "cars"}, {"nodes.ego.process", "cars"}});
    return Drive(overrides).policies();
  };
  EXPECT_EQ(policies({{"recovery", "restart"}}), std::vector<Policy>(5, Policy::kRestart));
  EXPECT_EQ(policies({{"recovery", "restart"}, {"nodes.ego.recovery", "pause"}}),
            (std::vector{Policy::kRestart, Policy::kPause, Policy::kPause, Policy::kRestart, Policy::kRestart}));
  EXPECT_EQ(policies({{"recovery", "restart"}, {"nodes.driver.config.source", "keyboard"}}),
            (std::vector{Policy::kRestart, Policy::kStop, Policy::kStop, Policy::kRestart, Policy::kRestart}))
      << "what a person does cannot be computed again";
}

TEST(SharedProcess, APolicyThatTheProcessCannotHaveIsRefused) {
  const base::Error error = Refused(
      kDrive, {{"nodes.driver.process", "cars"}, {"nodes.ego.process", "cars"}, {"nodes.driver.recovery", "restart"}});
  EXPECT_EQ(error.id.text(), "launch.process_with_two_policies") << error.Text();
  EXPECT_NE(error.Text().find("'ego'"), std::string::npos) << error.Text();
}

}  // namespace
}  // namespace rodeira::launch
