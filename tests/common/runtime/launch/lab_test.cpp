// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/launch/lab.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/runtime/launch/agreement.hpp"
#include "common/runtime/launch/lab_schema.hpp"
#include "tests/common/core/config/every_key.hpp"
#include "tests/names.hpp"

namespace rodeira::launch {
namespace {

const std::string kLab = R"(rodeira: lab/1
domain: 42
run: rig
clock: right
discovery: {kind: peers}
hosts:
  left: {address: 192.168.10.1}
  right: {address: 192.168.10.2}
)";

const std::string kLaunch = R"(rodeira: launch/1
nodes:
  a: {kind: empty, host: left}
  b: {kind: empty}
)";

base::Error ErrorOf(const std::string& text) {
  const auto lab = Lab::Parse(text, "dir/rig.yaml");
  return lab.ok() ? base::Error() : lab.error();
}
std::string Refusal(const std::string& text) { return ErrorOf(text).Text(); }
std::string Changed(const std::string& old_text, const std::string& new_text) {
  std::string text = kLab;
  return text.replace(text.find(old_text), old_text.size(), new_text);
}
// The launch file as a process on this host reads it.
Discovery On(const std::string& host, const std::string& lab_text) {
  const Lab lab = Lab::Parse(lab_text, "rig.yaml").value();
  const auto launch = Launch::Parse(kLaunch, "empty.yaml", lab.For(lab.Host(host).value()));
  EXPECT_TRUE(launch.ok()) << launch.error().Text();
  EXPECT_EQ(launch.value().transport(), Transport::kUdp);
  return launch.value().discovery();
}

TEST(Lab, SaysWhereEachNodeIs) {
  const Lab lab = Lab::Parse(kLab, "rig.yaml").value();
  EXPECT_EQ(lab.run(), "rig");
  EXPECT_EQ(lab.domain(), 42u);
  ASSERT_EQ(lab.hosts().size(), 2u);
  EXPECT_EQ(lab.hosts()[1].name, "right");
  const Launch launch = Launch::Parse(kLaunch, "empty.yaml").value();
  EXPECT_TRUE(lab.Fits(launch).ok());
  EXPECT_EQ(lab.HostOf(launch.node(0)), "left");
  EXPECT_EQ(lab.HostOf(launch.node(1)), "right") << "the clock's, where nobody says";
  EXPECT_EQ(Lab::Parse(Changed("clock: right\n", ""), "rig.yaml").value().clock(), "left") << "the first one";
}

TEST(Lab, MeasuresItsScreens) {
  const std::string text = std::string(kLab) +
                           "screens:\n  left: {width_cm: 120, height_cm: 70, distance_cm: 90, angle_deg: 60, "
                           "eye_height_cm: 30, aside_cm: -5}\n"
                           "  centre: {width_cm: 120, height_cm: 70, distance_cm: 90}\n";
  const Lab lab = Lab::Parse(text, "rig.yaml").value();
  const LabScreen left = lab.Screen("left").value();
  EXPECT_DOUBLE_EQ(left.width_m, 1.2);
  EXPECT_DOUBLE_EQ(left.height_m, 0.7);
  EXPECT_DOUBLE_EQ(left.distance_m, 0.9);
  EXPECT_NEAR(left.angle_rad, 1.0471975511965976, 1e-15);
  EXPECT_DOUBLE_EQ(left.eye_height_m, 0.3);
  EXPECT_DOUBLE_EQ(left.aside_m, -0.05);
  EXPECT_DOUBLE_EQ(lab.Screen("centre").value().eye_height_m, 0.35) << "before its middle, where nobody says";
  EXPECT_EQ(lab.Screen("center").error().Text(), "rig.yaml: there is no screen 'center'; did you mean 'centre'?");
  EXPECT_EQ(Refusal(std::string(kLab) + "screens:\n  left: {width_cm: 0, height_cm: 70, distance_cm: 90}\n"),
            "dir/rig.yaml:10: 'screens.left.width_cm' is 0; a number from 1 to 5000 was expected");
}

TEST(Lab, TellsEveryProcessHowToMeetTheOthers) {
  const Discovery peers = On("left", kLab);
  EXPECT_EQ(peers.kind, DiscoveryKind::kPeers);
  EXPECT_EQ(peers.interface, "192.168.10.1");
  EXPECT_EQ(peers.addresses, (std::vector<std::string>{"192.168.10.1", "192.168.10.2"}));
  EXPECT_GT(peers.participants, 4u) << "Fast DDS looks for four a PC of itself; a demo has seven";
  const Discovery server = On("left", Changed("kind: peers", "kind: server, port: 12345"));
  EXPECT_EQ(server.kind, DiscoveryKind::kServer);
  EXPECT_EQ(server.address, "192.168.10.2") << "the clock's PC";
  EXPECT_EQ(server.port, 12345);
  EXPECT_EQ(On("right", Changed("discovery: {kind: peers}\n", "")).kind, DiscoveryKind::kMulticast);
}

TEST(Lab, RefusesWhatIsWrongWithPlaceAndNearestName) {
  EXPECT_EQ(Refusal(Changed("lab/1", "lab/2")), "dir/rig.yaml:1: 'rodeira' is 'lab/2'; did you mean 'lab/1'?");
  EXPECT_EQ(Refusal(Changed("clock: right", "clock: rihgt")),
            "dir/rig.yaml:4: 'clock' is 'rihgt'; did you mean 'right'?");
  EXPECT_EQ(Refusal(Changed("kind: peers", "kind: pears")),
            "dir/rig.yaml:5: 'discovery.kind' is 'pears'; did you mean 'peers'?");
  EXPECT_EQ(Refusal(Changed("kind: peers", "kind: peers, port: 1")),
            "dir/rig.yaml:5: unknown key 'discovery.port'; known are kind, participants");
  EXPECT_EQ(Refusal(Changed("192.168.10.2", "192.168.10")),
            "dir/rig.yaml:8: 'address' is '192.168.10'; an IPv4 address as 192.168.10.1 was expected");
  EXPECT_EQ(Refusal(Changed("192.168.10.2", "192.168.10.1")),
            "dir/rig.yaml:8: hosts 'left' and 'right' have the same address 192.168.10.1");
  EXPECT_EQ(Refusal(Changed("address: 192.168.10.2", "adress: 192.168.10.2")),
            "dir/rig.yaml:8: unknown key 'hosts.right.adress'; did you mean 'address'?");
  EXPECT_THAT(ErrorOf(Changed("domain: 42", "domain: 233")),
              IsError("config.out_of_range", "dir/rig.yaml:2: … 'domain' … 233 … 0 … 232"));
  EXPECT_EQ(Refusal(Changed("run: rig", "transport: shared_memory")),
            "dir/rig.yaml:3: 'transport' is 'shared_memory', which ends at a PC; 'udp' was expected");
  EXPECT_THAT(ErrorOf("rodeira: lab/1\ndomain: 1\n"), IsError("config.missing_key", "dir/rig.yaml:1: … 'hosts'"));
  const Lab lab = Lab::Parse(kLab, "dir/rig.yaml").value();
  EXPECT_EQ(lab.Host("lefft").error().Text(), "dir/rig.yaml: there is no host 'lefft'; did you mean 'left'?");
  const Launch launch = Launch::Parse(kLaunch, "dir/empty.yaml", {{"nodes.b.host", "lft"}}).value();
  EXPECT_EQ(lab.Fits(launch).error().Text(),
            "--set nodes.b.host=lft: node 'b' belongs to host 'lft', which is not in dir/rig.yaml; "
            "did you mean 'left'?");
}

TEST(Agreement, IsOfWhatTheRunIsAndNotOfThePc) {
  const auto of = [](const std::string& text, const Overrides& overrides) {
    return Agreement(Launch::Parse(text, "x.yaml", overrides).value());
  };
  const base::Digest digest = of(kLaunch, {});
  const Lab lab = Lab::Parse(kLab, "rig.yaml").value();
  ASSERT_FALSE(lab.hosts().empty());
  for (const LabHost& host : lab.hosts()) EXPECT_EQ(of(kLaunch, lab.For(host)), digest);
  EXPECT_EQ(of(kLaunch, {{"limits.start_s", "9"}, {"nodes.a.config.window", "never"}}), digest);
  EXPECT_NE(of(kLaunch, {{"seed", "2"}}), digest);
  EXPECT_NE(of(kLaunch, {{"nodes.a.config.fail_at_step", "2"}}), digest) << "the roster is the same";
  EXPECT_NE(of(kLaunch + "seed: 2\n", {}), digest);
}

TEST(Discovery, OfALaunchFile) {
  const auto parse = [](const std::string& discovery) {
    return Launch::Parse(kLaunch + "transport: udp\ndiscovery: " + discovery + "\n", "x.yaml");
  };
  const auto refusal = [&](const std::string& discovery) {
    const auto launch = parse(discovery);
    return launch.ok() ? "" : launch.error().Text();
  };
  EXPECT_EQ(parse("{kind: peers, addresses: [10.0.0.1, 10.0.0.2], participants: 50}").value().discovery().participants,
            50u);
  EXPECT_EQ(parse("{kind: server, address: 10.0.0.1}").value().discovery().port, Discovery::kServerPort);
  EXPECT_EQ(refusal("{kind: server}"), "x.yaml:6: key 'discovery.address' is missing; a text was expected");
  EXPECT_THAT(refusal("{kind: server, address: 10.0.0.1, port: 70000}"),
              Names("x.yaml:6: … 'discovery.port' … 70000 … 1 … 65535"));
  EXPECT_EQ(refusal("{kind: peers, addresses: []}"),
            "x.yaml:6: 'addresses' is empty; the address of each PC of the run was expected");
  EXPECT_THAT(refusal("{kind: peers, addresses: [left]}"), Names("x.yaml:6: … address 'left'"));
  const auto shared = Launch::Parse(kLaunch + "discovery: {kind: server, address: 10.0.0.1}\n", "x.yaml");
  ASSERT_FALSE(shared.ok());
  EXPECT_EQ(shared.error().Text(), "x.yaml:5: 'discovery.kind' is 'server', which needs 'transport: udp'");
}

// A generated file for each declared key. The ports and processes belong to a kind of discovery.
TEST(Lab, EveryDeclaredKeyKeepsItsTypeAndBounds) {
  config::ExpectEveryKey(
      LabSchema(), Refusal,
      {{"discovery.participants", {{"discovery.kind", "peers"}}}, {"discovery.port", {{"discovery.kind", "server"}}}});
}

}  // namespace
}  // namespace rodeira::launch
