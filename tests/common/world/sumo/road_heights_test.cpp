// SPDX-License-Identifier: Apache-2.0
// Roads on a ground with a formula as its height: the right answer is the formula, and that no wheel feels a step.
#include "common/world/sumo/road_heights.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "common/core/base/files.hpp"
#include "common/core/base/temporary_folder.hpp"
#include "common/world/lanes/graph.hpp"
#include "common/world/opendrive/import.hpp"
#include "common/world/sumo/import_file.hpp"
#include "common/world/terrain/elevation_file.hpp"

namespace rodeira::sumo {
namespace {

class RoadHeightsTest : public testing::Test {
 protected:
  void SetUp() override {
    if (std::system("command -v netconvert netgenerate > /dev/null 2>&1") != 0)
      GTEST_SKIP() << "SUMO's netconvert is not installed";
    const std::string command = "cd " + folder_.path().string() +
                                " && SUMO_HOME=/usr/share/sumo netgenerate --grid --grid.number 3 --grid.length 220 "
                                "--grid.attach-length 180 --seed 5 --no-turnarounds -o own.net.xml > log 2>&1";
    ASSERT_EQ(std::system(command.c_str()), 0);
    const auto imported = ImportFile({folder_.path() / "own.net.xml", File(), {}, {}});
    ASSERT_TRUE(imported) << imported.error().Text();
    drive_ = imported.value().drive;
    flat_ = opendrive::Read(drive_, File()).value().network;
  }
  std::filesystem::path File() const { return folder_.path() / "it.xodr"; }
  std::shared_ptr<const network::Network> On(const GroundHeight& ground) const {
    const auto heights = HeightsOf(*flat_, ground);
    EXPECT_TRUE(heights.ok());
    const auto import = opendrive::Read(WithHeights(drive_, heights.value()), File());
    EXPECT_TRUE(import.ok() && import.value().errors.empty());
    return import.value().network;
  }

  base::TemporaryFolder folder_ = std::move(base::TemporaryFolder::Make("heights-test")).value();
  std::string drive_;
  std::shared_ptr<const network::Network> flat_;
};

// Every way of a lane into the next one: no step, and no kink of the grade.
void ExpectSmooth(const network::Network& network) {
  const lanes::Graph graph(network);
  int links = 0;
  for (const lanes::Track& track : graph.tracks()) {
    for (const lanes::Link& link : track.next) {
      const auto &end = track.curve.nodes().back(), &begin = graph[link.to].curve.nodes().front();
      EXPECT_NEAR(end.p_W.z(), begin.p_W.z(), 1e-3) << network.roads()[track.lane.road].spec().name;
      EXPECT_NEAR(end.along_W.z(), begin.along_W.z(), 2e-3) << network.roads()[track.lane.road].spec().name;
      ++links;
    }
  }
  EXPECT_GT(links, 100);
}

TEST_F(RoadHeightsTest, FollowsAHillWithoutAStep) {
  const auto hill = [](const Eigen::Vector2d& p) {
    return 100.0 + 6.0 * std::sin(p.x() / 110.0) * std::cos(p.y() / 140.0);
  };
  const auto network = On([&](const Eigen::Vector2d& p) { return std::optional(hill(p)); });
  ExpectSmooth(*network);
  // In the middle of roads 60 m from their junctions: the ground, less what averaging over 24 m takes of it.
  int compared = 0;
  for (const network::Road& road : network->roads()) {
    if (!road.spec().junction.empty() || road.length_m() < 140.0) continue;
    for (double s = 65.0; s < road.length_m() - 65.0; s += 3.0) {
      const network::SurfaceSample sample = road.Surface(s, -1.6);
      EXPECT_NEAR(sample.p_W.z(), hill(road.axis().Evaluate(s).p_W), 0.15) << road.spec().name << " at " << s;
      EXPECT_LT(std::fabs(sample.ds_W.z()), 0.08);
      ++compared;
    }
  }
  EXPECT_GT(compared, 300);
}

// A cliff of 30 m between junctions 220 m apart, at x 180 and 400: 13.6 % in the mean, which junctions move to 10 %.
TEST_F(RoadHeightsTest, MovesJunctionsWhereARoadWouldBeTooSteep) {
  const auto cliff = [](const Eigen::Vector2d& p) { return p.x() > 290.0 ? 30.0 : 0.0; };
  const auto network = On([&](const Eigen::Vector2d& p) { return std::optional(cliff(p)); });
  ExpectSmooth(*network);
  double steepest = 0.0;
  for (const network::Road& road : network->roads()) {
    if (!road.spec().junction.empty() || !road.spec().predecessor || !road.spec().successor) continue;
    const double rise = road.Surface(road.length_m(), -1.6).p_W.z() - road.Surface(0.0, -1.6).p_W.z();
    steepest = std::max(steepest, std::fabs(rise) / road.length_m());
  }
  EXPECT_LE(steepest, kMaxGrade + 1e-4);
  EXPECT_GT(steepest, 0.9 * kMaxGrade);
}

TEST_F(RoadHeightsTest, NamesARoadWithoutGround) {
  const auto heights =
      HeightsOf(*flat_, [](const Eigen::Vector2d& p) { return p.x() < 300.0 ? std::optional(5.0) : std::nullopt; });
  ASSERT_FALSE(heights.ok());
  EXPECT_NE(heights.error().message.find("the ground at road '"), std::string::npos) << heights.error().message;
}

// Zone 35 of UTM, of which zone 34 is another projection: the file's metres are not the network's. The ground rises by
// 4 cm a metre to the east of zone 35 from 500 km on, where longitude 27 is.
TEST(RoadHeights, MeetAnElevationFileOfAnotherProjection) {
  if (std::system("command -v netconvert > /dev/null 2>&1") != 0) GTEST_SKIP() << "SUMO's netconvert is not installed";
  const base::TemporaryFolder folder = std::move(base::TemporaryFolder::Make("heights-test")).value();
  const std::filesystem::path map = folder.path() / "a.osm", ground = folder.path() / "ground.asc";
  // Longitude 23.99 lies in zone 34, and the file in zone 35, with its middle at longitude 27.
  ASSERT_TRUE(
      base::WriteWhole(map,
                       "<osm version=\"0.6\"><node id=\"1\" lat=\"60.000\" lon=\"23.990\"/>"
                       "<node id=\"2\" lat=\"60.001\" lon=\"23.998\"/>"
                       "<way id=\"9\"><nd ref=\"1\"/><nd ref=\"2\"/><tag k=\"highway\" v=\"primary\"/></way></osm>")
          .ok());
  // The corner of the raster, about longitude 23.97, latitude 59.99, in zone 35 (PROJ: 331 km, 6653 km).
  constexpr double kWest_m = 330500.0, kCell_m = 25.0;
  constexpr int kColumns = 120, kRows = 160;
  std::string text = "ncols 120\nnrows 160\nxllcorner 330500\nyllcorner 6652500\ncellsize 25\n";
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column)
      text += std::to_string(10.0 + 0.04 * kCell_m * (column + 0.5)) + " ";
    text += "\n";
  }
  ASSERT_TRUE(base::WriteWhole(ground, text).ok());
  ASSERT_TRUE(base::WriteWhole(folder.path() / "ground.prj", terrain::ProjectionWkt("EPSG:32635").value()).ok());
  const auto imported = ImportFile({map, folder.path() / "it.xodr", ground, {}});
  ASSERT_TRUE(imported) << imported.error().Text();
  const auto import = opendrive::Read(imported.value().drive, folder.path() / "it.xodr");
  ASSERT_TRUE(import.ok() && import.value().network != nullptr);
  // By the formulas of the transverse Mercator projection (EPSG guidance note 7-2), the second node lies at this east.
  const double a = 6378137.0, f = 1.0 / 298.257223563, e2 = f * (2.0 - f), k0 = 0.9996;
  const auto east = [&](double latitude_deg, double longitude_deg) {
    const double phi = latitude_deg * M_PI / 180.0, e1 = e2 / (1.0 - e2);
    const double n = a / std::sqrt(1.0 - e2 * std::sin(phi) * std::sin(phi));
    const double t = std::pow(std::tan(phi), 2), c = e1 * std::pow(std::cos(phi), 2);
    const double x = (longitude_deg - 27.0) * M_PI / 180.0 * std::cos(phi);
    return 500000.0 + k0 * n *
                          (x + (1.0 - t + c) * std::pow(x, 3) / 6.0 +
                           (5.0 - 18.0 * t + t * t + 72.0 * c - 58.0 * e1) * std::pow(x, 5) / 120.0);
  };
  int compared = 0;
  for (const network::Road& road : import.value().network->roads()) {
    if (road.spec().name != "9") continue;
    EXPECT_NEAR(road.Surface(0.0, 0.0).p_W.z(), 10.0 + 0.04 * (east(60.000, 23.990) - kWest_m), 0.1);
    EXPECT_NEAR(road.Surface(road.length_m(), 0.0).p_W.z(), 10.0 + 0.04 * (east(60.001, 23.998) - kWest_m), 0.1);
    ++compared;
  }
  EXPECT_EQ(compared, 1);
}

}  // namespace
}  // namespace rodeira::sumo
