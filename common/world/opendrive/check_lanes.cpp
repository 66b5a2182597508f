// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "common/world/network/meeting.hpp"
#include "common/world/opendrive/checks.hpp"
#include "common/world/opendrive/repair_lanes.hpp"

namespace rodeira::opendrive {
namespace {

using network::End;
using network::Lane;
using network::LaneEnd;
using network::LaneKey;
using network::Network;
using network::Road;

constexpr double kListed_m = 0.01;     // ASAM's own limit between two lanes
constexpr double kLaneWidth_m = 1.0;   // narrower, a lane ends beside another one
constexpr double kFarAside_m = 100.0;  // reference lines farther apart have no lanes that meet

struct LaneChecker {
  const Network& network;
  std::span<const RoadLines> lines;
  const Tolerance& tolerance;
  Findings& findings;
  bool ground_is_wrong = false;  // of a junction
  LaneRepairs repairs{network, lines, *findings.source};

  double StationOf(const LaneKey& key, End end) const {
    const network::LaneSection& section = network.Section(key);
    return network.roads()[key.road].Held(key.section, end == End::kStart ? section.s_m : section.end_s_m);
  }

  Finding At(const LaneKey& key, End end, std::string rule, std::string message, Repair repair = {}) const {
    return {std::move(rule),
            std::move(message),
            lines[key.road].sections[key.section],
            network.roads()[key.road].id(),
            key.lane,
            StationOf(key, end),
            std::move(repair)};
  }

  // The section that a lane's links at one end mean; nothing where it is a junction or there is none.
  struct Target {
    std::uint32_t road, section;
    End end;
  };
  std::optional<Target> TargetOf(const LaneKey& key, End end) const {
    const Road& road = network.roads()[key.road];
    const auto count = road.spec().sections.size();
    if (end == End::kEnd && key.section + 1 < count) return Target{key.road, key.section + 1, End::kStart};
    if (end == End::kStart && key.section > 0) return Target{key.road, key.section - 1, End::kEnd};
    const auto& link = end == End::kEnd ? road.spec().successor : road.spec().predecessor;
    if (!link || link->junction) return std::nullopt;
    const auto other = network.FindRoad(link->id);
    if (!other) return std::nullopt;
    return Target{*other, network::SectionMet(*link, network.roads()[*other].spec()), link->contact};
  }

  void Links(const LaneKey& key, End end) const {
    const Lane& lane = *network.Find(key);
    const std::vector<int>& targets = end == End::kEnd ? lane.successors : lane.predecessors;
    const auto target = TargetOf(key, end);
    const char* word = end == End::kEnd ? "successor" : "predecessor";
    for (const int id : targets) {
      if (!target) continue;
      const LaneKey other{target->road, target->section, id};
      const Lane* found = network.Find(other);
      if (found == nullptr) {
        findings.errors.push_back(At(key, end, "road.lane.link.lanes_across_lane_sections",
                                     fmt::format("the lane's {} is lane {} of road {}, which has no such lane there",
                                                 word, id, network.roads()[target->road].id()),
                                     repairs.DropLink(key, end, id)));
        continue;
      }
      if (id == 0) continue;
      const auto& own_link =
          end == End::kEnd ? network.roads()[key.road].spec().successor : network.roads()[key.road].spec().predecessor;
      if (target->road != key.road && own_link && own_link->s_m)
        continue;  // in its middle the other road goes on as if nothing were there
      // In a junction the other road's lane does not say where it goes.
      const auto& road_link = target->end == End::kEnd ? network.roads()[target->road].spec().successor
                                                       : network.roads()[target->road].spec().predecessor;
      const bool inner = target->road == key.road && target->section != key.section;
      if (!inner && road_link && road_link->junction) continue;
      const std::vector<int>& back = target->end == End::kEnd ? found->successors : found->predecessors;
      if (std::find(back.begin(), back.end(), key.lane) == back.end()) {
        findings.warnings.push_back(
            At(key, end, "road.lane.link.lanes_across_lane_sections",
               fmt::format("the lane's {} is lane {} of road {}, which does not say so; both directions were expected",
                           word, id, network.roads()[target->road].id())));
      }
    }
  }

  // What a lane says of its neighbours on other roads.
  void Beside(const LaneKey& key) const {
    const Lane& lane = *network.Find(key);
    for (const bool left : {true, false}) {
      const auto& name = left ? lane.left_beside : lane.right_beside;
      if (!name || (left ? network.SharingLeft(key) : network.SharingRight(key))) continue;
      const auto road = network.FindRoad(name->road);
      const auto has = [&](const network::LaneSection& on) { return on.Find(name->lane) != nullptr; };
      const bool is_there = road && std::any_of(network.roads()[*road].spec().sections.begin(),
                                                network.roads()[*road].spec().sections.end(), has);
      findings.warnings.push_back(
          At(key, End::kStart, "rodeira.beside",
             fmt::format("beside it on the {} is said to be lane {} of road {}, which {}: no vehicle changes to it",
                         left ? "left" : "right", name->lane, name->road,
                         is_there ? "does not say so" : "is not in the file")));
    }
  }

  // Where two lanes meet, edge meets edge.
  void Gap(const LaneKey& key, End end, const LaneEnd& other) const {
    const Lane &lane = *network.Find(key), &met = *network.Find(other.lane);
    if (!network::IsDrivable(lane.type) || !network::IsDrivable(met.type)) return;
    const Road &road = network.roads()[key.road], &other_road = network.roads()[other.lane.road];
    const network::LaneMeeting meeting = network::MeetingOf(
        {&road, key.section, key.lane, end}, {&other_road, other.lane.section, other.lane.lane, other.end});
    double gap = meeting.gap_m;
    // A lane that splits into several, or several that become one, meet with their outer edges.
    if (gap > kListed_m) gap = std::min({gap, GapTogether({key, end}, other), GapTogether(other, {key, end})});
    Finding finding =
        At(key, end, "lane_smoothness.contact_point_no_horizontal_gaps",
           fmt::format("a gap of {:.4g} m between the lane's edges and those of lane {} of road {}; {}", gap,
                       other.lane.lane, other_road.id(), GapWords(gap, LaneGap(tolerance), kListed_m, "m")));
    if (gap > LaneGap(tolerance)) {
      finding.repair = repairs.GapRepair({key, end}, other);
      findings.errors.push_back(finding);
    } else if (gap > kListed_m) {
      findings.warnings.push_back(finding);
    }
    // What the reference lines' heights do is told with the roads.
    const bool lines_meet = road.spec().junction.empty() && other_road.spec().junction.empty();
    const double step = meeting.step_m - (lines_meet ? AxisStep(key, end, other) : 0.0);
    // A junction's own grid of heights is as high as it says; how it goes over into its roads is told, never refused.
    // One that is wrong is told for itself, and leaves its roads without their heights.
    const bool on_grid = road.spec().ground != nullptr || other_road.spec().ground != nullptr || ground_is_wrong;
    const double most = on_grid ? std::numeric_limits<double>::infinity() : StepMost(tolerance, kListed_m);
    JudgeStep(At(key, end, "lane_smoothness.contact_point_no_vertical_gaps",
                 fmt::format("a step of {:.4g} m between the lane's edges and those of lane {} of road {}; {}",
                             meeting.step_m, other.lane.lane, other_road.id(), StepWords(step, most))),
              step, most, findings);
  }

  // Between a lane's end and all the lanes of the other one's section that it goes on into.
  double GapTogether(const LaneEnd& from, const LaneEnd& other) const {
    std::vector<LaneEnd> all;
    for (const LaneEnd& end : from.end == End::kEnd ? network.AtEnd(from.lane) : network.AtStart(from.lane)) {
      if (end.lane.road == other.lane.road && end.lane.section == other.lane.section && end.end == other.end)
        all.push_back(end);
    }
    return all.size() < 2 ? std::numeric_limits<double>::infinity() : repairs.GapToAll(from, all);
  }

  double AxisStep(const LaneKey& key, End end, const LaneEnd& other) const {
    const auto height = [&](const LaneKey& of, End at) {
      return network.roads()[of.road].spec().elevation.Value(StationOf(of, at));
    };
    return std::fabs(height(key, end) - height(other.lane, other.end));
  }

  // A lane that goes on nowhere in a junction, in its road's middle or where its road goes on: it goes on as the only
  // lane that lies there; otherwise it is told where traffic is led onto it in a junction or in its road's middle.
  void DeadEnd(const LaneKey& key) const {
    const Lane& lane = *network.Find(key);
    if (!network::IsDrivable(lane.type) || lane.direction == 0 || lane.traffic_ends) return;
    if (!network.Successors(key).empty()) return;
    const End end = lane.direction < 0 ? End::kStart : End::kEnd;
    if (network.Span(key, StationOf(key, end))->width_m() < kLaneWidth_m) return;
    const auto target = TargetOf(key, end);
    const network::RoadSpec& road = network.roads()[key.road].spec();
    const bool in_junction = !road.junction.empty(),
               in_middle = target && target->road == key.road && target->section != key.section;
    if (!target && !in_junction) return;
    // A way off a road's middle may end where nothing is drawn, as in a yard.
    const auto junction = network.FindJunction(road.junction);
    const bool has_link = (end == End::kEnd ? road.successor : road.predecessor).has_value();
    if (junction && network.junctions()[*junction].type == "virtual" && !has_link) return;
    const bool is_led_onto = !network.Predecessors(key).empty();
    Finding finding = At(key, end, std::string(kDeadEndRule),
                         is_led_onto ? "traffic is led onto the lane, and it goes on nowhere"
                                     : "the lane goes on nowhere, and another one begins there");
    const auto next = target || !has_link ? NextOf({key, end}, target) : std::nullopt;
    // Where traffic is not led onto it, both lanes miss the link.
    if (!is_led_onto && !(next && network.Predecessors(next->lane).empty())) return;
    if (next && tolerance.repair) {
      finding.repair = repairs.FindLink({key, end}, *next);
      findings.errors.push_back(std::move(finding));
    } else if (is_led_onto && (next || in_junction || in_middle)) {
      findings.warnings.push_back(std::move(finding));
    }
  }

  // The one lane that lies at a lane's end without a gap: of the section that its road goes on into, at the other end
  // of that road, or of any road that ends there where its own road does not say where it goes on.
  std::optional<LaneEnd> NextOf(const LaneEnd& from, const std::optional<Target>& target) const {
    std::vector<LaneEnd> lying;
    if (target) {
      LanesAt(from, *target, lying);
      const auto& link = from.end == End::kEnd ? network.roads()[from.lane.road].spec().successor
                                               : network.roads()[from.lane.road].spec().predecessor;
      if (lying.empty() && target->road != from.lane.road && link && !link->s_m)
        LanesAt(from, EndOf(target->road, target->end == End::kEnd ? End::kStart : End::kEnd), lying);
    } else {
      for (std::uint32_t road = 0; road < network.roads().size(); ++road) {
        if (road == from.lane.road || network.roads()[road].spec().junction == JunctionOf(from)) continue;
        for (const End end : {End::kStart, End::kEnd}) LanesAt(from, EndOf(road, end), lying);
      }
    }
    return lying.size() == 1 ? std::optional(lying.front()) : std::nullopt;
  }

  const std::string& JunctionOf(const LaneEnd& end) const { return network.roads()[end.lane.road].spec().junction; }
  Target EndOf(std::uint32_t road, End end) const {
    const auto last = static_cast<std::uint32_t>(network.roads()[road].spec().sections.size()) - 1;
    return {road, end == End::kEnd ? last : 0, end};
  }

  void LanesAt(const LaneEnd& from, const Target& target, std::vector<LaneEnd>& lying) const {
    const Road &road = network.roads()[from.lane.road], &other = network.roads()[target.road];
    const auto plan = [](const Road& of, double s_m) { return of.axis().Evaluate(s_m).p_W; };
    const network::LaneSection& section = other.spec().sections[target.section];
    const double s_m = target.end == End::kStart ? section.s_m : section.end_s_m;
    if ((plan(road, StationOf(from.lane, from.end)) - plan(other, s_m)).norm() > kFarAside_m) return;
    for (const auto* side : {&section.left, &section.right}) {
      for (const Lane& lane : *side) {
        const LaneEnd to{{target.road, target.section, lane.id}, target.end};
        if (!network::IsDrivable(lane.type) || !repairs.LeadOn(from, to) ||
            network.Span(to.lane, StationOf(to.lane, to.end))->width_m() < kLaneWidth_m)
          continue;
        const network::LaneMeeting meeting = network::MeetingOf({&road, from.lane.section, from.lane.lane, from.end},
                                                                {&other, target.section, lane.id, target.end});
        if (meeting.gap_m <= kFound_m && repairs.PassingOf(from, to).drivable) lying.push_back(to);
      }
    }
  }

  void JunctionLanes() const {
    for (const network::Junction& junction : network.junctions()) {
      for (const network::JunctionConnection& connection : junction.connections) {
        const auto connecting = network.FindRoad(connection.connecting_road),
                   incoming = network.FindRoad(connection.incoming_road);
        if (!connecting || !incoming) continue;
        const auto& sections = network.roads()[*connecting].spec().sections;
        const auto section = connection.contact == End::kStart ? 0u : static_cast<std::uint32_t>(sections.size()) - 1;
        for (const network::JunctionLaneLink& link : connection.lane_links) {
          const LaneKey to{*connecting, section, link.to};
          if (network.Find(to) == nullptr) {
            findings.errors.push_back(
                At(to, connection.contact, "junctions.connection.lane_link",
                   fmt::format("connection {} of junction {} leads to this lane, which the road does not have there",
                               connection.id, junction.id),
                   repairs.DropLaneLink(connection, link)));
          }
          const auto has = [&](const network::LaneSection& on) { return on.Find(link.from) != nullptr; };
          const auto& from = network.roads()[*incoming].spec().sections;
          if (std::any_of(from.begin(), from.end(), has)) continue;
          findings.errors.push_back(
              At({*incoming, 0, link.from}, End::kStart, "junctions.connection.lane_link",
                 fmt::format("connection {} of junction {} comes from this lane, which the road does not have",
                             connection.id, junction.id),
                 repairs.DropLaneLink(connection, link)));
        }
      }
    }
  }
};

}  // namespace

double LaneGap(const Tolerance& tolerance) { return tolerance.strict ? kListed_m : tolerance.gap_m; }

void CheckLaneLinks(const Network& network, std::span<const RoadLines> lines, const Tolerance& tolerance,
                    Findings& findings) {
  const bool ground_is_wrong = std::any_of(findings.errors.begin(), findings.errors.end(), [](const Finding& error) {
    return error.rule.starts_with("junctions.elevation_grid") || error.rule.starts_with("junctions.boundary");
  });
  const LaneChecker checker{network, lines, tolerance, findings, ground_is_wrong};
  for (const LaneKey& key : network.Lanes()) {
    checker.Beside(key);
    for (const End end : {End::kStart, End::kEnd}) {
      checker.Links(key, end);
      for (const LaneEnd& other : end == End::kEnd ? network.AtEnd(key) : network.AtStart(key)) {
        if (LaneEnd{key, end} < other) checker.Gap(key, end, other);
      }
    }
  }
  checker.JunctionLanes();
  for (const LaneKey& key : network.Lanes()) checker.DeadEnd(key);
}

}  // namespace rodeira::opendrive
