// SPDX-License-Identifier: Apache-2.0
// A road of a world file of version 1 by closed formulas that share none with the network that it is converted to: an
// oracle of where the road lies and of the ground around it.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "common/core/config/config.hpp"
#include "common/world/road/road.hpp"
#include "common/world/road/road_reader.hpp"
#include "common/world/road/surface_point.hpp"

namespace rodeira {

class Version1Road : public road::Road {
 public:
  struct Coordinate {
    double s_m = 0.0, t_m = 0.0;
  };
  struct Stroke {
    double from_s_m = 0.0, to_s_m = 0.0;
  };

  explicit Version1Road(const road::RoadSpec& spec) : Road(spec), start_heading_rad_(spec.heading_rad) {
    for (const road::Mark& mark : marks())
      mark_begin_m_.push_back(AlongMark(mark, mark.from_s_m, plan().Evaluate(mark.from_s_m).heading_rad));
  }
  // The first road of a world file.
  static Version1Road Of(const config::File& file) {
    return Version1Road(road::ReadRoad(file.root().Items("roads").At(0)));
  }
  static Version1Road Load(const std::filesystem::path& file) { return Of(config::File::Load(file).value()); }
  static Version1Road Parse(std::string_view text) { return Of(config::File::Parse(text, "sample.yaml").value()); }

  // Nothing where the nearest point of the axis is an end and (x, y) lies more than 1e-9 m beyond it.
  std::optional<Coordinate> Locate(double x_m, double y_m) const {
    const geometry::Foot foot = plan().Project(x_m, y_m);
    if (std::fabs(foot.beyond_m) > 1e-9) return std::nullopt;
    return Coordinate{foot.s_m, foot.t_m};
  }
  // As what is converted or makes hills: the road alone.
  std::span<const road::Road> Alone() const { return {static_cast<const road::Road*>(this), 1}; }
  double LaneCentre(int lane_id) const { return section().FindLane(lane_id)->centre_t_m(); }
  // The lane at t, or null beside the lanes. On a line between two lanes: the one farther left.
  const road::Lane* LaneAt(double t_m) const {
    for (auto lane = lanes().rbegin(); lane != lanes().rend(); ++lane) {
      const double low = std::min(lane->inner_t_m, lane->outer_t_m);
      const double high = std::max(lane->inner_t_m, lane->outer_t_m);
      if (t_m >= low && t_m <= high) return &*lane;
    }
    return nullptr;
  }
  // The painted pieces of a mark, in ascending s.
  std::vector<Stroke> Strokes(const road::Mark& mark) const {
    const double end_s = std::min(mark.to_s_m, length_m());
    if (!mark.dashed()) return {{mark.from_s_m, end_s}};
    const auto along = [&](double s) { return AlongMark(mark, s, plan().Evaluate(s).heading_rad); };
    const double begin = along(mark.from_s_m), end = along(end_s);
    const auto inverse = [&](double length, double from) {  // the s at which the mark is `length` long; along() grows
      double low = from, high = end_s;
      for (int i = 0; i < 60 && high - low > 1e-9; ++i) {
        const double middle = 0.5 * (low + high);
        (along(middle) < length ? low : high) = middle;
      }
      return 0.5 * (low + high);
    };
    std::vector<Stroke> strokes;
    double from = mark.from_s_m;
    for (double k = 0.0; begin + k * (mark.stroke_m + mark.gap_m) < end; k += 1.0) {
      const double stroke_begin = begin + k * (mark.stroke_m + mark.gap_m), stroke_end = stroke_begin + mark.stroke_m;
      from = k == 0.0 ? mark.from_s_m : inverse(stroke_begin, from);
      const double to = stroke_end >= end ? end_s : inverse(stroke_end, from);
      strokes.push_back({from, to});
      from = to;
    }
    return strokes;
  }
  // heading_rad: the axis' unwrapped heading at s.
  bool IsPainted(double s_m, double t_m, double heading_rad) const {
    for (std::size_t i = 0; i < marks().size(); ++i) {
      const road::Mark& mark = marks()[i];
      if (std::fabs(t_m - mark.t_m) > 0.5 * mark.width_m || s_m < mark.from_s_m || s_m > mark.to_s_m) continue;
      if (!mark.dashed()) return true;
      const double phase = std::fmod(AlongMark(mark, s_m, heading_rad) - mark_begin_m_[i], mark.stroke_m + mark.gap_m);
      if (phase <= mark.stroke_m) return true;
    }
    return false;
  }

  // How far a point lies from the outline of the verges; 0: on the road.
  double OutsideVerges(double x_m, double y_m) const {
    const geometry::Foot foot = plan().Project(x_m, y_m);
    return std::hypot(Aside(foot), foot.beyond_m);
  }
  // The ground at (x, y), where the terrain without the road is `bare`: within the verges the road, over the blend the
  // road's surface, going on in its slopes, and the terrain, weighted by 3 u^2 - 2 u^3.
  road::SurfacePoint GroundAt(double x_m, double y_m, const road::SurfacePoint& bare,
                              const road::FrictionTable& friction) const {
    const geometry::Foot foot = plan().Project(x_m, y_m);
    const double aside = Aside(foot), excess = std::sqrt(aside * aside + foot.beyond_m * foot.beyond_m);
    const double blend = section().spec().blend_m;
    if (excess >= blend) return bare;
    const geometry::ProfilePoint profile_at = profile().Evaluate(foot.s_m);
    const road::Band& band = section().BandAt(foot.t_m);
    const Eigen::Vector2d along_W = foot.at.tangent_W, left_W = foot.at.left_W();
    // Along the axis s grows by 1 / (1 - k t) a metre; past an end it stands still and the straight distance counts.
    const double stretch = foot.beyond_m == 0.0 ? 1.0 / (1.0 - foot.at.curvature_1pm * foot.t_m) : 1.0;
    const double z =
        profile_at.z_m + profile_at.grade * foot.beyond_m + band.from_z_m + band.slope * (foot.t_m - band.from_t_m);
    const Eigen::Vector2d slope = profile_at.grade * stretch * along_W + band.slope * left_W;
    if (excess == 0.0) {
      const bool painted = IsPainted(foot.s_m, foot.t_m, foot.at.heading_rad);
      const ground::Surface surface = painted ? ground::Surface::kRoadMark : band.surface;
      return {z, slope.x(), slope.y(), friction[static_cast<std::size_t>(surface)], surface, true};
    }
    if (!bare.inside) return bare;
    const double u = excess / blend, weight = u * u * (3.0 - 2.0 * u), weight_slope = 6.0 * u * (1.0 - u) / blend;
    const Eigen::Vector2d outward_W = (aside * left_W + foot.beyond_m * along_W) / excess;
    const double step = bare.z_m - z;
    road::SurfacePoint point = bare;
    point.slope_x = slope.x() + weight * (bare.slope_x - slope.x()) + weight_slope * step * outward_W.x();
    point.slope_y = slope.y() + weight * (bare.slope_y - slope.y()) + weight_slope * step * outward_W.y();
    point.z_m = z + weight * step;
    return point;
  }

 private:
  double Aside(const geometry::Foot& foot) const {
    return foot.t_m - std::clamp(foot.t_m, section().verge_right_m(), section().verge_left_m());
  }
  // The length of a mark from the road's start to s. A line at offset t of an axis with curvature k grows by
  // (1 - k t) ds, so its length is s - t (heading(s) - heading(0)).
  double AlongMark(const road::Mark& mark, double s_m, double heading_rad) const {
    return s_m - mark.t_m * (heading_rad - start_heading_rad_);
  }

  double start_heading_rad_;
  std::vector<double> mark_begin_m_;
};

}  // namespace rodeira
