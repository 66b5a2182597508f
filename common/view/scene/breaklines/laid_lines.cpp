// SPDX-License-Identifier: Apache-2.0
#include "common/view/scene/breaklines/laid_lines.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "common/world/network/network.hpp"

namespace rodeira::scene {
namespace {

constexpr double kMaxBumpStep_m = 0.25;     // within a bump two lines are never farther apart, along it
constexpr double kMaxPatchStep_m = 8.0;     // beside a patch
constexpr double kMinSubdivision_m = 0.02;  // at a kink in the height a finer subdivision gains nothing
constexpr double kMeasuredStep_m = 0.5;     // what is seen of measured surfaces has no waves shorter than some 2 m
constexpr double kOfTolerance = 0.8;        // between two places that are asked it may be farther off
constexpr double kHint_m = 0.3;             // what is farther away is another road's
constexpr int kAcross = 6;                  // parts of a bump across, at least

// Values between two, so close that what they stand for is straight enough from each to the next: `off` says how far it
// is from straight between two of them.
std::vector<double> Subdivide(double from, double to, double longest, const std::function<double(double, double)>& off,
                              double tolerance) {
  std::vector<double> values = {from};
  const std::function<void(double, double)> divide = [&](double a, double b) {
    if (b - a > kMinSubdivision_m && off(a, b) > tolerance) {
      divide(a, 0.5 * (a + b));
      divide(0.5 * (a + b), b);
    } else {
      values.push_back(b);
    }
  };
  const int parts = std::max(1, static_cast<int>(std::ceil((to - from) / longest - 1e-9)));
  for (int i = 0; i < parts; ++i)
    divide(from + (to - from) * i / parts, i + 1 == parts ? to : from + (to - from) * (i + 1) / parts);
  return values;
}

class Piece {
 public:
  Piece(const road::World& world, const network::Road& road, const network::Object& object, const Tolerance& tolerance)
      : world_(world), road_(road), tolerance_(tolerance), bump_(object.subtype == "speedBump") {
    from_s_m_ = std::max(object.s_m - 0.5 * object.length_m, 0.0),
    to_s_m_ = std::min(object.s_m + 0.5 * object.length_m, road.length_m());
    right_t_m_ = object.t_m - 0.5 * object.width_m, left_t_m_ = object.t_m + 0.5 * object.width_m;
  }

  void AddTo(std::vector<Line3>& lines) const {
    const double middle_t = 0.5 * (right_t_m_ + left_t_m_);
    const auto along_off = [&](double a, double b) {
      double off = 0.0;
      for (const double t : {right_t_m_, middle_t, left_t_m_})
        off = std::max(off, Off(At(a, t), At(0.5 * (a + b), t), At(b, t)));
      return off;
    };
    const std::vector<double> stations =
        Subdivide(from_s_m_, to_s_m_, bump_ ? kMaxBumpStep_m : kMaxPatchStep_m, along_off, 1.0);
    std::vector<double> across = {right_t_m_, left_t_m_};
    if (bump_) {
      const double highest = *std::max_element(stations.begin(), stations.end(), [&](double a, double b) {
        return Raised(a, middle_t) < Raised(b, middle_t);
      });
      const auto across_off = [&](double a, double b) {
        return Off(At(highest, a), At(highest, 0.5 * (a + b)), At(highest, b));
      };
      across = Subdivide(right_t_m_, left_t_m_, (left_t_m_ - right_t_m_) / kAcross, across_off, 1.0);
    }
    for (const double t : across) lines.push_back(Line(stations, [&](double s) { return At(s, t); }));
    for (const double s : bump_ ? stations : std::vector<double>{from_s_m_, to_s_m_}) {
      lines.push_back(Line(across, [&](double t) { return At(s, t); }));
    }
  }

 private:
  // SUELO's ground there.
  Eigen::Vector3d At(double s_m, double t_m) const {
    const Eigen::Vector3d p = road_.Surface(s_m, t_m).p_W;
    return {p.x(), p.y(), world_.At(p.x(), p.y(), p.z()).z_m};
  }
  double Raised(double s_m, double t_m) const { return std::fabs(At(s_m, t_m).z() - road_.Surface(s_m, t_m).p_W.z()); }
  // How far the middle of three points is off the way from one to the other; 1: as far as it may be.
  double Off(const Eigen::Vector3d& a, const Eigen::Vector3d& middle, const Eigen::Vector3d& b) const {
    const Eigen::Vector3d off = middle - 0.5 * (a + b);
    return std::max(off.head<2>().norm() / tolerance_.plan_m, std::fabs(off.z()) / (0.4 * tolerance_.height_m));
  }
  template <class Place>
  static Line3 Line(const std::vector<double>& values, const Place& place) {
    Line3 line;
    for (const double value : values) line.push_back(place(value));
    return line;
  }

  const road::World& world_;
  const network::Road& road_;
  Tolerance tolerance_;
  bool bump_;
  double from_s_m_, to_s_m_, right_t_m_, left_t_m_;
};

}  // namespace

bool IsLaid(const network::Object& object) {
  return (network::IsPatch(object) || (object.type == "roadSurface" && object.subtype == "speedBump")) &&
         object.length_m > 0.0 && object.width_m > 0.0;
}

void AddLaidLines(const road::World& world, const network::Road& road, const Tolerance& tolerance,
                  std::vector<Line3>& lines) {
  if (world.open_drive()) return;  // there they are only seen, as what they are
  for (const network::Object& object : road.spec().objects) {
    if (IsLaid(object)) Piece(world, road, object, tolerance).AddTo(lines);
  }
}

void MeetMeasured(const road::World& world, const network::Road& road, const Tolerance& tolerance,
                  std::vector<Line3>& lines) {
  const auto is_measured = [](const network::Road& one) { return !one.spec().crg.empty(); };
  const auto roads = world.network()->roads();
  if (!is_measured(road) && (road.spec().junction.empty() || std::none_of(roads.begin(), roads.end(), is_measured)))
    return;
  const auto meet = [&](Eigen::Vector3d p) {
    if (const road::SurfacePoint ground = world.At(p.x(), p.y(), p.z() + kHint_m);
        ground.inside && std::fabs(ground.z_m - p.z()) < kHint_m)
      p.z() = ground.z_m;
    return p;
  };
  for (Line3& line : lines) {
    Line3 met = {meet(line.front())};
    const std::function<void(const Eigen::Vector3d&, const Eigen::Vector3d&)> divide = [&](const Eigen::Vector3d& a,
                                                                                           const Eigen::Vector3d& b) {
      const double length_m = (b - a).head<2>().norm();
      const int parts = std::max(4, static_cast<int>(std::ceil(length_m / kMeasuredStep_m)));
      bool off = false;
      for (int k = 1; k < parts && !off && length_m > 2.0 * kMinSubdivision_m; ++k) {
        const Eigen::Vector3d p = a + static_cast<double>(k) / parts * (b - a);
        off = std::fabs(meet(p).z() - p.z()) > kOfTolerance * tolerance.height_m;
      }
      if (!off) {
        met.push_back(b);
        return;
      }
      const Eigen::Vector3d middle = meet(0.5 * (a + b));
      divide(a, middle), divide(middle, b);
    };
    for (std::size_t i = 1; i < line.size(); ++i) divide(met.back(), meet(line[i]));
    line = std::move(met);
  }
}

}  // namespace rodeira::scene
