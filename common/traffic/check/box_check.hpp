// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "common/traffic/check/body_size.hpp"
#include "common/traffic/state/agent.hpp"

namespace rodeira::traffic {

// Finds vehicles with boxes that share ground (driver::Overlap) on one level (network::Network::kLevel_m).
class BoxCheck {
 public:
  using Pair = std::pair<std::uint32_t, std::uint32_t>;  // ids, the lower one first

  // All such pairs, ascending. `poses`: by ascending id; `bodies`: by id. The result holds until the next call.
  const std::vector<Pair>& Find(std::span<const AgentPose> poses, std::span<const BodySize> bodies);

 private:
  struct Item {
    double x_m, y_m, reach_m;
    std::uint32_t pose;  // index into the poses
  };
  std::size_t BucketOf(std::uint64_t column, std::uint64_t row) const;
  void Sort(std::span<const AgentPose> poses, std::span<const BodySize> bodies);
  void Compare(const Item& item, std::size_t from, std::size_t to, std::span<const AgentPose> poses,
               std::span<const BodySize> bodies);

  double per_cell_1pm_ = 1.0;                    // one over the length of a cell's side
  std::size_t mask_ = 0;                         // buckets less 1; their number is a power of two
  std::vector<std::uint32_t> buckets_, begins_;  // by pose; by bucket: its first item
  std::vector<Item> items_;                      // bucket by bucket
  std::vector<Pair> found_;
};

}  // namespace rodeira::traffic
