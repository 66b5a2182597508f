#pragma once

#include <optional>
#include <vector>

#include "common/driver/footprint.hpp"
#include "common/road/road.hpp"

namespace rodeira::driver {

// The middle of a lane at a distance along it, looking the way its traffic goes.
struct LaneFrame {
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();  // on the road's surface
  double heading_rad = 0.0;                       // in (-pi, pi]
  double curvature_1pm = 0.0;                     // of the lane's own middle, positive to the left
  double grade = 0.0;                             // rise over plan distance, positive uphill
};

// Something that occupies a stretch of the lane.
struct LaneSpan {
  double rear_m = 0.0;   // distances along the lane
  double front_m = 0.0;
  double right_m = 0.0;  // offsets from the lane's middle, positive to the left; right <= left
  double left_m = 0.0;
  double speed_mps = 0.0;  // along the lane, negative against its traffic
};

// A lane as those who drive in it see it: distance d from where its traffic enters the road, measured along the lane's own
// middle, which is exact: d = s - t (heading(s) - heading(0)) for a lane at offset t of the axis. The road must outlive it.
class LanePath {
 public:
  LanePath(const road::Road& road, int lane_id);  // the lane must be one of the road's

  const road::Road& road() const { return *road_; }
  const road::Lane& lane() const { return *lane_; }
  double length_m() const { return length_m_; }
  double speed_limit_mps() const { return lane_->speed_limit_mps; }

  double AxisS(double d_m) const;    // s of the axis beside d, held within the road
  double Distance(double s_m) const;  // d beside s
  LaneFrame At(double d_m) const;
  // The surface at d, `offset_m` to the left of the lane's middle as its traffic sees it.
  Eigen::Vector3d Position(double d_m, double offset_m) const;
  // The lane coordinates of a point, or nothing beside the road's ends.
  struct Place {
    double d_m = 0.0;
    double offset_m = 0.0;
  };
  std::optional<Place> Locate(double x_m, double y_m) const;
  // The stretch that a rectangle takes up, or nothing where its middle is beyond the road's ends.
  std::optional<LaneSpan> SpanOf(const Footprint& footprint) const;

 private:
  double AxisLength(double s_m) const;  // of the lane's middle, from the road's start

  const road::Road* road_;
  const road::Lane* lane_;
  double t_m_ = 0.0;
  bool along_ = true;  // traffic goes with growing s
  double start_heading_rad_ = 0.0;
  double length_m_ = 0.0;
  std::vector<double> nodes_m_;  // AxisLength at equal steps of s, where the search of AxisS starts
  double step_s_m_ = 1.0;
};

}  // namespace rodeira::driver
