// SPDX-License-Identifier: Apache-2.0
#include "common/world/design/junction_builder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "common/world/design/cut.hpp"
#include "common/world/design/junction_arms.hpp"
#include "common/world/design/junction_lights.hpp"
#include "common/world/design/junction_outline.hpp"
#include "common/world/design/junction_ways.hpp"

namespace rodeira::design {
namespace {

using network::End;

constexpr double kShortest_m = 2.0;  // of what is left of a road between two junctions
constexpr double kMajorWeight = 4.0;

// Where a junction lies on one of its roads.
struct Gap {
  std::size_t junction, meeting;
  double from_s_m, to_s_m;
};

using Specs = std::vector<network::RoadSpec>;

class Builder {
 public:
  Builder(const std::vector<RoadDesign>& designs, const std::vector<network::Road>& roads,
          const std::vector<JunctionSpec>& junctions)
      : designs_(designs), roads_(roads), junctions_(junctions), arms_(junctions.size()), gaps_(roads.size()) {}

  Layout Build() {
    for (std::size_t i = 0; i < junctions_.size(); ++i) FindGaps(i);
    for (std::size_t road = 0; road < roads_.size(); ++road) CutRoad(road);
    for (std::size_t i = 0; i < junctions_.size(); ++i) {
      if (arms_[i].size() >= 2) BuildJunction(i);
    }
    for (std::size_t i = 0; i < specs_.size(); ++i) layout_.network.roads.emplace_back(std::move(specs_[i]), axes_[i]);
    for (network::Road& way : ways_) layout_.network.roads.push_back(std::move(way));
    return std::move(layout_);
  }

 private:
  void FindGaps(std::size_t index) {
    const JunctionSpec& junction = junctions_[index];
    const std::vector<Setback> setbacks = Setbacks(junction, roads_);
    for (std::size_t i = 0; i < junction.meetings.size(); ++i) {
      const Meeting& meeting = junction.meetings[i];
      gaps_[meeting.road].push_back({index, i, meeting.before ? meeting.s_m - setbacks[i].before_m : meeting.s_m,
                                     meeting.after ? meeting.s_m + setbacks[i].after_m : meeting.s_m});
    }
  }

  void CutRoad(std::size_t road) {
    std::vector<Gap>& gaps = gaps_[road];
    std::sort(gaps.begin(), gaps.end(), [](const Gap& a, const Gap& b) { return a.from_s_m < b.from_s_m; });
    const double length = roads_[road].length_m();
    double from = 0.0;
    int count = 0;
    const Gap* before = nullptr;
    const auto add = [&](double to, const Gap* after) {
      const std::string& id = designs_[road].spec.id;
      const network::Road piece =
          gaps.empty() ? roads_[road] : Cut(roads_[road], from, to, fmt::format("{}/{}", id, ++count));
      const auto number = static_cast<std::uint32_t>(specs_.size());
      specs_.push_back(piece.spec());
      axes_.push_back(piece.axis());
      layout_.pieces.push_back({road, from, to});
      if (before != nullptr) {
        arms_[before->junction].push_back({before->meeting, number, End::kStart});
        specs_.back().predecessor = network::RoadLink{true, junctions_[before->junction].id, End::kStart};
      }
      if (after != nullptr) {
        arms_[after->junction].push_back({after->meeting, number, End::kEnd});
        specs_.back().successor = network::RoadLink{true, junctions_[after->junction].id, End::kStart};
      }
    };
    for (const Gap& gap : gaps) {
      const Meeting& meeting = junctions_[gap.junction].meetings[gap.meeting];
      if (meeting.before) {
        if (gap.from_s_m < from + kShortest_m) return Crowded(gap, road, gap.from_s_m - from);
        add(gap.from_s_m, &gap);
      }
      from = gap.to_s_m;
      before = &gap;
      if (!meeting.after) return;
    }
    if (!gaps.empty() && from > length - kShortest_m) return Crowded(gaps.back(), road, length - from);
    add(length, nullptr);
  }

  void Crowded(const Gap& gap, std::size_t road, double left_m) {
    const JunctionSpec& junction = junctions_[gap.junction];
    junction.map.Problem(
        "roads", "config.out_of_range",
        fmt::format("junction '{}' reaches from s = {:.1f} m to {:.1f} m of road '{}': {:.1f} m are left before the "
                    "road's end or its next junction; at least {} m were expected",
                    junction.id, gap.from_s_m, gap.to_s_m, designs_[road].spec.id, left_m, kShortest_m));
  }

  network::Road Piece(std::uint32_t index) const { return {specs_[index], axes_[index]}; }

  void BuildJunction(std::size_t index) {
    const JunctionSpec& junction_spec = junctions_[index];
    std::vector<Arm>& arms = arms_[index];
    std::vector<network::Road> pieces;
    Eigen::Vector2d middle = roads_[junction_spec.meetings[0].road].axis().Evaluate(junction_spec.meetings[0].s_m).p_W;
    const auto angle = [&](const Arm& arm) {
      const network::Road piece = Piece(arm.piece);
      const auto [left, right] = EdgesAt(piece, arm.end, false);
      const Eigen::Vector2d away = 0.5 * (left + right) - middle;
      return std::atan2(away.y(), away.x());
    };
    std::sort(arms.begin(), arms.end(), [&](const Arm& a, const Arm& b) { return angle(a) < angle(b); });
    std::vector<Mouth> outer, paved;
    std::vector<ArmSection> sections;
    for (const Arm& arm : arms) {
      pieces.push_back(Piece(arm.piece));
      const Eigen::Vector2d outward = Outward(pieces.back(), arm.end);
      const auto [left, right] = EdgesAt(pieces.back(), arm.end, false);
      const auto [paved_left, paved_right] = EdgesAt(pieces.back(), arm.end, true);
      outer.push_back({left, right, outward});
      paved.push_back({paved_left, paved_right, outward});
      sections.push_back(SectionOf(pieces.back(), arm.end, arm.meeting == 0 ? kMajorWeight : 1.0));
    }
    Outline outline = MakeOutline(outer);
    network::Junction junction;
    junction.id = junction_spec.id;
    junction.name = junction_spec.name;
    junction.paved_W = MakeOutline(paved).corners_W;
    junction.outline_W = outline.corners_W;
    const auto surface =
        std::make_shared<const JunctionSurface>(junction_spec.id, std::move(sections), std::move(outline.corners_W),
                                                junction.paved_W, std::move(outline.free_edges));
    layout_.surfaces.push_back(surface);
    AddThrough(junction_spec, arms, pieces, *surface, junction);
    AddTurns(junction_spec, arms, pieces, *surface, junction);
    for (const Arm& arm : arms) MarkArm(specs_[arm.piece], arm.end, junction_spec.control, arm.meeting == 0);
    if (junction_spec.lights) AddLights(junction_spec, arms, junction);
    layout_.network.junctions.push_back(std::move(junction));
  }

  // A light before each arm that traffic comes from, a controller a road.
  void AddLights(const JunctionSpec& junction_spec, const std::vector<Arm>& arms, network::Junction& junction) {
    for (const std::string& name : junction_spec.lights->Names()) {
      network::Controller controller;
      controller.id = fmt::format("{}-{}", junction_spec.id, name);
      controller.name = fmt::format("{}: {}", junction_spec.name, name);
      controller.times = lights::TimesOf(*junction_spec.lights, name);
      controller.place = lights::PlaceOf(*junction_spec.lights, name);
      for (const Arm& arm : arms) {
        if (designs_[junction_spec.meetings[arm.meeting].road].spec.id != name) continue;
        if (const auto id = PutLight(specs_[arm.piece], arm.end)) controller.controls.push_back({*id, "0"});
      }
      junction.controllers.push_back(controller.id);
      layout_.network.controllers.push_back(std::move(controller));
    }
  }

  // Straight on along roads that pass.
  void AddThrough(const JunctionSpec& junction_spec, const std::vector<Arm>& arms,
                  const std::vector<network::Road>& pieces, const JunctionSurface& surface,
                  network::Junction& junction) {
    for (std::size_t meeting = 0; meeting < junction_spec.meetings.size(); ++meeting) {
      const Meeting& passing = junction_spec.meetings[meeting];
      if (!passing.before || !passing.after) continue;
      std::size_t from = arms.size(), to = arms.size();
      for (std::size_t i = 0; i < arms.size(); ++i) {
        if (arms[i].meeting == meeting) (arms[i].end == End::kEnd ? from : to) = i;
      }
      if (from == arms.size() || to == arms.size()) continue;
      const double begin = layout_.pieces[arms[from].piece].to_s_m, end = layout_.pieces[arms[to].piece].from_s_m;
      network::Road way =
          WayAlong(roads_[passing.road], begin, end,
                   fmt::format("{}/{}", junction_spec.id, designs_[passing.road].spec.id), junction_spec.id, surface);
      network::RoadSpec spec = way.spec();
      spec.predecessor = network::RoadLink{false, pieces[from].id(), End::kEnd};
      spec.successor = network::RoadLink{false, pieces[to].id(), End::kStart};
      std::erase_if(spec.lines, [&](const network::PaintedLine& line) {
        return !KeepsLine(junction_spec, arms, meeting, line, spec.lane_offset.Value(0.0));
      });
      network::JunctionConnection with{
          fmt::format("{}", junction.connections.size()), pieces[from].id(), spec.id, End::kStart, {}};
      network::JunctionConnection against{
          fmt::format("{}", junction.connections.size() + 1), pieces[to].id(), spec.id, End::kEnd, {}};
      for (auto* side : {&spec.sections[0].left, &spec.sections[0].right}) {
        for (network::Lane& lane : *side) {
          lane.predecessors = lane.successors = {lane.id};
          if (!network::IsDrivable(lane.type)) continue;
          if (lane.direction >= 0) with.lane_links.push_back({lane.id, lane.id});
          if (lane.direction <= 0) against.lane_links.push_back({lane.id, lane.id});
        }
      }
      for (const auto& connection : {with, against}) {
        if (!connection.lane_links.empty()) junction.connections.push_back(connection);
      }
      layout_.along.emplace_back(specs_.size() + ways_.size(), design::Piece{passing.road, begin, end});
      AddWay(network::Road(std::move(spec), way.axis()), meeting == 0, junction);
    }
  }

  // Of a road with priority the middle line goes on, and the lines on a side without other roads; of others none.
  bool KeepsLine(const JunctionSpec& junction_spec, const std::vector<Arm>& arms, std::size_t meeting,
                 const network::PaintedLine& line, double centre) const {
    if (meeting != 0) return false;
    const double t = line.t.Value(0.5 * (line.from_s_m + line.to_s_m)) - centre;
    if (std::fabs(t) < 0.5) return line.gap_m > 0.0;
    const geometry::PlanPoint axis =
        roads_[junction_spec.meetings[0].road].axis().Evaluate(junction_spec.meetings[0].s_m);
    for (const Arm& arm : arms) {
      if (arm.meeting == 0) continue;
      const network::Road piece = Piece(arm.piece);
      const auto [left, right] = EdgesAt(piece, arm.end, false);
      const double side = (0.5 * (left + right) - axis.p_W).dot(axis.left_W());
      if (side * t > 0.0) return false;
    }
    return true;
  }

  // From each arm to each other one that no road leads to: the leftmost lanes turn left, the rightmost right.
  void AddTurns(const JunctionSpec& junction_spec, const std::vector<Arm>& arms,
                const std::vector<network::Road>& pieces, const JunctionSurface& surface, network::Junction& junction) {
    for (std::size_t from = 0; from < arms.size(); ++from) {
      for (std::size_t to = 0; to < arms.size(); ++to) {
        if (from == to || arms[from].meeting == arms[to].meeting) continue;
        const auto in = LanesOf(pieces[from], arms[from].end, true), out = LanesOf(pieces[to], arms[to].end, false);
        if (in.empty() || out.empty()) continue;
        const Eigen::Vector2d inward = -Outward(pieces[from], arms[from].end),
                              outward = Outward(pieces[to], arms[to].end);
        const bool left = inward.x() * outward.y() - inward.y() * outward.x() > 0.0;
        const ArmLane& lane = left ? in.front() : in.back();
        const ArmLane& target = left ? out.front() : out.back();
        const std::string id = fmt::format("{}/{}-{}", junction_spec.id, pieces[from].id(), pieces[to].id());
        auto way = WayBetween(lane, inward, target, outward, id, junction_spec.id, surface, pieces[from]);
        if (!way) continue;
        network::RoadSpec spec = way->spec();
        spec.predecessor = network::RoadLink{false, pieces[from].id(), arms[from].end};
        spec.successor = network::RoadLink{false, pieces[to].id(), arms[to].end};
        junction.connections.push_back(
            {fmt::format("{}", junction.connections.size()), pieces[from].id(), id, End::kStart, {{lane.id, -1}}});
        AddWay(network::Road(std::move(spec), way->axis()), arms[from].meeting == 0, junction);
      }
    }
  }

  // The ways of the road with priority go before all others.
  void AddWay(network::Road way, bool major, network::Junction& junction) {
    for (const network::Road& other : ways_) {
      if (other.spec().junction != junction.id || major_.at(other.id()) == major) continue;
      if (major)
        junction.priorities.push_back({way.id(), other.id()});
      else
        junction.priorities.push_back({other.id(), way.id()});
    }
    major_[way.id()] = major;
    ways_.push_back(std::move(way));
  }

  const std::vector<RoadDesign>& designs_;
  const std::vector<network::Road>& roads_;
  const std::vector<JunctionSpec>& junctions_;
  std::vector<std::vector<Arm>> arms_;
  std::vector<std::vector<Gap>> gaps_;  // by road
  Specs specs_;                         // of the pieces
  std::vector<geometry::PlanAxis> axes_;
  std::vector<network::Road> ways_;
  std::map<std::string, bool> major_;
  Layout layout_;
};

}  // namespace

Layout BuildLayout(const std::vector<RoadDesign>& designs, const std::vector<network::Road>& roads,
                   const std::vector<JunctionSpec>& junctions) {
  return Builder(designs, roads, junctions).Build();
}

}  // namespace rodeira::design
