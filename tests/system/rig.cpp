// SPDX-License-Identifier: Apache-2.0
#include "tests/system/rig.hpp"

#include <signal.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <filesystem>

#include "tests/system/command.hpp"

namespace rodeira::system_test {
namespace {

constexpr const char* kPrefix = "rodeira-test-";

std::string FindIp() {
  for (const char* path : {"/usr/bin/ip", "/usr/sbin/ip", "/bin/ip", "/sbin/ip"}) {
    if (::access(path, X_OK) == 0) return path;
  }
  return "";
}

// Removes network namespaces that killed test programs have left.
void RemoveOldSpaces(const std::string& ip) {
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator("/run/netns", none)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with(kPrefix)) continue;
    const pid_t owner = std::atoi(name.c_str() + std::string(kPrefix).size());
    if (owner > 0 && ::kill(owner, 0) != 0 && errno == ESRCH) (void)RunCommand({ip, "netns", "delete", name});
  }
}

}  // namespace

Rig::Rig(int hosts, const Weather& weather) : ip_(FindIp()) {
  if (ip_.empty()) problem_ = "there is no program 'ip' (package iproute2)";
  if (!problem_.empty()) return;
  RemoveOldSpaces(ip_);
  const std::string hub = Space("hub");
  std::vector<std::string> ports;
  if (!Ip({"netns", "add", hub})) return;
  spaces_.push_back(hub);
  for (int host = 0; host < hosts; ++host) {
    const std::string space = Space(std::to_string(host));
    ports.push_back("port" + std::to_string(host));
    if (!Ip({"netns", "add", space})) return;
    spaces_.push_back(space);
    if (!Ip({"link", "add", "name", ports.back(), "netns", hub, "type", "veth", "peer", "name", "eth0", "netns",
             space}))
      return;
    if (!Ip({"-n", hub, "link", "set", ports.back(), "up"})) return;
    if (!Ip({"-n", space, "address", "add", Address(host) + "/24", "dev", "eth0"})) return;
    if (!Ip({"-n", space, "link", "set", "lo", "up"}) || !Ip({"-n", space, "link", "set", "eth0", "up"})) return;
  }
  for (int host = 0; host < hosts; ++host) {  // an interface runs a moment after it was switched on
    const std::vector<std::string> show{ip_, "-n", Space(std::to_string(host)), "link", "show", "eth0"};
    for (int i = 0; i < 300 && RunCommand(show).out.find("state UP") == std::string::npos; ++i) ::usleep(10'000);
  }
  hub_ = std::make_unique<Hub>(hub, ports, weather);
  problem_ = hub_->problem();
}

Rig::~Rig() {
  hub_.reset();
  for (const std::string& space : spaces_) (void)RunCommand({ip_, "netns", "delete", space});
}

std::string Rig::Space(const std::string& name) const { return kPrefix + std::to_string(::getpid()) + "-" + name; }

bool Rig::Ip(std::vector<std::string> words) {
  words.insert(words.begin(), ip_);
  const Ended ended = RunCommand(words);
  if (ended.status != 0) problem_ = "network namespaces cannot be made here: " + ended.out;
  return ended.status == 0;
}

std::vector<std::string> Rig::On(int host, std::vector<std::string> command) const {
  command.insert(command.begin(), {ip_, "netns", "exec", Space(std::to_string(host))});
  return command;
}

std::string Rig::Name(int host) {
  return std::vector<std::string>{"left", "right", "third"}.at(static_cast<std::size_t>(host));
}

std::string Rig::RunName() { return "rig-" + std::to_string(::getpid()) + "-pcs"; }

std::string Rig::Laboratory(int hosts, const std::string& discovery) {
  std::string text = "rodeira: lab/1\ndomain: 9\nrun: " + RunName() + "\ndiscovery: " + discovery + "\nhosts:\n";
  for (int host = 0; host < hosts; ++host) text += "  " + Name(host) + ": {address: " + Address(host) + "}\n";
  return text;
}

void Rig::SetRunning(int host, bool runs) {
  (void)Ip({"-n", Space(std::to_string(host)), "link", "set", "eth0", "mode", runs ? "default" : "dormant"});
  (void)Ip({"-n", Space(std::to_string(host)), "link", "set", "eth0", "state", runs ? "up" : "dormant"});
}

void Rig::Unplug(int host) { (void)Ip({"-n", Space("hub"), "link", "set", "port" + std::to_string(host), "down"}); }

void Rig::Plug(int host) { (void)Ip({"-n", Space("hub"), "link", "set", "port" + std::to_string(host), "up"}); }

}  // namespace rodeira::system_test
