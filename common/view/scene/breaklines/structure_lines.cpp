// SPDX-License-Identifier: Apache-2.0
#include "common/view/scene/breaklines/structure_lines.hpp"

namespace rodeira::scene {
namespace {

void AddLineAcross(const network::Road& road, double s_m, std::vector<Line3>& lines) {
  constexpr double kBeyond_m =
      0.05;  // the drawn edges are chords: a line that ended at the edge itself might not reach them
  if (s_m <= 0.0 || s_m >= road.length_m()) return;
  double right, left;
  road.SectionAt(s_m).Bounds(road.spec().lane_offset, s_m, s_m, right, left);
  const Eigen::Vector3d from = road.Surface(s_m, right).p_W, to = road.Surface(s_m, left).p_W;
  const Eigen::Vector3d beyond = (to - from).normalized() * kBeyond_m;
  lines.push_back({from - beyond, to + beyond});
}

}  // namespace

void AddStructureLines(const network::Road& road, std::span<const road::Stretch> decks, std::vector<Line3>& lines) {
  for (const network::Structure& structure : road.spec().structures) {
    for (const double s : {structure.s_m, structure.s_m + structure.length_m}) AddLineAcross(road, s, lines);
  }
  for (const road::Stretch& deck : decks) {
    for (const double s : {deck.from_s_m, deck.to_s_m}) AddLineAcross(road, s, lines);
  }
}

}  // namespace rodeira::scene
