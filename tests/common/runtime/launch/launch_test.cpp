// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/launch/launch.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "common/runtime/launch/launch_schema.hpp"
#include "tests/common/core/config/every_key.hpp"
#include "tests/names.hpp"
#include "tests/tree.hpp"

namespace rodeira::launch {
namespace {

constexpr const char* kDrive = R"(rodeira: launch/1
world: ../worlds/plane.yaml
seed: 7
nodes:
  road: {kind: road}
  driver: {kind: input, config: {source: script}}
  ego: {kind: vehicle, config: {vehicle: car.yaml}}
  traffic: {kind: traffic, period_s: 0.02, delay_s: 0.04}
  recorder: {kind: recorder}
)";

base::Error ErrorOf(const std::string& text, const Overrides& overrides = {}) {
  const auto launch = Launch::Parse(text, "dir/drive.yaml", overrides);
  return launch.ok() ? base::Error() : launch.error();
}
std::string Refusal(const std::string& text, const Overrides& overrides = {}) {
  return ErrorOf(text, overrides).Text();
}

TEST(Launch, WiresAllNodesByTopic) {
  const Launch launch = Launch::Parse(kDrive, "dir/drive.yaml").value();
  const auto& roster = launch.roster();
  EXPECT_EQ(launch.world(), "worlds/plane.yaml");
  EXPECT_EQ(launch.seed(), 7u);
  EXPECT_EQ(roster.base_step_ns(), 1'000'000);
  const auto& ego = roster.node(roster.Find("ego"));
  EXPECT_EQ(ego.period, 1);
  ASSERT_EQ(ego.inputs.size(), 2u);
  EXPECT_EQ(roster.SourceName(ego.inputs[0].sources[0]), "driver.rodeira/controls");
  EXPECT_EQ(roster.SourceName(ego.inputs[1].sources[0]), "traffic.rodeira/traffic_state");
  const auto& traffic = roster.node(roster.Find("traffic"));
  EXPECT_EQ(traffic.period, 20);
  EXPECT_EQ(traffic.delay, 40);
  EXPECT_EQ(roster.node(roster.Find("recorder")).inputs.size(), 7u) << "six streams of samples, and the snapshots";
  EXPECT_EQ(roster.node(roster.Find("road")).role, lockstep::Role::kService);
  EXPECT_EQ(launch.node(1).config->OptionalChild("config").Text("source"), "script");
}

TEST(Launch, TheSameFileGivesTheSameHashAndAnOverrideAnother) {
  const auto hash = [](const Overrides& overrides) {
    return Launch::Parse(kDrive, "x.yaml", overrides).value().roster().hash();
  };
  EXPECT_EQ(hash({}), hash({}));
  EXPECT_NE(hash({}), hash({{"nodes.traffic.period_s", "0.01"}}));
}

// A node that begins at a snapshot must find the recorder beginning there too: otherwise it waits for an earlier one,
// for ever.
TEST(Launch, SnapshotsAreTakenWhereAllPeriodsMeetTheRecordersToo) {
  const auto every = [](const Overrides& overrides) {
    const Launch launch = Launch::Parse(kDrive, "x.yaml", overrides).value();
    const auto& roster = launch.roster();
    return roster.source(*roster.node(roster.Find("ego")).snapshots).period;
  };
  EXPECT_EQ(every({}), 1000);
  EXPECT_EQ(every({{"snapshot_every_s", "0.01"}, {"nodes.recorder.period_s", "0.05"}}), 100)
      << "of 1, 20, 50 and the driver's 10 steps";
  EXPECT_EQ(every({{"snapshot_every_s", "0.01"}, {"nodes.recorder.period_s", "0.03"}}), 60);
  EXPECT_EQ(every({{"snapshot_every_s", "1"}, {"nodes.recorder.period_s", "0.03"}}), 1020);
}

TEST(Launch, ANodeOfNoKindIsNotThere) {
  std::string without = kDrive;
  without.resize(without.find("  recorder:"));
  const Launch launch =
      Launch::Parse(kDrive, "x.yaml", {{"nodes.recorder.kind", "none"}, {"nodes.recorder.config.file", "a.mcap"}})
          .value();
  EXPECT_EQ(launch.roster().hash(), Launch::Parse(without, "x.yaml").value().roster().hash());
  EXPECT_EQ(launch.nodes().size(), 4u);
  EXPECT_EQ(Refusal(kDrive, {{"nodes.driver.kind", "none"}}).substr(0, 61),
            "dir/drive.yaml:7: node 'ego' needs 'controls', but no node pu");
}

TEST(Launch, TransportIsAWordOrAMapping) {
  const auto of = [](const char* value) {
    return Launch::Parse(kDrive, "x.yaml", {{"transport", value}}).value().transport_settings();
  };
  EXPECT_EQ(Launch::Parse(kDrive, "x.yaml").value().transport(), Transport::kSharedMemory);
  EXPECT_EQ(of("udp").kind, Transport::kUdp);
  EXPECT_FALSE(of("shared_memory").has_observers);
  EXPECT_EQ(of("{observers: udp}").kind, Transport::kSharedMemory);
  EXPECT_TRUE(of("{observers: udp}").has_observers);
  EXPECT_EQ(of("{segment_kib: 1024}").segment_kib, 1024u);
  TransportSettings settings{Transport::kSharedMemory, true, 2048};
  EXPECT_EQ(TransportText(of(TransportText(settings).c_str())), TransportText(settings));
  settings.kind = Transport::kUdp;
  EXPECT_EQ(TransportText(of(TransportText(settings).c_str())), TransportText(settings));
  EXPECT_EQ(Refusal(kDrive, {{"transport", "{observers: upd}"}}),
            "--set transport={observers: upd}: 'transport.observers' is 'upd'; did you mean 'udp'?");
  EXPECT_EQ(
      Refusal(kDrive, {{"transport", "{kind: udp, segment_kib: 1024}"}}),
      "--set transport={kind: udp, segment_kib: 1024}: unknown key 'transport.segment_kib'; known are kind, observers");
  EXPECT_EQ(Refusal(kDrive, {{"transport", "upd"}}), "--set transport=upd: 'transport' is 'upd'; did you mean 'udp'?");
}

// A topic that is published on request has a source only where the launch file names it; the recorder then takes it.
TEST(Launch, PublishesOnRequestWhatOutputsNames) {
  const auto inputs_of_recorder = [](const Launch& launch) {
    return launch.roster().node(launch.roster().Find("recorder")).inputs;
  };
  const auto takes_forces = [](const auto& port) { return port.topic == "rodeira/joint_forces"; };
  const Launch without = Launch::Parse(kDrive, "dir/drive.yaml").value();
  EXPECT_TRUE(std::ranges::none_of(inputs_of_recorder(without), takes_forces));
  EXPECT_EQ(without.roster().node(without.roster().Find("ego")).outputs.size(), 2u);
  const auto with = Launch::Parse(kDrive, "dir/drive.yaml", {{"nodes.ego.outputs", "[joint_forces, joint_forces]"}});
  ASSERT_TRUE(with) << with.error().Text();
  const auto& ego = with.value().roster().node(with.value().roster().Find("ego"));
  ASSERT_EQ(ego.outputs.size(), 3u);
  EXPECT_EQ(with.value().roster().SourceName(ego.outputs[2]), "ego.rodeira/joint_forces");
  EXPECT_TRUE(std::ranges::any_of(inputs_of_recorder(with.value()), takes_forces));
  const auto id_of = [](const char* key, const char* value) {
    const auto launch = Launch::Parse(kDrive, "dir/drive.yaml", {{key, value}});
    return std::string(launch.ok() ? std::string_view() : launch.error().id.text());
  };
  EXPECT_EQ(id_of("nodes.ego.outputs", "[joint_force]"), "launch.unknown_output");
  EXPECT_EQ(id_of("nodes.traffic.outputs", "[joint_forces]"), "launch.unknown_output");
  EXPECT_NE(Refusal(kDrive, {{"nodes.ego.outputs", "[joint_force]"}}).find("joint_forces"), std::string::npos);
}

TEST(Launch, RefusesWhatIsWrongWithPlaceAndNearestName) {
  const std::string text = kDrive;
  EXPECT_EQ(Refusal(text + "  x: {kind: vehcile}\n"),
            "dir/drive.yaml:10: 'nodes.x.kind' is 'vehcile'; did you mean 'vehicle'?");
  EXPECT_EQ(Refusal(text + "  b: {kind: input}\n"),
            "dir/drive.yaml:7: node 'ego' takes 'controls' from one node, but 2 publish it (driver, b); say which "
            "under 'inputs'");
  EXPECT_THAT(
      ErrorOf(text, {{"nodes.ego.inputs.controls", "[drivr]"}}),
      IsError("launch.unknown_node", "dir/drive.yaml: … node 'ego', input 'rodeira/controls': … 'drivr' … 'driver'"));
  EXPECT_EQ(Refusal(text + "sed: 4\n"), "dir/drive.yaml:10: unknown key 'sed'; did you mean 'seed'?");
  EXPECT_EQ(Refusal(text, {{"nodes.traffic.period_s", "0.0105"}}),
            "--set nodes.traffic.period_s=0.0105: 'period_s' is 0.0105 s; a multiple of the base step (0.001 s) was "
            "expected");
  EXPECT_EQ(Refusal("rodeira: launch/2\nnodes: {road: {kind: road}}\n"),
            "dir/drive.yaml:1: 'rodeira' is 'launch/2'; did you mean 'launch/1'?");
  EXPECT_THAT(ErrorOf("rodeira: launch/1\n"), IsError("config.missing_key", "dir/drive.yaml:1: … 'nodes'"));
  EXPECT_EQ(Refusal("rodeira: launch/1\nnodes: {ego: {kind: vehicle}}\n"),
            "dir/drive.yaml:2: node 'ego' needs 'controls', but no node publishes it");
  EXPECT_EQ(Refusal(text + "pace: rael\n"),
            "dir/drive.yaml:10: 'pace' is 'rael'; max, real or a positive number was expected");
  EXPECT_EQ(Refusal(text + "pace: -1\n"),
            "dir/drive.yaml:10: 'pace' is '-1'; max, real or a positive number was expected");
  EXPECT_THAT(ErrorOf(text, {{"base_step_s", "fast"}}),
              IsError("config.wrong_type", "--set base_step_s=fast: … 'base_step_s' … 'fast'"));
}

// A key of a node's own that is said at the top is told where it stands.
TEST(Launch, AnOverrideAtTheTopIsRefusedWithTheNodeThatHasTheKey) {
  const char* text =
      "rodeira: launch/1\nnodes:\n  traffic: {kind: traffic, config: {vehicles: 3}}\n"
      "  ego: {kind: vehicle, config: {vehicle: a.yaml}}\n  driver: {kind: input}\n";
  EXPECT_THAT(ErrorOf(text, {{"vehicles", "4"}}),
              IsError("config.unknown_key", "--set vehicles=4: … 'nodes.traffic.config.vehicles'"));
  EXPECT_THAT(ErrorOf(text, {{"vehicle", "prototype"}}),
              IsError("config.wrong_type",
                      "--set vehicle=prototype: … mapping … 'nodes.ego.config.vehicle' … 'vehicle.model'"));
  EXPECT_THAT(ErrorOf(text, {{"wrld", "a.yaml"}}), IsError("config.unknown_key", "--set wrld=a.yaml: … 'world'"));
  EXPECT_TRUE(Launch::Parse(text, "a.yaml", {{"vehicle", "{model: ode}"}}).ok());
}

// A misspelt node is not a new one without a kind.
TEST(Launch, AnOverrideOfNoNodeIsRefusedWithTheNearest) {
  EXPECT_THAT(ErrorOf(kDrive, {{"nodes.eog.period_s", "0.01"}}),
              IsError("launch.unknown_node", "--set nodes.eog.period_s=0.01: … 'eog' … 'ego'"));
  EXPECT_THAT(ErrorOf(kDrive, {{"nodes.eog.config.vehicle", "~"}}), IsError("launch.unknown_node", "'eog' … 'ego'"));
  EXPECT_THAT(ErrorOf(kDrive, {{"nodes.ego.config", "{vehicle: a.yaml}"}, {"nodes.ego.vehicle", "b.yaml"}}),
              IsError("config.unknown_key", "'nodes.ego.vehicle' … 'nodes.ego.config.vehicle'"));
  EXPECT_TRUE(Launch::Parse(kDrive, "a.yaml", {{"nodes.new.period_s", "0.01"}, {"nodes.new.kind", "empty"}}).ok());
}

// A generated file for each declared key. A kind of node needs others; a kind of discovery needs UDP and an address.
// The smallest number over 0 is no multiple of the base step.
TEST(Launch, EveryDeclaredKeyKeepsItsTypeAndBounds) {
  const auto problem = [](const std::string& text) -> std::string {
    const auto launch = Launch::Parse(text, SourceDir() + "/examples/own_node/launch.yaml");
    return launch ? "" : launch.error().Text();
  };
  const auto nodes = [](const std::string& text) { return config::Values{{"nodes", text}}; };
  const config::Values udp{{"transport", "udp"}}, peers{{"transport", "udp"}, {"discovery.kind", "peers"}},
      server{{"transport", "udp"}, {"discovery.kind", "server"}};
  config::Values one_peer = peers, port = server;
  one_peer["discovery.addresses"] = "[10.0.0.1]";
  port["discovery.address"] = "10.0.0.1";
  const config::Values external{{"nodes.NAME.kind", "external"}};
  config::ExpectEveryKey(
      LaunchSchema(), problem,
      {{"base_step_s", {{"nodes.NAME.period_s", "1"}, {"snapshot_every_s", "1"}}},
       {"transport.segment_kib", {{"transport.kind", "shared_memory"}}},
       {"discovery.kind=peers", one_peer},
       {"discovery.kind=server", port},
       {"discovery.interface", udp},
       {"discovery.addresses", peers},
       {"discovery.addresses[]", peers},
       {"discovery.participants", one_peer},
       {"discovery.address", server},
       {"discovery.port", port},
       {"nodes.NAME.kind=vehicle", nodes("{a: {kind: vehicle}, b: {kind: input}}")},
       {"nodes.NAME.kind=measures", nodes("{a: {kind: measures}, b: {kind: vehicle}, c: {kind: input}}")},
       {"nodes.NAME.kind=external",
        nodes("{a: {kind: external, program: eye, manifest: eye.yaml}, b: {kind: vehicle}, c: {kind: input}}")},
       {"nodes.NAME.outputs[]=joint_forces", nodes("{a: {kind: vehicle, outputs: [joint_forces]}, b: {kind: input}}")},
       {"nodes.NAME.program", external},
       {"nodes.NAME.manifest", {{"nodes.NAME.kind", "external"}, {"nodes.NAME.program", "eye"}}},
       {"nodes.NAME.library",
        {{"nodes.NAME.kind", "external"}, {"nodes.NAME.program", "eye"}, {"nodes.NAME.manifest", "eye.yaml"}}}},
      {"snapshot_every_s", "nodes.NAME.period_s", "nodes.NAME.delay_s"});
}

}  // namespace
}  // namespace rodeira::launch
