// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "common/core/geometry/clothoid_panel.hpp"

namespace rodeira::geometry {

// One element of a reference line, with a start of its own.
struct PlanElement {
  enum class Kind : std::uint8_t { kClothoid, kCubic };

  double s_m = 0.0;  // where it begins along the line
  double length_m = 0.0;
  Eigen::Vector2d start_W = Eigen::Vector2d::Zero();
  double heading_rad = 0.0;
  Kind kind = Kind::kClothoid;
  // A clothoid: curvature goes linearly from start to end. Equal: an arc; both zero: a line.
  double curvature_start_1pm = 0.0;
  double curvature_end_1pm = 0.0;
  // A parametric cubic in the frame of the start: u(p) = sum u[i] p^i along the heading, v(p) to its left, p from 0 to
  // p_end. Stations go with the curve's own length, stretched so that the whole curve takes length_m.
  std::array<double, 4> u{};
  std::array<double, 4> v{};
  double p_end = 1.0;
};

// The length of a cubic element's curve from p = 0 to `to`, which is p_end or any other p: Gauss-Legendre, to about
// 1e-13 of it. A graph v(u) is a cubic with u = {0, 1, 0, 0}.
double CubicLength(const PlanElement& element, double to);
// The p_end for which a graph v(u) has the element's length.
double GraphEnd(const PlanElement& element);

// A short part of a reference line. u counts from its middle, in metres of station, in [-half, half].
struct AxisPanel {
  enum class Kind : std::uint32_t { kLine, kArc, kSeries, kCubic };

  Kind kind = Kind::kLine;
  std::uint32_t detail = 0;  // of series and cubics: which
  double middle_s_m = 0.0;
  double half_m = 0.0;
  // There; a cubic's in the middle of its parameter.
  double heading_rad = 0.0;
  double curvature_1pm = 0.0;
  Eigen::Vector2d middle_W = Eigen::Vector2d::Zero();
  Eigen::Vector2d tangent_W = Eigen::Vector2d::UnitX();

  double begin_s_m() const { return middle_s_m - half_m; }
  double end_s_m() const { return middle_s_m + half_m; }
};

// The foot of a point on a panel: the nearest point of the panel. t is positive to the left; beyond is how far the
// point lies past the panel's end along it, negative before its beginning, 0 alongside.
struct AxisFoot {
  double u_m = 0.0;
  double t_m = 0.0;
  double beyond_m = 0.0;
  PlanPoint at;  // there, but for rounding what PlanAxis::At says
};

// A reference line as other programs' files give it: elements that each say where they start, which may leave small
// gaps. Lines and arcs are closed forms; clothoids and cubics are cut into short power series, exact to about 1e-13 m.
class PlanAxis {
 public:
  // Elements in ascending s, each of positive length. Nothing where a cubic has a cusp (it stands still somewhere), or
  // where an element turns so often or is so long that a million panels would not do.
  static std::optional<PlanAxis> Make(std::vector<PlanElement> elements);

  const std::vector<PlanElement>& elements() const { return elements_; }
  const std::vector<AxisPanel>& panels() const { return panels_; }
  double length_m() const { return length_m_; }  // the end of the last element
  // s is held within [0, length]. Where two elements meet: the start of the second.
  PlanPoint Evaluate(double s_m) const;
  // u_m: from the panel's middle, within its half length.
  PlanPoint At(const AxisPanel& panel, double u_m) const;
  // Of a panel of this axis; of equally near points the first one.
  AxisFoot Foot(const AxisPanel& panel, const Eigen::Vector2d& p_W) const;
  // By how much a panel's curvature changes a metre, where it does so linearly; nothing for a cubic.
  std::optional<double> RateOf(const AxisPanel& panel) const {
    if (panel.kind == AxisPanel::Kind::kCubic) return std::nullopt;
    return panel.kind == AxisPanel::Kind::kSeries ? series_[panel.detail].curvature_rate_1pm2 : 0.0;
  }
  // No point of the panel is farther from the chord between its ends than this.
  double Bulge(const AxisPanel& panel) const;
  // The panel that holds s, held within [0, length]; of two that meet there the second.
  std::size_t PanelAt(double s_m) const;
  // An element's end, by its own formula. The heading of a cubic's lies in (-pi, pi].
  static PlanPoint End(const PlanElement& element);

 private:
  struct CubicPanel {
    static constexpr int kTerms = 14;
    std::array<Eigen::Vector2d, 4> position_W;  // power series in q about the panel's middle
    std::array<double, kTerms> length_m;        // u = offset_m + sum length[n] q^(n+1)
    double offset_m;
    double half_q;
    double bulge_m;

    double QAt(double u_m) const;
    double UAt(double q) const;
    void Point(double q, Eigen::Vector2d& p_W, Eigen::Vector2d& first, Eigen::Vector2d& second) const;
  };
  bool CutClothoidElement(const PlanElement& element);
  bool CutCubicElement(const PlanElement& element);
  AxisFoot ArcFoot(const AxisPanel& panel, const Eigen::Vector2d& p_W) const;
  AxisFoot CubicFoot(const CubicPanel& cubic, const AxisPanel& panel, const Eigen::Vector2d& p_W) const;
  PlanPoint CubicAt(const CubicPanel& cubic, double heading_rad, double q) const;

  std::vector<PlanElement> elements_;
  std::vector<AxisPanel> panels_;
  std::vector<ClothoidPanel> series_;
  std::vector<CubicPanel> cubics_;
  double length_m_ = 0.0;
};

}  // namespace rodeira::geometry
