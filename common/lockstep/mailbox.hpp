#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "common/lockstep/inbox.hpp"
#include "common/lockstep/report.hpp"
#include "common/lockstep/roster.hpp"
#include "common/lockstep/sample.hpp"

namespace rodeira::lockstep {

// Holds a node's incoming samples and grants. Any thread delivers, in any order; the runner waits for exactly what the
// law names, so the order of arrival cannot change what it sees.
class Mailbox {
 public:
  Mailbox(const Roster& roster, NodeIndex node);

  // From the bus. A sample that this node is not wired to is ignored, an equal duplicate too. What cannot be (a step
  // that is no multiple of the source's period, two contents for one step) is refused: the sentence says why.
  base::Status Deliver(Sample sample);
  void DeliverGrant(const Grant& grant);

  enum class Woken { kReady, kTimeout, kFinal, kAborted };
  // Waits until every source has delivered its sample that is the newest at `step` (the start: 0, or a snapshot's).
  Woken WaitForInputs(Step step, std::chrono::milliseconds limit);
  // Waits until activation `step` is granted and everything it must see has arrived. kFinal: `step` lies behind the
  // last step of the run. kTimeout after `limit`, so that the caller can say again what may have been lost.
  Woken WaitForActivation(Step step, std::chrono::milliseconds limit);
  // For sinks: waits for all events through the run's last step.
  Woken WaitForEventsThrough(Step last, std::chrono::milliseconds limit);

  bool IsGranted(Step step) const;
  bool HasGrant() const;
  Grant grant() const;
  // The first source that is missing for activation `step`, or none.
  std::optional<SourceIndex> FirstMissing(Step step) const;

  // What activation `step` sees. Call it once everything is there.
  Inbox Open(Step step);
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
    Step first = 0;                        // the step of slots.front()
    std::deque<std::optional<Sample>> slots;

    const Sample* Find(Step step) const;
  };
  struct Want {
    enum class What { kNothing, kInputs, kActivation, kEvents } what = What::kNothing;
    Step step = 0;
  };

  static void DropBefore(Track& track, Step oldest);  // `oldest` is a multiple of the track's period
  base::Status Keep(Sample sample, bool& wake);
  bool IsNews(const Grant& grant) const;
  Track* TrackOf(SourceIndex source);
  const Track* TrackOf(SourceIndex source) const;
  bool Has(const Track& track, Step from, Step through) const;  // every multiple of the period in [from, through]
  std::optional<SourceIndex> MissingFor(Step step) const;
  bool Satisfied(const Want& want) const;
  Woken Wait(const Want& want, std::chrono::milliseconds limit);

  const Roster& roster_;
  const NodeSpec& spec_;
  mutable std::mutex mutex_;
  std::condition_variable woken_;
  std::vector<Track> tracks_;
  Grant grant_;
  Want want_;
};

}  // namespace rodeira::lockstep
