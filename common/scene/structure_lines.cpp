#include "common/scene/structure_lines.hpp"

namespace rodeira::scene {

void AddStructureLines(const network::Road& road, std::vector<Line3>& lines) {
  constexpr double kBeyond_m = 0.05;  // the drawn edges are chords: a line that ended at the edge itself might not reach them
  for (const network::Structure& structure : road.spec().structures) {
    for (const double s : {structure.s_m, structure.s_m + structure.length_m}) {
      if (s <= 0.0 || s >= road.length_m()) continue;
      double right, left;
      road.SectionAt(s).Bounds(road.spec().lane_offset, s, s, right, left);
      const Eigen::Vector3d from = road.Surface(s, right).p_W, to = road.Surface(s, left).p_W;
      Eigen::Vector3d beyond = (to - from).normalized() * kBeyond_m;
      lines.push_back({from - beyond, to + beyond});
    }
  }
}

}  // namespace rodeira::scene
