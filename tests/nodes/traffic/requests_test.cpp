// SPDX-License-Identifier: Apache-2.0
// Requests of several nodes in one step: one after the other as the inbox has them, each with its answer.
#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "common/core/base/assert.hpp"
#include "common/runtime/launch/launch.hpp"
#include "common/runtime/launch/node_context.hpp"
#include "common/runtime/lockstep/in_process.hpp"
#include "common/runtime/lockstep/inbox.hpp"
#include "common/runtime/lockstep/outbox.hpp"
#include "common/traffic/traffic_model.hpp"
#include "idl/codec.hpp"
#include "idl/messages.hpp"
#include "idl/topics.hpp"
#include "nodes/traffic/traffic_node.hpp"
#include "nodes/traffic/traffic_requests.hpp"
#include "tests/common/driving/driver/test_road.hpp"
#include "tests/launch/rodeira/temporary_folder.hpp"
#include "tests/tree.hpp"

namespace rodeira::nodes {
namespace {

lockstep::Sample SampleOf(lockstep::SourceIndex source, const std::vector<msg::TrafficRequest>& requests) {
  msg::TrafficRequests message;
  message.requests(requests);
  lockstep::Sample sample;
  sample.header.source = source;
  sample.payload = std::make_shared<const base::Bytes>(idl::Encode(message));
  return sample;
}
msg::TrafficRequest Speed(std::uint32_t number, std::uint32_t agent, double speed_mps) {
  msg::TrafficRequest request;
  request.number(number), request.name("speed"), request.agent(agent), request.speed_mps(speed_mps);
  return request;
}

TEST(TrafficRequestsOfNodes, TheLaterOneHoldsAndEachIsAnsweredInItsPlace) {
  traffic::TrafficSettings settings;
  settings.vehicles = 3;
  traffic::TrafficModel model = traffic::TrafficModel::Make(settings, driver::StraightWorld(2000.0, 20.0), {}).value();
  const std::uint32_t agent = model.poses().front().id;
  TrafficRequests requests("others");
  requests.BeginStep();
  ASSERT_TRUE(requests.Take(SampleOf(4, {Speed(7, agent, 3.0), Speed(8, 99, 3.0)}), model).ok());
  ASSERT_TRUE(requests.Take(SampleOf(9, {Speed(1, agent, 4.0)}), model).ok());
  EXPECT_EQ(model.agent(agent).cap_mps, 4.0);
  const auto& answers = requests.answers().answers();
  ASSERT_EQ(answers.size(), 3u);
  for (std::size_t i = 0; i < answers.size(); ++i) {
    EXPECT_EQ(answers[i].source(), i < 2 ? 4u : 9u);
    EXPECT_EQ(answers[i].number(), (std::vector<std::uint32_t>{7, 8, 1})[i]);
    EXPECT_EQ(answers[i].agent(), i == 1 ? 99u : agent);
    EXPECT_EQ(answers[i].refused(), i == 1 ? 1u : 0u);
    EXPECT_EQ(answers[i].error_id(), i == 1 ? "traffic.unknown_agent" : "");
    EXPECT_EQ(answers[i].sentence().empty(), i != 1);
  }
  requests.BeginStep();
  EXPECT_TRUE(requests.answers().answers().empty());
}

using Requests = std::map<lockstep::Step, std::vector<msg::TrafficRequest>>;  // by the step at which they are valid

class Requester final : public lockstep::Node {
 public:
  explicit Requester(Requests requests) : requests_(std::move(requests)) {}
  base::Status Initialise(lockstep::Outbox& outbox) override {
    outbox.Put(idl::topics::kTrafficRequests, idl::Encode(msg::TrafficRequests()));
    return {};
  }
  base::Status Step(const lockstep::StepInfo& step, const lockstep::Inbox&, lockstep::Outbox& outbox) override {
    msg::TrafficRequests out;
    if (const auto at = requests_.find(step.output_valid); at != requests_.end()) out.requests(at->second);
    outbox.Put(idl::topics::kTrafficRequests, idl::Encode(out));
    return {};
  }
  void Save(base::StateWriter&) const override {}
  void Restore(base::StateReader&) override {}

 private:
  Requests requests_;
};

class WithoutGround final : public launch::NodeContext {
 public:
  using NodeContext::NodeContext;
  ground::Ground& Ground() override { RODEIRA_ASSERT(false); }
  base::Result<launch::WorldSummary> World() override { return launch::WorldSummary(); }
};

// A run of traffic and two nodes that ask.
struct Ran {
  std::vector<msg::TrafficAnswer> answers;
  std::map<lockstep::Step, std::map<std::uint32_t, msg::TrafficAgent>> traffic;
  std::map<lockstep::Step, base::Digest> states;  // digests of the traffic's node
  lockstep::SourceIndex first = 0, second = 0;
};
// Traffic at a crossing with lights, and two nodes that ask ten times a second.
launch::Launch LaunchOf(const cli::TemporaryFolder& folder) {
  folder.Write("control.yaml", "rodeira: node/1\nperiod_s: 0.1\noutputs: [{topic: rodeira/traffic_requests}]\n");
  const std::string ask = "{kind: external, program: ask, manifest: control.yaml}\n";
  const auto file = folder.Write("run.yaml", "rodeira: launch/1\nworld: " + SourceDir() +
                                                 "/configs/worlds/lights.yaml\nseed: 5\nnodes:\n  others: {kind: "
                                                 "traffic, config: {vehicles: 10, scripted: [car]}, outputs: "
                                                 "[traffic_answers]}\n  a: " +
                                                 ask + "  b: " + ask);
  auto launch = launch::Launch::Load(file, {});
  EXPECT_TRUE(launch.ok()) << (launch.ok() ? "" : launch.error().Text());
  return std::move(launch).value();
}

Ran Drive(const Requests& first, const Requests& second, lockstep::Step last) {
  const cli::TemporaryFolder folder;
  Ran ran;
  const launch::Launch launch = LaunchOf(folder);
  const lockstep::Roster& roster = launch.roster();
  WithoutGround context(launch, roster.Find("others"));
  const auto traffic = MakeTrafficNode(context);
  EXPECT_TRUE(traffic.ok()) << (traffic.ok() ? "" : traffic.error().Text());
  if (!traffic) return ran;
  Requester a(first), b(second);
  std::vector<lockstep::Node*> nodes(roster.nodes().size());
  nodes[roster.Find("others")] = traffic.value().get();
  nodes[roster.Find("a")] = &a, nodes[roster.Find("b")] = &b;
  ran.first = roster.node(roster.Find("a")).outputs[0], ran.second = roster.node(roster.Find("b")).outputs[0];
  lockstep::InProcessSettings settings;
  settings.last_step = last;
  settings.on_sample = [&](const lockstep::Sample& sample) {
    const std::string& topic = roster.source(sample.source()).topic;
    if (topic == idl::topics::kTrafficAnswers) {
      const auto answers = idl::Decode<msg::TrafficAnswers>(*sample.payload).value();
      ran.answers.insert(ran.answers.end(), answers.answers().begin(), answers.answers().end());
    } else if (topic == idl::topics::kTrafficState) {
      const auto state = idl::Decode<msg::TrafficState>(*sample.payload).value();
      for (const msg::TrafficAgent& agent : state.agents()) ran.traffic[sample.valid()][agent.id()] = agent;
      ran.states[sample.valid()] = sample.header.state_digest;
    }
  };
  const auto outcome = lockstep::RunThreaded(roster, nodes, settings);
  EXPECT_TRUE(outcome.ok) << outcome.fault;
  return ran;
}

// Both ask for a speed of the same vehicle at the same step: that of the second one in the roster holds. What is added
// is published from the next period on.
TEST(TrafficRequestsOfNodes, TwoNodesInARunAreObeyedInTheRostersOrder) {
  msg::TrafficRequest add;
  add.number(3), add.name("add"), add.choice("car"), add.lane("cross/1:-1"), add.station_m(60.0), add.speed_mps(9.0);
  msg::TrafficRequest unknown = Speed(4, 0, 3.0);
  unknown.name("speeed");
  const Requests first{{1000, {Speed(1, 0, 5.0), add, unknown}}}, second{{1000, {Speed(1, 0, 3.0)}}};
  const Ran ran = Drive(first, second, 15'000);
  ASSERT_EQ(ran.answers.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(ran.answers[i].source(), i < 3 ? ran.first : ran.second) << i;
  EXPECT_EQ(ran.answers[2].error_id(), "traffic.unknown_request");
  EXPECT_EQ(ran.answers[1].refused(), 0u) << ran.answers[1].sentence();
  EXPECT_EQ(ran.answers[1].agent(), 10u);
  EXPECT_FALSE(ran.traffic.at(1000).contains(10));
  ASSERT_TRUE(ran.traffic.at(1010).contains(10));
  EXPECT_EQ(ran.traffic.at(1010).at(10).speed_mps(), 9.0);
  EXPECT_LT(ran.traffic.at(12'000).at(0).speed_mps(), 3.05);
  const Ran again = Drive(first, second, 15'000);
  EXPECT_EQ(again.states, ran.states);
}

TEST(TrafficRequestsOfNodes, RefusedRequestsChangeNoState) {
  msg::TrafficRequest light, lane;
  light.name("light"), light.light("nowhere"), light.choice("red"), light.duration_s(5.0);
  lane.name("change_lane"), lane.agent(0), lane.lane("left");
  const Ran ran = Drive({{1000, {Speed(1, 99, 3.0), light}}, {2000, {lane, Speed(1, 0, -3.0)}}}, {}, 5000);
  ASSERT_EQ(ran.answers.size(), 4u);
  for (const msg::TrafficAnswer& answer : ran.answers) EXPECT_EQ(answer.refused(), 1u) << answer.error_id();
  const Ran without = Drive({}, {}, 5000);
  EXPECT_TRUE(without.answers.empty());
  EXPECT_GT(without.states.size(), 400u);
  EXPECT_EQ(ran.states, without.states);
}

// Snapshots of a recording are such states: from one within a held speed, a route, a held light and a vehicle that has
// been added, the node goes on with the same bits.
TEST(TrafficRequestsOfNodes, ANodeRestoredAmidRequestsGoesOnWithTheSameBits) {
  const cli::TemporaryFolder folder;
  const launch::Launch launch = LaunchOf(folder);
  const lockstep::NodeIndex index = launch.roster().Find("others");
  WithoutGround one(launch, index), other(launch, index);
  const auto node = MakeTrafficNode(one).value(), restored = MakeTrafficNode(other).value();
  lockstep::Outbox outbox(launch.roster(), index);
  msg::TrafficRequest add, light, route;
  add.name("add"), add.choice("car"), add.lane("cross/1:-1"), add.station_m(60.0), add.speed_mps(9.0);
  add.roads({"main/2"});
  light.name("light"), light.light("centre-cross"), light.choice("red"), light.duration_s(9.0);
  route.name("route"), route.agent(10), route.roads({"cross/2"});
  const Requests asked{{100, {add, Speed(1, 0, 4.0), light}}, {1300, {route}}, {2000, {Speed(2, 10, 0.0)}}};
  const auto step = [&](lockstep::Node& of, lockstep::Step at) {
    std::vector<lockstep::Sample> samples;
    if (asked.contains(at)) samples.push_back(SampleOf(3, asked.at(at)));
    const lockstep::StepInfo info{at, at * 1'000'000, 10, 0.01, at + 10};
    ASSERT_TRUE(of.Step(info, lockstep::Inbox({{idl::topics::kTrafficRequests, samples}}), outbox).ok());
    outbox.Take(at + 10, 0, 0);
  };
  const auto digest = [](const lockstep::Node& of) {
    base::StateWriter writer;
    of.Save(writer);
    return writer.digest();
  };
  for (lockstep::Step at = 0; at < 1000; at += 10) step(*node, at);
  base::StateWriter state;
  node->Save(state);
  base::StateReader reader(state.bytes());
  restored->Restore(reader);
  ASSERT_TRUE(reader.Finish().ok());
  for (lockstep::Step at = 1000; at < 30'000; at += 10) {
    step(*node, at), step(*restored, at);
    ASSERT_EQ(digest(*restored), digest(*node)) << at;
  }
}

}  // namespace
}  // namespace rodeira::nodes
