// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <limits>
#include <optional>

#include "common/driving/driver/footprint.hpp"

namespace rodeira::driver {

// The lane's middle at a distance along it, in driving direction.
struct LaneFrame {
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();  // on the road's surface
  double heading_rad = 0.0;                       // in (-pi, pi]
  double curvature_1pm = 0.0;                     // of the lane's own middle, positive to the left
  double grade = 0.0;                             // rise over plan distance, positive uphill
};

// An object that occupies a part of the lane.
struct LaneSpan {
  double rear_m = 0.0;  // distances along the lane
  double front_m = 0.0;
  double right_m = 0.0;  // offsets from the lane's middle, positive to the left; right <= left
  double left_m = 0.0;
  double speed_mps = 0.0;  // along the lane, negative against its traffic
};

// What a driver follows: the middle of a lane, or of a chain of lanes, by the distance d along it in the direction of
// its traffic. Distances are metres, points lie in W, headings count from east counter-clockwise.
class Way {
 public:
  // The coordinates of a point: how far along, and how far to the left.
  struct Place {
    double d_m = 0.0;
    double offset_m = 0.0;
    double heading_rad = 0.0;  // of the middle at d, as At says
  };
  // Where a point is looked for: Near may find nothing if its d lies outside.
  struct Range {
    double from_m = -std::numeric_limits<double>::infinity();
    double to_m = std::numeric_limits<double>::infinity();
  };

  virtual ~Way() = default;
  // The largest d; the smallest is 0.
  virtual double length_m() const = 0;
  // In force at d.
  virtual double SpeedLimit_mps(double d_m) const = 0;
  // The lane's middle there, seen along the driving direction; d is held within the way.
  virtual LaneFrame At(double d_m) const = 0;
  // p_W and heading_rad of At.
  virtual Eigen::Vector3d MiddleAt(double d_m) const { return At(d_m).p_W; }
  virtual double HeadingAt(double d_m) const { return At(d_m).heading_rad; }
  // Of the middle's height over d: positive in a sag, negative over a crest.
  virtual double VerticalCurvature_1pm(double d_m) const = 0;
  // The surface at d, `offset_m` to the left of the middle as its traffic sees it.
  virtual Eigen::Vector3d Position(double d_m, double offset_m) const = 0;
  // Nothing beyond the ends. The height selects the level where the route crosses over itself.
  virtual std::optional<Place> Locate(double x_m, double y_m, std::optional<double> z_m = std::nullopt) const = 0;

  // The same as Locate. `hint` only saves work: it is where the search begins, and is set to where it ended.
  virtual std::optional<Place> Near(std::size_t& /*hint*/, double x_m, double y_m, std::optional<double> z_m,
                                    const Range& /*range*/) const {
    return Locate(x_m, y_m, z_m);
  }

  // The part that a rectangle occupies; nothing if its middle is beyond the ends.
  std::optional<LaneSpan> SpanOf(const Footprint& footprint) const;
  // The same with the hint and range of Near.
  std::optional<LaneSpan> SpanNear(std::size_t& hint, const Footprint& footprint, const Range& range) const;
};

}  // namespace rodeira::driver
