// SPDX-License-Identifier: Apache-2.0
// What is saved of traffic, and how it goes on from there.
#include <algorithm>

#include "common/traffic/traffic_model.hpp"

namespace rodeira::traffic {

void TrafficModel::Save(base::StateWriter& writer) const {
  for (const Agent& agent : agents_) writer.Put("agent", agent);
  if (full_) writer.Put("full", *full_);
  for (const MotorsDriver& driver : motors_) writer.Put("motors", driver);
  if (people_) writer.Put("people", *people_);
  for (const Yielding& yielding : yielding_) {
    writer.Put("yields", yielding.crossing);
    writer.Put("yielded_s", yielding.waited_s);
  }
  writer.Put("waiting", waiting_);
  std::vector<std::uint32_t> appearing;
  std::vector<double> appearing_at;
  for (const Appearing& next : appearing_) {
    appearing.insert(appearing.end(), {next.id, next.track});
    appearing_at.insert(appearing_at.end(), {next.d_m, next.speed_mps});
  }
  if (!settings_.scripted.empty()) {
    writer.Put("appearing", appearing);
    writer.Put("appearing_at", appearing_at);
  }
  writer.Put("next_grant", next_grant_);
  writer.Put("time_ns", time_ns_);
  writer.Put("ended", ended_);
  writer.Put("missed", missed_);
  for (const FlowCount& flow : flows_) {
    writer.Put("arrived", flow.arrived);
    writer.Put("given", flow.given);
    writer.Put("next_ns", flow.next_ns);
  }
}

// A snapshot comes from outside: whatever it says, nothing is read beside the arrays.
void TrafficModel::Restore(base::StateReader& reader) {
  for (Agent& agent : agents_) reader.Get("agent", agent);
  if (full_) reader.Get("full", *full_);
  for (MotorsDriver& driver : motors_) {
    reader.Get("motors", driver);
    if (driver.track >= graph().tracks().size())
      driver.lanes = driver.track = 0;
    else
      driver.checkpoint = std::min(driver.checkpoint, MotorsPoints(driver) - 2);
  }
  if (people_) reader.Get("people", *people_);
  for (Yielding& yielding : yielding_) {
    reader.Get("yields", yielding.crossing);
    reader.Get("yielded_s", yielding.waited_s);
  }
  way_keys_.assign(agents_.size(), {});  // what is remembered of steps before is of another past
  stretches_.assign(agents_.size(), {});
  passages_.assign(agents_.size(), {});
  known_.assign(agents_.size(), {});
  below_.assign(agents_.size(), {});
  reader.Get("waiting", waiting_);
  std::vector<std::uint32_t> appearing;
  std::vector<double> appearing_at;
  if (!settings_.scripted.empty()) {
    reader.Get("appearing", appearing);
    reader.Get("appearing_at", appearing_at);
  }
  appearing_.clear();
  for (std::size_t i = 0; 2 * i + 1 < appearing.size() && 2 * i + 1 < appearing_at.size(); ++i) {
    const Appearing next{appearing[2 * i], appearing[2 * i + 1], appearing_at[2 * i], appearing_at[2 * i + 1]};
    if (next.id < settings_.vehicles || next.id >= agents_.size() || next.track >= graph().tracks().size()) continue;
    if (next.d_m >= 0.0 && next.d_m <= graph()[next.track].length_m() && next.speed_mps >= 0.0)
      appearing_.push_back(next);
  }
  reader.Get("next_grant", next_grant_);
  reader.Get("time_ns", time_ns_);
  reader.Get("ended", ended_);
  reader.Get("missed", missed_);
  for (FlowCount& flow : flows_) {
    reader.Get("arrived", flow.arrived);
    reader.Get("given", flow.given);
    reader.Get("next_ns", flow.next_ns);
  }
  for (Agent& agent : agents_) {
    const auto tracks = graph().tracks().size();
    if (agent.entry >= tracks ||
        std::any_of(agent.path.begin(), agent.path.end(), [&](const Piece& p) { return p.track >= tracks; }))
      agent = Agent();
    if (agent.overtaking.passed >= static_cast<std::int64_t>(agents_.size())) agent = Agent();
    if (agent.flow >= static_cast<std::int32_t>(flows_.size())) agent.flow = -1;
    const Route* route = RouteOf(agent);
    if (route != nullptr) agent.leg = std::min(agent.leg, route->legs());
  }
  for (std::uint32_t id = 0; full_ && id < agents_.size(); ++id) {
    if (!agents_[id].on_road)
      full_->Clear(id);
    else if (!full_->cars().present(id))
      agents_[id] = Agent();
  }
  for (std::uint32_t id = 0; has_flows() && id < agents_.size(); ++id) traits_[id] = TraitsFor(id);
  std::erase_if(waiting_, [&](std::uint32_t id) { return id >= agents_.size(); });
  FindColours();
  std::fill(is_moved_.begin(), is_moved_.end(), 0);
  FindPoses();
}

}  // namespace rodeira::traffic
