// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "common/core/base/crash_trace.hpp"
#include "common/core/base/exhaustion.hpp"
#include "common/core/base/mathematics.hpp"
#include "common/core/base/print_error.hpp"
#include "common/runtime/dds/hosted_part.hpp"
#include "common/runtime/dds/node_bus.hpp"
#include "common/runtime/dds/options.hpp"
#include "common/runtime/dds/run.hpp"

namespace rodeira::dds {
namespace {

using lockstep::NodeIndex;

// A node with what it reads of the launch file: which keys were read is its own business.
struct Member {
  NodeIndex index = 0;
  std::unique_ptr<launch::Launch> launch;
  std::unique_ptr<HostedPart> part;
  int status = 0;
};

class Members {
 public:
  Members(const ProcessOptions& options, const launch::Launch& launch, Participant& participant,
          const DomainSettings& domain, std::vector<NodeIndex> nodes)
      : options_(options),
        participant_(participant),
        domain_(domain),
        nodes_(std::move(nodes)),
        exchange_(launch.roster(), nodes_) {
    for (const NodeIndex n : nodes_) has_sink_ = has_sink_ || launch.roster().node(n).is_sink();
  }

  // Servers first: nodes that are made ask them.
  base::Status Open(const SharedProcess& process, const lockstep::Roster& roster) {
    for (const bool services : {true, false}) {
      for (const NodeIndex n : nodes_) {
        if ((roster.node(n).role == lockstep::Role::kService) != services) continue;
        auto launch = launch::Launch::Load(options_.launch_file, options_.overrides);
        if (!launch) return launch.error();
        if (auto status = Open(process, n, std::move(launch).value()); !status) return status;
      }
    }
    return {};
  }

  // 0, 1 or 2: what is worst of them.
  int Run() {
    std::vector<std::thread> threads;
    for (Member& member : members_) {
      member.part->Make();
      threads.emplace_back([&member] { member.status = member.part->Run(); });
    }
    for (std::thread& thread : threads) thread.join();
    int status = 0;
    for (const Member& member : members_) status = std::max(status, member.status);
    return status;
  }

 private:
  base::Status Open(const SharedProcess& process, NodeIndex n, launch::Launch launch) {
    Member member{n, std::make_unique<launch::Launch>(std::move(launch)), nullptr};
    const launch::LaunchNode& node = member.launch->node(n);
    const PartHost host{*member.launch, participant_, domain_, &exchange_, has_sink_};
    auto factory = process.factory(node);
    const auto known = options_.incarnations.find(node.name);
    const std::uint32_t incarnation = known == options_.incarnations.end() ? 0 : known->second;
    auto part = [&]() -> base::Result<std::unique_ptr<HostedPart>> {
      if (!factory) {
        return OpenNode(host, n, incarnation,
                        [error = factory.error()](
                            launch::NodeContext&) -> base::Result<std::unique_ptr<lockstep::Node>> { return error; });
      }
      if (factory.value().service) return OpenService(host, n, incarnation, factory.value().service);
      return OpenNode(host, n, incarnation, factory.value().node);
    }();
    if (!part) return part.error();
    member.part = std::move(part).value();
    members_.push_back(std::move(member));
    return {};
  }

  const ProcessOptions& options_;
  Participant& participant_;
  const DomainSettings& domain_;
  const std::vector<NodeIndex> nodes_;
  LocalExchange exchange_;
  bool has_sink_ = false;
  std::vector<Member> members_;  // last: they use the rest
};

}  // namespace

int RunSharedProcess(std::string_view program, int argc, char** argv, const SharedProcess& process) {
  base::PinMathLibrary(argv);
  base::TraceCrashes();
  base::NameExhaustion(program);
  const ParsedOptions parsed = ParseOptions(std::string(program), ProgramOf::kNodes, argc, argv);
  if (parsed.leave_with) return *parsed.leave_with;
  NodeBus::HandleSignals();
  const ProcessOptions& options = parsed.options;
  const auto launch = launch::Launch::Load(options.launch_file, options.overrides);
  if (!launch) return base::PrintError(program, launch.error());
  const std::vector<NodeIndex> nodes = launch::NodesOfProcess(launch.value(), options.process);
  if (nodes.empty()) {
    return base::PrintError(
        program,
        base::WrongInput("launch.unknown_process",
                         fmt::format("--process {}: no node of the launch file has this process", options.process),
                         options.launch_file));
  }
  DomainSettings domain = DomainOf(options, launch.value(), options.process, nodes);
  domain.delivers_within = false;
  auto participant = Participant::Open(domain);
  if (!participant) return base::PrintError(program, participant.error());
  Members members(options, launch.value(), *participant.value(), domain, nodes);
  if (auto status = members.Open(process, launch.value().roster()); !status)
    return base::PrintError(program, status.error());
  const std::shared_ptr<const void> kept = process.prepare ? process.prepare(launch.value(), nodes) : nullptr;
  return members.Run();
}

}  // namespace rodeira::dds
