// SPDX-License-Identifier: Apache-2.0
#include "common/core/geometry/plan_curve.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/base/assert.hpp"
#include "common/core/geometry/clothoid.hpp"
#include "common/core/geometry/plane.hpp"

namespace rodeira::geometry {

PlanCurve::PlanCurve(Eigen::Vector2d start_W, double heading_rad, std::vector<PlanPiece> pieces, double reach_m)
    : pieces_(std::move(pieces)), reach_m_(reach_m) {
  RODEIRA_ASSERT(!pieces_.empty() && reach_m > 0.0);
  PlanPoint start{start_W, {std::cos(heading_rad), std::sin(heading_rad)}, heading_rad, 0.0};
  for (const PlanPiece& piece : pieces_) {
    RODEIRA_ASSERT(piece.length_m > 0.0);
    CutPiece(piece, length_m_, start);
    const double rate = (piece.curvature_end_1pm - piece.curvature_start_1pm) / piece.length_m;
    start.p_W += Rotate(ClothoidIntegral(piece.curvature_start_1pm, rate, piece.length_m), start.tangent_W);
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
  PlanPoint from = start;
  from.curvature_1pm = piece.curvature_start_1pm;
  int i = 0;
  for (const ClothoidPanel& panel : CutClothoid(from, rate, piece.length_m)) {
    panels_.push_back({panel, start_s_m + (2 * i++ + 1) * panel.half_m});
  }
}

PlanPoint PlanCurve::Evaluate(double s_m) const {
  const double s = std::clamp(s_m, 0.0, length_m_);
  const auto after = std::upper_bound(panel_begin_s_m_.begin() + 1, panel_begin_s_m_.end(), s);
  const Panel& panel = panels_[static_cast<std::size_t>(after - panel_begin_s_m_.begin()) - 1];
  return panel.At(std::clamp(s - panel.middle_s_m, -panel.half_m, panel.half_m));
}

}  // namespace rodeira::geometry
