// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "common/core/base/result.hpp"
#include "common/runtime/launch/launch.hpp"

namespace rodeira::launch {

// A PC of a laboratory.
struct LabHost {
  std::string name;
  std::string address;  // IPv4, in the network that the PCs share
};

// A screen, as its eye sees it (scene::ScreenPlane says what the lengths are).
struct LabScreen {
  std::string name;
  double width_m = 0.0, height_m = 0.0, distance_m = 0.0, angle_rad = 0.0, eye_height_m = 0.0, aside_m = 0.0;
};

// A laboratory file (docs/reference/lab-files.md): which PCs there are and how their processes meet. Every PC of a run
// reads the same.
class Lab {
 public:
  // Wrong input, with places, where the file is missing or faulty. Parse: the same of a text; `name` stands for its
  // file.
  static base::Result<Lab> Load(const std::filesystem::path& path);
  static base::Result<Lab> Parse(std::string_view text, const std::filesystem::path& name);

  const std::filesystem::path& path() const { return path_; }
  const std::string& run() const { return run_; }
  std::uint32_t domain() const { return domain_; }
  const std::vector<LabHost>& hosts() const { return hosts_; }  // in the file's order, at least one
  const std::string& clock() const { return clock_; }           // the host of the clock and of a discovery server

  // Wrong input, with the nearest name, where there is no such host.
  base::Result<LabHost> Host(const std::string& name) const;
  const std::vector<LabScreen>& screens() const { return screens_; }  // in the file's order; there may be none
  // Wrong input, with the nearest name, where there is no such screen.
  base::Result<LabScreen> Screen(const std::string& name) const;
  // The host that a node belongs to: the one that the launch file names, otherwise the clock's.
  const std::string& HostOf(const LaunchNode& node) const { return node.host.empty() ? clock_ : node.host; }
  // Wrong input where the launch file places a node on a host that is not in the laboratory.
  base::Status Fits(const Launch& launch) const;
  // What the laboratory says of transport and discovery on one of its hosts, in the words of a launch file.
  Overrides For(const LabHost& host) const;

 private:
  static base::Result<Lab> Read(const config::File& file);
  std::vector<std::string> Names() const;

  std::filesystem::path path_;
  std::string run_;
  std::uint32_t domain_ = 0;
  Transport transport_ = Transport::kUdp;
  DiscoveryKind discovery_ = DiscoveryKind::kMulticast;
  std::uint32_t participants_ = 0;
  std::uint16_t port_ = 0;
  std::string clock_;
  std::vector<LabHost> hosts_;
  std::vector<LabScreen> screens_;
};

}  // namespace rodeira::launch
