// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "common/runtime/lockstep/inbox.hpp"
#include "common/runtime/lockstep/life.hpp"
#include "common/runtime/lockstep/report.hpp"
#include "common/runtime/lockstep/ring.hpp"
#include "common/runtime/lockstep/roster.hpp"
#include "common/runtime/lockstep/sample.hpp"

namespace rodeira::lockstep {

// A source, and its oldest sample that a consumer lacks.
struct Gap {
  SourceIndex source = 0;
  Step from = 0;
};

// Holds a node's incoming samples and grants. Any thread delivers, in any order; the runner waits for exactly what the
// law names, so the order of arrival cannot change what it sees.
class Mailbox {
 public:
  // The roster outlives it.
  Mailbox(const Roster& roster, NodeIndex node);

  // From the bus. A sample that this node is not wired to is ignored, an equal duplicate too. What cannot be (a step
  // that is no multiple of the source's period, two contents for one step) is refused: the sentence says why.
  base::Status Deliver(Sample sample);
  // A grant that says less than the one that is here changes nothing.
  void DeliverGrant(const Grant& grant);
  // The node ends whatever the clock says: every wait ends with kAborted, and grant() aborts from now on. The first
  // reason counts.
  void EndEarly(EarlyEnd end);
  std::optional<EarlyEnd> early_end() const;

  enum class Woken { kReady, kTimeout, kFinal, kAborted };
  // The start, at 0 or at a snapshot: waits until every source has delivered its sample that is the newest at `step`,
  // and of events those through `step` that the first activation will see.
  Woken WaitForInputs(Step step, std::chrono::milliseconds limit);
  // Waits until activation `step` is granted and everything it must see has arrived. kFinal: `step` lies behind the
  // last step of the run. kTimeout after `limit`, so that the caller can say again what may have been lost.
  Woken WaitForActivation(Step step, std::chrono::milliseconds limit);
  // For sinks: waits for all events through the run's last step.
  Woken WaitForEventsThrough(Step last, std::chrono::milliseconds limit);

  // Instead of a thread that waits: `on_ready` is called, on the thread that delivers and with no lock held, when what
  // the last wait timed out for is there, or the run ends. Null: no call any more.
  void OnReady(std::shared_ptr<const std::function<void()>> on_ready);

  // What has been delivered and not forgotten.
  std::optional<Sample> Kept(SourceIndex source, Step step) const;
  // Whether the newest grant reaches the step.
  bool IsGranted(Step step) const;
  Grant grant() const;
  // Of grant(), without a copy: whether the run is aborted, and the run's last step where it is known, else kNever.
  bool is_aborted() const;
  Step last_step() const;
  // What WaitForInputs(step) still lacks.
  std::vector<Gap> MissingInputs(Step step) const;
  // What activation `step` still lacks: each source with the oldest sample of it that is not there.
  std::vector<Gap> Missing(Step step) const;
  // The first of them.
  std::optional<Gap> FirstMissing(Step step) const;
  // The same for WaitForEventsThrough(last).
  std::vector<Gap> MissingEvents(Step last) const;

  // What activation `step` sees, instead of the inbox's content. Call it once everything is there, with the same inbox
  // each time or an empty one.
  void Open(Step step, Inbox& inbox) const;
  // Events in (after, through], whatever has arrived.
  Inbox OpenEvents(Step after, Step through);
  // The newest step through which every event port is complete, beginning behind `after`.
  Step CompleteThrough(Step after) const;
  // Nothing before a snapshot at `at` will come: the first activation is the first one at or after it.
  void StartAt(Step at);
  // Forgets what no activation at or after `step` can ask for.
  void Forget(Step step);

 private:
  struct Track {
    SourceIndex source = 0;
    Step period = 1;
    bool events = false;
    Step first = 0;  // the step of slots.front()
    Ring<std::optional<Sample>> slots;

    const Sample* Find(Step step) const;
  };
  struct Want {
    enum class What { kNothing, kInputs, kActivation, kEvents } what = What::kNothing;
    Step step = 0;
  };

  Step Farthest(const Track& track) const;            // the last step of which a sample can be there
  static void DropBefore(Track& track, Step oldest);  // `oldest` is a multiple of the track's period
  base::Status Keep(Sample sample, bool& wake);
  bool IsOver(const Want& want) const;  // satisfied, or it never will be
  void Wake();
  bool IsNews(const Grant& grant) const;
  Track* TrackOf(SourceIndex source);
  const Track* TrackOf(SourceIndex source) const;
  // The oldest multiple of the period in [from, through] that is not there.
  static std::optional<Step> FirstGap(const Track& track, Step from, Step through);
  std::optional<Step> GapFor(const Track& track, Step step) const;    // of activation `step`
  std::optional<Step> InputGap(const Track& track, Step step) const;  // of the start at `step`
  bool Satisfied(const Want& want) const;
  Woken Wait(const Want& want, std::chrono::milliseconds limit);

  const Roster& roster_;
  const RosterNode& spec_;
  mutable std::mutex mutex_;
  std::condition_variable woken_;
  std::vector<Track> tracks_;
  std::vector<std::vector<std::size_t>> tracks_of_ports_;  // of each port's sources
  Grant grant_;
  std::optional<EarlyEnd> early_end_;
  Want want_;  // of the last wait, until it was satisfied
  std::shared_ptr<const std::function<void()>> on_ready_;
};

}  // namespace rodeira::lockstep
