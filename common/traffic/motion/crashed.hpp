// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "common/core/base/state.hpp"
#include "common/traffic/state/traffic_settings.hpp"

namespace rodeira::traffic {

// A car that has been hit: a rectangle that slides on four locked wheels and stays where it comes to rest.
struct Crashed {
  Eigen::Vector2d p_W = Eigen::Vector2d::Zero();  // of its middle
  double heading_rad = 0.0;
  Eigen::Vector2d v_W = Eigen::Vector2d::Zero();
  double yaw_rate_radps = 0.0;

  // An impulse on it, N s, at a point: v += J/m, yaw rate += (r × J)/I, I = m (length² + width²)/12.
  void Push(const AgentTraits& traits, const Eigen::Vector2d& impulse_Ns, const Eigen::Vector2d& point_W);
  // Each wheel, at the corners of wheelbase and width, bears a quarter of the weight and slides with the friction
  // coefficient mu.
  void Slide(const AgentTraits& traits, double mu, double dt_s);
  bool at_rest() const { return v_W.isZero(0.0) && yaw_rate_radps == 0.0; }

  void Save(base::StateWriter& writer) const;
  void Restore(base::StateReader& reader);
};

}  // namespace rodeira::traffic
