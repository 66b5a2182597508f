#include "common/geometry/plan_curve.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

#include "common/base/assert.hpp"
#include "common/geometry/clothoid.hpp"

namespace rodeira::geometry {
namespace {

// The half length h of a panel. Its power series has 12 terms; what follows is below (k h)^12 / 12! for the curvature k
// and below (sqrt(k') h)^12 / sqrt(12!) for the change k' of the curvature, both under 2e-14 of h with these bounds.
constexpr double kHalfTurn_rad = 0.2;
constexpr double kHalfTwist = 0.16;
constexpr double kHalfPanel_m = 8.0;  // so that a grid cell finds few panels

Eigen::Vector2d Turned(const Eigen::Vector2d& v, const Eigen::Vector2d& direction) {
  return {v.x() * direction.x() - v.y() * direction.y(), v.x() * direction.y() + v.y() * direction.x()};
}

}  // namespace

PlanCurve::PlanCurve(Eigen::Vector2d start_W, double heading_rad, std::vector<PlanPiece> pieces, double reach_m)
    : pieces_(std::move(pieces)), reach_m_(reach_m) {
  RODEIRA_ASSERT(!pieces_.empty() && reach_m > 0.0);
  PlanPoint start{start_W, {std::cos(heading_rad), std::sin(heading_rad)}, heading_rad, 0.0};
  for (const PlanPiece& piece : pieces_) {
    RODEIRA_ASSERT(piece.length_m > 0.0);
    CutPiece(piece, length_m_, start);
    const double rate = (piece.curvature_end_1pm - piece.curvature_start_1pm) / piece.length_m;
    start.p_W += Turned(ClothoidIntegral(piece.curvature_start_1pm, rate, piece.length_m), start.tangent_W);
    start.heading_rad += 0.5 * (piece.curvature_start_1pm + piece.curvature_end_1pm) * piece.length_m;
    start.tangent_W = {std::cos(start.heading_rad), std::sin(start.heading_rad)};
    length_m_ += piece.length_m;
  }
  for (const Panel& panel : panels_) panel_begin_s_m_.push_back(panel.middle_s_m - panel.half_m);
  BuildTree();
  BuildGrid();
}

void PlanCurve::CutPiece(const PlanPiece& piece, double start_s_m, const PlanPoint& start) {
  const double rate = (piece.curvature_end_1pm - piece.curvature_start_1pm) / piece.length_m;
  const double steepest = std::max(std::fabs(piece.curvature_start_1pm), std::fabs(piece.curvature_end_1pm));
  const double per_metre = std::max({1.0 / kHalfPanel_m, steepest / kHalfTurn_rad, std::sqrt(std::fabs(rate)) / kHalfTwist});
  const double count = std::ceil(0.5 * piece.length_m * per_metre);
  RODEIRA_ASSERT(count < 1e7);
  const double half = 0.5 * piece.length_m / count;
  for (int i = 0; i < static_cast<int>(count); ++i) {
    const double s = (2 * i + 1) * half;
    Panel panel{};
    panel.middle_s_m = start_s_m + s;
    panel.half_m = half;
    panel.heading_rad = start.heading_rad + (piece.curvature_start_1pm + 0.5 * rate * s) * s;
    panel.curvature_1pm = piece.curvature_start_1pm + rate * s;
    panel.curvature_rate_1pm2 = rate;
    panel.middle_W = start.p_W + Turned(ClothoidIntegral(piece.curvature_start_1pm, rate, s), start.tangent_W);
    // f(u) = exp(i (k u + k' u^2 / 2)) solves f' = i (k + k' u) f, which gives its power series term by term.
    std::complex<double> before = 0.0;
    std::complex<double> term = std::polar(1.0, panel.heading_rad);
    for (int n = 0; n < kTerms; ++n) {
      panel.series_W[n] = Eigen::Vector2d(term.real(), term.imag()) / (n + 1);
      const std::complex<double> next =
          std::complex<double>(0.0, 1.0) * (panel.curvature_1pm * term + rate * before) / static_cast<double>(n + 1);
      before = term;
      term = next;
    }
    panel.Point(-half, panel.begin_W, panel.begin_tangent_W);
    panel.Point(half, panel.end_W, panel.end_tangent_W);
    // A curve of curvature at most k and length 2 h stays within k (2 h)^2 / 8 of its chord.
    panel.bulge_m = 0.5 * steepest * half * half;
    panels_.push_back(panel);
  }
}

void PlanCurve::Panel::Point(double u_m, Eigen::Vector2d& p_W, Eigen::Vector2d& tangent_W) const {
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

PlanPoint PlanCurve::Panel::At(double u_m) const {
  PlanPoint point;
  Point(u_m, point.p_W, point.tangent_W);
  point.heading_rad = heading_rad + (curvature_1pm + 0.5 * curvature_rate_1pm2 * u_m) * u_m;
  point.curvature_1pm = curvature_1pm + curvature_rate_1pm2 * u_m;
  return point;
}

PlanPoint PlanCurve::Evaluate(double s_m) const {
  const double s = std::clamp(s_m, 0.0, length_m_);
  const auto after = std::upper_bound(panel_begin_s_m_.begin() + 1, panel_begin_s_m_.end(), s);
  const Panel& panel = panels_[static_cast<std::size_t>(after - panel_begin_s_m_.begin()) - 1];
  return panel.At(std::clamp(s - panel.middle_s_m, -panel.half_m, panel.half_m));
}

}  // namespace rodeira::geometry
