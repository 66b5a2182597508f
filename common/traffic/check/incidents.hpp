// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <string>
#include <vector>

#include "common/traffic/state/agent.hpp"
#include "common/world/network/network.hpp"

namespace rodeira::traffic {

// The first incidents of a run, as sentences.
class Incidents {
 public:
  static constexpr std::size_t kMax = 20;

  // The network outlives it.
  explicit Incidents(const network::Network& network) : network_(network) {}

  // `what`: a format of fmt for the values.
  template <class... Values>
  void Tell(double time_s, const AgentPose& pose, const char* what, Values... values) {
    if (sentences_.size() >= kMax) return;
    sentences_.push_back(Place(time_s, pose) + fmt::format(fmt::runtime(what), values...));
  }
  // The id of the road that the vehicle is on.
  const std::string& RoadOf(const AgentPose& pose) const {
    return network_.roads()[static_cast<std::size_t>(pose.road)].id();
  }
  const std::vector<std::string>& sentences() const { return sentences_; }

 private:
  std::string Place(double time_s, const AgentPose& pose) const {
    return fmt::format("{:.2f} s: car {} on road '{}', lane {}, at ({:.2f}, {:.2f}), {:.2f} m/s: ", time_s, pose.id,
                       RoadOf(pose), pose.lane, pose.p_WB_W.x(), pose.p_WB_W.y(), pose.speed_mps);
  }

  const network::Network& network_;
  std::vector<std::string> sentences_;
};

}  // namespace rodeira::traffic
