// SPDX-License-Identifier: Apache-2.0
// Which tracks lie beside one another, on one road or on two that share a side, and which distances along them do.
#include <algorithm>
#include <cmath>

#include "common/core/base/assert.hpp"
#include "common/world/lanes/graph.hpp"

namespace rodeira::lanes {
namespace {

constexpr double kFeet_m = 2.0;  // apart; between them what lies beside changes evenly to within a bend's share of that

}  // namespace

// left: as the track's traffic sees it; same_way: of two that are driven the same way, else of two that are driven
// against one another.
std::optional<std::uint32_t> Graph::BesideOf(const Track& track, bool left, bool same_way) const {
  const bool along_left = left == track.along;  // on the left as seen along s
  if (const auto own = along_left ? network_->Left(track.lane) : network_->Right(track.lane)) {
    const auto other = Find(*own);
    return other && (tracks_[*other].along == track.along) == same_way ? other : std::nullopt;
  }
  const auto sharing = along_left ? network_->SharingLeft(track.lane) : network_->SharingRight(track.lane);
  const auto other = sharing ? Find(sharing->lane) : std::nullopt;
  if (!other) return std::nullopt;
  return ((tracks_[*other].along == track.along) == sharing->same_way) == same_way ? other : std::nullopt;
}

std::optional<std::uint32_t> Graph::Oncoming(std::uint32_t track) const {
  return BesideOf(tracks_[track], !tracks_[track].left_hand, false);
}

void Graph::AddAllFeet() {
  for (std::uint32_t i = 0; i < tracks_.size(); ++i) {
    std::vector<std::pair<std::uint32_t, bool>> others;
    for (const bool same_way : {true, false}) {
      for (const bool left : {true, false}) {
        const auto beside = BesideOf(tracks_[i], left, same_way);
        if (beside && tracks_[*beside].lane.road != tracks_[i].lane.road) others.emplace_back(*beside, same_way);
      }
    }
    std::sort(others.begin(), others.end());
    for (const auto& [beside, same_way] : others) AddFeet(i, beside, same_way);
  }
}

void Graph::AddFeet(std::uint32_t track, std::uint32_t beside, bool same_way) {
  const Curve &own = tracks_[track].curve, &other = tracks_[beside].curve;
  const auto& nodes = other.nodes();
  const auto count = static_cast<std::size_t>(std::ceil(own.length_m() / kFeet_m)) + 1;
  Feet feet{track, beside, own.length_m() / static_cast<double>(count - 1), same_way, {}};
  std::size_t node = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const Eigen::Vector2d p_W = own.At(std::min(own.length_m(), static_cast<double>(k) * feet.apart_m)).p_W.head<2>();
    const auto squared = [&](std::size_t n) { return (nodes[n].p_W.head<2>() - p_W).squaredNorm(); };
    if (k == 0) {
      for (std::size_t n = 1; n < nodes.size(); ++n) node = squared(n) < squared(node) ? n : node;
    }
    while (node + 1 < nodes.size() && squared(node + 1) < squared(node)) ++node;
    while (node > 0 && squared(node - 1) < squared(node)) --node;
    feet.d_m.push_back(other.FootNear(p_W, node).d_m);
  }
  feet_.push_back(std::move(feet));
}

double Graph::Across(std::uint32_t track, double d_m, std::uint32_t beside) const {
  const Curve& curve = tracks_[track].curve;
  const double within_m = std::clamp(d_m, 0.0, curve.length_m()), beyond_m = d_m - within_m;
  if (tracks_[track].lane.road == tracks_[beside].lane.road)
    return tracks_[beside].curve.AtStation(curve.StationAt(d_m)) + beyond_m;
  const auto found = std::lower_bound(feet_.begin(), feet_.end(), std::pair(track, beside),
                                      [](const Feet& feet, const std::pair<std::uint32_t, std::uint32_t>& wanted) {
                                        return std::pair(feet.track, feet.beside) < wanted;
                                      });
  RODEIRA_ASSERT(found != feet_.end() && found->track == track && found->beside == beside);
  const double at = within_m / found->apart_m;
  const auto k = std::min(static_cast<std::size_t>(at), found->d_m.size() - 2);
  const double part = at - static_cast<double>(k);
  return found->d_m[k] + part * (found->d_m[k + 1] - found->d_m[k]) + (found->same_way ? beyond_m : -beyond_m);
}

}  // namespace rodeira::lanes
