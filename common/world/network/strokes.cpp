// SPDX-License-Identifier: Apache-2.0
#include "common/world/network/strokes.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace rodeira::network {
namespace {

constexpr double kIntegrationStep_m = 2.0;  // between the ends of two applications of the rule

// How long the line grows over a metre of s: a point at t of an axis with curvature k goes 1 - k t ahead and t' across.
double PaintedLengthRate(const Road& road, const PaintedLine& line, double s_m) {
  const geometry::CubicPoint t = line.t.Evaluate(s_m);
  const double ahead = 1.0 - road.axis().Evaluate(s_m).curvature_1pm * t.value;
  return std::sqrt(ahead * ahead + t.slope * t.slope);
}

// The line's length between two stations, by the Gauss-Legendre rule of 4 nodes.
double Length(const Road& road, const PaintedLine& line, double from_s_m, double to_s_m) {
  constexpr std::array<double, 2> kNodes = {0.33998104358485626480, 0.86113631159405257522};
  constexpr std::array<double, 2> kWeights = {0.65214515486254614263, 0.34785484513745385737};
  const double middle = 0.5 * (from_s_m + to_s_m), half = 0.5 * (to_s_m - from_s_m);
  double sum = 0.0;
  for (std::size_t i = 0; i < 2; ++i) {
    sum += kWeights[i] * (PaintedLengthRate(road, line, middle - half * kNodes[i]) +
                          PaintedLengthRate(road, line, middle + half * kNodes[i]));
  }
  return half * sum;
}

// Where the rule may not look across: the joints of the axis and of the line's own cubics.
std::vector<double> Joints(const Road& road, const PaintedLine& line, double from_s_m, double to_s_m) {
  std::vector<double> joints{from_s_m, to_s_m};
  for (const geometry::PlanElement& element : road.axis().elements()) joints.push_back(element.s_m);
  for (const geometry::Cubic& cubic : line.t.records()) joints.push_back(cubic.from);
  std::erase_if(joints, [&](double s) { return s < from_s_m || s > to_s_m; });
  std::sort(joints.begin(), joints.end());
  joints.erase(std::unique(joints.begin(), joints.end()), joints.end());
  return joints;
}

}  // namespace

std::vector<Stroke> Strokes(const Road& road, const PaintedLine& line) {
  const double from = std::max(line.from_s_m, 0.0), to = std::min(line.to_s_m, road.length_m());
  if (!(from < to)) return {};
  if (!(line.gap_m > 0.0)) return {{from, to}};
  std::vector<Stroke> strokes;
  double length = 0.0, next = line.stroke_m;  // of the line so far; where the paint begins or ends next
  bool painting = true;
  double begin = from;
  const std::vector<double> joints = Joints(road, line, from, to);
  for (std::size_t joint = 1; joint < joints.size(); ++joint) {
    const double whole = joints[joint] - joints[joint - 1];
    const double count = std::ceil(whole / kIntegrationStep_m);
    for (double k = 0.0; k < count; k += 1.0) {
      const double low = joints[joint - 1] + whole * k / count, high = joints[joint - 1] + whole * (k + 1.0) / count;
      const double grown = Length(road, line, low, high);
      while (length + grown > next) {
        double s = low + (high - low) * (next - length) / grown;
        for (int i = 0; i < 3; ++i)
          s += (next - length - Length(road, line, low, s)) / PaintedLengthRate(road, line, s);
        s = std::clamp(s, low, high);
        if (painting) strokes.push_back({begin, s});
        begin = s;
        painting = !painting;
        next += painting ? line.stroke_m : line.gap_m;
      }
      length += grown;
    }
  }
  if (painting && begin < to) strokes.push_back({begin, to});
  return strokes;
}

}  // namespace rodeira::network
