// SPDX-License-Identifier: Apache-2.0
#include "common/analysis/measures/drive_builder.hpp"

#include <algorithm>
#include <cmath>

namespace rodeira::measures {
namespace {

void Put(Neighbour& into, std::size_t k, const Near& near) {
  if (near.vehicle == nullptr) return;
  into.id[k] = static_cast<double>(near.vehicle->id);
  into.gap_m[k] = near.gap_m;
  into.speed_mps[k] = near.vehicle->speed_mps;
  into.length_m[k] = near.vehicle->length_m;
}

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
  drive_.episode.resize(size, episode_);
  GrowColumns(drive_, size);
  along_m_.resize(size, kMissing);
}

void DriveBuilder::AddSubject(std::size_t k, const SubjectSample& sample) {
  if (k < next_) return;  // repeated or out of order: the first one counts
  const bool gap = k > next_;
  GrowTo(k + 1);
  next_ = k + 1;
  drive_.x_m[k] = sample.x_m;
  drive_.y_m[k] = sample.y_m;
  drive_.z_m[k] = sample.z_m;
  drive_.heading_rad[k] = sample.heading_rad;
  drive_.speed_mps[k] = sample.speed_mps;
  drive_.yaw_radps[k] = sample.yaw_radps;
  drive_.throttle[k] = sample.throttle;
  drive_.brake[k] = sample.brake;
  drive_.steering_wheel_deg[k] = sample.steering_wheel_deg;
  drive_.indicator[k] = sample.indicator;
  if (graph_) {
    // It was set somewhere else, or the samples between are missing: no lane is left from there.
    constexpr double kJump_m = 5.0;
    const bool jumps = k > 0 && std::hypot(drive_.x_m[k] - drive_.x_m[k - 1], drive_.y_m[k] - drive_.y_m[k - 1]) >
                                    kJump_m + 2.0 * std::abs(sample.speed_mps) / drive_.rate_hz;
    if (gap || jumps) last_place_.reset();
    AddLane(k, sample);
  }
  if (k >= kLag) ProcessThrough(k - kLag);
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
  drive_.road[k] = static_cast<double>(place->lane.road);
  drive_.lane[k] = place->lane.lane;
  drive_.s_m[k] = place->s_m;
  drive_.t_m[k] = place->t_m;
  drive_.junction[k] = place->junction ? 1.0 : 0.0;
  drive_.speed_limit_mps[k] = place->speed_limit_mps.value_or(kMissing);
  along_m_[k] = place->along_m;
  if (place->junction) return;  // several lanes lie over one another there
  drive_.lane_width_m[k] = place->width_m;
  drive_.lane_position_m[k] = place->position_m;
  drive_.heading_error_rad[k] = place->heading_error_rad;
  drive_.lane_curvature_1pm[k] = place->curvature_1pm;
  const double sine = std::sin(place->heading_error_rad), cosine = std::cos(place->heading_error_rad);
  const double front = drive_.front_m * sine, rear = (drive_.front_m - drive_.length_m) * sine;
  const double half = 0.5 * drive_.width_m * std::abs(cosine);
  drive_.left_line_m[k] = 0.5 * place->width_m - (place->position_m + std::max(front, rear) + half);
  drive_.right_line_m[k] = 0.5 * place->width_m + (place->position_m + std::min(front, rear) - half);
}

void DriveBuilder::AddOthers(std::size_t k, const std::vector<OtherVehicle>& others, bool traffic) {
  if (!graph_) return;
  Frame& frame = frames_[k];
  frame.others.insert(frame.others.end(), others.begin(), others.end());
  frame.traffic = frame.traffic || traffic;
}

void DriveBuilder::ProcessThrough(std::size_t k) {
  while (!frames_.empty() && frames_.begin()->first <= k) {
    const auto& [at, frame] = *frames_.begin();
    if (frame.traffic || !has_traffic_) FindNeighbours(at, frame);
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
  constexpr std::ptrdiff_t kVisits = 60;
  std::vector<std::uint32_t> later, earlier;
  for (auto v = after; v != visits_.end() && v - after < kVisits; ++v) {
    if (v->track >= 0) later.push_back(static_cast<std::uint32_t>(v->track));
  }
  for (auto v = after - 1; v != visits_.begin() && after - v < kVisits; --v) {
    if ((v - 1)->track >= 0) earlier.push_back(static_cast<std::uint32_t>((v - 1)->track));
  }
  // Only those that may be near are looked up.
  std::vector<OtherVehicle> close;
  for (const OtherVehicle& other : frame.others) {
    if (std::hypot(other.x_m - drive_.x_m[k], other.y_m - drive_.y_m[k]) < kNeighbourReach_m) close.push_back(other);
  }
  leaders_->SetOthers(close);
  const double front = drive_.front_m, rear = drive_.length_m - drive_.front_m;
  const auto own = static_cast<std::uint32_t>(track);
  const NearBoth near = leaders_->Find(own, along_m_[k], front, rear, later, earlier);
  Put(drive_.leader, k, near.ahead);
  Put(drive_.follower, k, near.behind);
  const auto beside = [&](const std::optional<std::uint32_t>& next_lane, Neighbour& ahead, Neighbour& behind) {
    if (!next_lane) return;
    const double along = graph_->Across(own, along_m_[k], *next_lane);
    const NearBoth both = leaders_->Find(*next_lane, along, front, rear, later, earlier);
    Put(ahead, k, both.ahead);
    Put(behind, k, both.behind);
  };
  beside((*graph_)[own].left, drive_.left_leader, drive_.left_follower);
  beside((*graph_)[own].right, drive_.right_leader, drive_.right_follower);
}

Drive DriveBuilder::Finish() {
  if (next_ > 0) ProcessThrough(next_ - 1);
  for (Neighbour* n : {&drive_.leader, &drive_.follower, &drive_.left_leader, &drive_.left_follower,
                       &drive_.right_leader, &drive_.right_follower})
    FillBetween(*n, frame_samples_);
  return std::move(drive_);
}

}  // namespace rodeira::measures
