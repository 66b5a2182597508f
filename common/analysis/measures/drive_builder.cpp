// SPDX-License-Identifier: Apache-2.0
#include "common/analysis/measures/drive_builder.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace rodeira::measures {
namespace {

// Between two samples of slower traffic the same neighbour's values are linear. A sample without a frame lies between.
void FillBetween(Neighbour& n, const std::vector<std::size_t>& frames) {
  for (std::size_t i = 1; i < frames.size(); ++i) {
    const std::size_t a = frames[i - 1], b = frames[i];
    if (b >= n.id.size() || !(n.id[a] == n.id[b])) continue;
    for (std::size_t k = a + 1; k < b; ++k) {
      const double share = static_cast<double>(k - a) / static_cast<double>(b - a);
      n.id[k] = n.id[a];
      n.gap_m[k] = n.gap_m[a] + share * (n.gap_m[b] - n.gap_m[a]);
      n.speed_mps[k] = n.speed_mps[a] + share * (n.speed_mps[b] - n.speed_mps[a]);
      n.length_m[k] = n.length_m[a];
    }
  }
}

}  // namespace

DriveBuilder::DriveBuilder(const network::Network* network, double rate_hz) {
  drive_.rate_hz = rate_hz;
  if (network == nullptr) {
    drive_.notes = "the world has no roads: what needs a lane is missing";
    return;
  }
  graph_.emplace(*network);
  lanes_.emplace(*graph_);
  leaders_.emplace(*graph_);
}

void DriveBuilder::SetFootprint(double length_m, double front_m, double width_m) {
  drive_.length_m = length_m;
  drive_.front_m = front_m;
  drive_.width_m = width_m;
}

void DriveBuilder::GrowTo(std::size_t size) {
  constexpr std::size_t kBlock = 4096;  // some fifty columns grow together: not at each sample
  if (size > drive_.size()) {
    const std::size_t whole = (size + kBlock - 1) / kBlock * kBlock;
    GrowColumns(drive_, whole);
    along_m_.resize(whole, kMissing);
  }
  for (std::size_t k = next_; k < size; ++k) drive_.episode[k] = episode_;
}

void DriveBuilder::AddSubject(std::size_t k, const SubjectSample& sample) {
  if (k < next_) return;  // repeated or out of order: the first one counts
  const bool gap = k > next_;
  GrowTo(k + 1);
  next_ = k + 1;
  PutSubject(sample, k, drive_);
  // It was set somewhere else, or the samples between are missing: no lane is left from there.
  constexpr double kJump_m = 5.0;
  const bool jumps = k > 0 && std::hypot(drive_.x_m[k] - drive_.x_m[k - 1], drive_.y_m[k] - drive_.y_m[k - 1]) >
                                  kJump_m + 2.0 * std::abs(sample.speed_mps) / drive_.rate_hz;
  AddToPath(k, gap || jumps);
  if (graph_) {
    if (gap || jumps) last_place_.reset();
    AddLane(k, sample);
  }
  if (k >= kLag) ProcessThrough(k - kLag);
}

void DriveBuilder::AddToPath(std::size_t k, bool breaks) {
  const double heading = drive_.heading_rad[k], ahead = drive_.front_m - 0.5 * drive_.length_m;
  const Footprint footprint{{drive_.x_m[k] + ahead * std::cos(heading), drive_.y_m[k] + ahead * std::sin(heading)},
                            heading,
                            drive_.length_m,
                            drive_.width_m};
  if (!std::isnan(footprint.middle_W.sum() + drive_.width_m))
    encounters_.AddOwn(static_cast<double>(k) / drive_.rate_hz, drive_.z_m[k], footprint, breaks);
}

void DriveBuilder::AddLane(std::size_t k, const SubjectSample& sample) {
  const auto place = lanes_->Find(sample.x_m, sample.y_m, sample.z_m, sample.heading_rad, hint_);
  const std::int64_t track = place ? place->track : -1;
  if (visits_.empty() || visits_.back().track != track) visits_.push_back({k, track});
  const bool goes_on = place && last_place_ && GoesOn(*graph_, *last_place_, *place);
  if (!goes_on || place->junction != last_place_->junction) ++episode_;
  if (place && last_place_ && !goes_on)
    drive_.crossing[k] = static_cast<std::int8_t>(SideOf(graph_->network(), *last_place_, *place));
  drive_.episode[k] = episode_;
  last_place_ = place;
  if (!place) return;
  PutPlace(*place, k, drive_);
  along_m_[k] = place->along_m;
}

void DriveBuilder::AddOthers(std::size_t k, const std::vector<OtherVehicle>& others, bool traffic) {
  Frame& frame = frames_[k];
  frame.others.insert(frame.others.end(), others.begin(), others.end());
  frame.traffic = frame.traffic || traffic;
}

void DriveBuilder::ProcessThrough(std::size_t k) {
  while (!frames_.empty() && frames_.begin()->first <= k) {
    const auto& [at, frame] = *frames_.begin();
    if (frame.traffic || !has_traffic_) {
      if (graph_) FindNeighbours(at, frame);
      encounters_.AddOthers(static_cast<double>(at) / drive_.rate_hz, frame.others);
    }
    frames_.erase(frames_.begin());
  }
}

void DriveBuilder::FindNeighbours(std::size_t k, const Frame& frame) {
  frame_samples_.push_back(k);
  if (k >= next_ || std::isnan(along_m_[k]) || visits_.empty()) return;
  const auto after = std::ranges::upper_bound(visits_, k, {}, &Visit::from);
  if (after == visits_.begin()) return;
  const std::int64_t track = (after - 1)->track;
  if (track < 0) return;
  const std::vector<std::uint32_t> later = LaterTracks(static_cast<std::size_t>(after - visits_.begin()) - 1);
  std::vector<std::uint32_t> earlier;
  for (auto v = after - 1; v != visits_.begin() && after - v < static_cast<std::ptrdiff_t>(kVisits); --v) {
    if ((v - 1)->track >= 0) earlier.push_back(static_cast<std::uint32_t>((v - 1)->track));
  }
  PutNeighbours(*graph_, *leaders_, static_cast<std::uint32_t>(track), along_m_[k], frame.others, later, earlier, k,
                drive_);
}

void DriveBuilder::AddLight(std::size_t k, std::uint32_t controller, double colour) {
  auto& changes = colours_[controller];
  if (changes.empty() || changes.rbegin()->second != colour) changes.emplace(k, colour);
}

std::vector<std::uint32_t> DriveBuilder::LaterTracks(std::size_t visit) const {
  std::vector<std::uint32_t> later;
  for (std::size_t v = visit + 1; v < visits_.size() && v < visit + kVisits; ++v) {
    if (visits_[v].track >= 0) later.push_back(static_cast<std::uint32_t>(visits_[v].track));
  }
  return later;
}

void DriveBuilder::PutAhead() {
  WayAhead way(*graph_);
  for (std::size_t v = 0; v < visits_.size(); ++v) {
    if (visits_[v].track < 0) continue;
    const auto found = way.From(static_cast<std::uint32_t>(visits_[v].track), LaterTracks(v));
    const std::size_t end = v + 1 < visits_.size() ? visits_[v + 1].from : drive_.size();
    for (std::size_t k = visits_[v].from; k < end; ++k) {
      if (std::isnan(along_m_[k])) continue;
      const double front_m = along_m_[k] + drive_.front_m;
      if (found.junction_d_m > along_m_[k] && *found.junction_d_m - front_m <= WayAhead::kReach_m)
        drive_.junction_ahead_m[k] = *found.junction_d_m - front_m;
      const auto light = std::ranges::upper_bound(found.lights, along_m_[k], {}, &WayAhead::Light::d_m);
      if (light == found.lights.end() || light->d_m - front_m > WayAhead::kReach_m) continue;
      drive_.light_ahead_m[k] = light->d_m - front_m;
      const auto changes = colours_.find(light->controller);
      if (changes == colours_.end()) continue;
      const auto later = changes->second.upper_bound(k);
      if (later != changes->second.begin()) drive_.light_ahead[k] = std::prev(later)->second;
    }
  }
}

Drive DriveBuilder::Finish() {
  GrowColumns(drive_, next_);
  if (next_ > 0) ProcessThrough(next_ - 1);
  if (graph_) PutAhead();
  for (Neighbour* n : {&drive_.leader, &drive_.follower, &drive_.left_leader, &drive_.left_follower,
                       &drive_.right_leader, &drive_.right_follower})
    FillBetween(*n, frame_samples_);
  drive_.encounters = encounters_.Finish();
  return std::move(drive_);
}

}  // namespace rodeira::measures
