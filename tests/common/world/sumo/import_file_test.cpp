// SPDX-License-Identifier: Apache-2.0
// Networks of SUMO's own tools, imported. The right answers come from SUMO: what its simulation says of its lights, and
// what stands in its .net.xml.
#include "common/world/sumo/import_file.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <map>
#include <pugixml.hpp>
#include <sstream>
#include <tuple>
#include <utility>
#include <vector>

#include "common/core/base/files.hpp"
#include "common/core/base/temporary_folder.hpp"
#include "common/world/lanes/lights.hpp"
#include "common/world/lanes/right_of_way.hpp"
#include "common/world/lanes/zones.hpp"
#include "common/world/opendrive/import.hpp"
#include "common/world/sumo/read_net.hpp"

namespace rodeira::sumo {
namespace {

using testing::HasSubstr;

class ImportFileTest : public testing::Test {
 protected:
  void SetUp() override {
    if (std::system("command -v netconvert netgenerate sumo > /dev/null 2>&1") != 0)
      GTEST_SKIP() << "SUMO's netconvert is not installed";
  }
  std::filesystem::path File(const std::string& name) const { return folder_.path() / name; }
  void Write(const std::string& name, const std::string& text) const {
    ASSERT_TRUE(base::WriteWhole(File(name), text).ok());
  }
  // Of SUMO's programs, in the test's folder.
  void Run(const std::string& command) const {
    const std::string line = "cd " + folder_.path().string() +
                             " && { [ -n \"$SUMO_HOME\" ] || export SUMO_HOME=/usr/share/sumo; } && " + command +
                             " > log 2>&1";
    ASSERT_EQ(std::system(line.c_str()), 0) << base::ReadText(File("log")).value();
  }
  base::Result<Imported> Import(const std::string& name) const {
    return ImportFile({File(name), File("it.xodr"), {}, {}});
  }
  // The network of the text that an import makes, as a run reads it.
  std::shared_ptr<const network::Network> Network(const Imported& imported) const {
    auto import = opendrive::Read(imported.drive, File("it.xodr"));
    EXPECT_TRUE(import.ok() && import.value().network != nullptr);
    return import.value().network;
  }

 private:
  base::TemporaryFolder folder_ = std::move(base::TemporaryFolder::Make("import-test")).value();
};

// The ways over junctions by what they connect: edges and lanes in SUMO's numbers.
using Way = std::tuple<std::string, std::string, int, int>;

int RightLanesOf(const network::Network& network, std::size_t road) {
  return static_cast<int>(network.roads()[road].spec().sections.front().right.size());
}

std::map<Way, std::uint32_t> WaysOf(const lanes::Graph& graph) {
  std::map<Way, std::uint32_t> ways;
  const network::Network& network = graph.network();
  const auto name = [&](std::uint32_t track) { return network.roads()[graph[track].lane.road].spec().name; };
  const auto number = [&](std::uint32_t track) {
    return RightLanesOf(network, graph[track].lane.road) + graph[track].lane.lane;
  };
  for (std::uint32_t track = 0; track < graph.tracks().size(); ++track) {
    if (graph[track].junction < 0 || graph[track].before.size() != 1 || graph[track].next.size() != 1) continue;
    const std::uint32_t from = graph[track].before.front(), to = graph[track].next.front().to;
    ways[Way(name(from), name(to), number(from), number(to))] = track;
  }
  return ways;
}

// What SUMO says of each of its lights, second by second.
std::map<std::string, std::vector<std::string>> StatesOf(const std::filesystem::path& file) {
  std::map<std::string, std::vector<std::string>> states;
  pugi::xml_document document;
  EXPECT_TRUE(document.load_file(file.c_str()));
  for (const pugi::xml_node& state : document.child("tlsStates").children("tlsState"))
    states[state.attribute("id").value()].emplace_back(state.attribute("state").value());
  return states;
}

// SUMO runs its own network for three minutes. A way that is red or amber there is that here at the same second; one
// that is green there is green here, unless it yields to a green from another side.
TEST_F(ImportFileTest, LightsShowWhatSumoShowsAtTheSameSecond) {
  Run("netgenerate --grid --grid.x-number 3 --grid.y-number 2 --grid.attach-length 150 --default.lanenumber 2 --seed 7 "
      "--default-junction-type traffic_light --tls.left-green.time 6 -o own.net.xml");
  std::string text = base::ReadText(File("own.net.xml")).value();
  int programs = 0;  // each begins at another second
  for (std::size_t at = text.find("offset=\"0\""); at != std::string::npos; at = text.find("offset=\"0\""))
    text.replace(at, 10, fmt::format("offset=\"{}\"", 11 * ++programs));
  Write("own.net.xml", text);
  ASSERT_GE(programs, 4);
  const Net net = ReadNet(File("own.net.xml")).value();
  std::string events = "<additional>";
  for (const auto& [light, program] : net.programs)
    events += "<timedEvent type=\"SaveTLSStates\" source=\"" + light + "\" dest=\"states.xml\"/>";
  Write("events.xml", events + "</additional>");
  Run("sumo -n own.net.xml -a events.xml -b 0 -e 180 --no-step-log");
  const auto states = StatesOf(File("states.xml"));
  ASSERT_EQ(states.size(), static_cast<std::size_t>(programs));

  const auto imported = Import("own.net.xml");
  ASSERT_TRUE(imported) << imported.error().Text();
  const auto network = Network(imported.value());
  const lanes::Graph graph(*network);
  const auto ways = WaysOf(graph);
  std::size_t compared = 0, green = 0, green_there = 0;
  for (const NetConnection& connection : net.connections) {
    const auto way = ways.find(Way(connection.from, connection.to, connection.from_lane, connection.to_lane));
    if (connection.light.empty() || way == ways.end()) continue;
    const auto light = lanes::LightFor(graph, way->second, 0.0);
    ASSERT_TRUE(light) << connection.from << " to " << connection.to;
    const network::LightTimes& times = *network->controllers()[light->controller].times;
    const std::vector<std::string>& there = states.at(connection.light);
    ASSERT_GE(there.size(), 179u);
    for (std::size_t second = 0; second < there.size(); ++second) {
      const char letter = there[second][static_cast<std::size_t>(connection.light_index)];
      const network::LightColour here = network::ColourAt(times, static_cast<std::int64_t>(second) * 1'000'000'000);
      if (letter == 'r' || letter == 's') {
        ASSERT_EQ(here, network::LightColour::kRed) << connection.via << " at " << second << " s";
      }
      if (letter == 'y') {
        ASSERT_NE(here, network::LightColour::kGreen) << connection.via << " at " << second << " s";
      }
      if (letter == 'G') {
        ASSERT_EQ(here, network::LightColour::kGreen) << connection.via << " at " << second << " s";
      }
      green_there += letter == 'g' ? 1 : 0;
      green += letter == 'g' && here == network::LightColour::kGreen ? 1 : 0;
    }
    ++compared;
  }
  EXPECT_GE(compared, 60u);
  EXPECT_GT(green, green_there / 2);
}

// Two junctions of two roads, one with signs and one without: each pair of ways of which SUMO makes one yield has that
// right of way here.
TEST_F(ImportFileTest, RightOfWayIsThatOfTheRequests) {
  for (const char* type : {"priority", "right_before_left", "priority_stop", "allway_stop"}) {
    Run(std::string("netgenerate --grid --grid.number 2 --grid.attach-length 120 --no-turnarounds --seed 3 "
                    "--default-junction-type ") +
        type + " -o own.net.xml");
    const Net net = ReadNet(File("own.net.xml")).value();
    const auto imported = Import("own.net.xml");
    ASSERT_TRUE(imported) << imported.error().Text();
    const auto network = Network(imported.value());
    const lanes::Graph graph(*network);
    const lanes::Zones zones(graph);
    const auto ways = WaysOf(graph);
    std::map<std::uint32_t, const NetConnection*> connections;
    for (const NetConnection& connection : net.connections) {
      const auto way = ways.find(Way(connection.from, connection.to, connection.from_lane, connection.to_lane));
      if (way != ways.end()) connections[way->second] = &connection;
    }
    int compared = 0;
    for (const lanes::Zone& zone : zones.zones()) {
      const auto a = connections.find(zone.track[0]), b = connections.find(zone.track[1]);
      if (zone.kind == lanes::ZoneKind::kDiverge || a == connections.end() || b == connections.end()) continue;
      const NetConnection &one = *a->second, &other = *b->second;
      if (one.junction != other.junction) continue;
      const auto& requests = net.junctions.at(one.junction).requests;
      const bool one_yields = IsSet(requests.at(static_cast<std::size_t>(one.request)).response, other.request);
      const bool other_yields = IsSet(requests.at(static_cast<std::size_t>(other.request)).response, one.request);
      if (one_yields == other_yields) continue;
      EXPECT_EQ(zone.first, one_yields ? 1 : 0) << type << ": " << one.via << " and " << other.via;
      ++compared;
    }
    EXPECT_GE(compared, std::string(type) == "allway_stop" ? 0 : 12) << type;
  }
}

const std::string kBusNodes =
    "<nodes><node id=\"w\" x=\"0\" y=\"0\"/><node id=\"c\" x=\"210\" y=\"0\"/><node id=\"e\" x=\"400\" y=\"10\"/>"
    "<node id=\"s\" x=\"200\" y=\"-150\"/></nodes>";
const std::string kBusEdges =
    "<edges><edge id=\"in\" from=\"w\" to=\"c\" numLanes=\"4\" priority=\"3\" name=\"Ringstra\xc3\x9f"
    "e\">"
    "<lane index=\"0\" allow=\"pedestrian\"/><lane index=\"1\" allow=\"bus taxi\"/></edge>"
    "<edge id=\"out\" from=\"c\" to=\"e\" numLanes=\"3\" priority=\"3\"><lane index=\"0\" "
    "disallow=\"passenger\"/></edge>"
    "<edge id=\"side\" from=\"s\" to=\"c\" numLanes=\"1\" priority=\"1\"/></edges>";

// A lane of the network that is driven, by its edge's name and SUMO's number.
bool IsDriven(const lanes::Graph& graph, const std::string& edge, int number) {
  for (const lanes::Track& track : graph.tracks()) {
    if (graph.network().roads()[track.lane.road].spec().name == edge &&
        RightLanesOf(graph.network(), track.lane.road) + track.lane.lane == number)
      return true;
  }
  return false;
}

// What the edges above say: the outer lanes are for people on foot, buses, and all but cars.
TEST_F(ImportFileTest, LanesThatCarsMayNotUseAreNotDriven) {
  Write("own.nod.xml", kBusNodes);
  Write("own.edg.xml", kBusEdges);
  Run("netconvert -n own.nod.xml -e own.edg.xml --output.street-names true -o own.net.xml");
  const auto imported = Import("own.net.xml");
  ASSERT_TRUE(imported) << imported.error().Text();
  EXPECT_THAT(imported.value().table, HasSubstr("lanes closed to cars: 3\n"));
  const auto network = Network(imported.value());
  const lanes::Graph graph(*network);
  for (const auto& [edge, lane, driven] :
       {std::tuple("in", 0, false), std::tuple("in", 1, false), std::tuple("in", 2, true), std::tuple("in", 3, true),
        std::tuple("out", 0, false), std::tuple("out", 1, true), std::tuple("out", 2, true),
        std::tuple("side", 0, true)})
    EXPECT_EQ(IsDriven(graph, edge, lane), driven) << edge << " " << lane;
  // A way from or to such a lane is none either.
  ASSERT_FALSE(graph.tracks().empty());
  for (const lanes::Track& track : graph.tracks()) {
    const auto& lane = *network->Find(track.lane);
    EXPECT_TRUE(network::OpenToCars(lane)) << network->roads()[track.lane.road].spec().name;
  }
  EXPECT_THAT(imported.value().drive, HasSubstr("code=\"sumo:street\" value=\"Ringstra\xc3\x9f"
                                                "e\""));
  // The side road gives way, the ring road has priority (netconvert's own states: m and M).
  EXPECT_THAT(imported.value().drive, HasSubstr("id=\"side sign\" name=\"give way\""));
  EXPECT_THAT(imported.value().drive, HasSubstr("id=\"in sign\" name=\"priority\""));
}

// A network of a newer SUMO, with classes of vehicles that this one does not know: the lanes are for the others as
// before.
TEST_F(ImportFileTest, ForgetsClassesOfANewerSumo) {
  Write("own.nod.xml", kBusNodes);
  Write("own.edg.xml", kBusEdges);
  Run("netconvert -n own.nod.xml -e own.edg.xml -o own.net.xml");
  std::string text = base::ReadText(File("own.net.xml")).value();
  const auto replace = [&](const std::string& from, const std::string& to) {
    ASSERT_NE(text.find(from), std::string::npos) << from;
    for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
      text.replace(at, from.size(), to);
  };
  const auto before = Import("own.net.xml");
  ASSERT_TRUE(before) << before.error().Text();
  replace("disallow=\"passenger\"", "disallow=\"hovercraft passenger container\"");
  replace("allow=\"pedestrian\"", "allow=\"hovercraft\"");
  Write("newer.net.xml", text);
  const auto newer = Import("newer.net.xml");
  ASSERT_TRUE(newer) << newer.error().Text();
  EXPECT_THAT(newer.value().table, HasSubstr("lanes closed to cars: 3\n"));
  const auto network = Network(newer.value());
  EXPECT_FALSE(IsDriven(lanes::Graph(*network), "in", 0));  // for a class without a vehicle
  EXPECT_TRUE(IsDriven(lanes::Graph(*network), "in", 2));
}

// The middles of SUMO's own lanes outside of junctions, at half their length.
std::map<std::pair<std::string, int>, Eigen::Vector2d> MiddlesOf(const std::filesystem::path& file) {
  std::map<std::pair<std::string, int>, Eigen::Vector2d> middles;
  pugi::xml_document document;
  EXPECT_TRUE(document.load_file(file.c_str()));
  for (const pugi::xml_node& edge : document.child("net").children("edge")) {
    if (edge.attribute("function")) continue;
    for (const pugi::xml_node& lane : edge.children("lane")) {
      std::istringstream shape(lane.attribute("shape").value());
      std::vector<Eigen::Vector2d> points;
      double x = 0.0, y = 0.0;
      for (char comma = 0; shape >> x >> comma >> y;) points.emplace_back(x, y);
      EXPECT_EQ(points.size(), 2u) << "a straight grid";
      middles[{edge.attribute("id").value(), lane.attribute("index").as_int()}] =
          0.5 * (points.front() + points.back());
    }
  }
  return middles;
}

TEST_F(ImportFileTest, LeftHandTrafficKeepsToTheLeftOnSumosOwnLanes) {
  Run("netgenerate --grid --grid.x-number 3 --grid.y-number 2 --grid.attach-length 150 --default.lanenumber 2 --seed 7 "
      "--lefthand -o own.net.xml");
  const Net net = ReadNet(File("own.net.xml")).value();
  const auto imported = Import("own.net.xml");
  ASSERT_TRUE(imported) << imported.error().Text();
  const auto network = Network(imported.value());
  EXPECT_GT(opendrive::ReachOf(*network).share(), 0.999)
      << imported.value().table << testing::PrintToString(imported.value().warnings);
  std::map<std::string, std::uint32_t> road_of;
  for (std::uint32_t road = 0; road < network->roads().size(); ++road) {
    EXPECT_TRUE(network->roads()[road].spec().left_hand);
    EXPECT_TRUE(network->roads()[road].spec().sections.front().right.empty());
    road_of[network->roads()[road].spec().name] = road;
  }
  const auto middles = MiddlesOf(File("own.net.xml"));
  ASSERT_EQ(middles.size(), 68u);
  for (const auto& [lane, middle] : middles) {
    ASSERT_TRUE(road_of.contains(lane.first)) << lane.first;
    const network::Road& road = network->roads()[road_of.at(lane.first)];
    // SUMO counts from the kerb, here the left one; OpenDRIVE from the middle of the road outward.
    const int id = static_cast<int>(road.spec().sections.front().left.size()) - lane.second;
    const network::LaneKey key{road_of.at(lane.first), 0, id};
    EXPECT_GT(network->Find(key)->direction, 0);
    const Eigen::Vector3d p = network->Centre(key, 0.5 * road.length_m());
    EXPECT_NEAR(p.x(), middle.x(), 0.05) << lane.first << "_" << lane.second;
    EXPECT_NEAR(p.y(), middle.y(), 0.05) << lane.first << "_" << lane.second;
  }
  // Every way over a junction that SUMO has, but for turns round.
  const lanes::Graph graph(*network);
  std::size_t ways = 0, found = 0;
  for (const NetConnection& connection : net.connections) {
    if (connection.turns_round) continue;
    ++ways;
    for (std::uint32_t track = 0; track < graph.tracks().size(); ++track) {
      if (graph[track].junction < 0 || graph[track].before.size() != 1 || graph[track].next.size() != 1) continue;
      const auto is = [&](std::uint32_t end, const std::string& edge, int index) {
        const network::LaneKey& key = graph[end].lane;
        const auto& spec = network->roads()[key.road].spec();
        return spec.name == edge && key.lane == static_cast<int>(spec.sections.front().left.size()) - index;
      };
      if (is(graph[track].before.front(), connection.from, connection.from_lane) &&
          is(graph[track].next.front().to, connection.to, connection.to_lane))
        ++found;
    }
  }
  EXPECT_EQ(ways, 96u);
  EXPECT_EQ(found, ways);
}

// The same file gives the same bytes: no date, no path of a temporary folder.
TEST_F(ImportFileTest, GivesTheSameBytesAgain) {
  Run("netgenerate --spider --spider.arm-number 5 --spider.circle-number 2 --seed 11 -o own.net.xml");
  const auto once = Import("own.net.xml"), again = Import("own.net.xml");
  ASSERT_TRUE(once && again) << once.error().Text();
  EXPECT_EQ(once.value().drive, again.value().drive);
  EXPECT_EQ(once.value().drive.find("/tmp"), std::string::npos);
}

}  // namespace
}  // namespace rodeira::sumo
