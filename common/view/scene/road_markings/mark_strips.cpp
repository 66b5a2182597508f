// SPDX-License-Identifier: Apache-2.0
#include "common/view/scene/road_markings/mark_strips.hpp"

#include <algorithm>
#include <cmath>

#include "common/view/scene/ground_materials/colours.hpp"
#include "common/world/network/marking.hpp"

namespace rodeira::scene {
namespace {

constexpr double kMaxStripLength_m = 24.0, kMinStripLength_m = 0.05;

using Edges = std::array<Eigen::Vector3d, 2>;  // right and left

// Cuts one stroke into pieces.
class MarkStripBuilder {
 public:
  MarkStripBuilder(const network::Road& road, const network::Marking& line, double chord_m, TilePaint& paint)
      : road_(road), line_(line), chord_m_(chord_m), colour_(PaintColour(line.colour)), paint_(paint) {}

  void Paint(double from, double to) {
    const int count = std::max(1, static_cast<int>(std::ceil((to - from) / kMaxStripLength_m)));
    Edges before = At(from);
    for (int k = 1; k <= count; ++k) {
      const double low = from + (to - from) * (k - 1) / count, high = k == count ? to : from + (to - from) * k / count;
      const Edges after = At(high);
      Refine(low, high, before, after, 0);
      before = after;
    }
  }

 private:
  Edges At(double s_m) const {
    const geometry::CubicPoint t = network::MarkingAt(road_, line_, s_m);
    const double s = line_.painted != nullptr ? s_m : road_.Held(line_.section, s_m);
    // Across the line, not across the road, where it runs askew: the width is measured square to the line.
    const double pace = 1.0 - road_.axis().Evaluate(s).curvature_1pm * t.value;
    const double stretch = pace > 1e-3 ? std::sqrt(1.0 + (t.slope / pace) * (t.slope / pace)) : 1.0;
    const double half = 0.5 * line_.width_m * stretch;
    return {road_.Surface(s, t.value - half).p_W, road_.Surface(s, t.value + half).p_W};
  }

  void Refine(double from, double to, const Edges& before, const Edges& after, int depth) {
    bool fits = true;
    if (to - from > kMinStripLength_m && depth < 16) {
      for (const double part : {0.5, 0.25, 0.75}) {
        const Edges at = At(from + part * (to - from));
        for (std::size_t k = 0; k < 2 && fits; ++k) {
          const Eigen::Vector2d along = (after[k] - before[k]).head<2>(), off = (at[k] - before[k]).head<2>();
          const double share =
              along.squaredNorm() > 0.0 ? std::clamp(off.dot(along) / along.squaredNorm(), 0.0, 1.0) : 0.0;
          fits = (off - share * along).norm() <= chord_m_;
        }
      }
    }
    if (!fits) {
      const double middle = 0.5 * (from + to);
      const Edges between = At(middle);
      Refine(from, middle, before, between, depth + 1);
      Refine(middle, to, between, after, depth + 1);
      return;
    }
    AddPaint({{before[0], after[0], after[1], before[1]}, colour_}, paint_);
  }

  const network::Road& road_;
  const network::Marking& line_;
  double chord_m_;
  Colour colour_;
  TilePaint& paint_;
};

}  // namespace

Colour PaintColour(std::string_view name) {
  if (name == "yellow") return Colour::Of(0xe5b52e);
  if (name == "blue") return Colour::Of(0x2f6fc0);
  if (name == "green") return Colour::Of(0x3f9a53);
  if (name == "red") return Colour::Of(0xc0392f);
  if (name == "orange") return Colour::Of(0xe58a2e);
  if (name == "violet") return Colour::Of(0x8a4fb5);
  if (name == "black") return Colour::Of(0x202020);
  return SurfaceColour(ground::Surface::kRoadMark);  // white, standard, unsaid
}

void AddPaint(const PaintPiece& piece, TilePaint& paint) {
  Eigen::Vector2d low = piece.p_W[0].head<2>(), high = low;
  for (const Eigen::Vector3d& p : piece.p_W) low = low.cwiseMin(p.head<2>()), high = high.cwiseMax(p.head<2>());
  const WorldStep from = ToSteps(low), to = ToSteps(high);
  for (std::int64_t column = TileOf(from.x - 1); column <= TileOf(to.x + 1); ++column) {
    for (std::int64_t row = TileOf(from.y - 1); row <= TileOf(to.y + 1); ++row) paint[{column, row}].push_back(piece);
  }
}

void PaintRoad(const network::Road& road, double chord_m, TilePaint& paint) {
  for (const network::Marking& line : network::MarkingsOf(road)) {
    MarkStripBuilder builder(road, line, chord_m, paint);
    for (const network::Stroke& at : network::StrokesOf(road, line)) builder.Paint(at.from_s_m, at.to_s_m);
  }
}

}  // namespace rodeira::scene
