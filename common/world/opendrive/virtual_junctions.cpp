// SPDX-License-Identifier: Apache-2.0
// Roads that leave, or come onto, the middle of another one: its lane sections are cut there, so that lanes go on into
// lanes as they do anywhere.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "common/world/opendrive/checks.hpp"

namespace rodeira::opendrive {
namespace {

using network::End;
using network::Lane;
using network::LaneSection;

constexpr double kSame_m = 1e-3;  // a section's beginning, or a road's end, so near is the place that was meant

// The records that say something between two stations: the last one that begins before them, and those within.
template <class Record>
void Keep(std::vector<Record>& records, double from_s_m, double to_s_m) {
  std::erase_if(records, [&](const Record& record) { return record.s_m >= to_s_m; });
  std::size_t first = 0;
  while (first + 1 < records.size() && records[first + 1].s_m <= from_s_m) ++first;
  records.erase(records.begin(), records.begin() + static_cast<std::ptrdiff_t>(first));
}

// Lines that are painted once, counted from the mark's beginning: what of them lies behind the cut.
void CutOnce(double cut_s_m, network::RoadMark& mark) {
  const double gone = cut_s_m - mark.s_m;
  if (!(gone > 0.0)) return;
  for (network::MarkLine& line : mark.explicit_lines) {
    const double begin = std::max(0.0, line.s_offset_m - gone), end = line.s_offset_m + line.length_m - gone;
    line.s_offset_m = begin, line.length_m = end - begin;
  }
  std::erase_if(mark.explicit_lines, [](const network::MarkLine& line) { return !(line.length_m > 0.0); });
}

void Cut(Lane& before, Lane& behind, double from_s_m, double cut_s_m, double to_s_m, bool left_hand) {
  for (auto& [lane, from, to] :
       {std::tuple<Lane*, double, double>(&before, from_s_m, cut_s_m), {&behind, cut_s_m, to_s_m}}) {
    Keep(lane->marks, from, to), Keep(lane->access, from, to);
  }
  for (network::RoadMark& mark : behind.marks) CutOnce(cut_s_m, mark);
  if (before.id == 0) return;
  before.successors = {before.id}, behind.predecessors = {behind.id};
  // Vehicles begin where the traffic comes onto the lane, and end where it leaves it.
  const bool along = before.direction != 0 ? before.direction > 0 : (before.id < 0) != left_hand;
  (along ? behind : before).traffic_begins = false;
  (along ? before : behind).traffic_ends = false;
}

void CutSection(RoadReading& road, double s_m) {
  auto& sections = road.spec.sections;
  std::size_t at = 0;
  while (at + 1 < sections.size() && sections[at + 1].s_m < s_m) ++at;
  const double end = at + 1 < sections.size() ? sections[at + 1].s_m : road.spec.length_m;
  LaneSection behind = sections[at];
  LaneSection& before = sections[at];
  behind.s_m = s_m;
  Cut(before.centre, behind.centre, before.s_m, s_m, end, road.spec.left_hand);
  for (std::size_t i = 0; i < before.left.size(); ++i)
    Cut(before.left[i], behind.left[i], before.s_m, s_m, end, road.spec.left_hand);
  for (std::size_t i = 0; i < before.right.size(); ++i)
    Cut(before.right[i], behind.right[i], before.s_m, s_m, end, road.spec.left_hand);
  sections.insert(sections.begin() + static_cast<std::ptrdiff_t>(at) + 1, std::move(behind));
  road.lines.sections.insert(road.lines.sections.begin() + static_cast<std::ptrdiff_t>(at) + 1,
                             road.lines.sections[at]);
  road.lines.section_nodes.insert(road.lines.section_nodes.begin() + static_cast<std::ptrdiff_t>(at) + 1,
                                  road.lines.section_nodes[at]);
}

// The station that is meant: the beginning of one of the road's sections, after the cut if need be; or its end, and
// then the link is one to an end.
void Settle(network::RoadLink& link, RoadReading& road) {
  const double s = *link.s_m;
  if (s <= kSame_m || s >= road.spec.length_m - kSame_m) {
    link.contact = s <= kSame_m ? End::kStart : End::kEnd;
    link.s_m.reset();
    return;
  }
  for (const LaneSection& section : road.spec.sections) {
    if (std::fabs(section.s_m - s) > kSame_m) continue;
    link.s_m = section.s_m;
    return;
  }
  CutSection(road, s);
}

}  // namespace

void CutAtMiddles(std::vector<RoadReading>& roads, const std::set<std::string, std::less<>>& not_of,
                  Findings& findings) {
  std::map<std::string, std::size_t> number;
  for (std::size_t i = 0; i < roads.size(); ++i) number.emplace(roads[i].spec.id, i);
  for (RoadReading& road : roads) {
    if (not_of.contains(road.spec.id)) continue;
    for (auto* link : {&road.spec.predecessor, &road.spec.successor}) {
      if (!*link || !(*link)->s_m) continue;
      const auto other = number.find((*link)->id);
      if (other == number.end()) continue;  // told with the links
      const double s = *(*link)->s_m, length = roads[other->second].spec.length_m;
      if (s >= -kSame_m && s <= length + kSame_m) {
        Settle(**link, roads[other->second]);
        continue;
      }
      const bool first = link == &road.spec.predecessor;
      findings.errors.push_back({"road.linkage.element_s",
                                 fmt::format("the road's {} goes on at s = {} m of road {}, which is {} m long",
                                             first ? "start" : "end", s, (*link)->id, length),
                                 road.lines.road,
                                 road.spec.id,
                                 std::nullopt,
                                 first ? 0.0 : road.spec.length_m,
                                 {RepairKind::kRoadEnded, "the road ends there"}});
      link->reset();
    }
  }
}

}  // namespace rodeira::opendrive
