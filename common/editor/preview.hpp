// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "common/core/base/result.hpp"
#include "common/editor/document.hpp"
#include "common/traffic/results/lane_statistics.hpp"
#include "common/traffic/traffic_model.hpp"

namespace rodeira::editor {

// How much traffic a preview has.
struct PreviewSettings {
  std::uint32_t vehicles =
      30;  // on the road and waiting to enter; where start lanes have flows at most so many at a time
  std::uint64_t seed = 1;
};

// A metre or so of a lane and how fast it was driven on there, from corner to corner.
struct HeatPatch {
  Eigen::Vector2d p_W = Eigen::Vector2d::Zero();  // its middle
  Eigen::Vector2d ahead_W = Eigen::Vector2d::UnitX();
  double length_m = 1.0, width_m = 3.0;
  double share = 0.0;  // mean speed over the lane's limit, at most 1
};

// Traffic on the map as it is drawn, by the flows of its start lanes where there are any: what `rodeira traffic run`
// computes, in the editor.
class Preview {
 public:
  static constexpr double kStep_s = 0.01;

  // Wrong input with the check's first error where the map is not whole.
  static base::Result<Preview> Start(const Document& document, const PreviewSettings& settings);

  // So much further, in steps of 10 ms; what is left over counts the next time.
  void Run(double seconds);
  double time_s() const { return time_s_; }
  const traffic::TrafficModel& model() const { return *model_; }
  const traffic::LaneStatistics& statistics() const { return *statistics_; }
  // Where a vehicle has been; in the order of the lanes.
  std::vector<HeatPatch> Heat() const;

 private:
  Preview() = default;

  std::unique_ptr<traffic::TrafficModel> model_;
  std::unique_ptr<traffic::LaneStatistics> statistics_;
  double time_s_ = 0.0, left_over_s_ = 0.0;
  std::uint64_t steps_ = 0;
};

}  // namespace rodeira::editor
