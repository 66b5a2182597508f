// SPDX-License-Identifier: Apache-2.0
// Worlds as OpenDRIVE: read again by the strict rules, they are the same roads; another program reads them too.
#include "common/world/road/world_export.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <map>

#include "common/core/base/files.hpp"
#include "common/core/base/random.hpp"
#include "common/world/opendrive/import.hpp"
#include "common/world/road/network_ground.hpp"
#include "tests/common/world/road/sample_world.hpp"
#include "tests/n222.hpp"

namespace rodeira::road {
namespace {

std::shared_ptr<const World> Of(const char* file) {
  return World::Load(std::filesystem::path(SourceDir()) / "configs/worlds" / file).value();
}

void ExpectTheSameRoad(const World& world, const Version1Road& road) {
  const auto text = ExportOpenDrive(world);
  ASSERT_TRUE(text.ok()) << text.error().Text();
  const auto import = opendrive::Read(text.value(), "export.xodr", opendrive::Tolerance::Strict());
  ASSERT_TRUE(import.ok()) << import.error().Text();
  for (const auto& error : import.value().errors) ADD_FAILURE() << error.Text();
  for (const auto& warning : import.value().warnings) ADD_FAILURE() << warning.Text();
  ASSERT_NE(import.value().network, nullptr);
  const network::Network& network = *import.value().network;
  const LaneGrounds grounds(network, kUsualFriction);
  const NetworkLand land(import.value().network);
  const network::Road& again = network.roads()[0];
  EXPECT_NEAR(again.length_m(), road.length_m(), 1e-9);
  for (std::uint64_t i = 0; i < 3000; ++i) {
    const double s = base::RandomUniform({i, 1}, 0.1, road.length_m() - 0.1);
    const double t =
        base::RandomUniform({i, 2}, road.section().verge_right_m() + 0.01, road.section().verge_left_m() - 0.01);
    const Eigen::Vector3d p = road.Position(s, t);
    EXPECT_NEAR((again.Surface(s, t).p_W - p).norm(), 0.0, 1e-8) << s << " " << t;
    const SurfacePoint ours = world.At(p.x(), p.y()),
                       theirs = NetworkGround(network, grounds, land, kUsualFriction, p.x(), p.y(), p.z());
    EXPECT_NEAR(ours.z_m, theirs.z_m, 1e-8);
    EXPECT_NEAR(ours.slope_x, theirs.slope_x, 1e-8);
    EXPECT_NEAR(ours.slope_y, theirs.slope_y, 1e-8);
    const bool paint = ours.surface == ground::Surface::kRoadMark;
    EXPECT_TRUE(paint || ours.friction == theirs.friction);
    const Lane* lane = road.LaneAt(t);
    const auto place = network.Locate(p.x(), p.y());
    if (lane == nullptr || std::fabs(t - lane->inner_t_m) < 1e-6 || std::fabs(t - lane->outer_t_m) < 1e-6) continue;
    EXPECT_EQ(place->lane.lane, lane->id);
    EXPECT_EQ(network.Find(place->lane)->direction, lane->direction);
    EXPECT_NEAR(*again.SpeedLimitAt(*network.Find(place->lane), s), lane->speed_limit_mps, 1e-12);
  }
}

TEST(WorldExport, N222OfVersion1ComesBack) { ExpectTheSameRoad(*N222OfVersion1(), N222Road()); }
TEST(WorldExport, TheSampleComesBack) { ExpectTheSameRoad(*Sample(), SampleRoad()); }

TEST(WorldExport, MarksStandAtTheNearestEdge) {
  const auto import = opendrive::Read(ExportOpenDrive(*Sample()).value(), "export.xodr").value();
  const network::Road& road = import.network->roads()[0];
  std::size_t lines = 0;
  const auto look = [&](const network::Lane& lane, double edge_t) {
    for (const network::RoadMark& mark : lane.marks) {
      for (const network::MarkLine& line : mark.lines) {
        ++lines;
        const auto ours = std::find_if(SampleRoad().marks().begin(), SampleRoad().marks().end(), [&](const Mark& m) {
          return std::fabs(m.t_m - edge_t - line.t_offset_m) < 1e-9;
        });
        ASSERT_TRUE(ours != SampleRoad().marks().end());
        EXPECT_EQ(line.space_m, ours->gap_m);
      }
    }
  };
  look(road.spec().sections[0].centre, 0.0);
  for (const auto* side : {&road.spec().sections[0].left, &road.spec().sections[0].right}) {
    for (const network::Lane& lane : *side) look(lane, import.network->Span({0, 0, lane.id}, 10.0)->outer_t_m);
  }
  EXPECT_GE(lines, SampleRoad().marks().size());
}

TEST(WorldExport, NothingToExportIsSaid) {
  EXPECT_THAT(ExportOpenDrive(*Of("plane.yaml")).error().Text(),
              testing::HasSubstr("this world has no road; OpenDRIVE needs one"));
}

// The lanes of a side that SUMO keeps, and their mean length in space: SUMO has one length for all lanes of an edge.
double MeanLength(const network::Network& network, std::uint32_t road, bool left) {
  constexpr double kStep_m = 0.5;
  const network::LaneSection& section = network.roads()[road].spec().sections[0];
  double sum = 0.0;
  int lanes = 0;
  for (const network::Lane& lane : left ? section.left : section.right) {
    if (!network::IsDrivable(lane.type)) continue;
    ++lanes;
    const double steps = std::ceil(network.roads()[road].length_m() / kStep_m);
    Eigen::Vector3d before = network.Centre({road, 0, lane.id}, 0.0);
    for (double i = 1.0; i <= steps; i += 1.0) {
      const Eigen::Vector3d next = network.Centre({road, 0, lane.id}, network.roads()[road].length_m() * i / steps);
      sum += (next - before).norm();
      before = next;
    }
  }
  return lanes == 0 ? 0.0 : sum / lanes;
}

// By SUMO's edge, `-ROAD` along s and `ROAD` against it: what its first lane's text says as length.
std::map<std::string, double> LengthsIn(const std::string& net) {
  std::map<std::string, double> lengths;
  for (std::size_t at = net.find("<lane id=\""); at != std::string::npos; at = net.find("<lane id=\"", at + 1)) {
    const std::string id = net.substr(at + 10, net.find('"', at + 10) - at - 10);
    const std::size_t length = net.find("length=\"", at) + 8;
    if (id[0] != ':') lengths[id.substr(0, id.rfind('_'))] = std::strtod(net.c_str() + length, nullptr);
  }
  return lengths;
}

// Roads without junctions: at junctions SUMO cuts its lanes by a shape of its own.
TEST(WorldExport, NetconvertReadsItWithTheSameLanes) {
  if (std::system("command -v netconvert > /dev/null 2>&1") != 0) GTEST_SKIP() << "SUMO's netconvert is not installed";
  const auto folder = std::filesystem::temp_directory_path() / ("rodeira-export-" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  for (const char* name : {"n222.yaml", "motorway.yaml", "flat.yaml"}) {
    const auto world = Of(name);
    ASSERT_TRUE(base::WriteWhole(folder / "it.xodr", std::string_view(ExportOpenDrive(*world).value())).ok());
    const std::string command =
        "cd " + folder.string() +
        " && { [ -n \"$SUMO_HOME\" ] || [ ! -d /usr/share/sumo ] || export SUMO_HOME=/usr/share/sumo; } && netconvert "
        "--opendrive-files it.xodr --output-file it.net.xml > log 2>&1";
    EXPECT_EQ(std::system(command.c_str()), 0) << base::ReadText(folder / "log").value();
    const auto lengths = LengthsIn(base::ReadText(folder / "it.net.xml").value());
    const network::Network& network = *world->network();
    for (std::uint32_t road = 0; road < network.roads().size(); ++road) {
      for (const bool left : {false, true}) {
        const double ours = MeanLength(network, road, left);
        if (ours == 0.0) continue;
        const std::string edge = (left ? "" : "-") + network.roads()[road].id();
        if (lengths.contains(edge + "#0")) continue;  // closed in itself, and split: NetworkExport looks at its parts
        ASSERT_TRUE(lengths.contains(edge)) << edge;
        // Chords of 2 m on bends of 30 m are 2e-4 shorter than the bend.
        EXPECT_NEAR(lengths.at(edge), ours, 2e-4 * ours) << edge;
      }
    }
  }
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace rodeira::road
