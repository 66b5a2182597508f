// SPDX-License-Identifier: Apache-2.0
#include "common/world/opendrive/repair_lanes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "common/core/geometry/angle.hpp"
#include "common/world/opendrive/repair_plan.hpp"

namespace rodeira::opendrive {
namespace {

using network::End;
using network::LaneEnd;
using network::LaneKey;
using network::Road;

// A car takes a sharper turn from one lane into the next only as an arc; onto a way that turns round no such turn fits.
constexpr double kDrivenKink_rad = 0.7, kDrivenKinkTurning_rad = 0.35;
constexpr double kTurnsRound_rad = 1.9;
constexpr double kDrivenAhead_m = 1.0;  // of nothing between two lanes
constexpr std::size_t kMaxTurned = 3;   // repairs; a road with both ends at one place would be turned for ever
constexpr double kShared = 0.7;         // of the narrower lane's width, which both share

const char* Word(End end) { return end == End::kEnd ? "successor" : "predecessor"; }

// A lane's end seen driving out of it: its edges, where it is left, and where to.
struct LaneMouth {
  Eigen::Vector2d left_W, right_W, out_W;

  Eigen::Vector2d middle_W() const { return 0.5 * (left_W + right_W); }
  double width_m() const { return (left_W - right_W).norm(); }
};

LaneMouth LaneMouthOf(const network::Network& network, const LaneEnd& end) {
  const Road& road = network.roads()[end.lane.road];
  const network::LaneSection& section = network.Section(end.lane);
  const double s = road.Held(end.lane.section, end.end == End::kStart ? section.s_m : section.end_s_m);
  const network::LaneSpan span = *road.SpanAt(end.lane.section, end.lane.lane, s);
  const double slope = 0.5 * (span.inner_slope + span.outer_slope);
  const network::SurfaceSample at = road.Surface(s, span.centre_t_m(), section, span);
  const double way = end.end == End::kEnd ? 1.0 : -1.0;
  const double high = std::max(span.inner_t_m, span.outer_t_m), low = std::min(span.inner_t_m, span.outer_t_m);
  const Eigen::Vector2d upper = road.Surface(s, high, section, span).p_W.head<2>(),
                        lower = road.Surface(s, low, section, span).p_W.head<2>();
  // Within a bend that is sharper than the lane lies aside the lane's middle runs backward; a car does not.
  const Eigen::Vector2d along = (at.ds_W + slope * at.dt_W).head<2>(), tangent = road.axis().Evaluate(s).tangent_W;
  return {way > 0.0 ? upper : lower, way > 0.0 ? lower : upper,
          way * (along.dot(tangent) > 0.0 ? along.normalized() : tangent)};
}

}  // namespace

LaneRepairs::LaneRepairs(const network::Network& network, std::span<const RoadLines> lines, Source& source)
    : network_(network), lines_(lines), source_(source) {
  for (const Node& junction : source.root().Children("junction")) {
    connections_.push_back(junction.Children("connection"));
    for (const Node& connection : connections_.back()) {
      const std::string way = connection.Text(connection.Has("linkedRoad") ? "linkedRoad" : "connectingRoad", "");
      between_[{connection.Text("incomingRoad", ""), way}].push_back(connection);
    }
  }
  for (std::uint32_t i = 0; i < network.roads().size(); ++i) {
    const std::string& junction = network.roads()[i].spec().junction;
    if (!junction.empty()) ways_of_[junction].push_back(i);
  }
}

Node LaneRepairs::LaneNode(const LaneKey& key) const {
  const Node section(&source_, lines_[key.road].section_nodes[key.section]);
  for (const Node& side : section.Children(key.lane > 0 ? "left" : "right")) {
    for (const Node& lane : side.Children("lane")) {
      if (lane.xml().attribute("id").as_int() == key.lane) return lane;
    }
  }
  return {&source_, {}};
}

LaneRepairs::Passing LaneRepairs::PassingOf(const LaneEnd& from, const LaneEnd& to) const {
  const LaneMouth here = LaneMouthOf(network_, from), there = LaneMouthOf(network_, to);
  const Eigen::Vector2d left(-here.out_W.y(), here.out_W.x()), in_W = -there.out_W;
  Passing passing;
  passing.kink_rad = std::fabs(std::atan2(in_W.dot(left), in_W.dot(here.out_W)));
  const Eigen::Vector2d between = there.middle_W() - here.middle_W();
  passing.aside_m = std::fabs(between.dot(left)), passing.ahead_m = std::fabs(between.dot(here.out_W));
  // Driven into, the other lane has its left and right exchanged.
  const auto aside = [&](const Eigen::Vector2d& p_W) { return (p_W - here.middle_W()).dot(left); };
  const double half = 0.5 * here.width_m(), high = aside(there.right_W), low = aside(there.left_W);
  const double shared = std::min(half, high) - std::max(-half, low);
  const double needed = std::min(kShared * std::min(here.width_m(), there.width_m()),
                                 std::min(here.width_m(), there.width_m()) - 2.0 * kBridgedAcross_m);
  const auto turns_round = [&](const LaneEnd& end) {
    const geometry::PlanAxis& axis = network_.roads()[end.lane.road].axis();
    return std::fabs(geometry::WrapAngle(axis.Evaluate(axis.length_m()).heading_rad - axis.Evaluate(0.0).heading_rad)) >
           kTurnsRound_rad;
  };
  const double most_rad = turns_round(from) || turns_round(to) ? kDrivenKinkTurning_rad : kDrivenKink_rad;
  // Of wide lanes that meet with a kink one edge meets, and the other leaves a wedge.
  const double wedge_m = 0.5 * std::min(here.width_m(), there.width_m()) * std::sin(std::min(passing.kink_rad, 1.0));
  passing.drivable =
      passing.kink_rad <= most_rad && passing.ahead_m <= kDrivenAhead_m + wedge_m && shared >= std::min(needed, 1e3);
  return passing;
}

double LaneRepairs::GapToAll(const LaneEnd& from, std::span<const LaneEnd> to) const {
  const LaneMouth here = LaneMouthOf(network_, from);
  const Eigen::Vector2d left(-here.out_W.y(), here.out_W.x());
  const Eigen::Vector2d *leftmost = nullptr, *rightmost = nullptr;
  std::vector<LaneMouth> there;
  for (const LaneEnd& each : to) there.push_back(LaneMouthOf(network_, each));
  for (const LaneMouth& mouth : there) {
    if (leftmost == nullptr || (mouth.right_W - *leftmost).dot(left) > 0.0) leftmost = &mouth.right_W;
    if (rightmost == nullptr || (mouth.left_W - *rightmost).dot(left) < 0.0) rightmost = &mouth.left_W;
  }
  return std::max((here.left_W - *leftmost).norm(), (here.right_W - *rightmost).norm());
}

Repair LaneRepairs::DropLink(const LaneKey& lane, End end, int id) const {
  Repair repair{RepairKind::kLinkDropped, "the link is dropped", {}};
  for (const Node& link : LaneNode(lane).Child("link").Children(Word(end))) {
    if (link.xml().attribute("id").as_int() == id) repair.edits.push_back(link.Remove());
  }
  return repair;
}

Repair LaneRepairs::DropLaneLink(const network::JunctionConnection& connection,
                                 const network::JunctionLaneLink& link) const {
  Repair repair{RepairKind::kLaneLinkDropped, "the way is dropped", {}};
  const auto found = between_.find({connection.incoming_road, connection.connecting_road});
  if (found == between_.end()) return repair;
  for (const Node& each : found->second) {
    for (const Node& lane : each.Children("laneLink")) {
      if (lane.xml().attribute("from").as_int() == link.from && lane.xml().attribute("to").as_int() == link.to)
        repair.edits.push_back(lane.Remove());
    }
  }
  return repair;
}

Repair LaneRepairs::DropConnection(std::size_t junction, std::size_t connection) const {
  return {RepairKind::kConnectionDropped, "the connection is dropped", {connections_[junction][connection].Remove()}};
}

void LaneRepairs::Unlink(const LaneEnd& from, const LaneEnd& to, std::vector<Edit>& edits) const {
  for (const auto& [a, b] : {std::pair(from, to), std::pair(to, from)}) {
    const network::RoadSpec& spec = network_.roads()[a.lane.road].spec();
    const auto& link = a.end == End::kEnd ? spec.successor : spec.predecessor;
    const bool inner = a.lane.road == b.lane.road && a.lane.section != b.lane.section;
    if (inner || (link && !link->junction && link->id == network_.roads()[b.lane.road].id())) {
      for (const Edit& edit : DropLink(a.lane, a.end, b.lane.lane).edits) edits.push_back(edit);
    }
    const auto found = between_.find({spec.id, network_.roads()[b.lane.road].id()});
    if (found == between_.end()) continue;
    for (const Node& connection : found->second) {
      for (const Node& lane : connection.Children("laneLink")) {
        if (lane.xml().attribute("from").as_int() == a.lane.lane && lane.xml().attribute("to").as_int() == b.lane.lane)
          edits.push_back(lane.Remove());
      }
    }
  }
}

Repair LaneRepairs::DropConnectingRoad(std::uint32_t index) const {
  const network::RoadSpec& spec = network_.roads()[index].spec();
  Repair repair{RepairKind::kConnectingRoadDropped,
                fmt::format("the way over road {} is dropped: no car can drive it", spec.id),
                {Node(&source_, lines_[index].node).Remove()}};
  const auto junction = network_.FindJunction(spec.junction);
  if (!junction) return repair;
  const auto& connections = network_.junctions()[*junction].connections;
  for (std::size_t i = 0; i < connections.size(); ++i) {
    if (connections[i].connecting_road == spec.id) repair.edits.push_back(DropConnection(*junction, i).edits.front());
  }
  // A road that no other way of the junction leads to or from ends there.
  for (const auto* link : {&spec.predecessor, &spec.successor}) {
    const auto beside = *link && !(*link)->junction ? network_.FindRoad((*link)->id) : std::nullopt;
    if (!beside) continue;
    const auto meets = [&](std::uint32_t way) {
      const Road& road = network_.roads()[way];
      if (road.id() == spec.id) return false;
      const auto is_it = [&](const std::optional<network::RoadLink>& of) {
        return of && !of->junction && of->id == (*link)->id && of->contact == (*link)->contact;
      };
      return is_it(road.spec().predecessor) || is_it(road.spec().successor);
    };
    const std::vector<std::uint32_t>& ways = ways_of_.at(spec.junction);
    if (std::any_of(ways.begin(), ways.end(), meets)) continue;
    const Node own = Node(&source_, lines_[*beside].node).Child("link").Child(Word((*link)->contact));
    if (own) repair.edits.push_back(own.Remove());
  }
  return repair;
}

bool LaneRepairs::LeadOn(const LaneEnd& from, const LaneEnd& to) const {
  // 1: traffic leaves the lane at this end; -1: it enters there; 0: both.
  const auto leaves = [&](const LaneEnd& at) {
    const int direction = network_.Find(at.lane)->direction;
    return at.end == End::kEnd ? direction : -direction;
  };
  return leaves(from) == 0 || leaves(to) == 0 || leaves(from) != leaves(to);
}

std::optional<LaneEnd> LaneRepairs::MeantBy(const LaneEnd& from, const LaneEnd& to) const {
  const network::RoadSpec& other = network_.roads()[to.lane.road].spec();
  const auto last = static_cast<std::uint32_t>(other.sections.size()) - 1;
  std::vector<LaneEnd> lying;
  const auto add = [&](std::uint32_t section, End end) {
    for (const auto* side : {&other.sections[section].left, &other.sections[section].right}) {
      for (const network::Lane& lane : *side) {
        const LaneEnd found{{to.lane.road, section, lane.id}, end};
        if (network::IsDrivable(lane.type) && found != to && LeadOn(from, found) && PassingOf(from, found).drivable)
          lying.push_back(found);
      }
    }
  };
  if (from.lane.road == to.lane.road) {
    if (from.lane.section != to.lane.section) add(to.lane.section, to.end);
  } else if (to.lane.section == (to.end == End::kEnd ? last : 0)) {
    add(0, End::kStart);
    add(last, End::kEnd);
  }
  if (lying.size() > 1)
    std::erase_if(lying, [&](const LaneEnd& each) { return GapToAll(from, {&each, 1}) > kFound_m; });
  return lying.size() == 1 ? std::optional(lying.front()) : std::nullopt;
}

std::optional<Repair> LaneRepairs::Relink(const LaneEnd& from, const LaneEnd& to) const {
  const std::optional<LaneEnd> found = MeantBy(from, to);
  if (!found) return std::nullopt;
  const network::RoadSpec &spec = network_.roads()[from.lane.road].spec(),
                          &other = network_.roads()[to.lane.road].spec();
  const std::string lane = std::to_string(found->lane.lane);
  const bool inner = from.lane.road == to.lane.road;
  Repair repair{
      RepairKind::kLinkMoved, fmt::format("it goes on as lane {} of road {}, which lies there", lane, other.id), {}};
  if (found->end != to.end) repair.kind = RepairKind::kContactTurned, repair.done = "the road is met at its other end";
  const auto renumber = [&](const Node& node, const char* attribute, int id) {
    if (found->lane.lane != id && node.xml().attribute(attribute).as_int() == id)
      repair.edits.push_back(node.Set(attribute, lane));
  };
  const char* word = found->end == End::kEnd ? "end" : "start";
  const auto& link = from.end == End::kEnd ? spec.successor : spec.predecessor;
  const bool by_road = link && !link->junction && !link->s_m && link->id == other.id && link->contact == to.end;
  if (by_road && found->end != to.end && !inner) {
    const Node node = Node(&source_, lines_[from.lane.road].node).Child("link").Child(Word(from.end));
    repair.edits.push_back(node.Set("contactPoint", word));
  }
  if (by_road || inner) {
    for (const Node& node : LaneNode(from.lane).Child("link").Children(Word(from.end)))
      renumber(node, "id", to.lane.lane);
    // The other lane no longer leads back.
    const auto& back = to.end == End::kEnd ? other.successor : other.predecessor;
    if (inner || (back && !back->junction && back->id == spec.id && back->contact == from.end)) {
      for (const Edit& edit : DropLink(to.lane, to.end, from.lane.lane).edits) repair.edits.push_back(edit);
    }
  }
  if (const auto ways = between_.find({spec.id, other.id}); ways != between_.end()) {
    for (const Node& connection : ways->second) {
      if ((connection.Text("contactPoint", "start") == "end") != (to.end == End::kEnd)) continue;
      if (found->end != to.end) repair.edits.push_back(connection.Set("contactPoint", word));
      for (const Node& pair : connection.Children("laneLink")) {
        if (pair.xml().attribute("from").as_int() == from.lane.lane) renumber(pair, "to", to.lane.lane);
      }
    }
  }
  return repair.edits.empty() ? std::nullopt : std::optional(std::move(repair));
}

Repair LaneRepairs::GapRepair(const LaneEnd& from, const LaneEnd& to) const {
  const Passing passing = PassingOf(from, to);
  if (passing.drivable) return {RepairKind::kGapDriven, fmt::format("it is driven, {:.2g} m aside", passing.aside_m)};
  if (source_.repairs() < kMaxTurned) {
    if (auto moved = Relink(from, to)) return *moved;
    if (auto moved = Relink(to, from)) return *moved;
  }
  for (const LaneEnd* end : {&from, &to}) {
    const network::RoadSpec& spec = network_.roads()[end->lane.road].spec();
    if (spec.junction.empty()) continue;
    const auto drivable = [](const network::LaneSection& section) {
      const auto is = [](const network::Lane& lane) { return network::IsDrivable(lane.type); };
      return std::count_if(section.left.begin(), section.left.end(), is) +
             std::count_if(section.right.begin(), section.right.end(), is);
    };
    if (drivable(spec.sections.front()) == 1 && drivable(spec.sections.back()) == 1)
      return DropConnectingRoad(end->lane.road);
  }
  Repair repair{RepairKind::kLaneEnded, "the lane ends there", {}};
  Unlink(from, to, repair.edits);
  return repair;
}

Repair LaneRepairs::FindLink(const LaneEnd& from, const LaneEnd& to) const {
  Repair repair{RepairKind::kLinkFound,
                fmt::format("it goes on as lane {} of road {}, which lies there", to.lane.lane,
                            network_.roads()[to.lane.road].id()),
                {}};
  const auto add = [&](const LaneEnd& a, const LaneEnd& b) {
    const Node lane = LaneNode(a.lane), link = lane.Child("link");
    if (!lane) return;
    const std::string xml = fmt::format("<{} id=\"{}\"/>", Word(a.end), b.lane.lane);
    if (link) {
      repair.edits.push_back(link.Append(xml));
    } else {
      const std::string text(lane.Text());
      const std::size_t tag = TagEnd(text, 0);
      if (text[tag - 2] == '/')
        repair.edits.push_back(lane.Append("<link>" + xml + "</link>"));
      else  // as the first child
        repair.edits.push_back(lane.Insert("<link>" + xml + "</link>"));
    }
  };
  add(from, to);
  const network::RoadSpec &spec = network_.roads()[from.lane.road].spec(),
                          &other = network_.roads()[to.lane.road].spec();
  const auto& link = from.end == End::kEnd ? spec.successor : spec.predecessor;
  if (!link && from.lane.road != to.lane.road) {
    const Node road(&source_, lines_[from.lane.road].node), links = road.Child("link");
    const std::string xml = fmt::format("<{} elementType=\"road\" elementId=\"{}\" contactPoint=\"{}\"/>",
                                        Word(from.end), other.id, to.end == End::kEnd ? "end" : "start");
    repair.edits.push_back(links ? links.Append(xml) : road.Insert("<link>" + xml + "</link>"));
  } else if (link && !link->junction && link->contact != to.end && from.lane.road != to.lane.road) {
    const Node node = Node(&source_, lines_[from.lane.road].node).Child("link").Child(Word(from.end));
    repair.edits.push_back(node.Set("contactPoint", to.end == End::kEnd ? "end" : "start"));
  }
  const auto& back = to.end == End::kEnd ? other.successor : other.predecessor;
  const bool inner = from.lane.road == to.lane.road && from.lane.section != to.lane.section;
  if (inner || (back && !back->junction && back->id == network_.roads()[from.lane.road].id())) add(to, from);
  return repair;
}

}  // namespace rodeira::opendrive
