// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/check/box_check.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "common/driving/driver/footprint.hpp"
#include "common/world/network/network.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kSmallestCell_m = 1.0;

driver::Footprint BoxOf(const AgentPose& pose, const BodySize& body) {
  const Eigen::Vector3d forward = pose.q_WB * Eigen::Vector3d::UnitX();
  driver::Footprint box;
  box.x_m = pose.p_WB_W.x(), box.y_m = pose.p_WB_W.y();
  box.heading_rad = std::atan2(forward.y(), forward.x());
  box.length_m = body.length_m, box.width_m = body.width_m;
  return box;
}

constexpr double kOrigin = 1e9;  // cells to the origin, so that cutting off rounds down everywhere

std::int64_t CellOf(double at_m, double per_cell_1pm) {
  return static_cast<std::int64_t>(at_m * per_cell_1pm + kOrigin);
}

// What a column and a row make of a bucket: the one more or less of a neighbour is added.
constexpr std::uint64_t kColumn = 0x9E3779B97F4A7C15u, kRow = 0xC2B2AE3D27D4EB4Fu;

}  // namespace

// Cells far from one another may share a bucket; their items are compared in vain.
std::size_t BoxCheck::BucketOf(std::uint64_t column, std::uint64_t row) const {
  return static_cast<std::size_t>((column ^ row) >> 32) & mask_;
}

// A counting sort by bucket. A cell is as long as two vehicles reach together: boxes overlap only in cells that touch.
void BoxCheck::Sort(std::span<const AgentPose> poses, std::span<const BodySize> bodies) {
  double reach = 0.0;
  for (const AgentPose& pose : poses) reach = std::max(reach, bodies[pose.id].reach_m);
  per_cell_1pm_ = 1.0 / std::max(kSmallestCell_m, 2.0 * reach);
  mask_ = std::bit_ceil(2 * poses.size() + 1) - 1;
  begins_.assign(mask_ + 2, 0);
  buckets_.resize(poses.size());
  items_.resize(poses.size());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Eigen::Vector3d& p_W = poses[i].p_WB_W;
    const std::size_t bucket = BucketOf(kColumn * static_cast<std::uint64_t>(CellOf(p_W.x(), per_cell_1pm_)),
                                        kRow * static_cast<std::uint64_t>(CellOf(p_W.y(), per_cell_1pm_)));
    buckets_[i] = static_cast<std::uint32_t>(bucket);
    ++begins_[bucket + 1];
  }
  for (std::size_t bucket = 0; bucket <= mask_; ++bucket) begins_[bucket + 1] += begins_[bucket];
  for (std::size_t i = poses.size(); i-- > 0;) {  // from the back: each bucket's end moves to its beginning
    const AgentPose& pose = poses[i];
    items_[--begins_[buckets_[i] + 1]] = {pose.p_WB_W.x(), pose.p_WB_W.y(), bodies[pose.id].reach_m,
                                          static_cast<std::uint32_t>(i)};
  }
}

void BoxCheck::Compare(const Item& item, std::size_t from, std::size_t to, std::span<const AgentPose> poses,
                       std::span<const BodySize> bodies) {
  for (std::size_t k = from; k < to; ++k) {
    const Item& other = items_[k];
    const double dx = other.x_m - item.x_m, dy = other.y_m - item.y_m, reach = other.reach_m + item.reach_m;
    if (dx * dx + dy * dy > reach * reach || other.pose == item.pose) continue;
    const AgentPose &a = poses[item.pose], &b = poses[other.pose];
    if (std::fabs(a.p_WB_W.z() - b.p_WB_W.z()) > network::Network::kLevel_m) continue;
    if (driver::Overlap(BoxOf(a, bodies[a.id]), BoxOf(b, bodies[b.id])))
      found_.emplace_back(std::min(a.id, b.id), std::max(a.id, b.id));
  }
}

const std::vector<BoxCheck::Pair>& BoxCheck::Find(std::span<const AgentPose> poses, std::span<const BodySize> bodies) {
  found_.clear();
  Sort(poses, bodies);
  // After Sort, begins_[b + 1] is the first item of bucket b, and begins_[b + 2] the one after its last.
  const auto compare = [&](const Item& item, std::size_t bucket) {
    const std::size_t begin = begins_[bucket + 1], end = bucket == mask_ ? items_.size() : begins_[bucket + 2];
    if (begin != end) Compare(item, begin, end, poses, bodies);
  };
  for (std::size_t i = 0; i < items_.size(); ++i) {
    const Item& item = items_[i];
    const std::uint64_t column = kColumn * static_cast<std::uint64_t>(CellOf(item.x_m, per_cell_1pm_)),
                        row = kRow * static_cast<std::uint64_t>(CellOf(item.y_m, per_cell_1pm_));
    const std::size_t own = buckets_[item.pose];
    Compare(item, i + 1, own == mask_ ? items_.size() : begins_[own + 2], poses, bodies);
    // Half of the cells around; the other half has this one among its own.
    compare(item, BucketOf(column + kColumn, row - kRow));
    compare(item, BucketOf(column + kColumn, row));
    compare(item, BucketOf(column + kColumn, row + kRow));
    compare(item, BucketOf(column, row + kRow));
  }
  std::sort(found_.begin(), found_.end());
  found_.erase(std::unique(found_.begin(), found_.end()), found_.end());
  return found_;
}

}  // namespace rodeira::traffic
