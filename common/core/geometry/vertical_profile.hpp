// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

namespace rodeira::geometry {

// A point where two grades meet, rounded by a parabola of the given length centred on it (0: a kink).
struct GradePoint {
  double s_m = 0.0;
  double z_m = 0.0;
  double parabola_m = 0.0;
};

// The profile at one station.
struct ProfilePoint {
  double z_m = 0.0;
  double grade = 0.0;          // dz/ds
  double curvature_1pm = 0.0;  // d2z/ds2: positive in a sag, negative on a crest
};

// Height along an axis: straight grades between points of vertical intersection, parabolas at them (K = length / change
// of grade). Before the first and after the last point their grade goes on; a single point means level.
class VerticalProfile {
 public:
  // Points in ascending s; the parabolas may touch but not overlap, and none stands at the first or the last point.
  explicit VerticalProfile(std::vector<GradePoint> points);
  const std::vector<GradePoint>& points() const { return points_; }
  // At any s.
  ProfilePoint Evaluate(double s_m) const;

 private:
  struct Stretch {
    double from_s_m;
    double z_m;
    double grade;
    double curvature_1pm;
  };
  std::vector<GradePoint> points_;
  std::vector<Stretch> stretches_;
};

}  // namespace rodeira::geometry
