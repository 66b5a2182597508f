// SPDX-License-Identifier: Apache-2.0
// What `rodeira traffic run` writes, file by file, and which requests it refuses.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cctype>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <pugixml.hpp>
#include <set>
#include <sstream>
#include <vector>

#include "common/core/base/files.hpp"
#include "launch/rodeira/commands/traffic_command.hpp"
#include "tests/common/world/opendrive/sample.hpp"
#include "tests/launch/rodeira/commands/traffic_files_fixture.hpp"

namespace rodeira::cli {
namespace {

using testing::HasSubstr;

TEST_F(TrafficFilesTest, TablesAreThoseOfTheRun) {
  options_.csv = In("out");
  options_.duration_s = 180.0;
  const Said said = RunWith(options_);
  ASSERT_EQ(said.status, 0) << said.errors;
  for (const char* name : {"trajectories.csv", "lanes.csv", "queues.csv", "flows.csv", "trips.csv"})
    EXPECT_THAT(said.out, HasSubstr("wrote            " + In("out") + "/" + name + "\n"));
  // A row a car and half second: what a car goes between two of them is what its speed says.
  const Rows cars = Table(In("out") + "/trajectories.csv",
                          "time_s,car,trip,x_m,y_m,z_m,heading_rad,speed_mps,acceleration_mps2,road,lane,"
                          "length_m,width_m,kind,lamps");
  std::map<std::string, const std::map<std::string, std::string>*> before;
  std::set<std::string> times, ids;
  double way_m = 0.0;
  for (const auto& row : cars) {
    times.insert(row.at("time_s"));
    ids.insert(row.at("car"));
    const auto*& last = before[row.at("car")];
    if (last != nullptr && last->at("trip") == row.at("trip")) {
      const double moved =
          std::hypot(Number(row, "x_m") - Number(*last, "x_m"), Number(row, "y_m") - Number(*last, "y_m"));
      EXPECT_NEAR(Number(row, "time_s") - Number(*last, "time_s"), 0.5, 1e-9);
      EXPECT_NEAR(moved, 0.25 * (Number(row, "speed_mps") + Number(*last, "speed_mps")), 0.15) << row.at("time_s");
      way_m += moved;
    }
    last = &row;
  }
  EXPECT_EQ(times.size(), 361u);
  EXPECT_EQ(ids.size(), 10u);
  // A row a metre of lane: flow = density · speed, and all flows together are the way that was driven.
  const Rows lanes = Table(In("out") + "/lanes.csv", kLanes);
  double flows_m = 0.0, lanes_m = 0.0, fuel_l = 0.0;
  int empty = 0;
  for (const auto& row : lanes) {
    EXPECT_NEAR(Number(row, "length_m"), 1.0, 0.2);
    EXPECT_EQ(row.at("speed_mps").empty(), row.at("density_vehpkm") == "0.000") << row.at("road");  // no car was there
    lanes_m += Number(row, "length_m");
    EXPECT_GT(Number(row, "free_mps"), 2.0);
    if (row.at("speed_mps").empty()) {
      EXPECT_EQ(row.at("fuel_mlpkm"), "");
      EXPECT_EQ(row.at("flow_vehph"), "0.000");
      ++empty;
      continue;
    }
    EXPECT_NEAR(Number(row, "flow_vehph"), 3.6 * Number(row, "density_vehpkm") * Number(row, "speed_mps"),
                0.01 * Number(row, "flow_vehph") + 0.2);
    flows_m += Number(row, "flow_vehph") / 3600.0 * Number(row, "length_m") * options_.duration_s;
    fuel_l += 1e-6 * Number(row, "fuel_mlpkm") * Number(row, "flow_vehph") / 3600.0 * Number(row, "length_m") *
              options_.duration_s;
    EXPECT_LE(Number(row, "speed_mps"),
              1.001 * Number(row, "free_mps") + 0.5);  // no car here drives faster than the plan
  }
  EXPECT_GT(empty, 0);
  // The closing table: those that were there, came and left add up to those that are there; the fuel is that of the
  // table, but for what an idling engine burns at rest.
  const auto told = [&](const char* name) {
    std::istringstream line(said.out.substr(said.out.find(std::string("\n") + name) + 18));
    std::vector<double> numbers;
    for (std::string word; line >> word && word.find("l/100") == std::string::npos && numbers.size() < 3;) {
      if (std::isdigit(static_cast<unsigned char>(word[0])) != 0) numbers.push_back(std::stod(word));
    }
    return numbers;
  };
  const auto there = told("entered, left    "), fuel = told("fuel             ");
  ASSERT_EQ(there.size(), 3u);
  ASSERT_EQ(fuel.size(), 2u);
  EXPECT_EQ(there[2] + there[0] - there[1], std::stod(said.out.substr(17)));
  EXPECT_GT(there[1], 0.0);
  EXPECT_GT(fuel[0], 0.05);
  EXPECT_NEAR(fuel_l, fuel[0], 0.03 * fuel[0]);
  EXPECT_NEAR(fuel[1], 100.0 * fuel[0] / (1e-3 * flows_m), 0.02 * fuel[1]);
  EXPECT_NEAR(flows_m, way_m,
              0.05 * way_m);  // the table's rows miss what is driven from the last half second to a lane's end
  const Rows queues = Table(In("out") + "/queues.csv", "road,lane,length_m,queue_longest,queue_mean");
  double queues_m = 0.0;
  for (const auto& row : queues) {
    queues_m += Number(row, "length_m");
    EXPECT_GE(Number(row, "queue_longest"), Number(row, "queue_mean"));
  }
  EXPECT_EQ(queues.size(), 19u);
  EXPECT_NEAR(queues_m, lanes_m, 0.2);
  // The cars that came onto each lane and left it: as many are there as the last rows of the cars say, and as many came
  // into the network and left it as the closing table does.
  std::map<std::string, double> last_on, there_on;
  for (const auto& row : cars) {
    if (row.at("time_s") == "180.00") last_on[row.at("road")] += 1.0;
  }
  double balance = 0.0;
  for (const auto& row : Table(In("out") + "/flows.csv", "road,section,lane,began,in,out,there")) {
    EXPECT_EQ(Number(row, "began") + Number(row, "in") - Number(row, "out"), Number(row, "there"));
    there_on[row.at("road")] += Number(row, "there");
    balance += Number(row, "in") - Number(row, "out");
  }
  for (const auto& [road, cars_there] : there_on) EXPECT_EQ(cars_there, last_on[road]) << road;
  EXPECT_EQ(balance, there[0] - there[1]);
  const Rows trips = Table(In("out") + "/trips.csv", kTrips);
  std::map<std::pair<std::string, std::string>,
           std::pair<const std::map<std::string, std::string>*, const std::map<std::string, std::string>*>>
      ways;  // first and last row of each
  for (const auto& row : cars) {
    auto& way = ways[{row.at("car"), row.at("trip")}];
    if (way.first == nullptr) way.first = &row;
    way.second = &row;
  }
  EXPECT_GT(trips.size(), 0u);
  const std::string ended = said.out.substr(0, said.out.find(" trips ended"));
  EXPECT_LE(trips.size(),
            std::stoul(ended.substr(ended.rfind(' ') + 1)));  // those that began on the way have no whole time
  for (const auto& row : trips) {
    EXPECT_GT(Number(row, "travel_time_s"), 1.0);
    EXPECT_GT(Number(row, "fuel_ml"), 0.1);
    EXPECT_GT(Number(row, "delay_s"),
              -0.05 * Number(row, "travel_time_s"));  // no car is faster than the free speeds of its way, but where
                                                      // they change within a metre
    EXPECT_LT(Number(row, "delay_s"), 0.5 * Number(row, "travel_time_s"));
    EXPECT_EQ(row.at("flow"), "");
    EXPECT_TRUE(row.at("kind") == "car" || row.at("kind") == "van") << row.at("kind");
    int found = 0;
    for (const auto& [key, way] :
         ways) {  // its first row is at most half a second after it entered, its last one as long before it left
      const double first = Number(*way.first, "time_s"), last = Number(*way.second, "time_s"),
                   entered = Number(row, "entered_s"), left = entered + Number(row, "travel_time_s");
      if (key.first != row.at("vehicle") || first < entered - 1e-6 || first > entered + 0.51 || last > left + 1e-6 ||
          last < left - 0.51)
        continue;
      ++found;
      EXPECT_EQ(row.at("from"), way.first->at("road") + ":" + way.first->at("lane"));
      EXPECT_EQ(row.at("to"), way.second->at("road") + ":" + way.second->at("lane"));
    }
    EXPECT_EQ(found, 1) << row.at("vehicle") << " at " << row.at("entered_s");
  }
}

// The stretches of time follow one another from where the tables begin to the end, the last one shorter, and together
// they are the whole tables.
TEST_F(TrafficFilesTest, IntervalsAddUpToTheTables) {
  options_.csv = In("out");
  options_.duration_s = 150.0, options_.warm_s = 30.0, options_.every_s = 50.0;
  const Said said = RunWith(options_);
  ASSERT_EQ(said.status, 0) << said.errors;
  std::set<std::pair<std::string, std::string>> times;
  std::map<std::string, double> in, out, way_m, longest;
  for (const auto& row : Table(In("out") + "/intervals.csv", kIntervals)) {
    times.emplace(row.at("from_s"), row.at("to_s"));
    const std::string& road = row.at("road");
    in[road] += Number(row, "in"), out[road] += Number(row, "out");
    way_m[road] +=
        Number(row, "flow_vehph") / 3600.0 * (Number(row, "to_s") - Number(row, "from_s"));  // a metre of lane
    longest[road] = std::max(longest[road], Number(row, "queue_longest"));
    EXPECT_LE(Number(row, "queue_mean"), Number(row, "queue_longest"));
    EXPECT_EQ(row.at("speed_mps").empty(), row.at("density_vehpkm") == "0.000");
  }
  EXPECT_THAT(times, testing::ElementsAre(testing::Pair("130.00", "150.00"), testing::Pair("30.00", "80.00"),
                                          testing::Pair("80.00", "130.00")));
  for (const auto& row : Table(In("out") + "/flows.csv", "road,section,lane,began,in,out,there")) {
    EXPECT_EQ(in[row.at("road")], Number(row, "in")) << row.at("road");
    EXPECT_EQ(out[row.at("road")], Number(row, "out")) << row.at("road");
  }
  for (const auto& row : Table(In("out") + "/queues.csv", "road,lane,length_m,queue_longest,queue_mean"))
    EXPECT_EQ(longest[row.at("road")], Number(row, "queue_longest")) << row.at("road");
  std::map<std::string, double> vehicles;  // m driven, by lanes.csv, over the lane's length
  std::map<std::string, double> length_m;
  for (const auto& row : Table(In("out") + "/lanes.csv", kLanes)) {
    vehicles[row.at("road")] += Number(row, "flow_vehph") / 3600.0 * 120.0 * Number(row, "length_m");
    length_m[row.at("road")] += Number(row, "length_m");
  }
  for (const auto& [road, sum] : vehicles)
    EXPECT_NEAR(way_m[road], sum / length_m[road], 1e-3 * way_m[road] + 1e-3) << road;
  for (const auto& row : Table(In("out") + "/trips.csv", kTrips))
    EXPECT_LE(Number(row, "entered_s") + Number(row, "travel_time_s"), 120.0 + 1e-6);
}

TEST_F(TrafficFilesTest, PicturesAreWholeAndNameTheMap) {
  options_.duration_s = 30.0;
  for (const bool heat : {true, false}) {
    TrafficOptions options = options_;
    (heat ? options.heat : options.diagram) = In("picture.svg");
    const Said said = RunWith(options);
    ASSERT_EQ(said.status, 0) << said.errors;
    EXPECT_THAT(said.out, HasSubstr("wrote            " + In("picture.svg")));
    pugi::xml_document picture;
    ASSERT_TRUE(picture.load_file(In("picture.svg").c_str()));
    EXPECT_THAT(picture.select_node("//text").node().text().get(),
                testing::ContainsRegex(heat ? "a & <b>.motors: 10 vehicles, 30 s$"
                                            : "a & <b>.motors: 10 vehicles, 30 s, [1-9] of them here$"));
    EXPECT_GT(picture.select_nodes("//polyline").size(), heat ? 5u : 0u);
  }
  options_.heat = In("heat.tif");
  ASSERT_EQ(RunWith(options_).status, 0);
  EXPECT_THAT(base::ReadText(In("heat.tif")).value(), testing::StartsWith("II*"));
}

TEST_F(TrafficFilesTest, ADiagramIsOfTheLaneThatIsAskedFor) {
  options_.diagram = In("a.svg");
  options_.lane = "1:-1";
  ASSERT_EQ(RunWith(options_).status, 0);
  TrafficOptions other = options_;
  other.diagram = In("b.svg");
  other.lane = "2:-1";
  ASSERT_EQ(RunWith(other).status, 0);
  EXPECT_NE(base::ReadText(In("a.svg")).value(), base::ReadText(In("b.svg")).value());
}

// Each vehicle at each half second, and SUMO's own tool reads them.
TEST_F(TrafficFilesTest, FloatingCarsAreAsSumoWritesThem) {
  options_.fcd = In("cars.xml");
  options_.csv = In("out");
  ASSERT_EQ(RunWith(options_).status, 0);
  pugi::xml_document document;
  ASSERT_TRUE(document.load_file(options_.fcd.c_str()));
  const Rows cars = Table(In("out") + "/trajectories.csv",
                          "time_s,car,trip,x_m,y_m,z_m,heading_rad,speed_mps,acceleration_mps2,road,lane,"
                          "length_m,width_m,kind,lamps");
  std::size_t i = 0;
  for (const pugi::xml_node step : document.child("fcd-export").children("timestep")) {
    for (const pugi::xml_node car : step.children("vehicle")) {
      ASSERT_LT(i, cars.size());
      const auto& row = cars[i++];
      EXPECT_EQ(step.attribute("time").value(), row.at("time_s"));
      EXPECT_EQ(car.attribute("id").value(), row.at("car") + "." + row.at("trip"));
      EXPECT_NEAR(car.attribute("speed").as_double(), Number(row, "speed_mps"), 0.006);
      EXPECT_EQ(car.attribute("lane").value(), row.at("road") + "_0");
      for (const char* key : {"x", "y", "angle", "pos", "slope", "type"}) EXPECT_TRUE(car.attribute(key)) << key;
    }
  }
  EXPECT_EQ(i, cars.size());
  const char* tool = "/usr/share/sumo/tools/traceExporter.py";
  if (!std::filesystem::exists(tool)) GTEST_SKIP() << "SUMO's traceExporter.py is not installed (package sumo-tools)";
  const std::string command =
      fmt::format("SUMO_HOME=/usr/share/sumo /usr/bin/python3 {} --fcd-input {} --gpx-output {} > {} 2>&1", tool,
                  options_.fcd, In("ways.gpx"), In("said"));
  ASSERT_EQ(std::system(command.c_str()), 0) << base::ReadText(In("said")).value();
  pugi::xml_document ways;
  ASSERT_TRUE(ways.load_file(In("ways.gpx").c_str()));
  EXPECT_EQ(ways.select_nodes("//trkpt").size(), cars.size());
}

// The same trips as trips.csv has, to the 0.1 s in which the run is looked at; SUMO's own tool reads them.
TEST_F(TrafficFilesTest, TripInformationIsAsSumoWritesIt) {
  constexpr double kLook_s = 0.1 + 0.006, kFastest_mps = 40.0;
  options_.tripinfo = In("trips.xml");
  options_.csv = In("out");
  ASSERT_EQ(RunWith(options_).status, 0);
  pugi::xml_document document;
  ASSERT_TRUE(document.load_file(options_.tripinfo.c_str()));
  const Rows trips = Table(In("out") + "/trips.csv", kTrips);
  ASSERT_FALSE(trips.empty());
  std::size_t found = 0;
  for (const pugi::xml_node trip : document.child("tripinfos").children("tripinfo")) {
    const std::string id = trip.attribute("id").value(), vehicle = id.substr(0, id.find('.'));
    for (const auto& row : trips) {
      if (row.at("vehicle") != vehicle ||
          std::fabs(trip.attribute("arrival").as_double() - Number(row, "left_s")) > kLook_s)
        continue;
      ++found;
      EXPECT_NEAR(trip.attribute("depart").as_double(), Number(row, "entered_s"), kLook_s) << id;
      EXPECT_NEAR(trip.attribute("duration").as_double(), Number(row, "travel_time_s"), 2.0 * kLook_s) << id;
      EXPECT_NEAR(trip.attribute("routeLength").as_double(), Number(row, "way_m"), 2.0 * kLook_s * kFastest_mps) << id;
      EXPECT_NEAR(trip.attribute("waitingTime").as_double(), Number(row, "waiting_s"), 0.5) << id;
      EXPECT_EQ(trip.attribute("vType").value(), row.at("kind")) << id;
      EXPECT_EQ(trip.attribute("departLane").value(), row.at("from").substr(0, row.at("from").find(':')) + "_0") << id;
    }
  }
  EXPECT_EQ(found, trips.size());
  const char* tool = "/usr/share/sumo/tools/output/attributeStats.py";
  if (!std::filesystem::exists(tool)) GTEST_SKIP() << "SUMO's attributeStats.py is not installed (package sumo-tools)";
  const std::string command = fmt::format("SUMO_HOME=/usr/share/sumo /usr/bin/python3 {} -a duration {} > {} 2>&1",
                                          tool, options_.tripinfo, In("said"));
  ASSERT_EQ(std::system(command.c_str()), 0) << base::ReadText(In("said")).value();
  EXPECT_THAT(base::ReadText(In("said")).value(), HasSubstr(fmt::format("count {}", trips.size())));
}

// Larger pixels make a map of the same place.
TEST_F(TrafficFilesTest, ThePixelsOfAHeatMapCanBeChosen) {
  options_.duration_s = 10.0;
  std::map<double, std::uintmax_t> bytes;
  for (const double pixel_m : {1.0, 5.0}) {
    options_.pixel_m = pixel_m;
    options_.heat = In("heat.tif");
    ASSERT_EQ(RunWith(options_).status, 0);
    bytes[pixel_m] = std::filesystem::file_size(options_.heat);
  }
  EXPECT_GT(bytes[1.0], 10 * bytes[5.0]);
}

// A road's id may hold what separates cells: it is one cell then.
TEST_F(TrafficFilesTest, NamesOfRoadsAreCells) {
  opendrive::RoadText road;
  road.id = "1,&quot;a&quot;";
  options_.map = In("odd.xodr");
  ASSERT_TRUE(base::WriteWhole(options_.map, opendrive::Document(road.Text())).ok());
  options_.csv = In("out");
  options_.vehicles = 2;
  options_.duration_s = 40.0;
  const Said said = RunWith(options_);
  ASSERT_EQ(said.status, 0) << said.errors;
  const std::string header =
      "time_s,car,trip,x_m,y_m,z_m,heading_rad,speed_mps,acceleration_mps2,road,lane,"
      "length_m,width_m,kind,lamps";
  const std::string id = "1,\"a\"";
  for (const auto& [file, names] :
       std::map<std::string, std::string>{{"trajectories.csv", header},
                                          {"lanes.csv", kLanes},
                                          {"queues.csv", "road,lane,length_m,queue_longest,queue_mean"},
                                          {"flows.csv", "road,section,lane,began,in,out,there"}}) {
    const Rows rows = Table(In("out") + "/" + file, names);
    EXPECT_GT(rows.size(), 0u) << file;
    for (const auto& row : rows) EXPECT_EQ(row.at("road"), id) << file;
  }
  const Rows trips = Table(In("out") + "/trips.csv", kTrips);
  EXPECT_GT(trips.size(), 0u);
  for (const auto& row : trips) EXPECT_EQ(row.at("from").substr(0, row.at("from").rfind(':')), id);
}

}  // namespace
}  // namespace rodeira::cli
