// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/lockstep/mailbox.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "common/core/base/assert.hpp"

namespace rodeira::lockstep {

const Sample* Mailbox::Track::Find(Step step) const {
  if (step < first) return nullptr;
  const auto at = static_cast<std::size_t>((step - first) / period);
  return at < slots.size() && slots[at] ? &*slots[at] : nullptr;
}

Mailbox::Mailbox(const Roster& roster, NodeIndex node) : roster_(roster), spec_(roster.node(node)) {
  for (const Port& port : spec_.inputs) {
    for (const SourceIndex source : port.sources) {
      tracks_.push_back({source, roster.source(source).period, port.kind == PortKind::kEvent, 0, {}});
    }
  }
  for (const Port& port : spec_.inputs) {
    auto& tracks = tracks_of_ports_.emplace_back();
    for (const SourceIndex source : port.sources)
      tracks.push_back(static_cast<std::size_t>(TrackOf(source) - tracks_.data()));
  }
}

Mailbox::Track* Mailbox::TrackOf(SourceIndex source) {
  const auto found =
      std::find_if(tracks_.begin(), tracks_.end(), [&](const Track& track) { return track.source == source; });
  return found == tracks_.end() ? nullptr : &*found;
}
const Mailbox::Track* Mailbox::TrackOf(SourceIndex source) const { return const_cast<Mailbox*>(this)->TrackOf(source); }

base::Status Mailbox::Deliver(Sample sample) {
  bool wake = false;
  auto status = Keep(std::move(sample), wake);
  if (wake) Wake();  // without the lock: the woken thread would only run into it
  return status;
}

void Mailbox::Wake() {
  std::shared_ptr<const std::function<void()>> on_ready;
  {
    const std::lock_guard lock(mutex_);
    on_ready = on_ready_;
  }
  woken_.notify_all();
  if (on_ready) (*on_ready)();
}

void Mailbox::OnReady(std::shared_ptr<const std::function<void()>> on_ready) {
  const std::lock_guard lock(mutex_);
  on_ready_ = std::move(on_ready);
}

base::Status Mailbox::Keep(Sample sample, bool& wake) {
  const std::lock_guard lock(mutex_);
  Track* track = TrackOf(sample.source());
  if (track == nullptr) return {};
  const Step step = sample.valid();
  const std::string_view topic = roster_.source(sample.source()).topic;
  if (step < 0 || step % track->period != 0) {
    return base::WrongInput(
        "run.wrong_sample",
        fmt::format("a sample valid at {} was found, multiples of the period {} were expected", step, track->period),
        fmt::format("{} (topic {})", roster_.SourceName(sample.source()), topic));
  }
  if (step < track->first) return {};  // an old one said again
  const auto at = static_cast<std::size_t>((step - track->first) / track->period);
  if (const Step farthest = Farthest(*track); step > farthest) {
    return base::WrongInput(
        "run.wrong_sample",
        fmt::format("a sample valid at {} was found; steps from {} to {} were expected", step, track->first, farthest),
        roster_.SourceName(sample.source()));
  }
  if (at >= track->slots.size()) track->slots.resize(at + 1);
  if (track->slots[at]) {
    if (SameContent(*track->slots[at], sample)) return {};
    return base::WrongInput("run.two_samples", fmt::format("two different samples are valid at step {}", step),
                            roster_.SourceName(sample.source()));
  }
  track->slots[at] = std::move(sample);
  wake = want_.what != Want::What::kNothing && IsOver(want_);
  return {};
}

// No source runs further ahead than the window beyond the slowest node, which is at most an activation before this one,
// and publishes its delay ahead. A node that is started again is behind the grant.
Step Mailbox::Farthest(const Track& track) const {
  const RosterNode& producer = roster_.node(roster_.source(track.source).node);
  return std::max(track.first + track.period + spec_.period, grant_.through) + roster_.window() +
         std::max(producer.delay, producer.period) + track.period;
}

std::optional<Sample> Mailbox::Kept(SourceIndex source, Step step) const {
  const std::lock_guard lock(mutex_);
  const Track* track = TrackOf(source);
  const Sample* sample = track == nullptr ? nullptr : track->Find(step);
  return sample == nullptr ? std::nullopt : std::optional(*sample);
}

void Mailbox::DeliverGrant(const Grant& grant) {
  bool wake = false;
  {
    const std::lock_guard lock(mutex_);
    if (!IsNews(grant)) return;  // said again, or overtaken on its way
    grant_ = grant;
    wake = want_.what != Want::What::kNothing && IsOver(want_);
  }
  if (wake) Wake();
}

void Mailbox::EndEarly(EarlyEnd end) {
  bool wake = false;
  {
    const std::lock_guard lock(mutex_);
    if (early_end_) return;
    early_end_ = std::move(end);
    wake = want_.what != Want::What::kNothing;
  }
  if (wake) Wake();
}

std::optional<EarlyEnd> Mailbox::early_end() const {
  const std::lock_guard lock(mutex_);
  return early_end_;
}

bool Mailbox::IsNews(const Grant& grant) const {
  return grant.through > grant_.through || (grant.final && !grant_.final) || (grant.abort && !grant_.abort) ||
         (grant.over && !grant_.over);
}

std::optional<Step> Mailbox::FirstGap(const Track& track, Step from, Step through) {
  for (Step step = CeilTo(from, track.period); step <= through; step += track.period) {
    if (track.Find(step) == nullptr) return step;
  }
  return std::nullopt;
}

std::optional<Step> Mailbox::GapFor(const Track& track, Step step) const {
  const Step newest = FloorTo(step, track.period);
  return FirstGap(track, track.events ? std::max<Step>(step - spec_.period + 1, 0) : newest, newest);
}

std::optional<Step> Mailbox::InputGap(const Track& track, Step step) const {
  const Step newest = FloorTo(step, track.period);
  return FirstGap(track, track.events ? std::max<Step>(CeilTo(step, spec_.period) - spec_.period + 1, 0) : newest,
                  newest);
}

bool Mailbox::Satisfied(const Want& want) const {
  switch (want.what) {
    case Want::What::kNothing:
      return true;
    case Want::What::kInputs:
      return std::none_of(tracks_.begin(), tracks_.end(),
                          [&](const Track& track) { return InputGap(track, want.step).has_value(); });
    case Want::What::kActivation:
      return grant_.through >= want.step && std::none_of(tracks_.begin(), tracks_.end(), [&](const Track& track) {
               return GapFor(track, want.step).has_value();
             });
    case Want::What::kEvents:
      return std::all_of(tracks_.begin(), tracks_.end(),
                         [&](const Track& track) { return !track.events || !FirstGap(track, track.first, want.step); });
  }
  return false;
}

bool Mailbox::IsOver(const Want& want) const {
  return grant_.abort || early_end_ ||
         (want.what == Want::What::kActivation && grant_.final && want.step > grant_.through) || Satisfied(want);
}

Mailbox::Woken Mailbox::Wait(const Want& want, std::chrono::milliseconds limit) {
  std::unique_lock lock(mutex_);
  want_ = want;
  if (!IsOver(want) && !(limit.count() > 0 && woken_.wait_for(lock, limit, [&] { return IsOver(want); })))
    return Woken::kTimeout;
  want_ = {};
  if (grant_.abort || early_end_) return Woken::kAborted;
  return Satisfied(want) ? Woken::kReady : Woken::kFinal;
}

Mailbox::Woken Mailbox::WaitForInputs(Step step, std::chrono::milliseconds limit) {
  return Wait({Want::What::kInputs, step}, limit);
}
Mailbox::Woken Mailbox::WaitForActivation(Step step, std::chrono::milliseconds limit) {
  return Wait({Want::What::kActivation, step}, limit);
}
Mailbox::Woken Mailbox::WaitForEventsThrough(Step last, std::chrono::milliseconds limit) {
  return Wait({Want::What::kEvents, last}, limit);
}

bool Mailbox::IsGranted(Step step) const {
  const std::lock_guard lock(mutex_);
  return grant_.through >= step;
}
Grant Mailbox::grant() const {
  const std::lock_guard lock(mutex_);
  Grant grant = grant_;
  if (early_end_ && !grant.abort) {
    grant.abort = true;
    grant.reason = early_end_->reason;
  }
  return grant;
}
bool Mailbox::is_aborted() const {
  const std::lock_guard lock(mutex_);
  return grant_.abort || early_end_;
}
Step Mailbox::last_step() const {
  const std::lock_guard lock(mutex_);
  return grant_.final ? grant_.through : kNever;
}
std::optional<Gap> Mailbox::FirstMissing(Step step) const {
  const std::lock_guard lock(mutex_);
  for (const Track& track : tracks_) {
    if (const auto from = GapFor(track, step)) return Gap{track.source, *from};
  }
  return std::nullopt;
}
std::vector<Gap> Mailbox::MissingInputs(Step step) const {
  const std::lock_guard lock(mutex_);
  std::vector<Gap> gaps;
  for (const Track& track : tracks_) {
    if (const auto from = InputGap(track, step)) gaps.push_back({track.source, *from});
  }
  return gaps;
}
std::vector<Gap> Mailbox::Missing(Step step) const {
  const std::lock_guard lock(mutex_);
  std::vector<Gap> gaps;
  for (const Track& track : tracks_) {
    if (const auto from = GapFor(track, step)) gaps.push_back({track.source, *from});
  }
  return gaps;
}
std::vector<Gap> Mailbox::MissingEvents(Step last) const {
  const std::lock_guard lock(mutex_);
  std::vector<Gap> gaps;
  for (const Track& track : tracks_) {
    if (!track.events) continue;
    if (const auto from = FirstGap(track, track.first, last)) gaps.push_back({track.source, *from});
  }
  return gaps;
}

// Samples by step, and those of one step in the order of the port's sources.
void Mailbox::Open(Step step, Inbox& inbox) const {
  const std::lock_guard lock(mutex_);
  inbox.ports_.resize(spec_.inputs.size());
  for (std::size_t p = 0; p < spec_.inputs.size(); ++p) {
    const Port& port = spec_.inputs[p];
    Inbox::PortSamples& out = inbox.ports_[p];
    out.topic = port.topic;
    out.samples.clear();
    const auto add = [&](const Track& track, Step valid) {
      const Sample* sample = track.Find(valid);
      RODEIRA_ASSERT(sample != nullptr);
      out.samples.push_back(*sample);
    };
    if (port.kind != PortKind::kEvent) {
      for (const std::size_t t : tracks_of_ports_[p]) add(tracks_[t], FloorTo(step, tracks_[t].period));
      continue;
    }
    for (Step valid = std::max<Step>(step - spec_.period + 1, 0); valid <= step; ++valid) {
      for (const std::size_t t : tracks_of_ports_[p]) {
        if (valid % tracks_[t].period == 0) add(tracks_[t], valid);
      }
    }
  }
}

Inbox Mailbox::OpenEvents(Step after, Step through) {
  const std::lock_guard lock(mutex_);
  std::vector<Inbox::PortSamples> ports;
  for (const Port& port : spec_.inputs) {
    if (port.kind != PortKind::kEvent) continue;
    Inbox::PortSamples out{port.topic, {}};
    for (const SourceIndex source : port.sources) {
      const Track& track = *TrackOf(source);
      for (Step s = CeilTo(after + 1, track.period); s <= through; s += track.period) {
        if (const Sample* sample = track.Find(s)) out.samples.push_back(*sample);
      }
    }
    std::stable_sort(out.samples.begin(), out.samples.end(),
                     [](const Sample& a, const Sample& b) { return a.valid() < b.valid(); });
    ports.push_back(std::move(out));
  }
  return Inbox(std::move(ports));
}

Step Mailbox::CompleteThrough(Step after) const {
  const std::lock_guard lock(mutex_);
  Step complete = std::numeric_limits<Step>::max();
  for (const Track& track : tracks_) {
    if (!track.events) continue;
    Step next = CeilTo(after + 1, track.period);
    while (track.Find(next) != nullptr) next += track.period;
    complete = std::min(complete, next - 1);
  }
  return complete == std::numeric_limits<Step>::max() ? after : complete;
}

void Mailbox::StartAt(Step at) {
  const std::lock_guard lock(mutex_);
  const Step after = CeilTo(at, spec_.period) - spec_.period;
  for (Track& track : tracks_) {
    const Step oldest = track.events ? CeilTo(std::max<Step>(after + 1, 0), track.period) : FloorTo(at, track.period);
    DropBefore(track, oldest);
  }
}

void Mailbox::Forget(Step step) {
  const std::lock_guard lock(mutex_);
  for (Track& track : tracks_) {
    const Step oldest =
        track.events ? CeilTo(std::max<Step>(step - spec_.period + 1, 0), track.period) : FloorTo(step, track.period);
    DropBefore(track, oldest);
  }
}

void Mailbox::DropBefore(Track& track, Step oldest) {
  while (track.first < oldest && !track.slots.empty()) {
    track.slots.pop_front();
    track.first += track.period;
  }
  track.first = std::max(track.first, oldest);
}

}  // namespace rodeira::lockstep
