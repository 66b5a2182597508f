// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "common/runtime/dds/grant_listener.hpp"
#include "common/runtime/dds/local_exchange.hpp"
#include "common/runtime/dds/participant.hpp"
#include "common/runtime/dds/retransmit_server.hpp"
#include "common/runtime/dds/wire.hpp"
#include "common/runtime/lockstep/bus.hpp"
#include "common/runtime/lockstep/clock_silence.hpp"
#include "common/runtime/lockstep/mailbox.hpp"
#include "common/runtime/lockstep/runner.hpp"
#include "common/runtime/lockstep/sample_batches.hpp"

namespace rodeira::dds {

// A node's side of the bus: its writers and readers, the clock's grants, and the heartbeat that tells the clock where
// the node stands even while it computes or waits.
class NodeBus final : public lockstep::Bus {
 public:
  // Which node it is, and how it speaks.
  struct Settings {
    lockstep::NodeIndex node = 0;
    std::uint32_t incarnation = 0;
    Hello hello;
    idl::TopicTable topics;  // of the launch
    bool keeps_all =
        false;  // a recorder, in a run of which a part may be started again: answers for all nodes' samples
    std::size_t max_batch_bytes = 8'000;    // as SampleBatches
    std::size_t most_answer_bytes = 1'200;  // as Answers; what is small gets through where large datagrams do not
    std::chrono::milliseconds heartbeat{25};
    std::chrono::milliseconds clock_silence{
        3000};  // the clock repeats its grant all the time; silent this long it is gone
    std::chrono::milliseconds longest_gap{300};  // between two looks at it; the process was stopped in a longer one
    DomainSettings domain;  // of the participant; for another one that hears the clock while this one is held up
    LocalExchange* exchange = nullptr;  // with the nodes that share the process; null: there are none
    bool has_sink = false;              // one of them has a file to close
  };
  // Begins to send heartbeats, on a thread of its own. Fails as Participant::MakeWriter and MakeReader do. Roster and
  // mailbox outlive the bus.
  static base::Result<std::unique_ptr<NodeBus>> Open(Participant& participant, const lockstep::Roster& roster,
                                                     lockstep::Mailbox& mailbox, const Settings& settings);
  ~NodeBus() override;

  base::Status Publish(const lockstep::Sample& sample) override;
  void SendNack(const lockstep::Gap& gap) override;
  void Tell(const lockstep::Report& report) override;

  // A sample of another node of this process.
  void TakeLocal(const lockstep::Sample& sample);
  // From then on heartbeats carry the runner's report; before, "starting". Null before the runner goes.
  void Follow(const lockstep::Runner* runner);
  // For the hellos of later heartbeats. Any thread.
  void SetWorldHash(base::Digest hash);
  // Of a recorder: samples valid through it lie in its file. Any thread.
  void SetSafe(lockstep::Step safe);
  // The newest grant, waited for; none where the run was aborted or nothing came. `with_resume`: of a clock that knows
  // where a lost node goes on.
  std::optional<lockstep::Grant> AwaitGrant(std::chrono::milliseconds limit, bool with_resume = false);
  // Another incarnation than the first takes samples only from then on: its mailbox must know before where it begins.
  void Listen() { listens_ = true; }
  // This node's snapshot at `step`, from the node that keeps it: asked for until it comes; none after `limit` or an
  // abort.
  std::optional<lockstep::Snapshot> FetchSnapshot(lockstep::Step step, std::chrono::milliseconds limit);
  // What a recorder that is started again has in its file already.
  base::Status Remember(const lockstep::Sample& sample);
  // The node's last word, repeated until the clock says that all is over, aborts the run or is lost, at most for
  // `limit`. A node that has finished has none: until then others may ask for its samples.
  void Linger(const lockstep::Report& last, std::optional<std::chrono::milliseconds> limit);
  // While it lives, the calling thread, one that receives, handles a message.
  class Receiving {
   public:
    explicit Receiving(NodeBus& bus) : bus_(bus) {
      ++bus_.messages_begun_;
      if (bus_.settings_.exchange != nullptr) ++bus_.settings_.exchange->messages_begun;
    }
    ~Receiving() {
      ++bus_.messages_done_;
      if (bus_.settings_.exchange != nullptr) ++bus_.settings_.exchange->messages_done;
    }
    Receiving(const Receiving&) = delete;
    Receiving& operator=(const Receiving&) = delete;

   private:
    NodeBus& bus_;
  };
  // Ctrl-C is left to the clock, which stops all nodes at the same step. SIGTERM, also by the death of the parent, ends
  // this node as lost: it has 1.7 s to close what it has open. Call it once, early.
  static void HandleSignals();

 private:
  NodeBus(const lockstep::Roster& roster, lockstep::Mailbox& mailbox, const Settings& settings);
  base::Status Connect(Participant& participant);
  base::Status ConnectSampleBatches(Participant& participant);
  base::Status Say(const lockstep::Sample& sample);
  bool IsLocal(lockstep::SourceIndex source) const;  // its samples come by the exchange
  bool IsHere(lockstep::NodeIndex node) const;       // in this process, beside this node
  void Take(const lockstep::Sample& sample);
  OnPayload Noted(OnPayload on_payload);  // counts its messages
  void OnSampleBatch(const base::Bytes& payload);
  void OnAnswer(const base::Bytes& payload);
  void TakeSnapshot(const base::Bytes& payload);
  // On a receive thread of Fast DDS. `topic`: the sample's topic; empty for a sample of a batch.
  void OnSample(std::string_view topic, base::Bytes&& payload);
  void OnGrant(base::Bytes&& payload);
  // While a receiving thread is held up. No step is begun on this thread.
  void OnGrantMeanwhile(const base::Bytes& payload);
  std::optional<lockstep::Grant> Note(const base::Bytes& payload);  // of this run's clock, else none
  // The clock is heard again over another participant where the receiving thread is held up for long. From then on its
  // silence counts again.
  void ListenMeanwhile();
  bool CanHear(bool held_up) const;
  // Ends the node where a message of another process may have been passed over for want of memory.
  void LookAtAddressSpace(const lockstep::Grant& grant);
  // Ends this process where it has been told to end and does not come to it.
  void EndIfItHangs(const lockstep::Grant& grant);
  void OnNack(const base::Bytes& payload);
  Writer& WriterOf(lockstep::SourceIndex output);
  void EndEarly(lockstep::LifeEvent event, std::string reason);
  lockstep::Report ReportNow();
  // A sample was refused: where it contradicts one that is here, the reason is the node that said both.
  void AbortBy(const base::Error& error, const lockstep::Sample& came);
  void Heartbeat();
  std::uint64_t clock_id() const;  // 0 before the clock was heard

  const lockstep::Roster& roster_;
  lockstep::Mailbox& mailbox_;
  Settings settings_;
  std::atomic<bool> listens_;
  std::vector<lockstep::SourceIndex> outputs_;    // with the snapshots
  std::vector<std::unique_ptr<Writer>> writers_;  // one for each of them
  std::unique_ptr<Writer> nack_writer_;
  std::unique_ptr<Writer> reports_;
  std::vector<std::unique_ptr<Reader>> readers_;

  std::map<lockstep::NodeIndex, std::unique_ptr<Writer>> batch_writers_;  // by the node that they are for
  std::unique_ptr<Writer> answers_writer_;                                // of the answering thread

  lockstep::SampleBatches batches_;  // of the thread that publishes
  std::optional<RetransmitServer> retransmit_server_;

  mutable std::mutex mutex_;
  std::condition_variable woken_;
  const lockstep::Runner* runner_ = nullptr;
  lockstep::Report last_;
  std::uint64_t clock_id_ = 0;
  lockstep::ClockSilence clock_silence_;
  std::atomic<std::uint64_t> messages_begun_ = 0;  // by all receiving threads
  std::atomic<std::uint64_t> messages_done_ = 0;
  // A receiving thread, by one message of this node.
  std::optional<std::chrono::steady_clock::time_point> held_up_since_;
  std::optional<std::chrono::steady_clock::time_point> ends_since_;     // it has to end, and has not yet
  std::optional<std::chrono::steady_clock::time_point> leaves_since_;   // the same, of the process
  std::optional<std::chrono::steady_clock::time_point> listens_since_;  // to the clock, over another participant
  bool heard_meanwhile_ = false;
  std::optional<lockstep::Grant> heard_;
  std::optional<lockstep::Gap> wanted_;  // the snapshot that is waited for
  std::optional<lockstep::Snapshot> snapshot_;
  lockstep::Step safe_;
  bool stop_ = false;
  std::optional<GrantListener> listener_;  // of the heartbeat's thread
  const std::chrono::steady_clock::time_point opened_ = std::chrono::steady_clock::now();
  std::thread heartbeat_;
};

}  // namespace rodeira::dds
