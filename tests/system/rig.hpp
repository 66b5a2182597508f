// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "tests/system/hub.hpp"

namespace rodeira::system_test {

// Several PCs on one: a network namespace each, with one interface eth0 that hangs on a hub. They share /dev/shm, so
// what is to go over the network must be told so (transport: udp). Made and removed by the test itself.
class Rig {
 public:
  Rig(int hosts, const Weather& weather);
  ~Rig();
  Rig(const Rig&) = delete;
  Rig& operator=(const Rig&) = delete;

  // Why there is no rig here (no permission, no iproute2); empty where there is one.
  const std::string& problem() const { return problem_; }
  const Hub& hub() const { return *hub_; }
  static std::string Address(int host) { return "10.77.0." + std::to_string(host + 1); }
  static std::string Name(int host);
  // The run that a laboratory file names: of this test program, so that several rigs may be there at once.
  static std::string RunName();
  // A laboratory file of the first `hosts` of them: domain 9, the run is RunName().
  static std::string Laboratory(int hosts, const std::string& discovery);
  // The command, in the network of this host.
  std::vector<std::string> On(int host, std::vector<std::string> command) const;
  // Pulls the host's cable, and plugs it in again.
  // Whether the interface counts as running; packets pass all the same (RFC 2863: dormant).
  void SetRunning(int host, bool runs);
  void Unplug(int host);
  void Plug(int host);

 private:
  std::string Space(const std::string& name) const;
  bool Ip(std::vector<std::string> words);

  std::string ip_;  // the program
  std::string problem_;
  std::vector<std::string> spaces_;
  std::unique_ptr<Hub> hub_;
};

}  // namespace rodeira::system_test
