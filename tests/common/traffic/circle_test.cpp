// SPDX-License-Identifier: Apache-2.0
// Streets as full as can be, with closed chains of waiting: which one goes, so that all of them go on, and which is
// not counted on to go, so that none closes.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "common/core/base/random.hpp"
#include "common/traffic/traffic_model.hpp"
#include "tests/common/traffic/restored.hpp"
#include "tests/common/world/opendrive/sample.hpp"

namespace rodeira::traffic {
namespace {

constexpr std::uint64_t kDrawLink = 103;  // of the draws at branches
constexpr double kStep_s = 0.05, kGap_m = 2.1, kLine_m = 0.6, kAtLine_m = 0.02, kStand_m = 2.5, kPi = std::numbers::pi;

struct Part {
  double x, y, heading, length, curvature;
};

std::string Lane(int id, int before, int after) {
  return fmt::format(
      "<lane id=\"{}\" type=\"driving\"><link><predecessor id=\"{}\"/><successor id=\"{}\"/></link><width "
      "sOffset=\"0\" a=\"3.5\" b=\"0\" c=\"0\" d=\"0\"/></lane>",
      id, before, after);
}

opendrive::RoadText Road(const std::string& id, const std::vector<Part>& parts, const std::string& link) {
  opendrive::RoadText text;
  text.id = id, text.link = link;
  text.length = 0.0, text.geometry = "", text.left = "", text.right = Lane(-1, -1, -1);
  for (const Part& part : parts) {
    const std::string shape =
        part.curvature == 0.0 ? "<line/>" : fmt::format("<arc curvature=\"{:.17g}\"/>", part.curvature);
    text.geometry +=
        fmt::format("<geometry s=\"{:.17g}\" x=\"{}\" y=\"{}\" hdg=\"{:.17g}\" length=\"{:.17g}\">{}</geometry>",
                    text.length, part.x, part.y, part.heading, part.length, shape);
    text.length += part.length;
  }
  return text;
}

// A way through a junction from one road's right-hand lane to the right-hand lane of another one, which it comes to
// where that begins or ends.
struct Through {
  std::string junction, id, from, to;
  Part part;
  bool from_end = true, to_start = true;
};

std::string Text(const std::vector<opendrive::RoadText>& roads, const std::vector<Through>& ways) {
  std::string text;
  for (const opendrive::RoadText& road : roads) text += road.Text();
  std::vector<std::string> junctions;
  for (const Through& way : ways) {
    opendrive::RoadText road =
        Road(way.id, {way.part},
             fmt::format("<predecessor elementType=\"road\" elementId=\"{}\" contactPoint=\"{}\"/><successor "
                         "elementType=\"road\" elementId=\"{}\" contactPoint=\"{}\"/>",
                         way.from, way.from_end ? "end" : "start", way.to, way.to_start ? "start" : "end"));
    road.attributes = "junction=\"" + way.junction + "\"";
    road.right = Lane(-1, way.from_end ? -1 : 1, way.to_start ? -1 : 1);
    text += road.Text();
    if (std::find(junctions.begin(), junctions.end(), way.junction) == junctions.end())
      junctions.push_back(way.junction);
  }
  for (const std::string& junction : junctions) {
    text += "<junction id=\"" + junction + "\" name=\"\">";
    int count = 0;
    for (const Through& way : ways) {
      if (way.junction != junction) continue;
      text += fmt::format(
          "<connection id=\"{}\" incomingRoad=\"{}\" connectingRoad=\"{}\" contactPoint=\"start\"><laneLink "
          "from=\"{}\" to=\"-1\"/></connection>",
          count++, way.from, way.id, way.from_end ? -1 : 1);
    }
    text += "</junction>";
  }
  return opendrive::Document(text);
}

std::string From(const std::string& junction) {
  return "<predecessor elementType=\"junction\" elementId=\"" + junction + "\"/>";
}
std::string To(const std::string& junction) {
  return "<successor elementType=\"junction\" elementId=\"" + junction + "\"/>";
}

// Vehicles that stand one behind another.
class Streets {
 public:
  static constexpr std::uint32_t kVehicles = 120;  // of which some are on the road

  explicit Streets(const std::string& text) {
    settings_.vehicles = kVehicles;
    settings_.mix.shares = {0.6, 0.0, 0.0, 0.4};
    model = std::make_unique<TrafficModel>(TrafficModel::Make(settings_, opendrive::MustRead(text), {}).value());
  }

  // By the road's id; of a road of two lanes the one in its direction, or against it.
  std::uint32_t Track(const std::string& road, bool against = false) const {
    const lanes::Graph& graph = model->graph();
    for (std::uint32_t track = 0; track < graph.tracks().size(); ++track) {
      if (graph.network().roads()[graph[track].lane.road].id() == road && (graph[track].lane.lane > 0) == against)
        return track;
    }
    ADD_FAILURE() << road;
    return 0;
  }
  double Length(std::uint32_t id) const { return model->traits(id).length_m; }
  double LengthOf(std::uint32_t track) const { return model->graph()[track].length_m(); }
  std::uint32_t On(std::uint32_t id) const { return PieceAt(model->agent(id).path, model->agent(id).o_m).track; }
  const std::vector<std::uint32_t>& all() const { return all_; }

  // One that is not on the road yet.
  std::uint32_t Next(VehicleKind kind) const {
    for (std::uint32_t id = 0; id < kVehicles; ++id) {
      if (!agents[id].on_road && model->traits(id).kind == kind) return id;
    }
    ADD_FAILURE();
    return 0;
  }

  // Where a car that takes that way at a street's end stands at its line, from the street's beginning.
  double LineOf(std::uint32_t street, std::uint32_t way) const {
    double first = 1e9;
    for (const lanes::ZoneSide& part : model->zones().ConflictsOf(way))
      first = std::min(first, LengthOf(street) + part.in_m);
    for (const lanes::ZoneSide& part : model->zones().ConflictsOf(street)) {
      if (part.in_m > 0.5 * LengthOf(street)) first = std::min(first, part.in_m);
    }
    return first - kLine_m - kAtLine_m;
  }

  // With its front so far from a street's beginning, also beyond its end, on the trip on which it goes on by this way.
  void Put(std::uint32_t id, std::uint32_t street, double front_m, std::uint32_t way) {
    Agent& agent = agents[id];
    agent.on_road = true;
    agent.o_m = front_m - 0.5 * Length(id);
    agent.path = {{street, 0.0, 0.0, 0.0, 0.0, 1.0}};
    all_.push_back(id);
    const auto& next = model->graph()[street].next;
    const auto chosen = static_cast<std::size_t>(
        std::find_if(next.begin(), next.end(), [&](const lanes::Link& link) { return link.to == way; }) - next.begin());
    ASSERT_LT(chosen, next.size());
    while (static_cast<std::size_t>(static_cast<double>(next.size()) *
                                    base::RandomUniform({settings_.seed, id, kDrawLink, agent.trip, 0})) != chosen)
      ++agent.trip;
    const double end = LengthOf(street);
    if (front_m <= end) return;
    agent.path.push_back({way, end, end, 0.0, 0.0, 1.0}), agent.links = 1;
    if (agent.o_m - 0.5 * Length(id) > end) agent.path.erase(agent.path.begin());
  }

  // With its front so far from a street's beginning: it stands for good.
  void PutForGood(std::uint32_t id, std::uint32_t street, double front_m) {
    Agent& agent = agents[id];
    agent.on_road = true;
    agent.o_m = front_m - 0.5 * Length(id);
    agent.path = {{street, 0.0, 0.0, 0.0, 0.0, 1.0}};
    agent.brake_mps2 = 3.0;
    all_.push_back(id);
  }

  // The zones of the way at its street's end are its own.
  void Let(std::uint32_t id, std::uint32_t street, std::uint32_t way, std::uint64_t number) {
    double out = 0.0;
    for (const lanes::ZoneSide& part : model->zones().ConflictsOf(way))
      out = std::max(out, LengthOf(street) + part.out_m);
    agents[id].granted_m = out;
    agents[id].grants.push_back({out, number, true, -1.0});
  }

  // Cars one behind another, backwards from a place, as long as the last one's rear stays beyond `to_m`, of which those
  // that are on the street yet take another way; the first one, and where the last one's rear is.
  struct Queue {
    std::uint32_t first = 0;
    double rear_m = 0.0;
  };
  Queue Fill(std::uint32_t street, std::uint32_t way, std::uint32_t others, double from_m, double to_m) {
    Queue queue{Next(VehicleKind::kCar), from_m + kGap_m};
    for (std::uint32_t id = queue.first; queue.rear_m - kGap_m - Length(id) > to_m; id = Next(VehicleKind::kCar)) {
      Put(id, street, queue.rear_m - kGap_m, queue.rear_m - kGap_m > LengthOf(street) ? way : others);
      queue.rear_m -= kGap_m + Length(id);
    }
    return queue;
  }

  bool AnyTouch() const {
    const auto& poses = model->poses();
    for (const AgentPose& a : poses) {
      for (const AgentPose& b : poses) {
        if (a.id < b.id && driver::Overlap(FootprintOf(a, model->traits(a.id)), FootprintOf(b, model->traits(b.id))))
          return true;
      }
    }
    return false;
  }

  std::unique_ptr<TrafficModel> model;
  std::vector<Agent> agents = std::vector<Agent>(kVehicles);

 private:
  TrafficSettings settings_;
  std::vector<std::uint32_t> all_;
};

// A bus has waited longest to come into a street that goes round into itself and is full but for the metres that a car
// needs: they are kept for the bus. But those that stand behind them wait, one for another, for the car at the street's
// end, which wants to go round and is kept out for the bus. That chain is closed, and it goes, and as the next ones
// leave there is room for the bus as well. If a car did not wait for the one that it is kept out for, none would ever
// move.
TEST(Circle, AVehicleKeptOutForOneThatWaitsForRoomWaitsForIt) {
  Streets at(
      Text({Road("round",
                 {{9.0, 0.0, 0.0, 10.0 * kPi, 0.1}, {9.0, 20.0, kPi, 18.0, 0.0}, {-9.0, 20.0, kPi, 10.0 * kPi, 0.1}},
                 From("9") + To("9")),
            Road("comes", {{-1.0, -110.0, 0.5 * kPi, 100.0, 0.0}}, To("9")),
            Road("away", {{-4.0, -5.0, -0.5 * kPi, 200.0, 0.0}}, From("9"))},
           {{"9", "on", "round", "round", {-9.0, 0.0, 0.0, 18.0, 0.0}},
            {"9", "in", "comes", "round", {-1.0, -10.0, 0.5 * kPi, 5.0 * kPi, -0.1}},
            {"9", "out", "round", "away", {-9.0, 0.0, 0.0, 2.5 * kPi, -0.2}}}));
  const std::uint32_t round = at.Track("round"), comes = at.Track("comes"), bus = at.Next(VehicleKind::kBus);
  at.Put(bus, comes, at.LineOf(comes, at.Track("in")), at.Track("in"));
  at.agents[bus].waited_s = 60.0;
  const std::uint32_t first = at.Next(VehicleKind::kCar);
  const Streets::Queue queue = at.Fill(round, at.Track("on"), at.Track("out"), at.LineOf(round, at.Track("on")),
                                       at.Length(first) + kStand_m + 0.5);
  ASSERT_EQ(queue.first, first);
  ASSERT_LT(queue.rear_m, at.Length(bus) + 2.0);
  RestoreWith(*at.model, at.agents);
  double first_s = -1.0, bus_s = -1.0;
  for (int i = 1; i * kStep_s < 120.0 && bus_s < 0.0; ++i) {
    at.model->Step(kStep_s, {});
    ASSERT_FALSE(at.AnyTouch()) << i * kStep_s;
    if (first_s < 0.0 && at.On(first) == round && at.model->agent(first).links > 1) first_s = i * kStep_s;
    if (at.On(bus) == round) bus_s = i * kStep_s;
  }
  EXPECT_GT(first_s, 0.0);
  EXPECT_LT(first_s, 10.0);  // it stands there already
  EXPECT_GT(bus_s, 0.0);
}

// A short street between two junctions, with queues both ways; at its east end a bus that turns into it stands with its
// rear in the way of those that want to leave there; its queue wants into a street that is full as well, and that leads
// back, into the short one, to its west end, where a bus has waited longest to come in. No vehicle goes before another
// one of them does but the car at that street's end, for which there is room: it is let in, and all go on. Was the bus
// let in, since the one in its way waits for another of them, it would stand in the way of the next ones, and none
// would ever move.
TEST(Circle, AVehicleWithoutRoomGoesOnlyWhereItsLeadersGo) {
  constexpr double kBetween_m = 37.0, kEast_m = 15.0 + kBetween_m;
  opendrive::RoadText between = Road("between", {{15.0, 0.0, 0.0, kBetween_m, 0.0}}, From("1") + To("2"));
  between.left = Lane(1, 1, 1);
  Streets at(Text(
      {between,
       Road("back",
            {{0.0, -15.0, -0.5 * kPi, 25.0 * kPi, -0.04},
             {-50.0, -15.0, 0.5 * kPi, 30.0, 0.0},
             {-50.0, 15.0, 0.5 * kPi, 25.0 * kPi, -0.04}},
            From("1") + To("1")),
       Road("west", {{-44.0, 0.0, 0.0, 29.0, 0.0}}, To("1")),
       Road("east", {{kEast_m + 30.0, 0.0, 0.0, 300.0, 0.0}}, From("2")),
       Road("south", {{kEast_m + 15.0, -115.0, 0.5 * kPi, 100.0, 0.0}}, To("2"))},
      {{"1", "straight", "west", "between", {-15.0, 0.0, 0.0, 30.0, 0.0}},
       {"1", "left", "back", "between", {0.0, 15.0, -0.5 * kPi, 7.5 * kPi, 1.0 / 15.0}},
       {"1", "around", "between", "back", {15.0, 0.0, kPi, 7.5 * kPi, 1.0 / 15.0}, false},
       {"2", "on", "between", "east", {kEast_m, 0.0, 0.0, 30.0, 0.0}},
       {"2", "turns", "south", "between", {kEast_m + 15.0, -15.0, 0.5 * kPi, 7.5 * kPi, 1.0 / 15.0}, true, false}}));
  const std::uint32_t eastward = at.Track("between"), westward = at.Track("between", true), back = at.Track("back"),
                      west = at.Track("west"), south = at.Track("south"), turns = at.Track("turns");
  const std::uint32_t waits = at.Next(VehicleKind::kBus);
  at.Put(waits, west, at.LineOf(west, at.Track("straight")), at.Track("straight"));
  at.agents[waits].waited_s = 60.0;
  const Streets::Queue leads =
      at.Fill(back, at.Track("left"), at.Track("left"), at.LineOf(back, at.Track("left")), 0.5);
  const Streets::Queue leaves = at.Fill(eastward, at.Track("on"), at.Track("on"), at.LineOf(eastward, at.Track("on")),
                                        at.Length(leads.first) + kStand_m + 0.3);
  ASSERT_LT(leaves.rear_m, at.Length(waits) + 2.0);
  // The bus that turns in: its rear in what those that leave cross, from its own street's beginning.
  const std::uint32_t bus = at.Next(VehicleKind::kBus);
  double out = 0.0;
  for (const lanes::ZoneSide& part : at.model->zones().ConflictsOf(turns))
    out = std::max(out, part.kind == lanes::ZoneKind::kCross ? part.out_m : 0.0);
  const double to_street = at.LengthOf(turns);
  const Streets::Queue queue =
      at.Fill(westward, at.Track("around"), at.Track("around"), at.LineOf(westward, at.Track("around")),
              out - 6.0 + at.Length(bus) + kGap_m - to_street);
  const double rear = to_street + queue.rear_m - kGap_m - at.Length(bus);  // within the junction
  ASSERT_GT(rear, 0.0);
  ASSERT_LT(rear, out);
  at.Put(bus, south, at.LengthOf(south) + rear + at.Length(bus), turns);
  if (rear + at.Length(bus) > to_street)
    at.agents[bus].path.push_back(
        {westward, at.LengthOf(south) + to_street, at.LengthOf(south) + to_street, 0.0, 0.0, 1.0}),
        at.agents[bus].links = 2;
  RestoreWith(*at.model, at.agents);
  double in_s = -1.0, bus_s = -1.0;
  for (int i = 1; i * kStep_s < 300.0 && (in_s < 0.0 || bus_s < 0.0); ++i) {
    at.model->Step(kStep_s, {});
    ASSERT_FALSE(at.AnyTouch()) << i * kStep_s;
    if (in_s < 0.0 && at.On(waits) == eastward) in_s = i * kStep_s;
    if (bus_s < 0.0 && at.On(bus) == back) bus_s = i * kStep_s;
  }
  EXPECT_GT(in_s, 0.0);
  EXPECT_GT(bus_s, 0.0);
}

// A junction that a street from the west passes straight on to the east, one from the north to the south just before
// that, and one from the south to the right into the east; what follows in the east.
std::string Crossed(const std::vector<opendrive::RoadText>& east, const std::vector<Through>& onward) {
  std::vector<opendrive::RoadText> roads = {Road("west", {{-115.0, 0.0, 0.0, 100.0, 0.0}}, To("1")),
                                            Road("north", {{15.0, 165.0, -0.5 * kPi, 150.0, 0.0}}, To("1")),
                                            Road("south", {{0.0, -115.0, 0.5 * kPi, 100.0, 0.0}}, To("1")),
                                            Road("away", {{15.0, -15.0, -0.5 * kPi, 200.0, 0.0}}, From("1"))};
  roads.insert(roads.end(), east.begin(), east.end());
  std::vector<Through> ways = {{"1", "straight", "west", "east", {-15.0, 0.0, 0.0, 30.0, 0.0}},
                               {"1", "across", "north", "away", {15.0, 15.0, -0.5 * kPi, 30.0, 0.0}},
                               {"1", "right", "south", "east", {0.0, -15.0, 0.5 * kPi, 7.5 * kPi, -1.0 / 15.0}}};
  ways.insert(ways.end(), onward.begin(), onward.end());
  return Text(roads, ways);
}

// One comes from the north, and gets away: no vehicle comes to stand in its way. `stays` is still on its way then.
void PassesAcross(Streets& at, std::uint64_t next_grant, std::uint32_t stays) {
  constexpr double kFor_s = 90.0;
  const std::uint32_t across = at.Next(VehicleKind::kCar), away = at.Track("away"),
                      stood = PieceAt(at.agents[stays].path, at.agents[stays].o_m).track;
  at.Put(across, at.Track("north"), 40.0, at.Track("across"));
  RestoreWith(*at.model, at.agents, next_grant);
  double away_s = -1.0;
  for (int i = 1; i * kStep_s < kFor_s && away_s < 0.0; ++i) {
    at.model->Step(kStep_s, {});
    ASSERT_FALSE(at.AnyTouch()) << i * kStep_s;
    if (at.On(across) == away) away_s = i * kStep_s;
  }
  EXPECT_GT(away_s, 0.0);
  EXPECT_EQ(at.On(stays), stood);
}

// Two of which the first one follows a bus that merges in before it: the room that the bus takes up is not there for
// the second one, although the bus is not on their way yet when it asks.
TEST(Circle, AVehicleThatMergesBeforeTheLeaderTakesItsRoom) {
  constexpr double kStreet_m = 80.0, kRoom_m = 24.0;
  Streets at(
      Crossed({Road("east", {{15.0, 0.0, 0.0, kStreet_m, 0.0}}, From("1")),
               Road("before", {{-1.0, 115.0, -0.5 * kPi, 100.0, 0.0}}, To("1")),
               Road("aside", {{-1.0, -15.0, -0.5 * kPi, 100.0, 0.0}}, From("1"))},
              {{"1", "early", "before", "aside", {-1.0, 15.0, -0.5 * kPi, 30.0, 0.0}}}));  // one that comes from the
                                                                                           // west waits before that way
  const std::uint32_t west = at.Track("west"), south = at.Track("south"), straight = at.Track("straight");
  const std::uint32_t stands = at.Next(VehicleKind::kCar);
  at.PutForGood(stands, at.Track("east"), kRoom_m + at.Length(stands));
  const std::uint32_t bus = at.Next(VehicleKind::kBus);
  at.Put(bus, south, at.LineOf(south, at.Track("right")), at.Track("right"));
  at.agents[bus].waited_s = 60.0;
  at.agents[bus].cap_mps = 2.0;
  const std::uint32_t first = at.Next(VehicleKind::kCar);
  at.Put(first, west, at.LineOf(west, straight), straight);
  const std::uint32_t second = at.Next(VehicleKind::kCar);
  at.Put(second, west, at.LineOf(west, straight) - at.Length(first) - kGap_m, straight);
  PassesAcross(at, 1, second);
}

// A vehicle that was granted its zones behind a blocked vehicle does not count as leaving.
TEST(Circle, AVehicleThatIsHeldInItsZonesIsNotCountedOn) {
  constexpr double kStreet_m = 5.0, kEast_m = 15.0 + kStreet_m, kUp_m = kEast_m + 4.0;
  Streets at(Crossed({Road("east", {{15.0, 0.0, 0.0, kStreet_m, 0.0}}, From("1") + To("2")),
                      Road("beyond", {{kEast_m + 30.0, 0.0, 0.0, 200.0, 0.0}}, From("2")),
                      Road("below", {{kUp_m, -115.0, 0.5 * kPi, 100.0, 0.0}}, To("2")),
                      Road("above", {{kUp_m, 15.0, 0.5 * kPi, 100.0, 0.0}}, From("2"))},
                     {{"2", "on", "east", "beyond", {kEast_m, 0.0, 0.0, 30.0, 0.0}},
                      {"2", "up", "below", "above", {kUp_m, -15.0, 0.5 * kPi, 30.0, 0.0}}}));
  const std::uint32_t east = at.Track("east"), west = at.Track("west"), below = at.Track("below"), on = at.Track("on"),
                      up = at.Track("up");
  const std::uint32_t in_the_way = at.Next(VehicleKind::kCar);
  const double rear = 12.0;  // from where the way up begins, in the way of one that goes on
  at.Put(in_the_way, below, at.LengthOf(below) + rear + at.Length(in_the_way), up);
  at.Let(in_the_way, below, up, 1);
  const std::uint32_t stands = at.Next(VehicleKind::kCar);
  at.PutForGood(stands, up, rear + at.Length(in_the_way) + kGap_m + at.Length(stands));
  const std::uint32_t kept = at.Next(VehicleKind::kCar);
  at.Put(kept, east, at.LineOf(east, on), on);
  at.Let(kept, east, on, 2);
  const std::uint32_t comes = at.Next(VehicleKind::kCar);
  at.Put(comes, west, at.LineOf(west, at.Track("straight")), at.Track("straight"));
  PassesAcross(at, 3, comes);
}

}  // namespace
}  // namespace rodeira::traffic
