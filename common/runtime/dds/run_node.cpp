// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <condition_variable>
#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>

#include "common/core/base/crash_trace.hpp"
#include "common/core/base/exhaustion.hpp"
#include "common/core/base/mathematics.hpp"
#include "common/core/base/print_error.hpp"
#include "common/core/base/wait.hpp"
#include "common/runtime/dds/node_bus.hpp"
#include "common/runtime/dds/options.hpp"
#include "common/runtime/dds/remote_ground.hpp"
#include "common/runtime/dds/remote_keys.hpp"
#include "common/runtime/dds/remote_log.hpp"
#include "common/runtime/dds/remote_requests.hpp"
#include "common/runtime/dds/run.hpp"
#include "common/runtime/dds/supervisor_pipe.hpp"
#include "common/runtime/launch/node_library.hpp"
#include "common/runtime/lockstep/pump.hpp"
#include "common/runtime/lockstep/recovery.hpp"
#include "common/runtime/lockstep/runner.hpp"
#include "idl/codec.hpp"
#include "idl/messages.hpp"
#include "idl/topics.hpp"

namespace rodeira::dds {
namespace {

using namespace std::chrono_literals;

// A datagram is lost with any of its fragments of 1 500 bytes.
constexpr std::size_t kSampleBatchOnWire_bytes = 8'000;
constexpr std::size_t kSampleBatchInMemory_bytes = 40'000;
constexpr std::size_t kAnswerOnWire_bytes = 1'200;

class ProcessContext final : public launch::NodeContext {
 public:
  ProcessContext(const launch::Launch& launch, lockstep::NodeIndex index, Participant& participant,
                 lockstep::Mailbox& mailbox, NodeBus& bus, std::uint32_t incarnation)
      : NodeContext(launch, index),
        participant_(participant),
        mailbox_(mailbox),
        bus_(bus),
        incarnation_(incarnation) {}

  ground::Ground& Ground() override {
    if (ground_ == nullptr) {
      auto ground = RemoteGround::Open(participant_, index(), incarnation_, [this] { return mailbox_.grant().abort; });
      RODEIRA_ASSERT(ground.ok());  // fails only where Fast DDS has no memory left
      ground_ = std::move(ground).value();
    }
    return *ground_;
  }
  base::Result<launch::WorldSummary> World() override {
    std::mutex mutex;
    std::condition_variable woken;
    std::optional<launch::WorldSummary> summary;
    auto reader = participant_.MakeReader(idl::topics::kWorldInfo, Delivery::kLatched, [&](base::Bytes&& bytes) {
      const auto info = idl::Decode<msg::WorldInfo>(bytes);
      if (!info) return;
      const std::lock_guard lock(mutex);
      summary = {info.value().content_hash(), info.value().name(), info.value().start_x_m(), info.value().start_y_m(),
                 info.value().start_heading_rad()};
      woken.notify_all();
    });
    if (!reader) return reader.error();
    const base::WaitNote note("the road server's world");
    std::unique_lock lock(mutex);
    const auto until = std::chrono::steady_clock::now() + std::chrono::milliseconds(launch().watchdog().start_ms);
    while (!summary && !mailbox_.grant().abort && std::chrono::steady_clock::now() < until) woken.wait_for(lock, 20ms);
    lock.unlock();
    reader.value().reset();  // its callback uses what lies on this stack
    if (!summary) return base::Failed("run.no_answer", "the road server says nothing of the world");
    return *summary;
  }
  std::unique_ptr<launch::LiveKeysSender> KeysSender() override {
    auto sender = OpenKeysSender(participant_);
    RODEIRA_ASSERT(sender.ok());  // fails only where Fast DDS has no memory left
    return std::move(sender).value();
  }
  std::unique_ptr<launch::LiveKeysReceiver> KeysReceiver() override {
    auto receiver = OpenKeysReceiver(participant_);
    RODEIRA_ASSERT(receiver.ok());
    return std::move(receiver).value();
  }
  std::unique_ptr<launch::LiveRequestsSender> RequestsSender() override {
    auto sender = OpenRequestsSender(participant_);
    RODEIRA_ASSERT(sender.ok());
    return std::move(sender).value();
  }
  std::unique_ptr<launch::LiveRequestsReceiver> RequestsReceiver() override {
    auto receiver = OpenRequestsReceiver(participant_);
    RODEIRA_ASSERT(receiver.ok());
    return std::move(receiver).value();
  }
  std::unique_ptr<launch::RunLogReceiver> RunLog() override {
    auto receiver = OpenLogReceiver(participant_, roster().hash());
    RODEIRA_ASSERT(receiver.ok());
    return std::move(receiver).value();
  }
  bool is_restarted() const override { return incarnation_ > 0; }
  base::Result<lockstep::Step> LastRecordedStep() override {
    const auto grant = bus_.AwaitGrant(std::chrono::milliseconds(launch().watchdog().start_ms));
    if (!grant) return base::Failed("run.no_answer", "the clock says nothing to a node that is started again");
    return grant->safe;
  }
  std::function<void(lockstep::Step)> RecordedStepReporter() override {
    return [&bus = bus_](lockstep::Step through) { bus.SetSafe(through); };
  }
  base::Status Remember(const lockstep::Sample& sample) override { return bus_.Remember(sample); }
  void Follow(lockstep::Runner* runner) {
    if (ground_ != nullptr) ground_->Follow(runner);
  }

 private:
  Participant& participant_;
  lockstep::Mailbox& mailbox_;
  NodeBus& bus_;
  std::uint32_t incarnation_;
  std::unique_ptr<RemoteGround> ground_;
};

// For another incarnation than the first.
base::Status FindBeginning(ProcessContext& context, NodeBus& bus, lockstep::Mailbox& mailbox,
                           lockstep::Runner::Settings& settings) {
  const auto limit = std::chrono::milliseconds(context.launch().watchdog().start_ms);
  const auto until = std::chrono::steady_clock::now() + limit;
  if (context.roster().node(context.index()).keeps_snapshots()) bus.SetSafe(context.has_through());
  for (;;) {  // a clock that takes the place of a lost one may name a later snapshot
    const auto grant = bus.AwaitGrant(limit, true);
    if (!grant) return base::Failed("run.no_answer", "the clock says nothing to a node that is started again");
    const lockstep::Beginning beginning =
        lockstep::BeginningOf(context.roster(), context.index(), *grant, context.has_through());
    settings.sink_from = beginning.sink_from;
    if (beginning.snapshot <= 0) break;
    settings.resume = bus.FetchSnapshot(beginning.snapshot, std::min<std::chrono::milliseconds>(limit, 500ms));
    if (settings.resume) break;
    if (mailbox.grant().abort || std::chrono::steady_clock::now() > until)
      return base::Failed("run.cannot_restart",
                          fmt::format("no process has its snapshot at step {}", beginning.snapshot));
  }
  if (settings.resume && !settings.resume->has_state)
    return base::Failed("run.cannot_restart", "it cannot save its state, so it cannot be started again");
  mailbox.StartAt(settings.resume ? settings.resume->at : settings.sink_from);
  bus.Listen();
  return {};
}

// The node is made and runs; what goes wrong is told to the clock, which ends the run.
int Drive(const launch::NodeFactory& factory, ProcessContext& context, NodeBus& bus, lockstep::Mailbox& mailbox,
          const ProcessOptions& options) {
  const auto fail = [&](const base::Error& error) {
    lockstep::Report report;
    report.node = context.index();
    report.incarnation = options.incarnation;
    const auto end = mailbox.early_end().value_or(lockstep::EarlyEnd{
        error.exit_status() == 2 ? lockstep::LifeEvent::kRefused : lockstep::LifeEvent::kFailed, error.Text()});
    report.phase = lockstep::NextPhase(report.phase, end.event);
    report.message = end.reason;
    WriteLastWord(report);
    bus.Linger(report, 1000ms);
    return report.phase == lockstep::Phase::kRefused ? 2 : 1;
  };
  (void)context.config();  // so that the keys of a node that reads none are unknown ones
  auto node = factory(context);
  if (!node) return fail(node.error());
  node = launch::AsManifestSays(*context.launch().node(context.index()).kind, std::move(node).value());
  if (!node) return fail(node.error());
  if (auto status = context.launch().file().Finish(); !status) return fail(status.error());
  bus.SetWorldHash(context.world_hash());
  lockstep::Runner::Settings settings;
  settings.incarnation = options.incarnation;
  if (options.incarnation > 0) {
    if (auto status = FindBeginning(context, bus, mailbox, settings); !status) return fail(status.error());
  }
  lockstep::Runner runner(context.roster(), context.index(), *node.value(), bus, mailbox, settings);
  context.Follow(&runner);
  bus.Follow(&runner);
  const bool brief = node.value()->runs_inline();
  const auto outcome = brief ? lockstep::RunInline(runner, mailbox, settings) : runner.Run();
  context.Follow(nullptr);
  const bool finished = outcome == lockstep::Runner::Outcome::kFinished;
  WriteLastWord(runner.report());
  bus.Linger(runner.report(), finished ? std::nullopt : std::optional(500ms));
  if (finished) return 0;
  return runner.report().phase == lockstep::Phase::kRefused ? 2 : 1;
}

}  // namespace

int RunNode(std::string_view kind, int argc, char** argv, const launch::NodeFactory& factory) {
  base::PinMathLibrary(argv);
  base::TraceCrashes();
  // An external node is called as its file is.
  const std::string program = kind == launch::kExternalKind ? std::filesystem::path(argv[0]).filename().string()
                                                            : fmt::format("rodeira-{}", kind);
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
  settings.topics = launch.value().topics();
  settings.domain = domain;
  settings.max_batch_bytes =
      domain.transport == launch::Transport::kSharedMemory ? kSampleBatchInMemory_bytes : kSampleBatchOnWire_bytes;
  settings.most_answer_bytes =
      domain.transport == launch::Transport::kSharedMemory ? kSampleBatchInMemory_bytes : kAnswerOnWire_bytes;
  settings.keeps_all = launch.value().keeps_for_restarts() && roster.node(index).keeps_snapshots();
  auto bus = NodeBus::Open(*participant.value(), roster, mailbox, settings);
  if (!bus) return base::PrintError(program, bus.error());
  ProcessContext context(launch.value(), index, *participant.value(), mailbox, *bus.value(), options.incarnation);
  return Drive(factory, context, *bus.value(), mailbox, options);
}

}  // namespace rodeira::dds
