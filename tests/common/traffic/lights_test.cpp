// SPDX-License-Identifier: Apache-2.0
// Traffic at lights: which cars stop and which go on at amber, none at red, and what a green lets pass.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/traffic/results/study.hpp"
#include "common/world/lanes/lights.hpp"
#include "common/world/road/world.hpp"
#include "tests/common/traffic/demand_road.hpp"
#include "tests/common/traffic/identical.hpp"
#include "tests/common/world/lanes/lane_networks.hpp"
#include "tests/common/world/opendrive/sample.hpp"
#include "tests/tree.hpp"

namespace rodeira::traffic {
namespace {

using network::LightColour;

// Of docs/explanation/traffic.md: a car that can stop so far before the line by braking so hard, which changes by so
// much a second, does.
constexpr double kForAmber_mps2 = 2.9, kBefore_m = 0.6, kJerk_mps3 = 3.0;

// The way of that, in small steps.
double StopsIn(double v, double a) {
  constexpr double kStep_s = 1e-3;
  double way = 0.0;
  while (v > 1e-4) {
    const double wanted = std::max(-kForAmber_mps2, -std::sqrt(2.0 * kJerk_mps3 * v));
    a = std::max(wanted, a - kJerk_mps3 * kStep_s);
    const double next = std::max(0.0, v + a * kStep_s);
    way += 0.5 * (v + next) * kStep_s;
    v = next;
  }
  return way;
}

// The line ahead of a car on the lanes that arrive at the crossing: its distance from the front, and its light.
struct Line {
  double gap_m = 0.0;
  std::uint32_t controller = 0;
};
std::optional<Line> LineAhead(const TrafficModel& model, const AgentPose& pose) {
  const Agent& agent = model.agent(pose.id);
  const double front = agent.o_m + 0.5 * model.traits(pose.id).length_m;
  for (const Piece& piece : agent.path) {
    const auto lights = lanes::LightsOf(model.graph(), piece.track);
    if (!lights.empty() && piece.begin_m <= agent.o_m)
      return Line{piece.zero_m + lights[0].d_m - front, lights[0].controller};
  }
  return std::nullopt;
}

// At the instant at which a light turns amber every car that comes to it is looked at: the motion apart says whether it
// could stop (Gazis, Herman, Maradudin 1960), but for a decimetre. A vehicle that crosses a line is one that could not,
// or does it at green.
TEST(Lights, AtAmberACarStopsIfItCanAndNonePassesAtRed) {
  TrafficSettings settings;
  settings.vehicles = 60;
  settings.seed = 5;
  TrafficModel model = TrafficModel::Make(settings, lanes::MapNetwork("lights"), {}).value();
  std::vector<LightColour> before = model.colours();
  std::vector<double> gaps(settings.vehicles, -1.0);  // to the line ahead, one step ago
  std::vector<int> could(settings.vehicles, -1);      // at the last change to amber: 1 it could stop, 0 it could not
  int at_green = 0, at_amber = 0, stopped = 0;
  for (int i = 0; i < 24000; ++i) {
    model.Step(0.01, {});
    for (const AgentPose& pose : model.poses()) {
      const auto line = LineAhead(model, pose);
      double& gap = gaps[pose.id];
      if (line && gap >= 0.0 && line->gap_m < 0.0) {
        const LightColour colour = before[line->controller];
        ASSERT_TRUE(colour == LightColour::kGreen || colour == LightColour::kAmber)
            << "car " << pose.id << " at " << 0.01 * i << " s";
        if (colour == LightColour::kAmber) {
          ASSERT_EQ(could[pose.id], 0) << "car " << pose.id << " at " << 0.01 * i << " s";
          ++at_amber;
        } else {
          ++at_green;
        }
      }
      if (line && before[line->controller] == LightColour::kGreen &&
          model.colours()[line->controller] == LightColour::kAmber && line->gap_m > 0.0) {
        const double gap_m = line->gap_m - kBefore_m, v = pose.speed_mps;
        could[pose.id] = gap_m > 0.0 && StopsIn(v, pose.acceleration_mps2) < gap_m - 0.1 ? 1 : 0;
        if (could[pose.id] == 1 && v * v > 2.0 * gap_m) ++stopped;
      }
      gap = line ? line->gap_m : -1.0;
    }
    before = model.colours();
  }
  EXPECT_GT(at_green, 40);
  EXPECT_GT(at_amber, 0);
  EXPECT_GT(stopped, 0);
}

// A road of one lane with a light in its middle: green for `green_s` of every 60 s.
std::shared_ptr<const network::Network> Road(double green_s) {
  opendrive::RoadText road;
  road.length = 1200.0;
  road.left = "";
  road.geometry = "<geometry s=\"0\" x=\"0\" y=\"0\" hdg=\"0\" length=\"1200\"><line/></geometry>";
  road.more =
      "<signals><signal s=\"700\" t=\"-4\" id=\"7\" dynamic=\"yes\" orientation=\"+\" zOffset=\"2\" type=\"1000001\" "
      "subtype=\"-1\" "
      "country=\"OpenDRIVE\"/></signals>";
  return opendrive::MustRead(opendrive::Document(
      road.Text() + fmt::format("<controller id=\"1\" name=\"only\"><control signalId=\"7\" type=\"0\"/>"
                                "<userData code=\"rodeira:times\" value=\"60 5 {} 3 1\"/></controller>",
                                green_s)));
}

struct Car {
  double front_m = 0.0, length_m = 0.0, speed_mps = 0.0, acceleration_mps2 = 0.0;  // the line lies at 0
};

// A queue that starts at green, by the IDM integrated here with accelerations that change by 3 m/s³ at most: how many
// pass if it is green for `green_s` and a vehicle that cannot stop at the line then goes on. `passes`: when each front
// passes were it green for ever; `last_mps`: how fast the last one that passes is when green ends.
int PassedBy(std::vector<Car> queue, const driver::IdmSettings& idm, double desired_mps, double green_s,
             std::vector<double>& passes, double& last_mps) {
  constexpr double kStep_s = 0.002;
  passes.assign(queue.size(), 1e9);
  int passed = -1;
  for (int i = 0; i * kStep_s < 80.0; ++i) {
    if (passed < 0 && i * kStep_s >= green_s) {
      passed = 0;
      for (const Car& car : queue) {
        const double gap_m = -kBefore_m - car.front_m;
        if (gap_m < 0.0 || StopsIn(car.speed_mps, car.acceleration_mps2) > gap_m) ++passed, last_mps = car.speed_mps;
      }
    }
    const std::vector<Car> old = queue;
    for (std::size_t n = 0; n < queue.size(); ++n) {
      double interaction = 0.0;
      const double v = old[n].speed_mps;
      if (n > 0) {
        const double wanted =
            idm.min_gap_m +
            std::max(0.0, v * idm.time_gap_s + v * (v - old[n - 1].speed_mps) /
                                                   (2.0 * std::sqrt(idm.acceleration_mps2 * idm.braking_mps2)));
        interaction = std::pow(wanted / (old[n - 1].front_m - old[n - 1].length_m - old[n].front_m), 2);
      }
      const double wanted_mps2 = idm.acceleration_mps2 * (1.0 - std::pow(v / desired_mps, 4) - interaction),
                   before = old[n].acceleration_mps2;
      const double then = std::clamp(wanted_mps2, before - kStep_s * kJerk_mps3, before + kStep_s * kJerk_mps3);
      queue[n].acceleration_mps2 = std::max(then, -std::sqrt(2.0 * kJerk_mps3 * v));  // comes to rest without a jerk
      queue[n].speed_mps = std::max(0.0, v + kStep_s * queue[n].acceleration_mps2);
      queue[n].front_m += kStep_s * queue[n].speed_mps;
      if (passes[n] > 1e8 && queue[n].front_m > 0.0) passes[n] = i * kStep_s;
    }
  }
  return passed;
}

// Webster (1958): an approach carries s g / c: s the saturation flow, g the effective green, which is the green without
// what is lost at the start and with what of amber is used. Here the queue that stands at the beginning of each green
// is taken as it is, and the IDM integrated apart says how many of it pass, within one car in all, and what s and the
// lost time are.
TEST(Lights, CarryWhatWebsterSays) {
  constexpr double kCycle_s = 60.0, kLimit_mps = 50.0 / 3.6, kStep_s = 0.02, kGreenFrom_s = 5.0;
  constexpr int kFrom = 3, kCycles = 5;
  for (const double green_s : {18.0, 30.0}) {
    TrafficSettings settings = Identical(70, 1.4);
    TrafficModel model = TrafficModel::Make(settings, Road(green_s), {}).value();
    std::vector<double> before(settings.vehicles, 1e9);
    int passed = 0, said = 0;
    double webster = 0.0;
    for (int i = 0; i < std::lround((kFrom + kCycles) * kCycle_s / kStep_s); ++i) {
      const double t = i * kStep_s;
      if (t >= kFrom * kCycle_s && std::fabs(std::fmod(t, kCycle_s) - kGreenFrom_s) < 0.5 * kStep_s) {
        std::vector<Car> queue;
        for (const AgentPose& pose : model.poses()) {
          const double length_m = model.traits(pose.id).length_m, front_m = pose.p_WB_W.x() + 0.5 * length_m - 700.0;
          if (front_m < 0.0) queue.push_back({front_m, length_m, pose.speed_mps, pose.acceleration_mps2});
        }
        std::sort(queue.begin(), queue.end(), [](const Car& a, const Car& b) { return a.front_m > b.front_m; });
        ASSERT_GE(queue.size(), 25u);
        std::vector<double> passes;
        double last_mps = 0.0;
        said += PassedBy(queue, settings.idm, kLimit_mps, green_s, passes, last_mps);
        const double flow = 15.0 / (passes[19] - passes[4]), lost_s = passes[4] - 5.0 / flow;
        webster += flow * (green_s - lost_s + StopsIn(last_mps, 0.0) / last_mps);
      }
      model.Step(kStep_s, {});
      for (const AgentPose& pose : model.poses()) {
        const double front = pose.p_WB_W.x() + 0.5 * model.traits(pose.id).length_m;
        if (before[pose.id] <= 700.0 && front > 700.0 && t >= kFrom * kCycle_s) ++passed;
        before[pose.id] = front;
      }
    }
    EXPECT_NEAR(passed, said, 1) << "green " << green_s << " s";
    // Cars are whole: of x that could pass in a cycle those do that are complete.
    EXPECT_LE(passed, webster) << "green " << green_s << " s";
    EXPECT_GE(passed, webster - kCycles) << "green " << green_s << " s";
  }
}

TEST(Lights, RestoredAtAnyColourItGoesOnWithTheSameBits) {
  const auto digest = [](const TrafficModel& model) {
    base::StateWriter writer;
    model.Save(writer);
    return writer.digest();
  };
  TrafficSettings settings;
  settings.vehicles = 30;
  const auto network = lanes::MapNetwork("lights");
  TrafficModel a = TrafficModel::Make(settings, network, {}).value();
  for (int i = 0; i < 2600; ++i) a.Step(0.01, {});  // amber to the east and west
  base::StateWriter writer;
  a.Save(writer);
  TrafficModel b = TrafficModel::Make(settings, network, {}).value();
  base::StateReader reader(writer.bytes());
  b.Restore(reader);
  ASSERT_TRUE(reader.Finish().ok());
  EXPECT_EQ(a.colours(), b.colours());
  EXPECT_EQ(std::count(a.colours().begin(), a.colours().end(), LightColour::kAmber), 2);
  for (int i = 0; i < 2000; ++i) {
    a.Step(0.01, {});
    b.Step(0.01, {});
    if (i % 100 == 0) {
      ASSERT_EQ(digest(a), digest(b)) << i;
    }
  }
  EXPECT_EQ(digest(a), digest(b));
}

// A driver's car that comes from the right towards its red light, and can stop, keeps nobody waiting who has green:
// those drive to the bit as without it.
TEST(Lights, NoCarYieldsToOneThatComesToARedLight) {
  constexpr double kBefore_light_m = 25.0, kGhost_mps = 8.0;
  const auto network = lanes::MapNetwork("lights");
  const lanes::Graph graph(*network);
  std::vector<std::uint32_t> arms;
  for (std::uint32_t track = 0; track < graph.tracks().size(); ++track) {
    if (!lanes::LightsOf(graph, track).empty() && graph[track].entry) arms.push_back(track);
  }
  ASSERT_EQ(arms.size(), 4u);
  const auto ahead = [&](std::uint32_t track) { return graph[track].curve.At(graph[track].length_m()).ahead_W; };
  const auto from_the_right = std::find_if(arms.begin(), arms.end(), [&](std::uint32_t arm) {
    return ahead(arms[0]).x() * ahead(arm).y() - ahead(arms[0]).y() * ahead(arm).x() > 0.9;
  });
  ASSERT_NE(from_the_right, arms.end());
  const auto light = lanes::LightsOf(graph, *from_the_right)[0];
  const lanes::CurvePoint at = graph[*from_the_right].curve.At(light.d_m - kBefore_light_m);
  const driver::Footprint ghost{1'000'000,  at.p_W.x(), at.p_W.y(), std::atan2(at.ahead_W.y(), at.ahead_W.x()),
                                kGhost_mps, 4.4,        1.8};
  TrafficSettings settings;
  settings.vehicles = 30;
  FlowSettings flow;
  flow.lane = network->roads()[graph[arms[0]].lane.road].id() + ":" + std::to_string(graph[arms[0]].lane.lane);
  flow.per_h = {900.0};
  settings.demand.flows = {flow};
  TrafficModel without = TrafficModel::Make(settings, network, {}).value(),
               with = TrafficModel::Make(settings, network, {}).value();
  for (int i = 0; i < 6000; ++i) {
    const bool red = with.colours()[light.controller] == LightColour::kRed;
    without.Step(0.02, {});
    with.Step(0.02, red ? std::span(&ghost, 1) : std::span<const driver::Footprint>());
    ASSERT_EQ(with.poses().size(), without.poses().size()) << i;
    for (std::size_t k = 0; k < with.poses().size(); ++k)
      ASSERT_EQ(with.poses()[k].p_WB_W, without.poses()[k].p_WB_W) << i;
  }
  EXPECT_GT(with.ended(), 5u);
}

TEST(Lights, ConflictingGreensAreRefused) {
  const auto file = traffic_map::LoadMap(std::filesystem::path(SourceDir()) / "configs/maps/lights.motors");
  const auto heights = traffic_map::ParseHeights(
      "rodeira: motors/1\nlights: [{phases: [{green: [1, 3], for_s: 20}, {green: [5, 7], for_s: 9}]}]\n", "x.yaml");
  const auto network =
      traffic_map::ToNetwork(traffic_map::MakeLaneMap(file.value(), heights.value(), "x").value(), "x").value();
  const auto model = TrafficModel::Make({}, network, {});
  ASSERT_FALSE(model.ok());
  EXPECT_EQ(model.error().exit_status(), 2);
  EXPECT_NE(model.error().Text().find("'lane 1'"), std::string::npos) << model.error().Text();
  EXPECT_NE(model.error().Text().find("'lane 3'"), std::string::npos) << model.error().Text();
}

// One lane for left and straight on, against 900 an hour that come the other way and leave no gap in a green. SUMO 1.15
// serves 65 left turns an hour there, one a cycle: here two stand past the line where they are short enough, and turn
// when the oncoming traffic has stopped. They stand there at the end of green, and none crosses at red.
TEST(Lights, TwoThatTurnLeftWaitInsideAndGoWhenOncomingTrafficStops) {
  const auto world = road::World::Load(SourceDir() + "/configs/worlds/lights.yaml").value();
  StudySettings study;
  study.traffic = Settings(
      "routes: {left: [main/1, cross/2], through: [main/1, main/2], oncoming: [main/2, main/1]}\n"
      "flows:\n"
      "  - {lane: 'main/1:-1', vehicles_per_h: 150, route: left}\n"
      "  - {lane: 'main/1:-1', vehicles_per_h: 150, route: through}\n"
      "  - {lane: 'main/2:1', vehicles_per_h: 900, route: oncoming}\n");
  study.duration_s = 3600.0, study.step_s = 0.1;
  std::vector<bool> turns(study.traffic.vehicles, false);
  int left = 0, most_inside = 0;
  const auto watch = [&](const StudyMoment& moment) {
    int inside = 0;
    turns.resize(moment.model.vehicles(), false);
    for (std::uint32_t id = 0; id < moment.model.vehicles(); ++id) {
      const Agent& agent = moment.model.agent(id);
      const bool on_left = agent.on_road && agent.flow == 0;
      left += turns[id] && !on_left ? 1 : 0;
      turns[id] = on_left;
      if (on_left && agent.speed_mps < 0.05 && agent.waits_inside()) ++inside;
    }
    most_inside = std::max(most_inside, inside);
  };
  const StudyResult result = RunStudy(study, world, watch).value();
  EXPECT_GT(left, 80);
  EXPECT_EQ(most_inside, 2);
  EXPECT_EQ(result.reds, 0);
  EXPECT_EQ(result.collisions, 0);
  EXPECT_EQ(result.hurried_steps, 0);
}

}  // namespace
}  // namespace rodeira::traffic
