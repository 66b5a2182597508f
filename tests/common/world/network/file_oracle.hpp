// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace rodeira::network {

// Where a point lies, told from an OpenDRIVE file alone by other means than Network: nothing of the product's code is
// in it. Reference lines are curves of heading and length, integrated numerically and sampled each half metre; a foot
// is sought between samples by halving, on every element of every road. For files without superelevation; their roads
// have widths (no borders) and heights by `elevation` alone.
class FileOracle {
 public:
  // Fails the test where the file cannot be read.
  explicit FileOracle(const std::string& text);

  struct Foot {
    std::string road;
    int lane = 0;
    double s_m = 0.0, t_m = 0.0, z_m = 0.0;
    double outside_m = 0.0;   // how far beside the lanes, and beyond the line's end, seen from above
    double distance_m = 0.0;  // with the height
    bool past_end = false, drivable = false;
    double from_centre_m = 0.0;
    // Less than kNear_m from where something changes that is chosen by: the edge of a lane, a section, the end of an
    // element.
    bool near_change = false;
  };
  static constexpr double kNear_m = 1e-6;

  struct Answer {
    std::optional<Foot> best;
    // Another place is as good, or nearly: within kNear_m of what decides, or of where something changes.
    bool open = false;
  };
  // As Network::Locate says that it does (docs/explanation/ground.md, "Where a point lies").
  Answer Locate(const Eigen::Vector2d& p, std::optional<double> z_m) const;

  std::size_t roads() const { return roads_.size(); }
  double length_m(std::size_t road) const { return roads_[road].length_m; }
  // A point of the reference line, and its height.
  Eigen::Vector3d On(std::size_t road, double s_m) const;
  bool has_lateral() const { return has_lateral_; }  // superelevation or another cross-section than a level one
  bool has_borders() const { return has_borders_; }
  bool has_heights() const { return has_heights_; }  // of lanes

 private:
  struct Piece {  // a cubic by s, in force from there on
    double s_m, a, b, c, d;
  };
  using Pieces = std::vector<Piece>;
  struct Sample {
    double at;  // the element's own parameter: metres, or p
    double s_m;
    Eigen::Vector2d p;
  };
  struct Element {
    double s_m = 0.0, length_m = 0.0, heading_rad = 0.0;
    Eigen::Vector2d start = Eigen::Vector2d::Zero();
    bool cubic = false;
    double curvature = 0.0, curvature_rate = 0.0;  // of a clothoid
    double u[4] = {0.0, 1.0, 0.0, 0.0}, v[4] = {0.0, 0.0, 0.0, 0.0};
    double p_end = 1.0, own_length = 0.0;  // of a cubic
    std::vector<Sample> samples;

    Eigen::Vector2d Direction(double at) const;  // dp/d(at)
    Eigen::Vector2d From(const Sample& sample, double at) const;
    double StationFrom(const Sample& sample, double at) const;
    void Cut();
  };
  struct OneLane {
    int id;
    std::string type;
    Pieces width;
  };
  struct Section {
    double s_m = 0.0;
    std::vector<OneLane> left, right;  // outward
  };
  struct OneRoad {
    std::string id;
    double length_m = 0.0;
    bool linked_before = false, linked_behind = false;
    std::vector<Element> elements;
    Pieces offset, elevation;
    std::vector<Section> sections;
  };

  static double At(const Pieces& pieces, double s_m);
  static bool Changes(const Pieces& pieces, double s_m);
  void See(const OneRoad& road, std::size_t element, const Sample& from, double at, bool end, const Eigen::Vector2d& p,
           std::optional<double> z_m, std::vector<Foot>& feet) const;

  std::vector<OneRoad> roads_;
  bool has_lateral_ = false, has_borders_ = false, has_heights_ = false;
};

}  // namespace rodeira::network
