// SPDX-License-Identifier: Apache-2.0
#include "common/core/geometry/clothoid_panel.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

#include "common/core/base/assert.hpp"
#include "common/core/geometry/clothoid.hpp"
#include "common/core/geometry/plane.hpp"
#include "common/core/geometry/tolerances.hpp"

namespace rodeira::geometry {
namespace {

// Bounds of a panel's half length h: k h, sqrt(k') h and h itself, for the curvature k and its change k'. The power
// series has 12 terms. Its remainder is below (k h)^12 / 12! and below (sqrt(k') h)^12 / sqrt(12!), both under 2e-14 of
// h.
constexpr double kMaxClothoidHalfTurn_rad = 0.2;
constexpr double kMaxClothoidHalfTwist = 0.16;
constexpr double kMaxClothoidHalf_m = 8.0;  // so that a grid cell finds few panels

constexpr double kFlat_m = 1e-9;      // where p is nowhere farther ahead or behind, all points are equally near
constexpr double kShortest_m = 1e-9;  // of the intervals in which feet are told apart

// p as seen from the curve at u. `ahead_m`, f = (p - at) . tangent, is 0 at a foot and falls through it where the
// distance has a minimum; `fall`, g = 1 - k t, is -f', for p at t to the left.
struct Seen {
  Eigen::Vector2d at, tangent;
  double ahead_m, left_m, fall;
};

class Search {
 public:
  Search(const ClothoidPanel& panel, const Eigen::Vector2d& p) : panel_(panel), p_(p) {
    begin_ = Offer(-panel.half_m);
    end_ = Offer(panel.half_m);
  }

  // The whole panel, where the distance has one minimum at most.
  void One() { Falling(-panel_.half_m, begin_, panel_.half_m, end_); }

  // The whole panel, wherever p lies: cut until f falls, rises, has no zero or is zero throughout.
  void Every() { Within(-panel_.half_m, begin_, panel_.half_m, end_); }

  const PanelFoot& best() const { return best_; }

 private:
  Seen At(double u) const {
    Seen seen;
    if (u == -panel_.half_m)
      seen.at = panel_.begin_W, seen.tangent = panel_.begin_tangent_W;
    else if (u == panel_.half_m)
      seen.at = panel_.end_W, seen.tangent = panel_.end_tangent_W;
    else
      panel_.Point(u, seen.at, seen.tangent);
    const Eigen::Vector2d away = p_ - seen.at;
    seen.ahead_m = away.dot(seen.tangent);
    seen.left_m = seen.tangent.x() * away.y() - seen.tangent.y() * away.x();
    seen.fall = 1.0 - (panel_.curvature_1pm + panel_.curvature_rate_1pm2 * u) * seen.left_m;
    return seen;
  }

  Seen Offer(double u) {
    const Seen seen = At(u);
    const double squared = (p_ - seen.at).squaredNorm();
    if (squared < best_.squared_m2) best_ = {squared, u};
    return seen;
  }

  // Between points with f not below zero and not above it, f falling in between: Newton, kept in by halving.
  void Falling(double low, const Seen& at_low, double high, const Seen& at_high) {
    if (!(at_low.ahead_m >= 0.0 && at_high.ahead_m <= 0.0)) return;
    const double from = low, to = high, drop = at_low.ahead_m - at_high.ahead_m;
    double u = drop > 0.0 ? low + (high - low) * (at_low.ahead_m / drop) : low;
    for (int iteration = 0; iteration < 60; ++iteration) {
      const Seen seen = At(u);
      (seen.ahead_m > 0.0 ? low : high) = u;
      const double step = seen.ahead_m / seen.fall;
      if (std::fabs(step) <= kLastNewtonStep_m) {  // Newton doubles the digits: what is left after it is rounding
        u = std::clamp(u + step, from, to);
        break;
      }
      const double next = u + step;
      u = next > low && next < high ? next : 0.5 * (low + high);
    }
    Offer(u);
  }

  // On an interval of half length h about its middle m, by f' = -g, g' = k^2 f - k' t and t' = -k f:
  //   |f| <= F = (|f_m| + h |g_m| + h^2 |k' t_m|) / (1 - h^2 (K^2 + |k'| K h)),   |g'| <= L = |k'| (|t_m| + K h F) +
  //   K^2 F
  // with the steepest curvature K. A panel's bounds on k h and k' h^2 keep the denominator above 0.9.
  void Within(double low, const Seen& at_low, double high, const Seen& at_high) {
    const double h = 0.5 * (high - low), middle = 0.5 * (low + high);
    const Seen seen = At(middle);
    const double rate = std::fabs(panel_.curvature_rate_1pm2);
    const double steepest = std::fabs(panel_.curvature_1pm + panel_.curvature_rate_1pm2 * middle) + rate * h;
    const double f = std::fabs(seen.ahead_m), g = std::fabs(seen.fall), t = std::fabs(seen.left_m);
    const double f_most = (f + h * g + h * h * rate * t) / (1.0 - h * h * (steepest * steepest + rate * steepest * h));
    const double g_change = h * (rate * (t + steepest * h * f_most) + steepest * steepest * f_most);
    if (f > h * (g + g_change)) return;  // no zero
    if (g > g_change) {
      if (seen.fall > 0.0) Falling(low, at_low, high, at_high);
      return;  // or f rises: no minimum
    }
    if (f_most <= kFlat_m || h <= kShortest_m) {
      Offer(middle);
      return;
    }
    Within(low, at_low, middle, seen);
    Within(middle, seen, high, at_high);
  }

  const ClothoidPanel& panel_;
  const Eigen::Vector2d& p_;
  PanelFoot best_{std::numeric_limits<double>::infinity(), 0.0};
  Seen begin_, end_;
};

}  // namespace

std::vector<ClothoidPanel> CutClothoid(const PlanPoint& start, double rate_1pm2, double length_m) {
  const double steepest =
      std::max(std::fabs(start.curvature_1pm), std::fabs(start.curvature_1pm + rate_1pm2 * length_m));
  const double per_metre = std::max({1.0 / kMaxClothoidHalf_m, steepest / kMaxClothoidHalfTurn_rad,
                                     std::sqrt(std::fabs(rate_1pm2)) / kMaxClothoidHalfTwist});
  const double count = std::ceil(0.5 * length_m * per_metre);
  RODEIRA_ASSERT(count < 1e7);
  const double half = 0.5 * length_m / count;
  std::vector<ClothoidPanel> panels;
  for (int i = 0; i < static_cast<int>(count); ++i) {
    const double s = (2 * i + 1) * half;
    ClothoidPanel panel{};
    panel.half_m = half;
    panel.heading_rad = start.heading_rad + (start.curvature_1pm + 0.5 * rate_1pm2 * s) * s;
    panel.curvature_1pm = start.curvature_1pm + rate_1pm2 * s;
    panel.curvature_rate_1pm2 = rate_1pm2;
    panel.middle_W = start.p_W + Rotate(ClothoidIntegral(start.curvature_1pm, rate_1pm2, s), start.tangent_W);
    // f(u) = exp(i (k u + k' u^2 / 2)) solves f' = i (k + k' u) f, which gives its power series term by term.
    std::complex<double> before = 0.0;
    std::complex<double> term = std::polar(1.0, panel.heading_rad);
    for (std::size_t n = 0; n < ClothoidPanel::kTerms; ++n) {
      panel.series_W[n] = Eigen::Vector2d(term.real(), term.imag()) / static_cast<double>(n + 1);
      const std::complex<double> next = std::complex<double>(0.0, 1.0) *
                                        (panel.curvature_1pm * term + rate_1pm2 * before) / static_cast<double>(n + 1);
      before = term;
      term = next;
    }
    panel.Point(-half, panel.begin_W, panel.begin_tangent_W);
    panel.Point(half, panel.end_W, panel.end_tangent_W);
    // A curve of curvature at most k and length 2 h stays within k (2 h)^2 / 8 of its chord.
    panel.bulge_m = 0.5 * steepest * half * half;
    panels.push_back(panel);
  }
  return panels;
}

void ClothoidPanel::Point(double u_m, Eigen::Vector2d& p_W, Eigen::Vector2d& tangent_W) const {
  double x = series_W[kTerms - 1].x();
  double y = series_W[kTerms - 1].y();
  double dx = kTerms * x;
  double dy = kTerms * y;
  for (std::size_t n = kTerms - 1; n-- > 0;) {
    x = x * u_m + series_W[n].x();
    y = y * u_m + series_W[n].y();
    dx = dx * u_m + static_cast<double>(n + 1) * series_W[n].x();
    dy = dy * u_m + static_cast<double>(n + 1) * series_W[n].y();
  }
  p_W = {middle_W.x() + x * u_m, middle_W.y() + y * u_m};
  tangent_W = {dx, dy};
}

PlanPoint ClothoidPanel::At(double u_m) const {
  PlanPoint point;
  Point(u_m, point.p_W, point.tangent_W);
  point.heading_rad = heading_rad + (curvature_1pm + 0.5 * curvature_rate_1pm2 * u_m) * u_m;
  point.curvature_1pm = curvature_1pm + curvature_rate_1pm2 * u_m;
  return point;
}

PanelFoot ClothoidPanel::Nearest(const Eigen::Vector2d& p_W) const {
  Search search(*this, p_W);
  const double steepest = std::fabs(curvature_1pm) + std::fabs(curvature_rate_1pm2) * half_m;
  // Near or beyond a centre of curvature the distance may have more than one minimum on the panel.
  if (steepest * ((p_W - middle_W).norm() + half_m) < 0.9)
    search.One();
  else
    search.Every();
  return search.best();
}

}  // namespace rodeira::geometry
