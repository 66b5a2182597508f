// SPDX-License-Identifier: Apache-2.0
#include "common/world/network/network.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/base/assert.hpp"
#include "common/world/network/junction_ground.hpp"
#include "common/world/network/sign_limits.hpp"

namespace rodeira::network {

Eigen::Vector2d GeoOffset::ToMap(const Eigen::Vector2d& p_W) const {
  const double cosine = std::cos(heading_rad), sine = std::sin(heading_rad);
  return {p_W.x() * cosine - p_W.y() * sine + x_m, p_W.x() * sine + p_W.y() * cosine + y_m};
}

Eigen::Vector2d GeoOffset::FromMap(const Eigen::Vector2d& p_map) const {
  const double cosine = std::cos(heading_rad), sine = std::sin(heading_rad), x = p_map.x() - x_m, y = p_map.y() - y_m;
  return {x * cosine + y * sine, y * cosine - x * sine};
}

Network::Network(NetworkSpec spec)
    : spec_(std::move(spec)), index_(spec_.roads, kClosed_m), records_(spec_.roads, index_) {
  for (std::uint32_t i = 0; i < spec_.roads.size(); ++i) road_by_id_.emplace(spec_.roads[i].id(), i);
  for (std::uint32_t i = 0; i < spec_.junctions.size(); ++i) junction_by_id_.emplace(spec_.junctions[i].id, i);
  for (const Junction& junction : spec_.junctions) {
    if (junction.ground != nullptr) grounds_.push_back(junction.ground.get());
  }
  Link();
  SetSignSpeeds();
}

void Network::SetSignSpeeds() {
  const auto speeds = SignSpeeds(*this);
  for (const LaneKey& key : Lanes()) {
    LaneSection& section = spec_.roads[key.road].spec_.sections[key.section];
    Lane& lane = key.lane > 0 ? section.left[static_cast<std::size_t>(key.lane - 1)]
                              : section.right[static_cast<std::size_t>(-key.lane - 1)];
    lane.sign_speeds = speeds.empty() ? std::vector<SignSpeed>() : speeds[Number(key)];
  }
}

const JunctionGround* Network::GroundAt(const Eigen::Vector2d& p_W) const {
  for (const JunctionGround* ground : grounds_) {
    if (ground->Contains(p_W)) return ground;
  }
  return nullptr;
}

std::optional<std::uint32_t> Network::FindRoad(std::string_view id) const {
  const auto found = road_by_id_.find(id);
  return found == road_by_id_.end() ? std::nullopt : std::optional(found->second);
}

std::optional<std::uint32_t> Network::FindJunction(std::string_view id) const {
  const auto found = junction_by_id_.find(id);
  return found == junction_by_id_.end() ? std::nullopt : std::optional(found->second);
}

const Lane* Network::Find(const LaneKey& key) const {
  if (key.road >= roads().size() || key.section >= roads()[key.road].spec().sections.size()) return nullptr;
  return Section(key).Find(key.lane);
}

Eigen::Vector3d Network::Centre(const LaneKey& key, double s_m) const {
  const auto span = Span(key, s_m);
  RODEIRA_ASSERT(span.has_value());
  return roads()[key.road]
      .Surface(roads()[key.road].Held(key.section, s_m), span->centre_t_m(), Section(key), *span)
      .p_W;
}

std::size_t Network::Number(const LaneKey& key) const {
  return first_lane_[key.road][key.section] +
         static_cast<std::size_t>(key.lane + static_cast<int>(Section(key).right.size()));
}

std::span<const LaneEnd> Network::AtEnd(const LaneKey& key) const { return ends_[Number(key)].at_end; }
std::span<const LaneEnd> Network::AtStart(const LaneKey& key) const { return ends_[Number(key)].at_start; }

std::span<const LaneEnd> Network::Successors(const LaneKey& key) const {
  return Find(key)->direction < 0 ? AtStart(key) : AtEnd(key);
}
std::span<const LaneEnd> Network::Predecessors(const LaneKey& key) const {
  return Find(key)->direction < 0 ? AtEnd(key) : AtStart(key);
}

std::optional<LaneKey> Network::Left(const LaneKey& key) const {
  const LaneKey beside{key.road, key.section, key.lane == -1 ? 1 : key.lane + 1};
  return Find(beside) == nullptr ? std::nullopt : std::optional(beside);
}

std::optional<LaneKey> Network::Right(const LaneKey& key) const {
  const LaneKey beside{key.road, key.section, key.lane == 1 ? -1 : key.lane - 1};
  return Find(beside) == nullptr ? std::nullopt : std::optional(beside);
}

std::optional<Network::Sharing> Network::SharingOf(const LaneKey& key, std::optional<LaneName> Lane::*side) const {
  const std::optional<LaneName>& name = Find(key)->*side;
  const auto road = name ? FindRoad(name->road) : std::nullopt;
  if (!road) return std::nullopt;
  const LaneName own{roads()[key.road].id(), key.lane};
  const auto& sections = roads()[*road].spec().sections;
  for (std::uint32_t section = 0; section < sections.size(); ++section) {
    const LaneKey other{*road, section, name->lane};
    const Lane* lane = Find(other);
    if (lane == nullptr || lane->id == 0 || other == key) continue;
    for (const auto back : {&Lane::left_beside, &Lane::right_beside}) {
      if (lane->*back == own) return Sharing{other, back != side};
    }
  }
  return std::nullopt;
}

std::vector<LaneKey> Network::Lanes() const {
  std::vector<LaneKey> lanes;
  for (std::uint32_t road = 0; road < roads().size(); ++road) {
    const auto& sections = roads()[road].spec().sections;
    for (std::uint32_t section = 0; section < sections.size(); ++section) {
      for (int id = -static_cast<int>(sections[section].right.size());
           id <= static_cast<int>(sections[section].left.size()); ++id) {
        if (id != 0) lanes.push_back({road, section, id});
      }
    }
  }
  return lanes;
}

}  // namespace rodeira::network
