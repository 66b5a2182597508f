// SPDX-License-Identifier: Apache-2.0
// What is written of lanes' statistics: table, raster, floating car data, pictures.
#include <gdal_priv.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <pugixml.hpp>
#include <set>
#include <sstream>
#include <string>

#include "common/traffic/results/floating_cars.hpp"
#include "common/traffic/results/lane_tables.hpp"
#include "common/traffic/results/trajectory_diagram.hpp"
#include "common/world/lanes/floating_car.hpp"
#include "tests/common/traffic/identical.hpp"
#include "tests/common/traffic/ring.hpp"
#include "tests/common/world/lanes/lane_networks.hpp"

namespace rodeira::traffic {
namespace {

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
  for (std::uint32_t track = 0; track < model_.graph().tracks().size(); ++track)
    cells += statistics_.CellsOf(track).size();
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
      EXPECT_EQ(set->GetRasterBand(band)->RasterIO(GF_Read, 0, 0, columns, rows, values.data(), columns, rows,
                                                   GDT_Float64, 0, 0),
                CE_None);
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
  ASSERT_TRUE(document.load_string(
      (std::string(lanes::kFloatingCarsBegin) + FloatingCarsAt(60.0, model_) + std::string(lanes::kFloatingCarsEnd))
          .c_str()));
  const pugi::xml_node moment = document.child("fcd-export").child("timestep");
  EXPECT_DOUBLE_EQ(moment.attribute("time").as_double(), 60.0);
  auto pose = model_.poses().begin();
  for (const pugi::xml_node vehicle : moment.children("vehicle")) {
    ASSERT_NE(pose, model_.poses().end());
    EXPECT_EQ(std::string(vehicle.attribute("id").value()),
              std::to_string(pose->id) + "." + std::to_string(pose->trip));
    const double heading = std::atan2(2.0 * (pose->q_WB.w() * pose->q_WB.z() + pose->q_WB.x() * pose->q_WB.y()),
                                      1.0 - 2.0 * (std::pow(pose->q_WB.y(), 2) + std::pow(pose->q_WB.z(), 2)));
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

// Every cell of the map lies where its lane does, north up, and has the colour of the legend that its mean speed over
// its limit asks for; grey where no vehicle was.
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
        const double share = cell.distance_m / cell.time_s /
                             model_.graph().SpeedLimit_mps(track, (static_cast<double>(i) + 0.5) * length_m);
        colour =
            legend[std::min(legend.size() - 1, static_cast<std::size_t>(share * static_cast<double>(legend.size())))];
      }
      ASSERT_TRUE(line);
      EXPECT_EQ(std::string(line.attribute("stroke").value()), colour) << track << " " << i;
      seen.insert(colour);
      ASSERT_LT(at, points.size());
      const Eigen::Vector2d world = model_.graph()[track].curve.At(static_cast<double>(i) * length_m).p_W.head<2>(),
                            pixel = points[at];
      if (!first) first = {world, pixel};
      const Eigen::Vector2d across = world - first->first,
                            moved(pixel.x() - first->second.x(), first->second.y() - pixel.y());
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
    if (std::string(line.attribute("stroke").value()) == "#b2182b" && points.front().y() == points.back().y())
      stands = true;
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
