// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/launch/process_proposal.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>

#include "tests/launch/rodeira/temporary_folder.hpp"

namespace rodeira::launch {
namespace {

using Names = std::vector<std::string>;
using Proposal = std::vector<Names>;  // of each process its name and its nodes'

Launch With(const std::string& nodes, const Overrides& overrides = {}) {
  const auto launch = Launch::Parse("rodeira: launch/1\nnodes:\n" + nodes, "dir/drive.yaml", overrides);
  EXPECT_TRUE(launch.ok()) << launch.error().Text();
  return launch.value();
}
Launch Drive(const Overrides& overrides = {}) {
  return With(R"(  road: {kind: road}
  driver: {kind: input, config: {source: script}}
  ego: {kind: vehicle}
  traffic: {kind: traffic}
  recorder: {kind: recorder}
)",
              overrides);
}

RunOnOnePc Pc(const Launch& launch, unsigned processors) {
  RunOnOnePc pc{std::vector<lockstep::NodeIndex>(launch.nodes().size()), true, processors};
  std::iota(pc.nodes.begin(), pc.nodes.end(), 0);
  return pc;
}
Proposal ProposalFor(const Launch& launch, const RunOnOnePc& pc) {
  Proposal proposal;
  for (const NodeProcess& process : ProposeProcesses(launch, pc)) {
    Names& names = proposal.emplace_back(Names{process.name});
    for (const lockstep::NodeIndex n : process.nodes) names.push_back(launch.node(n).name);
  }
  return proposal;
}
Proposal ProposalFor(const Launch& launch, unsigned processors) { return ProposalFor(launch, Pc(launch, processors)); }

TEST(ProcessProposal, ThereIsNoneWhereEachProcessHasAProcessor) {
  EXPECT_EQ(ProposalFor(Drive(), 6), Proposal()) << "five nodes and the clock";
  RunOnOnePc pc = Pc(Drive(), 5);
  pc.has_clock = false;
  EXPECT_EQ(ProposalFor(Drive(), pc), Proposal()) << "the clock is on another PC";
  EXPECT_EQ(ProposalText(Drive(), Pc(Drive(), 6)), "");
}

TEST(ProcessProposal, SteppedNodesShareFirstAndTheRecorderLast) {
  const Proposal stepped{{"shared", "driver", "ego", "traffic"}},
      server{{"shared", "road", "driver", "ego", "traffic"}},
      all{{"shared", "road", "driver", "ego", "traffic", "recorder"}};
  EXPECT_EQ(ProposalFor(Drive(), 5), stepped);
  EXPECT_EQ(ProposalFor(Drive(), 4), stepped);
  EXPECT_EQ(ProposalFor(Drive(), 3), server);
  EXPECT_EQ(ProposalFor(Drive(), 2), all);
  EXPECT_EQ(ProposalFor(Drive(), 1), all);
}

TEST(ProcessProposal, NodesOfOtherPcsAreNotCounted) {
  RunOnOnePc pc = Pc(Drive(), 4);
  pc.nodes = {0, 2, 4};
  EXPECT_EQ(ProposalFor(Drive(), pc), Proposal());
  pc.processors = 3;
  EXPECT_EQ(ProposalFor(Drive(), pc), (Proposal{{"shared", "road", "ego"}}));
}

TEST(ProcessProposal, WindowsAndNodesThatAPersonDrivesStayAlone) {
  const Launch launch = With(R"(  road: {kind: road}
  driver: {kind: input, config: {source: keyboard}}
  ego: {kind: vehicle}
  story: {kind: scenario, config: {requests: true}}
  view: {kind: view}
)");
  EXPECT_EQ(ProposalFor(launch, 1), (Proposal{{"shared", "road", "ego"}}));
}

TEST(ProcessProposal, HostsPoliciesAndProcessesOfTheFileStayApart) {
  EXPECT_EQ(ProposalFor(Drive({{"nodes.traffic.host", "left"}, {"nodes.recorder.host", "left"}}), 2),
            (Proposal{{"shared", "road", "driver", "ego"}, {"shared2", "traffic", "recorder"}}));
  EXPECT_EQ(ProposalFor(Drive({{"nodes.ego.recovery", "pause"}}), 2),
            (Proposal{{"shared", "road", "driver", "traffic", "recorder"}}));
  EXPECT_EQ(ProposalFor(Drive({{"nodes.driver.process", "shared"}, {"nodes.ego.process", "shared"}}), 2),
            (Proposal{{"shared_", "road", "traffic", "recorder"}}));
}

TEST(ProcessProposal, AnExternalNodeNeedsItsSharedObject) {
  const cli::TemporaryFolder folder;
  const std::string manifest =
      folder
          .Write("eye.yaml", "rodeira: node/1\nperiod_s: 0.01\ninputs: [{topic: rodeira/vehicle_state, port: state}]\n")
          .string();
  const std::string text =
      "  driver: {kind: input, config: {source: script}}\n  ego: {kind: vehicle}\n  eye: {kind: external, program: "
      "eye, "
      "manifest: " +
      manifest;
  EXPECT_EQ(ProposalFor(With(text + "}\n"), 1), (Proposal{{"shared", "driver", "ego"}}));
  EXPECT_EQ(ProposalFor(With(text + ", library: eye.so}\n"), 1), (Proposal{{"shared", "driver", "ego", "eye"}}));
}

// With its lines at the nodes the launch file is taken, and there is nothing more to propose.
TEST(ProcessProposal, ItsLinesAreThoseOfALaunchFile) {
  const Launch launch = Drive();
  const std::string text = ProposalText(launch, Pc(launch, 3));
  EXPECT_THAT(text, testing::HasSubstr("6 processes run on 3 processors"));
  EXPECT_THAT(text, testing::EndsWith("\n  nodes:\n    road: {process: shared}\n    driver: {process: shared}\n"
                                      "    ego: {process: shared}\n    traffic: {process: shared}"));
  Overrides overrides;
  for (const NodeProcess& process : ProposeProcesses(launch, Pc(launch, 3))) {
    for (const lockstep::NodeIndex n : process.nodes)
      overrides.emplace_back("nodes." + launch.node(n).name + ".process", process.name);
  }
  const Launch followed = Drive(overrides);
  EXPECT_EQ(ProcessesOf(followed).size(), 2u);
  EXPECT_EQ(ProposalText(followed, Pc(followed, 3)), "");
}

}  // namespace
}  // namespace rodeira::launch
