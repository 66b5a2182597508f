// SPDX-License-Identifier: Apache-2.0
#include "common/world/traffic_map/drive_piece.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace rodeira::traffic_map {
namespace {

constexpr double kMinPiece_m = 0.05;
constexpr int kPlaces = 10;  // where a piece is compared with its lane

double Value(const Cubic1& c, double d) { return c[0] + d * (c[1] + d * (c[2] + d * c[3])); }
double Rate(const Cubic1& c, double d) { return c[1] + d * (2.0 * c[2] + d * 3.0 * c[3]); }

// By value and rate at both ends of a stretch of length h.
Cubic1 Hermite(double value0, double rate0, double value1, double rate1, double h) {
  const double mean = (value1 - value0) / h;
  return {value0, rate0, (3.0 * mean - 2.0 * rate0 - rate1) / h, (rate0 + rate1 - 2.0 * mean) / (h * h)};
}

// Through the values at 0, h/3, 2h/3, h: by divided differences.
Cubic1 Through(const std::array<double, 4>& y, double h) {
  const double third = h / 3.0;
  const double first = (y[1] - y[0]) / third;
  const double second = (y[2] - 2.0 * y[1] + y[0]) / (2.0 * third * third);
  const double last = (y[3] - 3.0 * y[2] + 3.0 * y[1] - y[0]) / (6.0 * third * third * third);
  // y0 + first d + second d(d − t) + last d(d − t)(d − 2t)
  return {y[0], first - second * third + 2.0 * last * third * third, second - 3.0 * last * third, last};
}

DrivePiece Fit(const LaneShape& lane, double s0, double s1) {
  DrivePiece piece{.s_m = s0, .length_m = s1 - s0};
  const double h = piece.length_m;
  const LanePoint begin = lane.At(s0), end = lane.At(s1);
  piece.p_W = begin.p_W;
  piece.heading_rad = std::atan2(begin.tangent_W.y(), begin.tangent_W.x());
  const auto along = [&](const Eigen::Vector2d& v) { return v.dot(begin.tangent_W); };
  const auto across = [&](const Eigen::Vector2d& v) { return v.dot(begin.left_W()); };
  piece.u = Hermite(0.0, 1.0, along(end.p_W - begin.p_W), along(end.tangent_W), h);
  piece.v = Hermite(0.0, 0.0, across(end.p_W - begin.p_W), across(end.tangent_W), h);
  piece.z = Hermite(begin.z_m, begin.grade, end.z_m, end.grade, h);
  std::array<double, 4> left{}, width{};
  for (int i = 0; i < 4; ++i) {
    const LanePoint at = lane.At(s0 + h * i / 3.0);
    left[static_cast<std::size_t>(i)] = at.left_m;
    width[static_cast<std::size_t>(i)] = at.width_m();
  }
  piece.left = Through(left, h);
  piece.width = Through(width, h);
  return piece;
}

DriveError Compare(const LaneShape& lane, const DrivePiece& piece) {
  DriveError error;
  const Eigen::Vector2d ahead(std::cos(piece.heading_rad), std::sin(piece.heading_rad));
  const Eigen::Vector2d aside(-ahead.y(), ahead.x());
  for (int i = 0; i < kPlaces; ++i) {
    const double d = piece.length_m * (i + 0.5) / kPlaces;
    const LanePoint at = lane.At(piece.s_m + d);
    const Eigen::Vector2d p = piece.p_W + Value(piece.u, d) * ahead + Value(piece.v, d) * aside;
    const Eigen::Vector2d tangent = (Rate(piece.u, d) * ahead + Rate(piece.v, d) * aside).normalized();
    const Eigen::Vector2d left(-tangent.y(), tangent.x());
    const double offset = Value(piece.left, d);
    const Eigen::Vector2d off_left = p + offset * left - at.p_W - at.left_m * at.left_W();
    const Eigen::Vector2d off_right = p + (offset - Value(piece.width, d)) * left - at.p_W - at.right_m * at.left_W();
    error.Include(
        {(p - at.p_W).norm(), std::max(off_left.norm(), off_right.norm()), std::abs(Value(piece.z, d) - at.z_m)});
  }
  return error;
}

// How far the curve's own length is from the piece's.
double LengthOff(const DrivePiece& piece) {
  constexpr int kIntervals = 32;  // Simpson's rule
  double sum = 0.0;
  for (int i = 0; i <= kIntervals; ++i) {
    const double d = piece.length_m * i / kIntervals;
    sum += (i == 0 || i == kIntervals ? 1.0 : i % 2 == 1 ? 4.0 : 2.0) * std::hypot(Rate(piece.u, d), Rate(piece.v, d));
  }
  return std::fabs(sum * piece.length_m / (3.0 * kIntervals) - piece.length_m);
}

}  // namespace

double DriveError::Most() const { return std::max({middle_m, border_m, height_m}); }

void DriveError::Include(const DriveError& other) {
  middle_m = std::max(middle_m, other.middle_m);
  border_m = std::max(border_m, other.border_m);
  height_m = std::max(height_m, other.height_m);
}

base::Result<std::vector<DrivePiece>> FitLane(const LaneShape& lane, double from_m, double to_m,
                                              const FitBounds& bounds, DriveError& error) {
  std::vector<DrivePiece> pieces;
  std::vector<double> ends = {to_m};  // of the pieces to come, the next one last
  for (double s = from_m; !ends.empty();) {
    const DrivePiece piece = Fit(lane, s, ends.back());
    const DriveError off = Compare(lane, piece);
    if (!(off.Most() <= bounds.off_m) || LengthOff(piece) > bounds.length_m) {
      if (piece.length_m < kMinPiece_m)
        return base::WrongInput(
            "map.too_sharp",
            fmt::format("it turns too sharply at {:.2f} m to be written as cubics of the distance", s));
      ends.push_back(0.5 * (s + ends.back()));
      continue;
    }
    error.Include(off);
    pieces.push_back(piece);
    s = ends.back();
    ends.pop_back();
  }
  return pieces;
}

}  // namespace rodeira::traffic_map
