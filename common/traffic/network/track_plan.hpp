// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "common/driving/driver/speed_plan.hpp"
#include "common/driving/driver/way.hpp"
#include "common/world/lanes/graph.hpp"
#include "common/world/lanes/lights.hpp"
#include "common/world/lanes/signs.hpp"

namespace rodeira::traffic {

// One track as a way, for what is computed along it.
class TrackWay final : public driver::Way {
 public:
  // The graph outlives it.
  TrackWay(const lanes::Graph& graph, std::uint32_t track) : graph_(&graph), track_(track) {}

  double length_m() const override { return curve().length_m(); }
  double SpeedLimit_mps(double d_m) const override { return graph_->SpeedLimit_mps(track_, d_m); }
  driver::LaneFrame At(double d_m) const override;
  double VerticalCurvature_1pm(double d_m) const override;
  Eigen::Vector3d Position(double d_m, double offset_m) const override;
  std::optional<Place> Locate(double x_m, double y_m, std::optional<double> z_m = std::nullopt) const override;

 private:
  const lanes::Curve& curve() const { return (*graph_)[track_].curve; }

  const lanes::Graph* graph_;
  std::uint32_t track_;
};

// A line at which traffic may have to come to rest.
struct StopLine {
  double d_m = 0.0;
  std::int64_t light = -1;  // index of a controller; below 0: a STOP sign
};

inline constexpr int kRing = 2;  // TrackPlan::turn of a track along a ring

// What is known of a track beforehand: the speed that it allows, its limit, and its lines. Where there are lights STOP
// signs say nothing.
struct TrackPlan {
  driver::SpeedPlan plan;
  double limit_mps;             // at its beginning …
  bool one_limit;               // … and everywhere
  std::vector<StopLine> lines;  // ascending
  int turn = 0;                 // to which side this way turns: +1 to the left, -1 to the right, 0 straight on; kRing

  TrackPlan(const lanes::Graph& graph, std::uint32_t track, const driver::SpeedPlanSettings& settings);
};

}  // namespace rodeira::traffic
