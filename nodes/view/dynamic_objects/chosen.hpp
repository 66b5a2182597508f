// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "common/view/scene/vehicles/scene_snapshot.hpp"

namespace rodeira::nodes {

// The vehicle that a person looks at, and what is said of it.
class Chosen {
 public:
  // One of the moment's cars or, numbered behind them, of its traffic; nothing: none any more.
  void Choose(const scene::SceneSnapshot& moment, std::optional<std::size_t> number);
  // Where it is among the moment's now; none where it has left.
  std::optional<std::size_t> In(const scene::SceneSnapshot& moment) const;
  // Lines about it: speed, pedals, gear, engine, consumption of a driver's car (at the moment, and since it was
  // chosen); of the traffic the same where it says so, and what its driver plans. Empty where it is not there.
  std::string Panel(const scene::SceneSnapshot& moment);

 private:
  std::string AgentPanel(const scene::SceneSnapshot& moment, const scene::AgentPose& agent);
  struct Vehicle {
    bool is_car = false;
    std::uint64_t id = 0;
  };
  std::optional<Vehicle> vehicle_;
  // Since when its mean consumption is counted.
  std::int64_t since_ns_ = 0;
  double since_l_ = 0.0, since_m_ = 0.0;
  // Of the traffic, which does not say how far it has gone: as far as it was seen.
  std::int64_t seen_ns_ = 0;
  Eigen::Vector3d seen_W_ = Eigen::Vector3d::Zero();
  double seen_m_ = 0.0;
};

}  // namespace rodeira::nodes
