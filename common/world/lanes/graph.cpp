// SPDX-License-Identifier: Apache-2.0
#include "common/world/lanes/graph.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/base/huge_pages.hpp"

namespace rodeira::lanes {
namespace {

using network::End;
using network::LaneKey;

constexpr double kCell_m = 8.0;
constexpr double kUnsaid_mps = 50.0 / 3.6;
constexpr double kNoLimit_mps = 130.0 / 3.6;

// Whether a lane of both directions lies beside lanes of one direction, as a two-way turning lane does.
bool IsTurningLane(const network::LaneSection& section, const network::Lane& lane) {
  if (lane.direction != 0) return false;
  const auto leads = [](const network::Lane& other) {
    return other.direction != 0 && network::IsDrivable(other.type) && network::OpenToCars(other);
  };
  return std::any_of(section.left.begin(), section.left.end(), leads) ||
         std::any_of(section.right.begin(), section.right.end(), leads);
}

// The way in which a lane is driven: nothing where motor traffic does not.
std::optional<bool> Along(const network::Network& network, const LaneKey& key) {
  const network::Lane& lane = *network.Find(key);
  if (!network::IsDrivable(lane.type) || !network::OpenToCars(lane)) return std::nullopt;
  if (IsTurningLane(network.Section(key), lane)) return std::nullopt;
  if (lane.direction != 0) return lane.direction > 0;
  return (key.lane < 0) != network.roads()[key.road].spec().left_hand;
}

}  // namespace

Graph::Graph(const network::Network& network) : network_(&network) {
  AddTracks();
  AddAllFeet();
  LinkLanes();
  LinkEndingLanes();
  for (Track& track : tracks_) {
    std::sort(track.next.begin(), track.next.end(), [](const Link& a, const Link& b) { return a.to < b.to; });
  }
  for (std::uint32_t i = 0; i < tracks_.size(); ++i) {
    for (const Link& link : tracks_[i].next) tracks_[link.to].before.push_back(i);
  }
  FindEntries();
  BuildGrid();
  base::PreferHugePages(tracks_);
}

void Graph::AddTracks() {
  for (const LaneKey& key : network_->Lanes()) {
    const auto along = Along(*network_, key);
    const network::LaneSection& section = network_->Section(key);
    if (!along || !(section.end_s_m > section.s_m)) continue;
    const network::RoadSpec& road = network_->roads()[key.road].spec();
    Track track{key, *along, Curve(*network_, key, *along), {}, {}, {}, {}, -1, false, road.left_hand};
    if (const auto junction = network_->FindJunction(road.junction))
      track.junction = static_cast<std::int32_t>(*junction);
    tracks_.push_back(std::move(track));
  }
  for (Track& track : tracks_) track.left = BesideOf(track, true, true), track.right = BesideOf(track, false, true);
}

std::optional<std::uint32_t> Graph::Find(const LaneKey& lane) const {
  const auto at = std::lower_bound(tracks_.begin(), tracks_.end(), lane,
                                   [](const Track& track, const LaneKey& key) { return track.lane < key; });
  if (at == tracks_.end() || at->lane != lane) return std::nullopt;
  return static_cast<std::uint32_t>(at - tracks_.begin());
}

void Graph::LinkLanes() {
  for (std::uint32_t i = 0; i < tracks_.size(); ++i) {
    const LaneKey key = tracks_[i].lane;
    for (const network::LaneEnd& end : tracks_[i].along ? network_->AtEnd(key) : network_->AtStart(key)) {
      const auto to = Find(end.lane);
      if (to && tracks_[*to].along == (end.end == End::kStart)) AddLink(i, *to, 0.0, false);
    }
  }
}

// A road's stretch that a driver's rectangle would leave: the limit of the lane, or the usual one.
double Graph::SpeedLimit_mps(std::uint32_t track, double d_m) const {
  const Track& t = tracks_[track];
  const auto limit = network_->roads()[t.lane.road].SpeedLimitAt(*network_->Find(t.lane), t.curve.StationAt(d_m));
  return limit ? std::clamp(*limit, 1.0, kNoLimit_mps) : kUnsaid_mps;
}

void Graph::BuildGrid() {
  for (std::uint32_t i = 0; i < tracks_.size(); ++i) {
    const auto& nodes = tracks_[i].curve.nodes();
    for (std::uint32_t n = 0; n < nodes.size(); ++n) {
      cells_.push_back({static_cast<std::int64_t>(std::floor(nodes[n].p_W.x() / kCell_m)),
                        static_cast<std::int64_t>(std::floor(nodes[n].p_W.y() / kCell_m)),
                        {i, n}});
    }
  }
  std::sort(cells_.begin(), cells_.end());
}

void Graph::Near(const Eigen::Vector2d& p_W, double radius_m, std::vector<NodeKey>& nodes) const {
  nodes.clear();
  const auto cell = [](double x) { return static_cast<std::int64_t>(std::floor(x / kCell_m)); };
  for (std::int64_t x = cell(p_W.x() - radius_m); x <= cell(p_W.x() + radius_m); ++x) {
    const std::int64_t low = cell(p_W.y() - radius_m), high = cell(p_W.y() + radius_m);
    for (auto at = std::lower_bound(cells_.begin(), cells_.end(), Cell{x, low, {}});
         at != cells_.end() && at->x == x && at->y <= high; ++at) {
      const auto& node = tracks_[at->node.track].curve.nodes()[at->node.node];
      if ((node.p_W.head<2>() - p_W).squaredNorm() <= radius_m * radius_m) nodes.push_back(at->node);
    }
  }
  std::sort(nodes.begin(), nodes.end());
}

std::vector<Graph::Beside> Graph::TracksAt(const Eigen::Vector2d& p_W, double radius_m) const {
  std::vector<NodeKey> nodes;
  Near(p_W, radius_m, nodes);
  std::vector<Beside> beside;
  for (std::size_t i = 0; i < nodes.size();) {
    const Track& track = tracks_[nodes[i].track];
    std::uint32_t best = nodes[i].node;
    double least = 1e300;
    const std::uint32_t number = nodes[i].track;
    for (; i < nodes.size() && nodes[i].track == number; ++i) {
      const double squared = (track.curve.nodes()[nodes[i].node].p_W.head<2>() - p_W).squaredNorm();
      if (squared < least) least = squared, best = nodes[i].node;
    }
    beside.push_back({number, track.curve.FootNear(p_W, best)});
  }
  return beside;
}

}  // namespace rodeira::lanes
