// SPDX-License-Identifier: Apache-2.0
// How the elements of a reference line become panels.
#include <algorithm>
#include <cmath>

#include "common/core/base/assert.hpp"
#include "common/core/geometry/clothoid.hpp"
#include "common/core/geometry/plan_axis.hpp"
#include "common/core/geometry/plane.hpp"

namespace rodeira::geometry {
namespace {

constexpr double kMaxPanelHalf_m = 16.0;        // of a panel of a line
constexpr double kMaxPanelHalfTurn_rad = 0.25;  // of a panel of an arc
constexpr double kMaxPanels = 1e6;
constexpr int kDeepest = 24;  // halvings of a cubic

// The Gauss-Legendre rule of 5 nodes on [-1, 1].
constexpr std::array<double, 3> kGauss5Nodes = {0.0, 0.53846931010568309104, 0.90617984593866399280};
constexpr std::array<double, 3> kGauss5Weights = {0.56888888888888888889, 0.47862867049936646804,
                                                  0.23692688505618908751};

double Speed(const PlanElement& element, double p) {
  const double du = element.u[1] + p * (2.0 * element.u[2] + p * 3.0 * element.u[3]);
  const double dv = element.v[1] + p * (2.0 * element.v[2] + p * 3.0 * element.v[3]);
  return std::hypot(du, dv);
}

double Rule(const PlanElement& element, double from, double to) {
  const double middle = 0.5 * (from + to), half = 0.5 * (to - from);
  double sum = kGauss5Weights[0] * Speed(element, middle);
  for (std::size_t i = 1; i < 3; ++i)
    sum += kGauss5Weights[i] *
           (Speed(element, middle - half * kGauss5Nodes[i]) + Speed(element, middle + half * kGauss5Nodes[i]));
  return half * sum;
}

double Adaptive(const PlanElement& element, double from, double to, double whole, int depth) {
  if (!std::isfinite(whole)) return whole;
  const double middle = 0.5 * (from + to);
  const double left = Rule(element, from, middle), right = Rule(element, middle, to);
  if (depth == 0 || std::fabs(left + right - whole) <= 1e-13 * std::fabs(whole)) return left + right;
  return Adaptive(element, from, middle, left, depth - 1) + Adaptive(element, middle, to, right, depth - 1);
}

}  // namespace

double CubicLength(const PlanElement& element, double to) {
  return Adaptive(element, 0.0, to, Rule(element, 0.0, to), 20);
}

double GraphEnd(const PlanElement& element) {
  double p = element.length_m;  // the curve is at least as long as its projection: too far at first
  for (int iteration = 0; iteration < 60; ++iteration) {
    const double step = (element.length_m - CubicLength(element, p)) / Speed(element, p);
    p = std::clamp(p + step, 0.0, element.length_m);
    if (std::fabs(step) <= 1e-12 * element.length_m) break;
  }
  return p;
}

std::optional<PlanAxis> PlanAxis::Make(std::vector<PlanElement> elements) {
  RODEIRA_ASSERT(!elements.empty());
  PlanAxis axis;
  axis.elements_ = std::move(elements);
  for (const PlanElement& element : axis.elements_) {
    RODEIRA_ASSERT(element.length_m > 0.0);
    const bool clothoid = element.kind == PlanElement::Kind::kClothoid;
    if (!(clothoid ? axis.CutClothoidElement(element) : axis.CutCubicElement(element))) return std::nullopt;
  }
  axis.length_m_ = axis.elements_.back().s_m + axis.elements_.back().length_m;
  return axis;
}

bool PlanAxis::CutClothoidElement(const PlanElement& element) {
  const double rate = (element.curvature_end_1pm - element.curvature_start_1pm) / element.length_m;
  PlanPoint start{element.start_W,
                  {std::cos(element.heading_rad), std::sin(element.heading_rad)},
                  element.heading_rad,
                  element.curvature_start_1pm};
  const double steepest = std::max(std::fabs(element.curvature_start_1pm), std::fabs(element.curvature_end_1pm));
  const double per_metre = std::max(
      {1.0 / kMaxPanelHalf_m, steepest / kMaxPanelHalfTurn_rad, std::sqrt(std::fabs(rate)) / kMaxPanelHalfTurn_rad});
  if (!(element.length_m * per_metre < kMaxPanels)) return false;  // NaN too
  AxisPanel panel;
  if (rate != 0.0) {
    panel.kind = AxisPanel::Kind::kSeries;
    int i = 0;
    for (const ClothoidPanel& series : CutClothoid(start, rate, element.length_m)) {
      panel.detail = static_cast<std::uint32_t>(series_.size());
      panel.half_m = series.half_m;
      panel.middle_s_m = element.s_m + (2 * i++ + 1) * series.half_m;
      panel.heading_rad = series.heading_rad;
      panel.curvature_1pm = series.curvature_1pm;
      panel.middle_W = series.middle_W;
      panel.tangent_W = series.series_W[0];
      series_.push_back(series);
      panels_.push_back(panel);
    }
    return true;
  }
  const double k = element.curvature_start_1pm;
  panel.kind = k == 0.0 ? AxisPanel::Kind::kLine : AxisPanel::Kind::kArc;
  panel.curvature_1pm = k;
  const double count =
      std::ceil(0.5 * element.length_m * std::max(1.0 / kMaxPanelHalf_m, std::fabs(k) / kMaxPanelHalfTurn_rad));
  panel.half_m = 0.5 * element.length_m / count;
  for (int i = 0; i < static_cast<int>(count); ++i) {
    const double s = (2 * i + 1) * panel.half_m;
    const Eigen::Vector2d moved = ClothoidIntegral(k, 0.0, s);
    panel.middle_s_m = element.s_m + s;
    panel.heading_rad = element.heading_rad + k * s;
    panel.middle_W = element.start_W + moved.x() * start.tangent_W + moved.y() * start.left_W();
    panel.tangent_W = {std::cos(panel.heading_rad), std::sin(panel.heading_rad)};
    panels_.push_back(panel);
  }
  return true;
}

// Panels on which the speed |dr/dq| = sqrt(Q(q)), Q of degree 4, is a power series of 14 terms: halved until the series
// says the same length as a quadrature, to 1e-13 of it.
bool PlanAxis::CutCubicElement(const PlanElement& element) {
  const double whole = CubicLength(element, element.p_end);
  if (!(whole > 0.0 && std::isfinite(whole) && element.length_m / kMaxPanelHalf_m < kMaxPanels)) return false;
  if (0.5 * whole / kMaxPanelHalf_m > kMaxPanels) return false;  // each panel is shorter than twice its greatest half
  const double stretch = element.length_m / whole;               // metres of station a metre of curve
  const Eigen::Vector2d ahead(std::cos(element.heading_rad), std::sin(element.heading_rad));
  const Eigen::Vector2d left = Left(ahead);
  double s = element.s_m;
  double heading = element.heading_rad;
  Eigen::Vector2d last = ahead;
  bool sound = true;
  const auto cut = [&](const auto& self, double from, double to, int depth) -> void {
    const double p = 0.5 * (from + to), half = 0.5 * (to - from);
    CubicPanel cubic{};
    std::array<std::array<double, 4>, 2> local{};  // Taylor's series about p
    for (std::size_t axis = 0; axis < 2; ++axis) {
      const std::array<double, 4>& a = axis == 0 ? element.u : element.v;
      local[axis] = {a[0] + p * (a[1] + p * (a[2] + p * a[3])), a[1] + p * (2.0 * a[2] + 3.0 * p * a[3]),
                     a[2] + 3.0 * p * a[3], a[3]};
    }
    for (std::size_t n = 0; n < 4; ++n) cubic.position_W[n] = local[0][n] * ahead + local[1][n] * left;
    cubic.position_W[0] += element.start_W;
    std::array<double, CubicPanel::kTerms> squared{};
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) {
        squared[i + j] += static_cast<double>((i + 1) * (j + 1)) *
                          (local[0][i + 1] * local[0][j + 1] + local[1][i + 1] * local[1][j + 1]);
      }
    }
    std::array<double, CubicPanel::kTerms> speed{};
    speed[0] = std::sqrt(squared[0]);
    const double length = Rule(element, from, p) + Rule(element, p, to);
    const double still = 1e-9 * whole / element.p_end;
    const bool moving = speed[0] > still && Speed(element, from) > still && Speed(element, to) > still;
    double series_length = 0.0;
    if (moving) {
      for (std::size_t n = 1; n < CubicPanel::kTerms; ++n) {
        double sum = squared[n];
        for (std::size_t i = 1; i < n; ++i) sum -= speed[i] * speed[n - i];
        speed[n] = sum / (2.0 * speed[0]);
      }
      for (std::size_t n = 0; n < CubicPanel::kTerms; ++n)
        cubic.length_m[n] = stretch * speed[n] / static_cast<double>(n + 1);
      cubic.half_q = half;
      series_length = cubic.UAt(half) - cubic.UAt(-half);
    }
    const double bent =
        std::fabs(Cross(cubic.position_W[1], cubic.position_W[2])) * half / std::max(squared[0], 1e-300);
    const bool fits =
        moving && std::fabs(series_length - stretch * length) <= 1e-12 * stretch * length && bent < 0.25 &&
        length < 2.0 * kMaxPanelHalf_m &&
        std::fabs(speed[CubicPanel::kTerms - 1]) * std::pow(half, CubicPanel::kTerms - 1) < 1e-14 * speed[0];
    if (!fits) {
      if (depth == 0 || static_cast<double>(cubics_.size()) > kMaxPanels) {
        sound = false;
        return;
      }
      self(self, from, p, depth - 1);
      if (sound) self(self, p, to, depth - 1);
      return;
    }
    AxisPanel panel;
    panel.kind = AxisPanel::Kind::kCubic;
    panel.detail = static_cast<std::uint32_t>(cubics_.size());
    panel.tangent_W = cubic.position_W[1].normalized();
    heading += std::atan2(Cross(last, panel.tangent_W), last.dot(panel.tangent_W));
    last = panel.tangent_W;
    panel.heading_rad = heading;
    panel.curvature_1pm = 2.0 * Cross(cubic.position_W[1], cubic.position_W[2]) / (squared[0] * speed[0]);
    panel.middle_W = cubic.position_W[0];
    // The station of the middle lies where the series says, so that a panel's two halves are of equal length: the
    // origin of the series is moved to the middle of the length.
    const double before = -cubic.UAt(-half), after = cubic.UAt(half);
    panel.half_m = 0.5 * (before + after);
    panel.middle_s_m = s + panel.half_m;
    cubic.offset_m = before - panel.half_m;
    s += before + after;
    cubic.bulge_m = half * half * (cubic.position_W[2].norm() + 3.0 * half * cubic.position_W[3].norm());
    cubics_.push_back(cubic);
    panels_.push_back(panel);
  };
  cut(cut, 0.0, element.p_end, kDeepest);
  return sound;
}

}  // namespace rodeira::geometry
