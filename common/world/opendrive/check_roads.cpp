// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>
#include <map>
#include <utility>

#include "common/core/base/suggest.hpp"
#include "common/core/geometry/angle.hpp"
#include "common/world/network/meeting.hpp"
#include "common/world/opendrive/checks.hpp"
#include "common/world/opendrive/repair_lanes.hpp"
#include "common/world/opendrive/twin_roads.hpp"

namespace rodeira::opendrive {
namespace {

using network::End;
using network::Network;
using network::Road;

constexpr const char* kByLanes = "each lane goes on as its own links say";
constexpr double kGapRounding_m = 1e-6;  // what ASAM's checker passes is not worth a word
constexpr double kTurned_rad = 1e-6;
constexpr double kMinHeightStep_m = 1e-3;  // smaller steps come from the digits of files

std::string_view Name(End end) { return end == End::kStart ? "start" : "end"; }
double StationOf(const Road& road, End end) { return end == End::kStart ? 0.0 : road.length_m(); }

const std::optional<network::RoadLink>& LinkOf(const Road& road, End end) {
  return end == End::kStart ? road.spec().predecessor : road.spec().successor;
}

struct RoadChecker {
  const Network& network;
  std::span<const RoadLines> lines;
  const Tolerance& tolerance;
  Findings& findings;

  Finding At(std::size_t road, std::string rule, std::string message, std::optional<double> s_m,
             Repair repair = {}) const {
    return {std::move(rule),  std::move(message), lines[road].road, network.roads()[road].id(), std::nullopt, s_m,
            std::move(repair)};
  }

  Node RoadNode(std::size_t road) const { return {findings.source, lines[road].node}; }

  Repair LinkRepair(std::size_t road, End end) const {
    const Node link = RoadNode(road).Child("link").Child(end == End::kStart ? "predecessor" : "successor");
    return {RepairKind::kRoadEnded, "the road ends there", {link.Remove()}};
  }

  // An error, which is read as `done` says, or a warning.
  void Judge(Finding finding, bool is_error, RepairKind kind, std::string done) const {
    if (is_error) finding.repair = {kind, std::move(done)};
    (is_error ? findings.errors : findings.warnings).push_back(std::move(finding));
  }

  std::vector<std::string> RoadNames() const {
    std::vector<std::string> names;
    for (const Road& road : network.roads()) names.push_back(road.id());
    return names;
  }

  void JunctionIds() const {
    std::map<std::string, int> count;
    for (const network::Junction& junction : network.junctions()) {
      if (++count[junction.id] == 2)
        findings.errors.push_back({"ids.id_unique_in_class",
                                   fmt::format("two junctions have the id {}", junction.id),
                                   0,
                                   "",
                                   {},
                                   {},
                                   {RepairKind::kJunctionsMerged, "the ways of both count"}});
    }
  }

  void HeightAndHeading(std::size_t index, End end, std::size_t other_index, End contact,
                        const network::RoadMeeting& meeting) const {
    const Road &road = network.roads()[index], &other = network.roads()[other_index];
    const double s = StationOf(road, end), kink = std::fabs(meeting.kink_rad);
    JudgeStep(At(index, "road.elevation.contact_point",
                 fmt::format("a step of {:.4g} m to the {} of road {}; {}", meeting.step_m, Name(contact), other.id(),
                             StepWords(meeting.step_m, StepMost(tolerance, tolerance.gap_m))),
                 s),
              meeting.step_m, StepMost(tolerance, tolerance.gap_m), findings);
    Finding finding = At(index, "road.geometry.contact_heading",
                         fmt::format("a kink of {:.4g} rad to the {} of road {}; {}", kink, Name(contact), other.id(),
                                     GapWords(kink, tolerance.kink_rad, Tolerance::Strict().kink_rad, "rad")),
                         s);
    if (kink > kTurned_rad)
      Judge(std::move(finding), kink > tolerance.kink_rad, RepairKind::kKinkDriven, "it is driven as it lies");
  }

  // A road with an end that goes on into another road.
  void RoadToRoad(std::size_t index, End end, std::size_t other_index, End contact) const {
    const Road& road = network.roads()[index];
    const Road& other = network.roads()[other_index];
    const double s = StationOf(road, end);
    const network::RoadMeeting meeting = network::MeetingOf(road, end, other, contact);
    const double gap = meeting.gap_m;
    Finding finding = At(index, "road.geometry.contact_point",
                         fmt::format("a gap of {:.4g} m to the {} of road {}; {}", gap, Name(contact), other.id(),
                                     GapWords(gap, tolerance.gap_m, Tolerance::Strict().gap_m, "m")),
                         s);
    // In and out of a junction the lanes meet, the reference lines need not.
    const bool in_junction = !road.spec().junction.empty() || !other.spec().junction.empty();
    if (gap > kGapRounding_m && !in_junction)
      Judge(finding, gap > tolerance.gap_m, RepairKind::kLinksByLanes, "lanes go on where their edges meet");
    // Of the other road's links one should lead back. A connecting road is reached by way of the junction.
    const auto& back = LinkOf(other, contact);
    const bool means_us = back && !back->junction && back->id == road.id() && back->contact == end;
    const bool told_by_other = means_us && std::pair(other_index, contact) < std::pair(index, end);
    if (!in_junction && !told_by_other) HeightAndHeading(index, end, other_index, contact, meeting);
    if (means_us || (back && back->junction)) return;
    if (back && !back->junction && back->id != road.id() && !in_junction) {
      finding.rule = "road.linkage.is_junction_needed";
      finding.message = fmt::format(
          "the {} of road {} goes on into road {}, and this road into it: a junction is needed where it is not clear "
          "which road "
          "follows",
          Name(contact), other.id(), back->id);
      Judge(finding, true, RepairKind::kLinksByLanes, kByLanes);
      return;
    }
    finding.rule = "road.linkage.both_ways";
    finding.message =
        fmt::format("this road goes on into the {} of road {}, which does not say so", Name(contact), other.id());
    findings.warnings.push_back(finding);
  }

  void Links() const {
    for (std::size_t i = 0; i < network.roads().size(); ++i) {
      const Road& road = network.roads()[i];
      for (const End end : {End::kStart, End::kEnd}) {
        const auto& link = LinkOf(road, end);
        if (!link) continue;
        const auto known = link->junction ? network.FindJunction(link->id) : network.FindRoad(link->id);
        if (known && link->s_m) {
          Middle(i, end, *known, *link);
        } else if (!known) {
          findings.errors.push_back(At(i, "road.linkage.id",
                                       fmt::format("the road's {} goes on into {} {}, which is not in the file",
                                                   Name(end), link->junction ? "junction" : "road", link->id),
                                       StationOf(road, end), LinkRepair(i, end)));
        } else if (!link->junction) {
          RoadToRoad(i, end, *known, link->contact);
        }
      }
      if (!road.spec().junction.empty() && !network.FindJunction(road.spec().junction)) {
        findings.errors.push_back(
            At(i, "junctions.id",
               fmt::format("the road belongs to junction {}, which is not in the file", road.spec().junction),
               std::nullopt,
               {RepairKind::kJunctionLeft,
                "it is read as a road outside of junctions",
                {RoadNode(i).Set("junction", "-1")}}));
      }
    }
  }

  // A connecting road that meets another one's middle points along it there; where its lanes lie is told with the
  // lanes.
  void Middle(std::size_t index, End end, std::size_t other_index, const network::RoadLink& link) const {
    const Road &road = network.roads()[index], &other = network.roads()[other_index];
    const double s = StationOf(road, end);
    const double turned = (end == End::kStart) == (link.contact == End::kEnd) ? 0.0 : geometry::kPi;
    const double kink = std::fabs(geometry::WrapAngle(road.axis().Evaluate(s).heading_rad -
                                                      other.axis().Evaluate(*link.s_m).heading_rad - turned));
    if (kink <= tolerance.kink_rad) return;
    findings.warnings.push_back(
        At(index, "junctions.virtual.heading_equal_mainroad",
           fmt::format("a kink of {:.4g} rad to road {} at its s = {} m; the same heading was expected", kink,
                       other.id(), *link.s_m),
           s));
  }

  void Ambiguous() const {
    // The roads, outside of junctions, that go on into each end.
    std::map<std::pair<std::uint32_t, End>, std::vector<std::size_t>> claims;
    for (std::size_t i = 0; i < network.roads().size(); ++i) {
      const Road& road = network.roads()[i];
      if (!road.spec().junction.empty()) continue;
      for (const End end : {End::kStart, End::kEnd}) {
        const auto& link = LinkOf(road, end);
        const auto other = link && !link->junction && !link->s_m ? network.FindRoad(link->id) : std::nullopt;
        if (other && network.roads()[*other].spec().junction.empty()) claims[{*other, link->contact}].push_back(i);
      }
    }
    for (const auto& [end, roads] : claims) {
      if (roads.size() < 2) continue;
      const Road& road = network.roads()[end.first];
      findings.errors.push_back(
          At(end.first, "road.linkage.is_junction_needed",
             fmt::format("roads {} and {} both go on into this road's {}: a junction is needed",
                         network.roads()[roads[0]].id(), network.roads()[roads[1]].id(), Name(end.second)),
             StationOf(road, end.second), {RepairKind::kLinksByLanes, kByLanes}));
    }
  }

  // A sign that is seen at another road than the one where it counts.
  void SeenAt() const {
    const std::vector<std::string> names = RoadNames();
    for (std::size_t i = 0; i < network.roads().size(); ++i) {
      for (const network::Signal& signal : network.roads()[i].spec().signals) {
        const auto* seen = std::get_if<network::SeenAtRoad>(&signal.seen);
        if (seen == nullptr || network.FindRoad(seen->road)) continue;
        findings.warnings.push_back(
            At(i, "road.signal.position",
               fmt::format(
                   "the signal '{}' stands at the road '{}', which is not in the file{}: it is drawn where it counts",
                   signal.id, seen->road, base::DidYouMean(seen->road, names)),
               signal.s_m));
      }
    }
  }

  void Junctions() const {
    const std::vector<std::string> names = RoadNames();
    const LaneRepairs repairs(network, lines, *findings.source);
    for (std::size_t number = 0; number < network.junctions().size(); ++number) {
      const network::Junction& junction = network.junctions()[number];
      for (std::size_t i = 0; i < junction.connections.size(); ++i) {
        const network::JunctionConnection& connection = junction.connections[i];
        for (const std::string* id : {&connection.incoming_road, &connection.connecting_road}) {
          if (network.FindRoad(*id) || (id->empty() && junction.type == "virtual")) continue;
          findings.errors.push_back(
              {"junctions.connection.road",
               fmt::format("connection {} of junction {} names the road '{}', which is not in the file{}",
                           connection.id, junction.id, *id, base::DidYouMean(*id, names)),
               0,
               "",
               {},
               {},
               repairs.DropConnection(number, i)});
        }
      }
    }
  }
};

}  // namespace

void JudgeStep(Finding finding, double step_m, double most_m, Findings& findings) {
  if (std::fabs(step_m) > most_m) finding.repair = {RepairKind::kStepKept, "it stays, and wheels feel it"};
  if (std::fabs(step_m) > most_m)
    findings.errors.push_back(finding);
  else if (std::fabs(step_m) > kMinHeightStep_m)
    findings.warnings.push_back(finding);
}

std::string StepWords(double step_m, double most_m) {
  if (std::fabs(step_m) > most_m) return fmt::format("at most {:.3g} m was expected", most_m);
  return std::isfinite(most_m) ? fmt::format("at most {:.3g} m is passed", most_m) : "wheels feel it";
}

void CheckRoadLinks(const Network& network, std::span<const RoadLines> lines, const Tolerance& tolerance,
                    Findings& findings) {
  const RoadChecker checker{network, lines, tolerance, findings};
  CheckTwinRoads(network, lines, findings);
  checker.JunctionIds();
  checker.Ambiguous();
  checker.Links();
  checker.Junctions();
  checker.SeenAt();
}

}  // namespace rodeira::opendrive
