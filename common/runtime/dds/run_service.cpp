// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <atomic>
#include <thread>

#include "common/core/base/crash_trace.hpp"
#include "common/runtime/dds/hosted_part.hpp"
#include "common/runtime/dds/node_bus.hpp"
#include "common/runtime/dds/run.hpp"
#include "common/runtime/dds/run_one_part.hpp"
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

class HostedService final : public HostedPart {
 public:
  HostedService(const PartHost& host, lockstep::NodeIndex index, std::uint32_t incarnation,
                launch::ServiceFactory factory)
      : host_(host),
        name_(host.exchange == nullptr ? "" : host.launch.roster().node(index).name),
        factory_(std::move(factory)),
        mailbox_(host.launch.roster(), index),
        context_(host.launch, index) {
    report_.node = index;
    report_.incarnation = incarnation;
  }
  ~HostedService() override { requests_.reset(); }  // first: its callback uses the rest

  base::Status Open() {
    NodeBus::Settings settings;
    settings.node = report_.node;
    settings.incarnation = report_.incarnation;
    settings.hello = OwnHello(host_.launch, report_.node);
    settings.domain = host_.domain;
    settings.exchange = host_.exchange;
    settings.has_sink = host_.has_sink;
    auto bus = NodeBus::Open(host_.participant, host_.launch.roster(), mailbox_, settings);
    if (!bus) return bus.error();
    bus_ = std::move(bus).value();
    if (host_.exchange != nullptr) host_.exchange->Join(report_.node, *bus_);
    return {};
  }

  void Make() override {
    const base::NodeCall call(name_.empty() ? nullptr : name_.c_str());
    problem_ = MakeService();
  }

  int Run() override {
    const base::NodeCall call(name_.empty() ? nullptr : name_.c_str());
    if (!problem_.ok()) {
      const base::Error& error = problem_.error();
      report_.phase = error.exit_status() == 2 ? lockstep::Phase::kRefused : lockstep::Phase::kFailed;
      report_.message = error.Text();
      WriteLastWord(report_, name_);
      bus_->Linger(report_, 1000ms);
      return error.exit_status();
    }
    report_.phase = lockstep::Phase::kRunning;
    report_.waiting = lockstep::Waiting::kGrant;
    bus_->Tell(report_);
    for (;;) {
      const lockstep::Grant grant = mailbox_.grant();
      if (const auto end = mailbox_.early_end()) {
        report_.phase = lockstep::NextPhase(report_.phase, end->event);
        report_.message = end->reason;
        WriteLastWord(report_, name_);
        bus_->Linger(report_, 300ms);
        return 1;
      }
      if (grant.over || grant.abort) return grant.abort ? 1 : 0;
      // The run's end is known once all others have finished; a server is finished whenever they are.
      if (grant.final && report_.phase != lockstep::Phase::kFinished) {
        report_.phase = lockstep::Phase::kFinished;
        report_.steps = 0;
        report_.server_calls = answered_;
        bus_->Tell(report_);
      }
      std::this_thread::sleep_for(5ms);
    }
  }

 private:
  // Answers from here on: nodes that are made later in this process may ask.
  base::Status MakeService() {
    auto service = factory_(context_);
    if (auto finish = host_.launch.file().Finish(); !service || !finish)
      return service ? finish : base::Status(service.error());
    service_ = std::move(service).value();
    bus_->SetWorldHash(service_->world_hash());
    auto replies = host_.participant.MakeWriter(topics::kGroundReply, Delivery::kBestEffortRepeated);
    if (!replies) return replies.error();
    replies_ = std::move(replies).value();
    auto information = host_.participant.MakeWriter(topics::kWorldInfo, Delivery::kLatched);
    if (!information) return information.error();
    information_ = std::move(information).value();
    if (auto status = information_->Write(service_->Announcement()); !status) return status;
    // The server waits for no node, so it may answer on the receive thread itself: one thread change less in every
    // step.
    auto requests = host_.participant.MakeReader(topics::kGroundRequest, Delivery::kBestEffortRepeated,
                                                 [this](base::Bytes&& request) { Answer(request); });
    if (!requests) return requests.error();
    requests_ = std::move(requests).value();
    return {};
  }
  void Answer(const base::Bytes& request) {
    const NodeBus::Receiving note(*bus_);
    const base::NodeCall call(name_.empty() ? nullptr : name_.c_str());
    auto reply = service_->Answer(request);
    if (!reply) return;
    (void)replies_->Write(reply.value());
    ++answered_;
  }

  const PartHost host_;
  const std::string name_;  // empty: the process has one node
  launch::ServiceFactory factory_;
  lockstep::Mailbox mailbox_;
  ServiceContext context_;
  lockstep::Report report_;
  std::unique_ptr<NodeBus> bus_;
  std::unique_ptr<launch::Service> service_;
  std::unique_ptr<Writer> replies_;
  std::unique_ptr<Writer> information_;
  std::unique_ptr<Reader> requests_;
  std::atomic<std::uint64_t> answered_ = 0;
  base::Status problem_;
};

}  // namespace

base::Result<std::unique_ptr<HostedPart>> OpenService(const PartHost& host, lockstep::NodeIndex index,
                                                      std::uint32_t incarnation, launch::ServiceFactory factory) {
  auto service = std::make_unique<HostedService>(host, index, incarnation, std::move(factory));
  if (auto status = service->Open(); !status) return status.error();
  return std::unique_ptr<HostedPart>(std::move(service));
}

int RunService(std::string_view kind, int argc, char** argv, const launch::ServiceFactory& factory) {
  return RunOnePart(fmt::format("rodeira-{}", kind), kind, argc, argv,
                    [&](const PartHost& host, lockstep::NodeIndex index, std::uint32_t incarnation) {
                      return OpenService(host, index, incarnation, factory);
                    });
}

}  // namespace rodeira::dds
