// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/network/outline.hpp"

#include <algorithm>

namespace rodeira::traffic {

Outline::Outline(const lanes::Graph& graph, const lanes::LargestCar& car)
    : graph_(graph), car_(car), swings_(graph.tracks().size()) {}

double Outline::FootOf(const Path& path, const Eigen::Vector2d& p_W, double near_m) const {
  const PathFrame frame = FrameAt(graph_, path, near_m);
  return near_m + frame.ahead_W.dot(p_W - frame.p_W.head<2>()) / frame.stretch;
}

void Outline::Note(const Path& path, const Eigen::Vector2d& middle_W, const Eigen::Vector2d& ahead_W, double o_m,
                   int points) {
  const Eigen::Vector2d left_W(-ahead_W.y(), ahead_W.x());
  const double half = 0.5 * car_.length_m;
  for (int i = 0; i <= points; ++i) {
    const double x = -half + car_.length_m * i / points;
    for (const double side : {-0.5, 0.5}) {
      const Eigen::Vector2d p_W = middle_W + x * ahead_W + side * car_.width_m * left_W;
      double at = o_m + x;
      for (int turn = 0; turn < 3; ++turn) at = std::clamp(FootOf(path, p_W, at), o_m - half, o_m + half);
      const PathFrame frame = FrameAt(graph_, path, at);
      const double offset = (p_W - frame.p_W.head<2>()).dot(Eigen::Vector2d(-frame.ahead_W.y(), frame.ahead_W.x()));
      for (const Piece& piece : path) Note(piece.track, at - piece.zero_m, offset);
    }
  }
}

void Outline::Note(std::uint32_t track, double d_m, double offset_m) {
  const auto& nodes = graph_[track].curve.nodes();
  constexpr double kBeside_m = 0.75;
  if (d_m < -kBeside_m || d_m > graph_[track].length_m() + kBeside_m) return;
  std::vector<lanes::Swing>& swings = swings_[track];
  if (swings.empty()) swings.resize(nodes.size());
  auto node = std::lower_bound(nodes.begin(), nodes.end(), d_m - kBeside_m,
                               [](const lanes::Curve::Node& at, double d) { return at.d_m < d; });
  for (; node != nodes.end() && node->d_m <= d_m + kBeside_m; ++node) {
    const auto i = static_cast<std::size_t>(node - nodes.begin());
    swings[i].left_m = std::max(swings[i].left_m, offset_m);
    swings[i].right_m = std::max(swings[i].right_m, -offset_m);
  }
}

void Outline::DropWhatCurvaturesSay(double margin_m) {
  for (std::uint32_t track = 0; track < swings_.size(); ++track) {
    std::vector<lanes::Swing>& swings = swings_[track];
    bool any = false;
    for (std::size_t i = 0; i < swings.size(); ++i) {
      const double known = lanes::HalfSwath_m(graph_[track].curve.nodes()[i].curvature_1pm, car_) + margin_m;
      for (double* side : {&swings[i].left_m, &swings[i].right_m}) *side = *side > known ? *side : 0.0;
      any = any || swings[i].left_m > 0.0 || swings[i].right_m > 0.0;
    }
    if (!any) swings.clear();
  }
}

}  // namespace rodeira::traffic
