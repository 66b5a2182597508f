// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "common/world/network/road.hpp"

// Road::Settle and Road::DistanceToEdge along one panel of the axis; its stations other panels of the road may have
// too: an OpenDRIVE file that is read with a wide tolerance may say where a stretch lies twice. Without a panel s tells
// it, as Road::Surface does.
namespace rodeira::network {

// As Road::Settle: finds (s, t) of a point, from those that are given; s is held within [low, high]. Returns the
// distance that is left.
double SettleOn(const Road& road, const geometry::AxisPanel* panel, const Eigen::Vector2d& p_W, double low_s_m,
                double high_s_m, double& s_m, double& t_m);
// Moves s to where the line at t is nearest to p.
void MoveAlongEdge(const Road& road, const geometry::AxisPanel* panel, const Eigen::Vector2d& p_W, double low_s_m,
                   double high_s_m, double t_m, double& s_m);
double DistanceToEdgeOn(const Road& road, const geometry::AxisPanel* panel, const Eigen::Vector2d& p_W, double low_s_m,
                        double high_s_m, double t_m, double& s_m);

}  // namespace rodeira::network
