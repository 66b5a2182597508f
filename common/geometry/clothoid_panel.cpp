#include "common/geometry/clothoid_panel.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

#include "common/base/assert.hpp"
#include "common/geometry/clothoid.hpp"

namespace rodeira::geometry {
namespace {

// The half length h of a panel. Its power series has 12 terms; what follows is below (k h)^12 / 12! for the curvature k
// and below (sqrt(k') h)^12 / sqrt(12!) for the change k' of the curvature, both under 2e-14 of h with these bounds.
constexpr double kHalfTurn_rad = 0.2;
constexpr double kHalfTwist = 0.16;
constexpr double kHalfPanel_m = 8.0;  // so that a grid cell finds few panels
constexpr double kLastStep_m = 1e-7;

Eigen::Vector2d Turned(const Eigen::Vector2d& v, const Eigen::Vector2d& direction) {
  return {v.x() * direction.x() - v.y() * direction.y(), v.x() * direction.y() + v.y() * direction.x()};
}

// The nearest point with u in [from, to], where the squared distance has one minimum at most.
void NearestWithin(const ClothoidPanel& panel, const Eigen::Vector2d& p, double from, double to, PanelFoot& best) {
  Eigen::Vector2d at, tangent;
  const auto ahead = [&](double u) {  // how far p lies ahead of the point at u; falls through 0 at a foot
    if (u == -panel.half_m) at = panel.begin_W, tangent = panel.begin_tangent_W;
    else if (u == panel.half_m) at = panel.end_W, tangent = panel.end_tangent_W;
    else panel.Point(u, at, tangent);
    return (p - at).dot(tangent);
  };
  const auto offer = [&](double u) {
    const double squared = (p - at).squaredNorm();
    if (squared < best.squared_m2) best = {squared, u};
  };
  double low = from, high = to;
  const double ahead_low = ahead(low);
  offer(low);
  const double ahead_high = ahead(high);
  offer(high);
  if (!(ahead_low > 0.0 && ahead_high < 0.0)) return;
  double u = low + (high - low) * (ahead_low / (ahead_low - ahead_high));
  for (int iteration = 0; iteration < 60; ++iteration) {
    const double value = ahead(u);
    (value > 0.0 ? low : high) = u;
    const double curvature = panel.curvature_1pm + panel.curvature_rate_1pm2 * u;
    const Eigen::Vector2d away = p - at;
    const double slope = 1.0 - curvature * (tangent.x() * away.y() - tangent.y() * away.x());
    const double step = value / slope;
    if (std::fabs(step) <= kLastStep_m) {  // Newton doubles the digits: what is left after it is rounding
      u = std::clamp(u + step, from, to);
      break;
    }
    const double next = u + step;
    u = next > low && next < high ? next : 0.5 * (low + high);
  }
  ahead(u);
  offer(u);
}

}  // namespace

std::vector<ClothoidPanel> CutClothoid(const PlanPoint& start, double rate_1pm2, double length_m) {
  const double steepest = std::max(std::fabs(start.curvature_1pm), std::fabs(start.curvature_1pm + rate_1pm2 * length_m));
  const double per_metre = std::max({1.0 / kHalfPanel_m, steepest / kHalfTurn_rad, std::sqrt(std::fabs(rate_1pm2)) / kHalfTwist});
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
    panel.middle_W = start.p_W + Turned(ClothoidIntegral(start.curvature_1pm, rate_1pm2, s), start.tangent_W);
    // f(u) = exp(i (k u + k' u^2 / 2)) solves f' = i (k + k' u) f, which gives its power series term by term.
    std::complex<double> before = 0.0;
    std::complex<double> term = std::polar(1.0, panel.heading_rad);
    for (int n = 0; n < ClothoidPanel::kTerms; ++n) {
      panel.series_W[n] = Eigen::Vector2d(term.real(), term.imag()) / (n + 1);
      const std::complex<double> next =
          std::complex<double>(0.0, 1.0) * (panel.curvature_1pm * term + rate_1pm2 * before) / static_cast<double>(n + 1);
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
  for (int n = kTerms - 2; n >= 0; --n) {
    x = x * u_m + series_W[n].x();
    y = y * u_m + series_W[n].y();
    dx = dx * u_m + (n + 1) * series_W[n].x();
    dy = dy * u_m + (n + 1) * series_W[n].y();
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
  PanelFoot best{std::numeric_limits<double>::infinity(), 0.0};
  const double steepest = std::fabs(curvature_1pm) + std::fabs(curvature_rate_1pm2) * half_m;
  const double distance = (p_W - middle_W).norm() + half_m;
  if (steepest * distance < 0.9) {
    NearestWithin(*this, p_W, -half_m, half_m, best);
    return best;
  }
  // Near or beyond a centre of curvature the distance may have more than one minimum on the panel.
  constexpr int kParts = 8;
  for (int part = 0; part < kParts; ++part) {
    const double from = half_m * (2.0 * part / kParts - 1.0);
    const double to = half_m * (2.0 * (part + 1) / kParts - 1.0);
    NearestWithin(*this, p_W, from, to, best);
  }
  return best;
}

}  // namespace rodeira::geometry
