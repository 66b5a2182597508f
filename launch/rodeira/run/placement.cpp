// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/run/placement.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "common/runtime/dds/udp_port.hpp"

namespace rodeira::cli {
namespace {

// Until all PCs are there: a person walks from one to the next.
constexpr const char* kStartPatience_s = "3600";

base::Error BelongsToTheClock(const char* option, const launch::Lab& lab) {
  return base::WrongInput("command.wrong_combination",
                          fmt::format("it belongs to the clock's host, '{}'; say it there", lab.clock()), option);
}

}  // namespace

base::Result<Placement> Placement::Find(const launch::Launch& launch, RunOptions& options,
                                        launch::Overrides& overrides) {
  Placement placement;
  const std::string file = !options.lab.empty() ? options.lab : launch.lab().string();
  if (options.host.empty()) {
    if (options.lab.empty()) return placement;
    return base::WrongInput("command.missing_option",
                            fmt::format("which PC is this? --host NAME was expected, of a host in {}", options.lab),
                            "--lab");
  }
  if (file.empty()) {
    return base::WrongInput(
        "command.missing_option",
        "no laboratory file says where the hosts are; --lab FILE, or 'lab: FILE' in the launch file, was expected",
        "--host");
  }
  if (options.in_process)
    return base::WrongInput("command.wrong_combination", "a run in one process has one host; --host was not expected",
                            "--in-process");
  auto lab = launch::Lab::Load(file);
  if (!lab) return lab.error();
  const auto host = lab.value().Host(options.host);
  if (!host) return host.error();
  if (auto status = lab.value().Fits(launch); !status) return status.error();
  placement.lab_ = std::move(lab).value();
  placement.host_ = host.value().name;
  if (!dds::IsOwnAddress(host.value().address)) {
    return base::WrongInput(
        "launch.wrong_host",
        fmt::format("host '{}' has the address {}, which this PC does not have; is it another one of the hosts, "
                    "is its network up (ip address)?",
                    placement.host_, host.value().address),
        file);
  }
  if (!placement.has_clock()) {
    if (options.duration_s) return BelongsToTheClock("--for", *placement.lab_);
    if (!options.pace.empty()) return BelongsToTheClock("--pace", *placement.lab_);
    if (std::ranges::none_of(launch.nodes(), [&](const launch::LaunchNode& node) { return placement.Has(node); })) {
      return base::WrongInput(
          "launch.host_without_nodes",
          fmt::format(
              "no node belongs to host '{0}'; say 'host: {0}' at a node, or --set nodes.NAME.host={0} on every PC",
              placement.host_),
          launch.path().string());
    }
  }
  if (options.run.empty()) options.run = placement.lab_->run();
  if (!options.domain) options.domain = placement.lab_->domain();
  for (auto& setting : placement.lab_->For(host.value())) overrides.push_back(std::move(setting));
  if (!launch.file().root().Peek({"limits", "start_s"})) overrides.emplace_back("limits.start_s", kStartPatience_s);
  return placement;
}

std::string Placement::ClocksPlace() const {
  if (!lab_) return "this PC";
  return fmt::format("host '{}' ({})", lab_->clock(), lab_->Host(lab_->clock()).value().address);
}

}  // namespace rodeira::cli
