// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/launch/lab.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "common/core/base/constants.hpp"
#include "common/core/base/suggest.hpp"
#include "common/core/config/declared.hpp"
#include "common/runtime/launch/lab_schema.hpp"

namespace rodeira::launch {

namespace {

using config::RequiredNumberKey;

config::Schema MakeLabSchema() {
  const Discovery discovery;
  config::Schema schema{"lab", "lab/1", "The PCs of a laboratory, their network and their screens.", {}};
  schema.keys = config::FileKeys(
      "lab/1",
      {config::TextKey("run", "lab", "Name of the run; only processes of the same name meet."),
       config::RequiredIntegerKey("domain", 0, 232, "DDS domain; another one for each rig."),
       config::Required(config::NamedKey(
           "hosts", {config::RequiredTextKey("address", "192.168.7.1", "IPv4 address of the PC.")}, "The PCs.")),
       config::ComputedTextKey("clock", "first host", "a", "Host of the clock."),
       config::WordKey("transport", {"udp", "shared_memory"}, "udp", "`shared_memory` only with one host."),
       config::MappingKey("discovery",
                          {config::WordKey("kind", {"multicast", "peers", "server"}, "multicast",
                                           "`peers`: between all hosts; `server`: on the clock's host."),
                           config::IntegerKey("participants", 1, 119, discovery.participants,
                                              "Most processes on a PC; only for `peers`."),
                           config::IntegerKey("port", 1, 65535, Discovery::kServerPort, "Port; only for `server`.")},
                          "How the processes find each other."),
       config::NamedKey(
           "screens",
           {RequiredNumberKey("width_cm", {1.0, 5000.0}, "Width of the picture."),
            RequiredNumberKey("height_cm", {1.0, 5000.0}, "Height of the picture."),
            RequiredNumberKey("distance_cm", {1.0, 5000.0}, "From the driver's eye to the picture's plane."),
            config::NumberKey("angle_deg", {-180.0, 180.0}, 0.0,
                              "Direction of that plane: 0 straight ahead, positive to the left."),
            config::ComputedNumberKey("eye_height_cm", {-5000.0, 5000.0}, "half of the height",
                                      "Eye above the lower edge of the picture."),
            config::NumberKey("aside_cm", {-5000.0, 5000.0}, 0.0,
                              "Middle of the picture, to the right of the nearest point.")},
           "The screens, measured with a tape.")});
  return schema;
}

LabScreen ReadScreen(const std::string& name, const config::DeclaredMap& map) {
  LabScreen screen;
  screen.name = name;
  screen.width_m = 0.01 * map.Number("width_cm");
  screen.height_m = 0.01 * map.Number("height_cm");
  screen.distance_m = 0.01 * map.Number("distance_cm");
  screen.angle_rad = base::kRadiansPerDegree * map.Number("angle_deg");
  screen.eye_height_m = 0.01 * map.Number("eye_height_cm", 50.0 * screen.height_m);
  screen.aside_m = 0.01 * map.Number("aside_cm");
  return screen;
}

}  // namespace

const config::Schema& LabSchema() {
  static const config::Schema schema = MakeLabSchema();
  return schema;
}

base::Result<Lab> Lab::Load(const std::filesystem::path& path) {
  auto file = config::File::Load(path);
  if (!file) return file.error();
  return Read(file.value());
}

base::Result<Lab> Lab::Parse(std::string_view text, const std::filesystem::path& name) {
  auto file = config::File::Parse(text, name);
  if (!file) return file.error();
  return Read(file.value());
}

base::Result<Lab> Lab::Read(const config::File& file) {
  Lab lab;
  lab.path_ = file.path();
  const config::Map root = file.root();
  const config::DeclaredMap declared(root, LabSchema().keys);
  (void)declared.Word("rodeira");
  lab.run_ = declared.Text("run");
  if (lab.run_.empty())
    root.Problem("run", "config.too_few", "'run' is empty; a name was expected by which the processes of all PCs meet");
  lab.domain_ = static_cast<std::uint32_t>(declared.Integer("domain"));

  for (const auto& [name, map] : declared.Named("hosts")) {
    const LabHost host{name, ReadAddress(map.MapWith("address"), "address")};
    const auto same = std::ranges::find(lab.hosts_, host.address, &LabHost::address);
    if (same != lab.hosts_.end()) {
      root.Child("hosts").Problem(
          name, "config.duplicate_name",
          fmt::format("hosts '{}' and '{}' have the same address {}", same->name, name, host.address));
    }
    lab.hosts_.push_back(host);
  }
  if (lab.hosts_.empty() && root.Has("hosts")) {
    root.Problem("hosts", "config.too_few", "'hosts' is empty; at least one PC with its address was expected");
  }
  if (!lab.hosts_.empty()) lab.clock_ = declared.MapWith("clock").Choice("clock", lab.Names(), lab.hosts_.front().name);

  const std::string transport = declared.Word("transport");
  lab.transport_ = transport == "udp" ? Transport::kUdp : Transport::kSharedMemory;
  if (lab.transport_ != Transport::kUdp && lab.hosts_.size() > 1) {
    root.Problem("transport", "'transport' is 'shared_memory', which ends at a PC; 'udp' was expected");
  }
  const config::DeclaredMap discovery = declared.Child("discovery");
  lab.discovery_ = ReadDiscoveryKind(discovery.MapWith("kind"));
  if (lab.discovery_ != DiscoveryKind::kMulticast && lab.transport_ != Transport::kUdp) {
    root.Problem("discovery", "config.conflicting_keys",
                 fmt::format("'discovery.kind' is '{}', which needs 'transport: udp'", Word(lab.discovery_)));
  }
  if (lab.discovery_ == DiscoveryKind::kPeers) lab.participants_ = ReadParticipants(discovery.MapWith("participants"));
  if (lab.discovery_ == DiscoveryKind::kServer) lab.port_ = ReadPort(discovery.MapWith("port"));
  for (const auto& [name, map] : declared.Named("screens")) lab.screens_.push_back(ReadScreen(name, map));
  if (auto status = file.Finish(); !status) return status.error();
  return lab;
}

std::vector<std::string> Lab::Names() const {
  std::vector<std::string> names;
  for (const LabHost& host : hosts_) names.push_back(host.name);
  return names;
}

base::Result<LabHost> Lab::Host(const std::string& name) const {
  const auto found = std::ranges::find(hosts_, name, &LabHost::name);
  if (found == hosts_.end()) {
    return base::WrongInput("launch.unknown_host",
                            fmt::format("there is no host '{}'{}", name, base::DidYouMean(name, Names())),
                            path_.string());
  }
  return *found;
}

base::Result<LabScreen> Lab::Screen(const std::string& name) const {
  const auto found = std::ranges::find(screens_, name, &LabScreen::name);
  if (found != screens_.end()) return *found;
  std::vector<std::string> names;
  for (const LabScreen& screen : screens_) names.push_back(screen.name);
  return base::WrongInput("launch.unknown_screen",
                          fmt::format("there is no screen '{}'{}", name, base::DidYouMean(name, names)),
                          path_.string());
}

base::Status Lab::Fits(const Launch& launch) const {
  for (const LaunchNode& node : launch.nodes()) {
    if (node.host.empty() || Host(node.host).ok()) continue;
    return base::WrongInput("launch.unknown_host",
                            fmt::format("node '{}' belongs to host '{}', which is not in {}{}", node.name, node.host,
                                        path_.string(), base::DidYouMean(node.host, Names())),
                            node.config->Place("host"));
  }
  return {};
}

Overrides Lab::For(const LabHost& host) const {
  Overrides overrides;
  overrides.emplace_back("transport", transport_ == Transport::kUdp ? "udp" : "shared_memory");
  std::string more;
  if (discovery_ == DiscoveryKind::kPeers) {
    std::vector<std::string> addresses;
    for (const LabHost& other : hosts_) addresses.push_back(other.address);
    more = fmt::format(", participants: {}, addresses: [{}]", participants_, fmt::join(addresses, ", "));
  }
  if (discovery_ == DiscoveryKind::kServer)
    more = fmt::format(", address: {}, port: {}", Host(clock_).value().address, port_);
  const std::string interface = transport_ == Transport::kUdp ? ", interface: " + host.address : "";
  overrides.emplace_back("discovery", fmt::format("{{kind: {}{}{}}}", Word(discovery_), interface, more));
  return overrides;
}

}  // namespace rodeira::launch
