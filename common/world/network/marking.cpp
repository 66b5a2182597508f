// SPDX-License-Identifier: Apache-2.0
#include "common/world/network/marking.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

namespace rodeira::network {
namespace {

constexpr double kMinMarking_m = 1e-3;

bool PaintsNothing(const std::string& type) {
  return type.empty() || type == "none" || type == "curb" || type == "edge" || type == "grass";
}

// Lines from the mark's type alone.
void AddByType(const RoadMark& mark, const Marking& edge, std::vector<Marking>& markings) {
  std::istringstream words(mark.type);
  std::vector<std::string> kinds;
  for (std::string word; words >> word;) kinds.push_back(word);
  if (kinds.size() == 2 && kinds[0] == "botts") kinds = {"dots"};
  const double count = static_cast<double>(kinds.size());
  // Inner lines first: those of a right lane lie to the left.
  const double outward = edge.lane > 0 ? 1.0 : -1.0;
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    Marking line = edge;
    line.t_offset_m = outward * (static_cast<double>(k) - 0.5 * (count - 1.0)) * (line.width_m + kBetween_m);
    if (kinds[k] == "broken") line.stroke_m = kStroke_m, line.gap_m = kGap_m;
    if (kinds[k] == "dots") line.stroke_m = kDot_m, line.gap_m = kDotGap_m, line.width_m = kDot_m;
    markings.push_back(line);
  }
}

void AddMark(const RoadMark& mark, const Marking& edge, std::vector<Marking>& markings) {
  if (mark.lines.empty() && mark.explicit_lines.empty()) return AddByType(mark, edge, markings);
  const auto add = [&](const MarkLine& said) {
    Marking line = edge;
    line.t_offset_m = said.t_offset_m;
    if (said.width_m > 0.0) line.width_m = said.width_m;
    if (!said.colour.empty()) line.colour = said.colour;
    return line;
  };
  for (const MarkLine& said : mark.lines) {
    Marking line = add(said);
    if (said.space_m > 0.0 && said.length_m > 0.0) line.stroke_m = said.length_m, line.gap_m = said.space_m;
    line.first_m = said.s_offset_m;
    markings.push_back(line);
  }
  for (const MarkLine& said : mark.explicit_lines) {
    Marking line = add(said);
    line.from_s_m = edge.from_s_m + said.s_offset_m;
    line.to_s_m = std::min(edge.to_s_m, line.from_s_m + said.length_m);
    markings.push_back(line);
  }
}

void AddLane(const LaneSection& section, const Lane& lane, std::uint32_t number, std::vector<Marking>& markings) {
  for (std::size_t i = 0; i < lane.marks.size(); ++i) {
    const RoadMark& mark = lane.marks[i];
    if (PaintsNothing(mark.type)) continue;
    Marking edge;
    edge.section = number;
    edge.lane = lane.id;
    edge.sway = mark.sway.empty() ? nullptr : &mark.sway;
    edge.from_s_m = std::max(mark.s_m, section.s_m);
    edge.to_s_m = i + 1 < lane.marks.size() ? std::min(lane.marks[i + 1].s_m, section.end_s_m) : section.end_s_m;
    edge.width_m = mark.width_m > 0.0 ? mark.width_m : mark.weight == "bold" ? kBoldWidth_m : kStandardWidth_m;
    edge.colour = mark.colour;
    AddMark(mark, edge, markings);
  }
}

// Dashes without a place of their own go on from the record before.
void Continue(const Road& road, std::vector<Marking>& markings) {
  for (std::size_t i = 0; i < markings.size(); ++i) {
    Marking& line = markings[i];
    if (line.gap_m <= 0.0 || line.first_m != 0.0 || line.painted != nullptr) continue;
    for (std::size_t j = i; j-- > 0;) {
      const Marking& before = markings[j];
      if (before.section + 1 < line.section) break;
      const bool same = before.lane == line.lane && before.to_s_m == line.from_s_m &&
                        before.stroke_m == line.stroke_m && before.gap_m == line.gap_m &&
                        before.t_offset_m == line.t_offset_m && before.width_m == line.width_m;
      if (!same) continue;
      const double period = line.stroke_m + line.gap_m;
      const double into =
          std::fmod(MarkingLength(road, before, before.from_s_m, before.to_s_m) - before.first_m, period);
      line.first_m = -(into < 0.0 ? into + period : into);
      break;
    }
  }
}

// The line's length a metre of s.
double MarkingLengthRate(const Road& road, const Marking& marking, double s_m) {
  const geometry::CubicPoint t = MarkingAt(road, marking, s_m);
  return std::hypot(1.0 - road.axis().Evaluate(s_m).curvature_1pm * t.value, t.slope);
}

}  // namespace

std::vector<Marking> MarkingsOf(const Road& road) {
  std::vector<Marking> markings;
  const RoadSpec& spec = road.spec();
  for (std::uint32_t number = 0; number < spec.sections.size(); ++number) {
    const LaneSection& section = spec.sections[number];
    for (std::size_t i = section.right.size(); i-- > 0;) AddLane(section, section.right[i], number, markings);
    AddLane(section, section.centre, number, markings);
    for (const Lane& lane : section.left) AddLane(section, lane, number, markings);
  }
  for (Marking& line : markings) {
    line.to_s_m = std::min(line.to_s_m, road.length_m());
    line.from_s_m = std::max(line.from_s_m, 0.0);
  }
  Continue(road, markings);
  for (const PaintedLine& painted : spec.lines) {
    Marking line;
    line.painted = &painted;
    line.from_s_m = std::max(painted.from_s_m, 0.0);
    line.to_s_m = std::min(painted.to_s_m, road.length_m());
    line.width_m = painted.width_m;
    if (painted.gap_m > 0.0) line.stroke_m = painted.stroke_m, line.gap_m = painted.gap_m;
    line.colour = painted.colour;
    markings.push_back(line);
  }
  std::erase_if(markings, [](const Marking& line) {
    return line.to_s_m - line.from_s_m < kMinMarking_m || !(line.width_m > 0.0);
  });
  return markings;
}

geometry::CubicPoint MarkingAt(const Road& road, const Marking& marking, double s_m) {
  if (marking.painted != nullptr) return marking.painted->t.Evaluate(s_m);
  const double s = road.Held(marking.section, s_m);
  geometry::CubicPoint t = road.CentreAt(s);
  if (const auto span = road.SpanAt(marking.section, marking.lane, s)) t = {span->outer_t_m, span->outer_slope, 0.0};
  t.value += marking.t_offset_m;
  if (marking.sway != nullptr) {
    const geometry::CubicPoint sway = marking.sway->Evaluate(s);
    t.value += sway.value;
    t.slope += sway.slope;
  }
  return t;
}

double MarkingLength(const Road& road, const Marking& marking, double from_s_m, double to_s_m) {
  // Gauss-Legendre with three nodes on pieces of at most 2 m.
  constexpr std::array<double, 3> kNodes = {-0.7745966692414834, 0.0, 0.7745966692414834},
                                  kWeights = {5.0 / 9.0, 8.0 / 9.0, 5.0 / 9.0};
  const int pieces = std::max(1, static_cast<int>(std::ceil(std::fabs(to_s_m - from_s_m) / 2.0)));
  const double half = 0.5 * (to_s_m - from_s_m) / pieces;
  double length = 0.0;
  for (int i = 0; i < pieces; ++i) {
    const double middle = from_s_m + (2.0 * i + 1.0) * half;
    for (std::size_t k = 0; k < 3; ++k)
      length += half * kWeights[k] * MarkingLengthRate(road, marking, middle + half * kNodes[k]);
  }
  return length;
}

std::vector<Stroke> StrokesOf(const Road& road, const Marking& marking) {
  if (marking.painted != nullptr) return Strokes(road, *marking.painted);
  if (marking.gap_m <= 0.0) return {{marking.from_s_m, marking.to_s_m}};
  const double period = marking.stroke_m + marking.gap_m;
  std::vector<Stroke> strokes;
  // Goes on along the line by a length; past its end it stays there. Newton's steps may come to no end where the line
  // folds or its curvature jumps: then it goes on by as much of s.
  constexpr int kMaxSteps = 100;
  double s = marking.from_s_m;
  const double end = marking.to_s_m + 1e-3;
  const auto advance = [&](double length) {
    double next = s, left = length;
    int turn = 0;
    for (; turn < kMaxSteps && std::fabs(left) > 1e-9 && !(next > marking.to_s_m); ++turn) {
      const double step = left / std::max(MarkingLengthRate(road, marking, next), 1e-3);
      const double to = std::max(s, std::min(next + step, end));
      left -= MarkingLength(road, marking, next, to);
      next = to;
    }
    s = turn < kMaxSteps ? next : std::min(s + length, end);
  };
  double first = std::fmod(marking.first_m, period);
  if (first > 0.0 && marking.first_m < 0.0) first -= period;
  double painted = marking.stroke_m;
  if (first < 0.0)
    painted = first + marking.stroke_m;  // a stroke, or a gap, that began before
  else
    advance(first);
  while (s < marking.to_s_m) {
    const double from = s;
    if (painted > 0.0) {
      advance(painted);
      const double to = std::min(s, marking.to_s_m);
      if (to - from > kMinMarking_m) strokes.push_back({from, to});
      advance(marking.gap_m);
    } else {
      advance(marking.gap_m + painted);
    }
    painted = marking.stroke_m;
  }
  return strokes;
}

}  // namespace rodeira::network
