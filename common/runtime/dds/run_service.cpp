// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <atomic>
#include <thread>

#include "common/core/base/crash_trace.hpp"
#include "common/core/base/exhaustion.hpp"
#include "common/core/base/mathematics.hpp"
#include "common/core/base/print_error.hpp"
#include "common/runtime/dds/node_bus.hpp"
#include "common/runtime/dds/options.hpp"
#include "common/runtime/dds/run.hpp"
#include "common/runtime/dds/supervisor_pipe.hpp"
#include "idl/topics.hpp"

namespace rodeira::dds {
namespace {

using namespace std::chrono_literals;
namespace topics = idl::topics;

class ServiceContext final : public launch::NodeContext {
 public:
  using NodeContext::NodeContext;
  ground::Ground& Ground() override { RODEIRA_ASSERT(false && "a server has no ground server"); }
  base::Result<launch::WorldSummary> World() override { RODEIRA_ASSERT(false && "a server has no ground server"); }
};

}  // namespace

int RunService(std::string_view kind, int argc, char** argv, const launch::ServiceFactory& factory) {
  base::PinMathLibrary(argv);
  base::TraceCrashes();
  const std::string program = fmt::format("rodeira-{}", kind);
  base::NameExhaustion(program);
  const ParsedOptions parsed = ParseOptions(program, false, argc, argv);
  if (parsed.leave_with) return *parsed.leave_with;
  NodeBus::HandleSignals();
  const ProcessOptions& options = parsed.options;
  const auto launch = launch::Launch::Load(options.launch_file, options.overrides);
  if (!launch) return base::PrintError(program, launch.error());
  const auto& roster = launch.value().roster();
  const lockstep::NodeIndex index = roster.Find(options.node);
  if (index == roster.nodes().size() || roster.node(index).kind != kind) {
    return base::PrintError(
        program, base::WrongInput("launch.unknown_node",
                                  fmt::format("--node {}: the launch file has no node of this name and of kind '{}'",
                                              options.node, kind),
                                  options.launch_file));
  }
  const DomainSettings domain = DomainOf(options, launch.value(), options.node);
  auto participant = Participant::Open(domain);
  if (!participant) return base::PrintError(program, participant.error());
  lockstep::Mailbox mailbox(roster, index);
  NodeBus::Settings settings;
  settings.node = index;
  settings.incarnation = options.incarnation;
  settings.hello = OwnHello(launch.value(), index);
  settings.domain = domain;
  auto bus = NodeBus::Open(*participant.value(), roster, mailbox, settings);
  if (!bus) return base::PrintError(program, bus.error());

  lockstep::Report report;
  report.node = index;
  report.incarnation = options.incarnation;
  ServiceContext context(launch.value(), index);
  auto service = factory(context);
  auto finish = launch.value().file().Finish();
  if (!service || !finish) {
    const base::Error& error = service ? finish.error() : service.error();
    report.phase = error.exit_status() == 2 ? lockstep::Phase::kRefused : lockstep::Phase::kFailed;
    report.message = error.Text();
    WriteLastWord(report);
    bus.value()->Linger(report, 1000ms);
    return error.exit_status();
  }
  bus.value()->SetWorldHash(service.value()->world_hash());
  auto replies = participant.value()->MakeWriter(topics::kGroundReply, Delivery::kBestEffortRepeated);
  auto information = participant.value()->MakeWriter(topics::kWorldInfo, Delivery::kLatched);
  if (!replies) return base::PrintError(program, replies.error());
  if (!information) return base::PrintError(program, information.error());
  if (auto status = information.value()->Write(service.value()->Announcement()); !status)
    return base::PrintError(program, status.error());
  std::atomic<std::uint64_t> answered = 0;
  // The server waits for no node, so it may answer on the receive thread itself: one thread change less in every step.
  auto requests = participant.value()->MakeReader(topics::kGroundRequest, Delivery::kBestEffortRepeated,
                                                  [&](base::Bytes&& request) {
                                                    const NodeBus::Receiving note(*bus.value());
                                                    auto reply = service.value()->Answer(request);
                                                    if (!reply) return;
                                                    (void)replies.value()->Write(reply.value());
                                                    ++answered;
                                                  });
  if (!requests) return base::PrintError(program, requests.error());
  report.phase = lockstep::Phase::kRunning;
  report.waiting = lockstep::Waiting::kGrant;
  bus.value()->Tell(report);
  for (;;) {
    const lockstep::Grant grant = mailbox.grant();
    if (const auto end = mailbox.early_end()) {
      report.phase = lockstep::NextPhase(report.phase, end->event);
      report.message = end->reason;
      WriteLastWord(report);
      bus.value()->Linger(report, 300ms);
      return 1;
    }
    if (grant.over || grant.abort) return grant.abort ? 1 : 0;
    // The run's end is known once all others have finished; a server is finished whenever they are.
    if (grant.final && report.phase != lockstep::Phase::kFinished) {
      report.phase = lockstep::Phase::kFinished;
      report.steps = 0;
      report.server_calls = answered;
      bus.value()->Tell(report);
    }
    std::this_thread::sleep_for(5ms);
  }
}

}  // namespace rodeira::dds
