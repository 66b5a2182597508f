// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/check/corridors.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/geometry/plane.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kBend_m = 0.25;       // at most from a chord to the middle that it stands for
constexpr double kMargin_m = 0.03;     // beside a lane's edge
constexpr double kEnd_m = 0.01;        // inside of a lane's ends: there the network may find another road
constexpr double kBow_m2 = 0.15;       // times the curvature: beside a lane's edge, for the arc between two nodes
constexpr double kChordRise_m = 0.2;   // at most from a chord to the middle's height
constexpr double kSlant_m = 0.3;       // at most between the height of the middle and that of the edge
constexpr double kAhead_m = 6.0;       // that a vehicle drives at most from one look to the next, usually
constexpr std::size_t kMaxNodes = 64;  // of a bend's chord

// How far the line of traffic of a lane that opens or ends may lie beside its middle (lanes::Curve).
double AsideOfMiddle_m(double width_m) {
  constexpr double kWide_m = 3.0, kInside_m = 1.25;
  const double lack = std::max(0.0, 1.0 - width_m / kWide_m);
  return kInside_m * lack * lack;
}

}  // namespace

Corridors::Corridors(const lanes::Graph& graph) : graph_(graph), ranges_(graph.tracks().size()) {}

Corridor Corridors::Between(const lanes::Curve& curve, std::size_t from, std::size_t to) const {
  const lanes::Curve::Node &a = curve.nodes()[from], &b = curve.nodes()[to];
  Corridor made;
  made.from_W = a.p_W.head<2>();
  const Eigen::Vector2d chord_W = b.p_W.head<2>() - made.from_W;
  made.length_m = chord_W.norm();
  if (made.length_m < 1e-6) return made;
  made.ahead_W = chord_W / made.length_m;
  made.z_m = a.p_W.z(), made.grade = (b.p_W.z() - a.p_W.z()) / made.length_m;
  double half = 1e9, aside = 0.0;
  for (std::size_t i = from; i <= to; ++i) {
    const lanes::Curve::Node& node = curve.nodes()[i];
    const Eigen::Vector2d d_W = node.p_W.head<2>() - made.from_W;
    const double off = std::fabs(geometry::Cross(made.ahead_W, d_W)),
                 rise = node.p_W.z() - made.z_m - made.grade * made.ahead_W.dot(d_W);
    if (off > kBend_m || std::fabs(rise) > kChordRise_m || std::fabs(node.bank) * 0.5 * node.width_m > kSlant_m)
      return made;
    aside = std::max(aside, off + kBow_m2 * std::fabs(node.curvature_1pm));
    half = std::min(half, 0.5 * node.width_m / std::sqrt(1.0 + node.bank * node.bank) - AsideOfMiddle_m(node.width_m));
  }
  made.half_m = half - aside - kMargin_m;
  return made;
}

void Corridors::Make(std::uint32_t track) {
  const lanes::Curve& curve = graph_[track].curve;
  const auto add = [&](std::size_t from, std::size_t to, Corridor made) {
    if (from == 0) made.from_W += kEnd_m * made.ahead_W, made.z_m += kEnd_m * made.grade, made.length_m -= kEnd_m;
    if (to + 1 == curve.nodes().size()) made.length_m -= kEnd_m;
    corridors_.push_back(made);
    tracks_.push_back(track);
    begins_d_m_.push_back(curve.nodes()[from].d_m);
  };
  ranges_[track].first = static_cast<std::uint32_t>(corridors_.size());
  const std::size_t last = curve.nodes().size() - 1;
  std::size_t from = 0;
  if (curve.straight()) {
    const Corridor whole = Between(curve, 0, last);
    if (whole.half_m > 0.0) add(0, last, whole), from = last;
  }
  while (from < last) {
    std::size_t to = from + 1;
    Corridor best = Between(curve, from, to);
    while (to < last && to - from < kMaxNodes) {
      const Corridor longer = Between(curve, from, to + 1);
      if (longer.half_m < best.half_m - kBend_m || longer.half_m < 0.0) break;
      best = longer, ++to;
    }
    add(from, to, best);
    // They overlap by a half, so that most vehicles are in one of them as a whole.
    from = to < last ? std::max(from + 1, (from + to) / 2) : to;
  }
  ranges_[track].end = static_cast<std::uint32_t>(corridors_.size());
  around_.resize(corridors_.size());
}

Corridors::Range Corridors::RangeOf(std::uint32_t track) {
  if (ranges_[track].first == kNone) Make(track);
  return ranges_[track];
}

std::uint32_t Corridors::At(std::uint32_t track, double d_m) {
  const Range range = RangeOf(track);
  const auto begin = begins_d_m_.begin() + range.first, end = begins_d_m_.begin() + range.end;
  const auto behind = std::upper_bound(begin + 1, end, d_m);
  return static_cast<std::uint32_t>(behind - begins_d_m_.begin()) - 1;
}

// Those behind it on its track that begin before d, and, as far on, those of the tracks that it goes on into.
void Corridors::AddAhead(std::uint32_t index, double to_d_m, std::vector<std::uint32_t>& around) {
  const std::uint32_t track = tracks_[index];
  const std::uint32_t end = RangeOf(track).end;
  for (std::uint32_t i = index + 1; i < end && begins_d_m_[i] < to_d_m; ++i) around.push_back(i);
  const double beyond_m = to_d_m - graph_[track].length_m();
  if (beyond_m <= 0.0) return;
  for (const lanes::Link& link : graph_[track].next) {
    const std::uint32_t first = At(link.to, link.from_d_m);
    around.push_back(first);
    AddAhead(first, link.from_d_m + beyond_m, around);
  }
}

// Those of tracks that part from this one's beginning, as far on.
void Corridors::AddParting(std::uint32_t index, std::vector<std::uint32_t>& around) {
  const std::uint32_t track = tracks_[index];
  const double begin = begins_d_m_[index], end = begin + corridors_[index].length_m;
  for (const std::uint32_t before : graph_[track].before) {
    for (const lanes::Link& link : graph_[before].next) {
      if (link.to == track) continue;
      const std::uint32_t first = At(link.to, link.from_d_m + begin), last = At(link.to, link.from_d_m + end);
      for (std::uint32_t i = first; i <= last; ++i) around.push_back(i);
    }
  }
}

void Corridors::AddBeside(std::uint32_t index, std::uint32_t beside, std::vector<std::uint32_t>& around) {
  const std::uint32_t track = tracks_[index];
  const double begin = begins_d_m_[index], end = begin + corridors_[index].length_m;
  const std::uint32_t first = At(beside, graph_.Across(track, begin, beside)),
                      last = At(beside, graph_.Across(track, end, beside));
  for (std::uint32_t i = std::min(first, last); i <= std::max(first, last); ++i) around.push_back(i);
}

std::span<const std::uint32_t> Corridors::Around(std::uint32_t index) {
  if (!around_[index].empty()) return around_[index];
  const std::uint32_t track = tracks_[index];
  const lanes::Track& on = graph_[track];
  const Range range = RangeOf(track);
  std::vector<std::uint32_t> around{index};
  AddAhead(index, begins_d_m_[index] + corridors_[index].length_m + kAhead_m, around);
  if (index > range.first) {
    around.push_back(index - 1);
  } else {
    for (const std::uint32_t before : on.before) around.push_back(RangeOf(before).end - 1);
  }
  for (const auto& beside : {on.left, on.right}) {
    if (beside) AddBeside(index, *beside, around);
  }
  AddParting(index, around);
  around_[index] = std::move(around);
  return around_[index];
}

}  // namespace rodeira::traffic
