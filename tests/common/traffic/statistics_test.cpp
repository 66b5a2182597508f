// Statistics of lanes: Edie's identity, what is conserved, steady flow in closed form, fuel, and what is written.
#include <gdal_priv.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <numbers>
#include <numeric>
#include <optional>
#include <pugixml.hpp>
#include <set>
#include <sstream>

#include "common/traffic/car_of.hpp"
#include "common/traffic/drivetrain.hpp"
#include "common/traffic/floating_cars.hpp"
#include "common/traffic/lane_tables.hpp"
#include "common/traffic/study.hpp"
#include "common/traffic/trajectory_diagram.hpp"
#include "tests/common/lanes/lane_networks.hpp"
#include "tests/common/traffic/identical.hpp"
#include "tests/common/traffic/ring.hpp"

namespace rodeira::traffic {
namespace {

// Planar cars of all kinds: what the tank has lost on a trip is the integral of the flow of engines that turn as is told, to 1e-9; none in overrun, which
// there is, and some wherever the throttle is open.
TEST(PlanarFuel, IsTheIntegralOfItsFlowAndNoneInOverrun) {
  TrafficSettings settings;
  settings.vehicles = 30;
  settings.mix.shares = {0.6, 0.1, 0.2, 0.1};
  TrafficModel model = TrafficModel::Make(settings, lanes::MapNetwork("overpass"), {}).value();
  constexpr double kStep_s = 0.02;
  std::vector<double> burnt_mg(settings.vehicles, 0.0);
  std::vector<std::uint32_t> trips(settings.vehicles, 0);
  int overruns = 0, driven = 0;
  for (int i = 0; i < 6000; ++i) {
    std::vector<bool> was_there;
    for (std::uint32_t id = 0; id < settings.vehicles; ++id) was_there.push_back(model.agent(id).on_road);
    model.Step(kStep_s, {});
    for (std::uint32_t id = 0; id < settings.vehicles; ++id) {
      const Agent& agent = model.agent(id);
      if (!agent.on_road) continue;
      if (!was_there[id] || trips[id] != agent.trip) {  // it has entered in this step, and not driven yet
        trips[id] = agent.trip;
        burnt_mg[id] = 0.0;
        EXPECT_EQ(agent.fuel_mg, 0.0);
        continue;
      }
      const double flow_mgps = FuelFlow_mgps(CarOfBody(model.traits(id).body), agent.driving);
      burnt_mg[id] += flow_mgps * kStep_s;
      ASSERT_NEAR(agent.fuel_mg, burnt_mg[id], 1e-9 * (1.0 + burnt_mg[id])) << id << " at " << i;
      const bool overrun = agent.driving.throttle == 0.0 && agent.driving.clutch == 0.0 && agent.speed_mps > 5.0;
      overruns += overrun ? 1 : 0;
      driven += agent.driving.throttle > 0.0 ? 1 : 0;
      EXPECT_TRUE(!overrun || flow_mgps == 0.0) << id;
      EXPECT_TRUE(agent.driving.throttle == 0.0 || flow_mgps > 0.0) << id;
    }
  }
  EXPECT_GT(overruns, 1000);
  EXPECT_GT(driven, 10000);
}

// In a town where cars come, go and queue: q = k v in every cell to 1e-9; all cells together have the vehicle seconds and the way that
// were there; and nobody comes or goes uncounted.
TEST(LaneStatistics, SumsAreWhatWasDriven) {
  TrafficSettings settings;
  settings.vehicles = 90;
  settings.seed = 7;
  TrafficModel model = TrafficModel::Make(settings, lanes::MapNetwork("town"), {}).value();
  LaneStatistics statistics(model);
  constexpr double kStep_s = 0.02;
  double vehicle_s = 0.0, way_m = 0.0, fuel_mg = 0.0;
  std::vector<double> before(settings.vehicles), before_mg(settings.vehicles);
  std::vector<std::uint32_t> trips(settings.vehicles);
  std::vector<bool> there(settings.vehicles);
  std::int64_t left = 0, entered = 0, began = static_cast<std::int64_t>(model.on_road());
  for (int i = 0; i <= 9000; ++i) {
    if (i > 0) {
      model.Step(kStep_s, {});
      statistics.Add(model, kStep_s);
      if (i % 10 == 0) statistics.LookAtQueues(model);
    }
    for (std::uint32_t id = 0; id < settings.vehicles; ++id) {
      const Agent& agent = model.agent(id);
      const bool same = there[id] && agent.on_road && trips[id] == agent.trip;
      if (i > 0 && there[id] && !same) ++left;
      if (i > 0 && agent.on_road && !same) ++entered;
      if (same) {
        vehicle_s += kStep_s, way_m += agent.o_m - before[id];
        fuel_mg += agent.fuel_mg - before_mg[id];
      }
      there[id] = agent.on_road, trips[id] = agent.trip, before[id] = agent.o_m, before_mg[id] = agent.fuel_mg;
    }
    ASSERT_EQ(statistics.began() + statistics.entered() - statistics.left(), static_cast<std::int64_t>(model.on_road())) << i;
  }
  EXPECT_EQ(statistics.began(), began);
  EXPECT_EQ(statistics.entered(), entered);
  EXPECT_EQ(statistics.left(), left);
  EXPECT_EQ(statistics.there(), static_cast<std::int64_t>(model.on_road()));
  EXPECT_GT(left, 20);
  LaneCell sum;
  int visited = 0;
  for (std::uint32_t track = 0; track < model.graph().tracks().size(); ++track) {
    const double length = statistics.CellLength_m(track);
    for (const LaneCell& cell : statistics.CellsOf(track)) {
      sum.distance_m += cell.distance_m, sum.time_s += cell.time_s, sum.fuel_mg += cell.fuel_mg;
      ASSERT_GE(cell.distance_m, 0.0);
      ASSERT_GE(cell.time_s, 0.0);
      const double q = cell.Flow_vehps(length, 180.0), k = cell.Density_vehpm(length, 180.0);
      ASSERT_NEAR(q, k * cell.Speed_mps(), 1e-9);
      if (cell.time_s > 0.0) ++visited;
    }
  }
  EXPECT_NEAR(sum.time_s, vehicle_s, 1e-9 * vehicle_s);
  EXPECT_NEAR(sum.distance_m, way_m, 1e-9 * way_m);
  EXPECT_NEAR(sum.fuel_mg, fuel_mg, 1e-9 * fuel_mg);
  EXPECT_NEAR(std::accumulate(statistics.fuel_mg().begin(), statistics.fuel_mg().end(), 0.0), fuel_mg, 1e-9 * fuel_mg);
  EXPECT_GT(visited, 1000);
  for (const LaneTrip& trip : statistics.trips()) EXPECT_GT(trip.took_s, 3.0);
}

// Each cell's time is, within a step a visit, that of the steps at whose ends somebody's middle was in it, on lanes that are changed, in a ring and at merges; and who
// looks in the middle of it all finds as much there, and changes nothing.
TEST(LaneStatistics, EachCellHasItsOwn) {
  constexpr double kStep_s = 0.02;
  for (const char* name : {"ramp", "roundabout", "crossing"}) {
    for (const double cell_m : {1.0, 7.0}) {
      TrafficSettings settings;
      settings.vehicles = 40;
      TrafficModel model = TrafficModel::Make(settings, lanes::MapNetwork(name), {}).value();
      LaneStatistics statistics(model, cell_m), asked(model, cell_m);
      std::vector<std::vector<double>> time_s, visits;
      for (std::uint32_t track = 0; track < model.graph().tracks().size(); ++track) {
        time_s.emplace_back(statistics.CellsOf(track).size(), 0.0);
        visits.emplace_back(statistics.CellsOf(track).size(), 0.0);
      }
      struct Place { std::int64_t trip = -1; std::uint32_t track = 0; std::size_t cell = 0; };
      std::vector<Place> before(settings.vehicles);
      for (int i = 0; i <= 4000; ++i) {
        if (i > 0) model.Step(kStep_s, {}), statistics.Add(model, kStep_s), asked.Add(model, kStep_s);
        for (const AgentPose& pose : model.poses()) {
          const Agent& agent = model.agent(pose.id);
          const Piece& piece = PieceAt(agent.path, agent.o_m);
          const double cell = std::floor((agent.o_m - piece.zero_m) / statistics.CellLength_m(piece.track));
          const Place now{pose.trip, piece.track, static_cast<std::size_t>(std::clamp(cell, 0.0, static_cast<double>(time_s[piece.track].size() - 1)))};
          Place& last = before[pose.id];
          if (last.trip == now.trip) time_s[now.track][now.cell] += kStep_s;
          if (last.trip != now.trip || last.track != now.track || last.cell != now.cell) ++visits[now.track][now.cell];
          last = now;
        }
        if (i % 400 != 200) continue;
        for (std::uint32_t track = 0; track < time_s.size(); ++track) {
          const auto cells = asked.CellsOf(track);
          for (std::size_t cell = 0; cell < cells.size(); ++cell) {
            ASSERT_NEAR(cells[cell].time_s, time_s[track][cell], kStep_s * (visits[track][cell] + 1.0)) << name << " " << track << " " << cell << " after " << i * kStep_s << " s";
          }
        }
      }
      for (std::uint32_t track = 0; track < time_s.size(); ++track) {
        const auto cells = statistics.CellsOf(track), same = asked.CellsOf(track);
        for (std::size_t cell = 0; cell < cells.size(); ++cell) {
          ASSERT_NEAR(cells[cell].time_s, time_s[track][cell], kStep_s * (visits[track][cell] + 1.0)) << name << " " << track << " " << cell;
          ASSERT_NEAR(cells[cell].time_s, same[cell].time_s, 1e-9 * (1.0 + same[cell].time_s));
          ASSERT_NEAR(cells[cell].distance_m, same[cell].distance_m, 1e-9 * (1.0 + same[cell].distance_m));
          ASSERT_NEAR(cells[cell].fuel_mg, same[cell].fuel_mg, 1e-9 * (1.0 + same[cell].fuel_mg));
        }
      }
    }
  }
}

// Thirty cars in equilibrium on a ring: everywhere the density N / L, the speed of the IDM, and their product the flow.
TEST(LaneStatistics, SteadyFlowIsThatOfTheEquilibrium) {
  const TrafficSettings settings = Identical(30, 2.0);
  TrafficModel model = TrafficModel::Make(settings, Ring(1000.0), {}).value();
  for (int i = 0; i < 60000; ++i) model.Step(0.02, {});
  const double speed = EquilibriumOf(model, settings.idm).speed_mps, length_m = model.graph()[0].length_m();
  LaneStatistics statistics(model, 10.0);
  const double round_s = length_m / speed;  // each car comes through each cell as often
  const int steps = static_cast<int>(std::lround(20.0 * round_s / 0.02));
  for (int i = 0; i < steps; ++i) model.Step(0.02, {}), statistics.Add(model, 0.02);
  ASSERT_EQ(statistics.CellsOf(0).size(), static_cast<std::size_t>(std::lround(0.1 * length_m)));
  for (const LaneCell& cell : statistics.CellsOf(0)) {
    const double k = cell.Density_vehpm(statistics.CellLength_m(0), statistics.watched_s()), q = cell.Flow_vehps(statistics.CellLength_m(0), statistics.watched_s());
    EXPECT_NEAR(k, 30.0 / length_m, 0.002 * k);
    EXPECT_NEAR(cell.Speed_mps(), speed, 0.01);
    EXPECT_NEAR(q, 30.0 / length_m * speed, 0.002 * q);
  }
  EXPECT_EQ(statistics.entered(), 0);
  EXPECT_EQ(statistics.left(), 0);
}

// What somebody could drive of whom nobody is in the way: √(a R) on a ring too narrow for its limit, the limit on a wide one.
TEST(LaneStatistics, FreeSpeedIsThatOfBendAndLimit) {
  TrafficSettings settings = Identical(3, 1.4);
  for (const double round_m : {200.0, 2000.0}) {
    const TrafficModel model = TrafficModel::Make(settings, Ring(round_m), {}).value();
    const LaneStatistics statistics(model);
    const double radius = model.graph()[0].length_m() / (2.0 * std::numbers::pi), bend = std::sqrt(settings.speed.lateral_mps2 * radius);
    EXPECT_EQ(bend < kRingLimit_mps, round_m < 1000.0);
    for (std::size_t cell = 0; cell < statistics.CellsOf(0).size(); ++cell) EXPECT_NEAR(statistics.FreeSpeed_mps(0, cell), std::min(bend, kRingLimit_mps), 1e-3) << round_m;
  }
}

// A jam behind a car that stands: cells before it are slow and dense, and the queue is counted.
TEST(LaneStatistics, AQueueIsCounted) {
  TrafficSettings settings = Identical(20, 1.4);
  TrafficModel model = TrafficModel::Make(settings, Ring(600.0), {}).value();
  LaneStatistics statistics(model);
  model.Brake(7, 2.0);
  for (int i = 0; i < 12000; ++i) {
    model.Step(0.01, {});
    statistics.Add(model, 0.01);
    if (i > 11000) statistics.LookAtQueues(model);
  }
  EXPECT_EQ(statistics.LongestQueue(0), 20);
  EXPECT_NEAR(statistics.MeanQueue(0), 20.0, 0.01);
}

// On the straight arms of the crossing, told apart from the model: each step's way from where its car was seen before and is seen now, its fuel from what the car says that it has burnt, shared out
// among the metres between the two places. Every metre of an arm has that distance, time and fuel.
TEST(LaneStatistics, CellsHaveWhatThePosesSay) {
  constexpr double kStep_s = 0.02;
  TrafficSettings settings;
  settings.vehicles = 20;
  TrafficModel model = TrafficModel::Make(settings, lanes::MapNetwork("crossing"), {}).value();
  LaneStatistics statistics(model);
  const lanes::Graph& graph = model.graph();
  std::map<std::pair<std::int32_t, std::int32_t>, std::uint32_t> arms;  // road and lane, and the track
  for (std::uint32_t track = 0; track < graph.tracks().size(); ++track) {
    if (graph[track].curve.straight() && graph[track].length_m() > 50.0) arms[{static_cast<std::int32_t>(graph[track].lane.road), graph[track].lane.lane}] = track;
  }
  ASSERT_EQ(arms.size(), 8u);
  std::map<std::uint32_t, std::vector<LaneCell>> told;
  for (const auto& [lane, track] : arms) told[track].resize(statistics.CellsOf(track).size());
  struct Before { std::int64_t trip = -1; Eigen::Vector2d p_W; double fuel_mg = 0.0; };
  std::vector<Before> before(settings.vehicles);
  const auto look = [&](bool shares) {
    for (const AgentPose& pose : model.poses()) {
      const double fuel_mg = model.agent(pose.id).fuel_mg;
      Before& last = before[pose.id];
      const auto arm = arms.find({pose.road, pose.lane});
      if (shares && last.trip == static_cast<std::int64_t>(pose.trip) && arm != arms.end()) {
        const auto& nodes = graph[arm->second].curve.nodes();
        const Eigen::Vector2d begin = nodes.front().p_W.head<2>(), along = (nodes.back().p_W.head<2>() - begin).normalized();
        const double from = along.dot(last.p_W - begin), to = along.dot(pose.p_WB_W.head<2>() - begin), length = statistics.CellLength_m(arm->second);
        auto& cells = told[arm->second];
        for (std::size_t i = 0; i < cells.size(); ++i) {
          const double low = static_cast<double>(i) * length, high = low + length;
          const double way = std::min(to, high) - std::max(from, low);
          const bool stands = to <= from && to >= low && to < high;
          if (way <= 0.0 && !stands) continue;
          const double share = stands ? 1.0 : way / (to - from);
          cells[i].distance_m += stands ? 0.0 : way;
          cells[i].time_s += share * kStep_s;
          cells[i].fuel_mg += share * (fuel_mg - last.fuel_mg);
        }
      }
      last = {pose.trip, pose.p_WB_W.head<2>(), fuel_mg};
    }
  };
  look(false);
  for (int i = 0; i < 15000; ++i) {
    model.Step(kStep_s, {});
    statistics.Add(model, kStep_s);
    look(true);
  }
  double driven_m = 0.0, burnt_mg = 0.0;
  for (const auto& [track, cells] : told) {
    for (std::size_t i = 3; i + 3 < cells.size(); ++i) {  // not where a step leads from one lane to another
      const LaneCell& cell = statistics.CellsOf(track)[i];
      ASSERT_NEAR(cell.distance_m, cells[i].distance_m, 1e-6 * (1.0 + cells[i].distance_m)) << track << " " << i;
      ASSERT_NEAR(cell.time_s, cells[i].time_s, 1e-6 * (1.0 + cells[i].time_s)) << track << " " << i;
      ASSERT_NEAR(cell.fuel_mg, cells[i].fuel_mg, 1e-6 * (1.0 + cells[i].fuel_mg)) << track << " " << i;
      driven_m += cell.distance_m, burnt_mg += cell.fuel_mg;
    }
  }
  EXPECT_GT(driven_m, 5000.0);
  EXPECT_GT(burnt_mg, 1e5);
}

class Written : public testing::Test {
 protected:
  Written() : model_(TrafficModel::Make(Settings(), lanes::MapNetwork("roundabout"), {}).value()), statistics_(model_) {
    for (int i = 0; i < 3000; ++i) model_.Step(0.02, {}), statistics_.Add(model_, 0.02);
  }
  static TrafficSettings Settings() {
    TrafficSettings settings;
    settings.vehicles = 25;
    return settings;
  }
  TrafficModel model_;
  LaneStatistics statistics_;
};

TEST_F(Written, TheTableHasARowACell) {
  std::istringstream table(LaneTable(model_.graph(), statistics_));
  std::string line;
  std::getline(table, line);
  EXPECT_EQ(line, "road,lane,s_m,x_m,y_m,length_m,flow_vehph,density_vehpkm,speed_mps,fuel_mlpkm,free_mps");
  std::size_t rows = 0, cells = 0;
  while (std::getline(table, line)) ++rows;
  for (std::uint32_t track = 0; track < model_.graph().tracks().size(); ++track) cells += statistics_.CellsOf(track).size();
  EXPECT_EQ(rows, cells);
}

// Read back by GDAL: where it lies, and the vehicle seconds of the whole map.
TEST_F(Written, TheRasterHoldsWhatWasSummed) {
  const auto file = std::filesystem::temp_directory_path() / ("rodeira-heat-" + std::to_string(::getpid()) + ".tif");
  ASSERT_TRUE(WriteHeatRaster(model_.graph(), statistics_, 5.0, file.string()).ok());
  {
    GDALAllRegister();
    const std::unique_ptr<GDALDataset> set(static_cast<GDALDataset*>(GDALOpen(file.c_str(), GA_ReadOnly)));
    ASSERT_NE(set, nullptr);
    ASSERT_EQ(set->GetRasterCount(), 5);
    EXPECT_STREQ(set->GetRasterBand(5)->GetDescription(), "free_mps");
    EXPECT_STREQ(set->GetRasterBand(2)->GetDescription(), "density_vehpkm");
    std::array<double, 6> transform{};
    ASSERT_EQ(set->GetGeoTransform(transform.data()), CE_None);
    EXPECT_EQ(transform[1], 5.0);
    const int columns = set->GetRasterXSize(), rows = set->GetRasterYSize();
    const auto read = [&](int band) {
      std::vector<double> values(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
      EXPECT_EQ(set->GetRasterBand(band)->RasterIO(GF_Read, 0, 0, columns, rows, values.data(), columns, rows, GDT_Float64, 0, 0), CE_None);
      return values;
    };
    const auto flow = read(1), density = read(2), speed = read(3), free = read(5);
    int told = 0;
    for (std::size_t i = 0; i < flow.size(); ++i) {
      if (std::isnan(density[i])) continue;
      ++told;
      EXPECT_NEAR(flow[i], 3.6 * density[i] * speed[i], 1e-3 + 1e-5 * flow[i]);  // vehicles an hour, a kilometre, m/s
      EXPECT_TRUE(free[i] > 2.0 && free[i] < 15.0) << free[i];
    }
    EXPECT_GT(told, 50);
    EXPECT_LT(told, static_cast<int>(flow.size()));
  }
  std::filesystem::remove(file);
  EXPECT_EQ(WriteHeatRaster(model_.graph(), statistics_, 5.0, "/nowhere/x.tif").error().exit_status(), 1);
  EXPECT_EQ(WriteHeatRaster(model_.graph(), statistics_, 1e-3, file.string()).error().exit_status(), 2);
}

TEST_F(Written, FloatingCarsAreThoseOfTheModel) {
  pugi::xml_document document;
  ASSERT_TRUE(document.load_string((FloatingCarsBegin() + FloatingCarsAt(60.0, model_) + FloatingCarsEnd()).c_str()));
  const pugi::xml_node moment = document.child("fcd-export").child("timestep");
  EXPECT_DOUBLE_EQ(moment.attribute("time").as_double(), 60.0);
  auto pose = model_.poses().begin();
  for (const pugi::xml_node vehicle : moment.children("vehicle")) {
    ASSERT_NE(pose, model_.poses().end());
    EXPECT_EQ(std::string(vehicle.attribute("id").value()), std::to_string(pose->id) + "." + std::to_string(pose->trip));
    const double heading = std::atan2(2.0 * (pose->q_WB.w() * pose->q_WB.z() + pose->q_WB.x() * pose->q_WB.y()), 1.0 - 2.0 * (std::pow(pose->q_WB.y(), 2) + std::pow(pose->q_WB.z(), 2)));
    const double angle = vehicle.attribute("angle").as_double() * 3.14159265358979323846 / 180.0;
    EXPECT_NEAR(std::sin(angle), std::cos(heading), 1e-3);  // from north, clockwise
    EXPECT_NEAR(std::cos(angle), std::sin(heading), 1e-3);
    const double half = 0.5 * model_.traits(pose->id).length_m;
    EXPECT_NEAR(vehicle.attribute("x").as_double() - half * std::cos(heading), pose->p_WB_W.x(), 0.02);
    EXPECT_NEAR(vehicle.attribute("speed").as_double(), pose->speed_mps, 0.01);
    ++pose;
  }
  EXPECT_EQ(pose, model_.poses().end());
}

TEST_F(Written, PicturesAreSoundXml) {
  TrajectoryDiagram diagram(0);
  for (int i = 0; i < 50; ++i) model_.Step(0.02, {}), diagram.Add(0.02 * i, model_);
  pugi::xml_document document;
  for (const std::string& svg : {SpeedMap(model_.graph(), statistics_, "a"), diagram.ToSvg(model_.graph(), "b")}) {
    ASSERT_TRUE(document.load_string(svg.c_str()));
    EXPECT_GT(document.child("svg").attribute("width").as_double(), 100.0);
  }
}

// The points of a line of a picture, in its pixels.
std::vector<Eigen::Vector2d> PointsOf(const pugi::xml_node& line) {
  std::istringstream text(line.attribute("points").value());
  std::vector<Eigen::Vector2d> points;
  for (std::string point; text >> point;) {
    const std::size_t comma = point.find(',');
    points.emplace_back(std::stod(point.substr(0, comma)), std::stod(point.substr(comma + 1)));
  }
  return points;
}

// Every cell of the map lies where its lane does, north up, and has the colour of the legend that its mean speed over its limit asks for; grey where nobody was.
TEST_F(Written, TheMapHasTheColoursOfItsLegend) {
  pugi::xml_document document;
  ASSERT_TRUE(document.load_string(SpeedMap(model_.graph(), statistics_, "a").c_str()));
  std::vector<std::string> legend;
  for (const pugi::xml_node box : document.child("svg").children("rect")) {
    if (box.attribute("width").as_double() < 10.0) legend.push_back(box.attribute("fill").value());
  }
  ASSERT_GE(legend.size(), 5u);
  std::set<std::string> seen;
  std::optional<std::pair<Eigen::Vector2d, Eigen::Vector2d>> first;  // in the world, and in the picture
  double scale = 0.0;
  pugi::xml_node line = document.child("svg").child("g").child("polyline");
  std::vector<Eigen::Vector2d> points = PointsOf(line);
  std::size_t at = 0;
  for (std::uint32_t track = 0; track < model_.graph().tracks().size(); ++track) {
    const double length_m = statistics_.CellLength_m(track);
    for (std::size_t i = 0; i < statistics_.CellsOf(track).size(); ++i) {
      const LaneCell& cell = statistics_.CellsOf(track)[i];
      std::string colour = "#d0d0d0";
      if (cell.time_s > 0.0) {
        const double share = cell.distance_m / cell.time_s / model_.graph().SpeedLimit_mps(track, (static_cast<double>(i) + 0.5) * length_m);
        colour = legend[std::min(legend.size() - 1, static_cast<std::size_t>(share * static_cast<double>(legend.size())))];
      }
      ASSERT_TRUE(line);
      EXPECT_EQ(std::string(line.attribute("stroke").value()), colour) << track << " " << i;
      seen.insert(colour);
      ASSERT_LT(at, points.size());
      const Eigen::Vector2d world = model_.graph()[track].curve.At(static_cast<double>(i) * length_m).p_W.head<2>(), pixel = points[at];
      if (!first) first = {world, pixel};
      const Eigen::Vector2d across = world - first->first, moved(pixel.x() - first->second.x(), first->second.y() - pixel.y());
      if (scale == 0.0 && across.norm() > 20.0) scale = moved.norm() / across.norm();
      if (scale > 0.0) {
        EXPECT_LT((moved - scale * across).norm(), 0.3 + 0.02 * scale * across.norm()) << track << " " << i;
      }
      if (++at + 1 < points.size()) continue;
      line = line.next_sibling("polyline"), points = PointsOf(line), at = 0;
    }
  }
  EXPECT_FALSE(line);
  EXPECT_GE(seen.size(), 4u);
}

// A car that stands is a level line of the first colour, one that drives as fast as it may a rising one of the last.
TEST(Diagram, HasTheColoursOfSpeeds) {
  TrafficSettings settings = Identical(2, 1.4);
  const double limit = 20.0;
  TrafficModel model = TrafficModel::Make(settings, Ring(1000.0, limit), {}).value();
  model.Brake(0, 4.0);
  for (int i = 0; i < 3000; ++i) model.Step(0.02, {});
  const std::uint32_t track = model.agent(0).path.back().track;
  TrajectoryDiagram standing(track);
  for (int i = 0; i < 100; ++i) model.Step(0.02, {}), standing.Add(0.02 * i, model);
  pugi::xml_document document;
  ASSERT_TRUE(document.load_string(standing.ToSvg(model.graph(), "b").c_str()));
  bool stands = false;
  for (const pugi::xml_node line : document.child("svg").child("g").children("polyline")) {
    const auto points = PointsOf(line);
    if (std::string(line.attribute("stroke").value()) == "#b2182b" && points.front().y() == points.back().y()) stands = true;
  }
  EXPECT_TRUE(stands);
  model.Release(0);
  for (int i = 0; i < 2000; ++i) model.Step(0.02, {});
  TrajectoryDiagram driving(track);
  std::size_t fast = 0;
  for (int i = 0; i < 500; ++i) {
    model.Step(0.02, {}), driving.Add(0.02 * i, model);
    for (const AgentPose& pose : model.poses()) fast += pose.speed_mps >= 0.8 * limit ? 1 : 0;
  }
  ASSERT_EQ(fast, 1000u);
  ASSERT_TRUE(document.load_string(driving.ToSvg(model.graph(), "b").c_str()));
  int lines = 0;
  for (const pugi::xml_node line : document.child("svg").child("g").children("polyline")) {
    const auto points = PointsOf(line);
    EXPECT_EQ(std::string(line.attribute("stroke").value()), "#2166ac");
    EXPECT_LT(points.back().y(), points.front().y());  // onwards is up
    EXPECT_GT(points.back().x(), points.front().x());
    ++lines;
  }
  EXPECT_GE(lines, 2);
}

}  // namespace
}  // namespace rodeira::traffic
