// SPDX-License-Identifier: Apache-2.0
#include "common/core/geometry/plan_axis.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/geometry/clothoid.hpp"
#include "common/core/geometry/plane.hpp"
#include "common/core/geometry/small_arc_tangent.hpp"
#include "common/core/geometry/tolerances.hpp"

namespace rodeira::geometry {
namespace {

PlanPoint ArcAt(const AxisPanel& panel, double u_m) {
  const double turned = panel.curvature_1pm * u_m;
  const double sine = std::sin(turned), cosine = std::cos(turned), half_sine = std::sin(0.5 * turned);
  const Eigen::Vector2d left = Left(panel.tangent_W);
  PlanPoint point;
  point.p_W = panel.middle_W + sine / panel.curvature_1pm * panel.tangent_W +
              2.0 * half_sine * half_sine / panel.curvature_1pm * left;
  point.tangent_W = cosine * panel.tangent_W + sine * left;
  point.heading_rad = panel.heading_rad + turned;
  point.curvature_1pm = panel.curvature_1pm;
  return point;
}

}  // namespace

std::size_t PlanAxis::PanelAt(double s_m) const {
  const auto after = std::upper_bound(panels_.begin() + 1, panels_.end(), s_m,
                                      [](double s, const AxisPanel& panel) { return s < panel.begin_s_m(); });
  return static_cast<std::size_t>(after - panels_.begin()) - 1;
}

PlanPoint PlanAxis::Evaluate(double s_m) const {
  const AxisPanel& panel = panels_[PanelAt(s_m)];
  return At(panel, std::clamp(s_m - panel.middle_s_m, -panel.half_m, panel.half_m));
}

PlanPoint PlanAxis::At(const AxisPanel& panel, double u_m) const {
  switch (panel.kind) {
    case AxisPanel::Kind::kLine:
      return {panel.middle_W + u_m * panel.tangent_W, panel.tangent_W, panel.heading_rad, 0.0};
    case AxisPanel::Kind::kArc:
      return ArcAt(panel, u_m);
    case AxisPanel::Kind::kSeries:
      return series_[panel.detail].At(u_m);
    case AxisPanel::Kind::kCubic:
      break;
  }
  const CubicPanel& cubic = cubics_[panel.detail];
  return CubicAt(cubic, panel.heading_rad, cubic.QAt(u_m));
}

AxisFoot PlanAxis::Foot(const AxisPanel& panel, const Eigen::Vector2d& p_W) const {
  switch (panel.kind) {
    case AxisPanel::Kind::kLine: {
      const Eigen::Vector2d away = p_W - panel.middle_W;
      const double along = away.dot(panel.tangent_W);
      const double u = std::clamp(along, -panel.half_m, panel.half_m);
      return {u, Cross(panel.tangent_W, away), along - u, At(panel, u)};
    }
    case AxisPanel::Kind::kArc:
      return ArcFoot(panel, p_W);
    case AxisPanel::Kind::kCubic:
      return CubicFoot(cubics_[panel.detail], panel, p_W);
    case AxisPanel::Kind::kSeries:
      break;
  }
  const ClothoidPanel& series = series_[panel.detail];
  const double u = series.Nearest(p_W).u_m;
  const PlanPoint at = series.At(u);
  const bool inside = std::fabs(u) < panel.half_m;
  return {u, Cross(at.tangent_W, p_W - at.p_W), inside ? 0.0 : at.tangent_W.dot(p_W - at.p_W), at};
}

AxisFoot PlanAxis::ArcFoot(const AxisPanel& panel, const Eigen::Vector2d& p_W) const {
  // Seen from the centre, the point stands at the angle of (1 - k n, k a): n is its distance to the left, a ahead.
  const Eigen::Vector2d away = p_W - panel.middle_W, left = Left(panel.tangent_W);
  const double along = away.dot(panel.tangent_W), aside = away.dot(left), k = panel.curvature_1pm;
  const double x = 1.0 - k * aside, y = k * along, h = std::sqrt(x * x + y * y);
  const double tangent_of_half = y / (h + x);
  const double u =
      (std::fabs(tangent_of_half) <= kSmallTangent ? 2.0 * SmallArcTangent(tangent_of_half) : std::atan2(y, x)) / k;
  if (std::fabs(u) <= panel.half_m && h > 0.0) {
    AxisFoot foot{u, (2.0 * aside - k * (along * along + aside * aside)) / (1.0 + h), 0.0, {}};
    const double inverse = 1.0 / h;
    foot.at.tangent_W = x * inverse * panel.tangent_W + y * inverse * left;
    foot.at.p_W = p_W - foot.t_m * foot.at.left_W();
    foot.at.heading_rad = panel.heading_rad + k * u;
    foot.at.curvature_1pm = k;
    return foot;
  }
  const double end = u > 0.0 ? panel.half_m : -panel.half_m;
  const PlanPoint at = ArcAt(panel, end);
  return {end, Cross(at.tangent_W, p_W - at.p_W), at.tangent_W.dot(p_W - at.p_W), at};
}

double PlanAxis::Bulge(const AxisPanel& panel) const {
  switch (panel.kind) {
    case AxisPanel::Kind::kLine:
      return 0.0;
    case AxisPanel::Kind::kArc:
      return 0.5 * std::fabs(panel.curvature_1pm) * panel.half_m * panel.half_m;
    case AxisPanel::Kind::kSeries:
      return series_[panel.detail].bulge_m;
    case AxisPanel::Kind::kCubic:
      break;
  }
  return cubics_[panel.detail].bulge_m;
}

void PlanAxis::CubicPanel::Point(double q, Eigen::Vector2d& p_W, Eigen::Vector2d& first,
                                 Eigen::Vector2d& second) const {
  p_W = position_W[0] + q * (position_W[1] + q * (position_W[2] + q * position_W[3]));
  first = position_W[1] + q * (2.0 * position_W[2] + q * 3.0 * position_W[3]);
  second = 2.0 * position_W[2] + 6.0 * q * position_W[3];
}

double PlanAxis::CubicPanel::UAt(double q) const {
  double sum = length_m[kTerms - 1];
  for (std::size_t n = kTerms - 1; n-- > 0;) sum = sum * q + length_m[n];
  return offset_m + sum * q;
}

double PlanAxis::CubicPanel::QAt(double u_m) const {
  const double wanted = u_m - offset_m;
  double q = wanted / length_m[0];
  for (int iteration = 0; iteration < 30; ++iteration) {
    double value = length_m[kTerms - 1], slope = 0.0;
    for (std::size_t n = kTerms - 1; n-- > 0;) {
      slope = slope * q + value;
      value = value * q + length_m[n];
    }
    slope = slope * q + value;  // of value q
    const double step = (wanted - value * q) / slope;
    q = std::clamp(q + step, -half_q, half_q);
    if (std::fabs(step) <= 1e-9 * half_q) break;
  }
  return q;
}

PlanPoint PlanAxis::CubicAt(const CubicPanel& cubic, double heading_rad, double q) const {
  Eigen::Vector2d first, second;
  PlanPoint point;
  cubic.Point(q, point.p_W, first, second);
  const double speed = first.norm();
  point.tangent_W = first / speed;
  const Eigen::Vector2d& middle = cubic.position_W[1];
  point.heading_rad = heading_rad + std::atan2(Cross(middle, first), middle.dot(first));
  point.curvature_1pm = Cross(first, second) / (speed * speed * speed);
  return point;
}

AxisFoot PlanAxis::CubicFoot(const CubicPanel& cubic, const AxisPanel& panel, const Eigen::Vector2d& p_W) const {
  Eigen::Vector2d at, first, second;
  double best_m2 = 0.0, best_q = 0.0;
  bool found = false;
  const auto offer = [&](double q) {
    const double squared = (p_W - at).squaredNorm();
    if (!found || squared < best_m2) best_m2 = squared, best_q = q, found = true;
  };
  const auto ahead = [&](double q) {
    cubic.Point(q, at, first, second);
    return (p_W - at).dot(first);
  };
  constexpr int kParts = 4;  // the distance may have more than one minimum
  double low_value = ahead(-cubic.half_q);
  offer(-cubic.half_q);
  for (int part = 0; part < kParts; ++part) {
    double low = cubic.half_q * (2.0 * part / kParts - 1.0);
    double high = cubic.half_q * (2.0 * (part + 1) / kParts - 1.0);
    const double from_value = low_value;
    low_value = ahead(high);
    offer(high);
    if (!(from_value > 0.0 && low_value < 0.0)) continue;
    double q = low + (high - low) * (from_value / (from_value - low_value));
    for (int iteration = 0; iteration < 60; ++iteration) {
      const double value = ahead(q);
      (value > 0.0 ? low : high) = q;
      const double step = value / (first.squaredNorm() - (p_W - at).dot(second));
      const double next = q + step;
      const bool inside = next > low && next < high;
      if (std::fabs(step) * first.norm() <= kLastNewtonStep_m) {
        if (inside) q = next;
        break;
      }
      q = inside ? next : 0.5 * (low + high);
    }
    ahead(q);
    offer(q);
  }
  const PlanPoint foot = CubicAt(cubic, panel.heading_rad, best_q);
  const double u = std::clamp(cubic.UAt(best_q), -panel.half_m, panel.half_m);
  const bool inside = std::fabs(best_q) < cubic.half_q;
  return {u, Cross(foot.tangent_W, p_W - foot.p_W), inside ? 0.0 : foot.tangent_W.dot(p_W - foot.p_W), foot};
}

PlanPoint PlanAxis::End(const PlanElement& element) {
  const Eigen::Vector2d ahead(std::cos(element.heading_rad), std::sin(element.heading_rad));
  PlanPoint end;
  if (element.kind == PlanElement::Kind::kClothoid) {
    const double k0 = element.curvature_start_1pm, k1 = element.curvature_end_1pm;
    const Eigen::Vector2d moved = ClothoidIntegral(k0, (k1 - k0) / element.length_m, element.length_m);
    end.p_W = element.start_W + moved.x() * ahead + moved.y() * Left(ahead);
    end.heading_rad = element.heading_rad + 0.5 * (k0 + k1) * element.length_m;
    end.curvature_1pm = k1;
    end.tangent_W = {std::cos(end.heading_rad), std::sin(end.heading_rad)};
    return end;
  }
  const double p = element.p_end;
  const auto value = [p](const std::array<double, 4>& a) { return a[0] + p * (a[1] + p * (a[2] + p * a[3])); };
  const auto slope = [p](const std::array<double, 4>& a) { return a[1] + p * (2.0 * a[2] + p * 3.0 * a[3]); };
  end.p_W = element.start_W + value(element.u) * ahead + value(element.v) * Left(ahead);
  const Eigen::Vector2d first = slope(element.u) * ahead + slope(element.v) * Left(ahead);
  end.tangent_W = first.normalized();
  end.heading_rad = std::atan2(first.y(), first.x());
  const Eigen::Vector2d second = (2.0 * element.u[2] + 6.0 * p * element.u[3]) * ahead +
                                 (2.0 * element.v[2] + 6.0 * p * element.v[3]) * Left(ahead);
  end.curvature_1pm = Cross(first, second) / std::pow(first.norm(), 3);
  return end;
}

}  // namespace rodeira::geometry
