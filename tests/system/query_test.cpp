// SPDX-License-Identifier: Apache-2.0
// SUELO as a user asks for it: `rodeira world query`, and the ground under the wheels of a run.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <set>
#include <sstream>

#include "idl/messages.hpp"
#include "idl/topics.hpp"
#include "tests/launch/rodeira/temporary_folder.hpp"
#include "tests/system/command.hpp"
#include "tests/system/recording.hpp"
#include "tests/tree.hpp"

namespace rodeira::system_test {
namespace {

namespace fs = std::filesystem;

const fs::path kRoot = SourceDir();
const std::string kN222 = (kRoot / "configs/worlds/n222.yaml").string();

// The words behind "key: " in the answer.
std::string Value(const std::string& answer, const std::string& key) {
  std::istringstream lines(answer);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with(key + ": ")) return line.substr(key.size() + 2);
  }
  ADD_FAILURE() << "no '" << key << "' in\n" << answer;
  return "nan";
}

struct Point {
  double z_m = 0.0;
  Eigen::Vector3d normal;
};

std::string Query(const std::string& world, double x_m, double y_m) {
  std::ostringstream x, y;
  x.precision(12);
  y.precision(12);
  x << x_m;
  y << y_m;
  const Ended ended = RunCommand({Bin("rodeira"), "world", "query", world, x.str(), y.str()});
  EXPECT_EQ(ended.status, 0) << ended.out;
  return ended.out;
}

Point PointOf(const std::string& answer) {
  Point point;
  point.z_m = std::stod(Value(answer, "z_m"));
  char bracket = 0, comma = 0;
  std::istringstream in(Value(answer, "normal"));
  in >> bracket >> point.normal.x() >> comma >> point.normal.y() >> comma >> point.normal.z();
  return point;
}

// The oracle of the real elevation file: altitude and normal by VTP's own rules (posts, the diagonal from SE to NW).
TEST(Query, OnARealElevationFileItIsTheOraclesPoint) {
  const fs::path crater = kRoot / "../shared/data/road/bt/crater_0513.bt";
  if (!fs::exists(crater)) GTEST_SKIP() << crater << " is not on this machine";
  const cli::TemporaryFolder folder;
  const auto world = folder.Write("crater.yaml", "rodeira: world/1\nname: crater\nterrain: {file: " +
                                                     fs::weakly_canonical(crater).string() + ", surface: soil}\n");
  const std::string answer = Query(world.string(), 566300, 4754000);
  EXPECT_EQ(Value(answer, "inside"), "true");
  EXPECT_NEAR(PointOf(answer).z_m, 2123.4310516, 1e-6);
  EXPECT_NEAR((PointOf(answer).normal - Eigen::Vector3d(-0.191350, -0.176795, 0.965468)).norm(), 0.0, 1e-6);
  EXPECT_EQ(Value(answer, "surface"), "soil");
  EXPECT_EQ(Value(Query(world.string(), 500000, 4754000), "inside"), "false");
}

// N222 begins with a straight under 20 degrees with lanes that fall by 2.5 % to both sides of the axis (its world
// file).
TEST(Query, TheRoadShowsItsCrossfall) {
  const double heading = 20.0 * std::numbers::pi / 180.0;
  const Eigen::Vector2d along(std::cos(heading), std::sin(heading)), left(-along.y(), along.x());
  const auto at = [&](double s_m, double t_m) {
    const Eigen::Vector2d p = Eigen::Vector2d(-1989, -543) + s_m * along + t_m * left;
    return PointOf(Query(kN222, p.x(), p.y()));
  };
  for (const double side : {1.0, -1.0}) {
    const Point inner = at(100.0, side * 0.5), outer = at(100.0, side * 2.5);
    EXPECT_NEAR(outer.z_m - inner.z_m, -0.025 * 2.0, 1e-6) << side;
    EXPECT_NEAR(inner.normal.head<2>().dot(left) / inner.normal.z(), side * 0.025, 1e-6) << side;
    // Along the axis the grade from (0, 120) to (210, 125.7), before its parabola begins at 145.
    EXPECT_NEAR(-inner.normal.head<2>().dot(along) / inner.normal.z(), 5.7 / 210.0, 1e-6) << side;
  }
}

TEST(Query, OutsideTheWorldItSaysSo) {
  const std::string answer = Query(kN222, 1e6, 0);
  EXPECT_EQ(Value(answer, "inside"), "false");
  EXPECT_NE(answer.find("extents_m: "), std::string::npos) << "and where the world lies";
  EXPECT_EQ(answer.find("z_m: "), std::string::npos) << "no altitude is made up:\n" << answer;
}

class Ground : public ::testing::Test {
 protected:
  // Drives a launch file in separate processes or one and gives the car's states.
  std::vector<msg::VehicleState> Drive(const std::string& launch, const std::string& for_s,
                                       std::vector<std::string> more = {}) const {
    const std::string recording = (folder_.path() / "drive.mcap").string();
    more.insert(more.begin(), {Bin("rodeira"), "run", launch, "--for", for_s, "--record", recording});
    const Ended ended = RunCommand(more);
    EXPECT_EQ(ended.status, 0) << ended.out;
    return MessagesOf<msg::VehicleState>(recording, idl::topics::kVehicleState);
  }
  const cli::TemporaryFolder folder_;
};

// The server's answers over DDS, as the wheels of a car that stands in its lane felt them.
// Where a wheel touches the ground, in the world.
Eigen::Vector3d ContactOf(const msg::VehicleState& car, std::size_t wheel) {
  const auto& q = car.attitude_wb();
  const auto& p = car.position_w_m();
  const auto& c = car.wheels()[wheel].contact_b_m();
  return Eigen::Quaterniond(q.w(), q.x(), q.y(), q.z()) * Eigen::Vector3f(c.x(), c.y(), c.z()).cast<double>() +
         Eigen::Vector3d(p.x(), p.y(), p.z());
}

TEST_F(Ground, TheWheelsStandOnTheCrossfallOfTheRoad) {
  const auto states =
      Drive((kRoot / "tests/data/n222_traffic.yaml").string(), "0.1", {"--set", "nodes.traffic.config.vehicles=0"});
  ASSERT_EQ(states.size(), 101u);
  const double heading = 20.0 * std::numbers::pi / 180.0;
  for (std::size_t i = 0; i < 4; ++i) {
    const auto& wheel = states.front().wheels()[i];
    EXPECT_EQ(wheel.in_contact(), 1u);
    const auto& normal = wheel.contact_normal_w();
    const Eigen::Vector3d n = Eigen::Vector3f(normal.x(), normal.y(), normal.z()).cast<double>();
    // Lane -1 lies to the right of the axis and falls to the right: the normal leans to the right.
    EXPECT_NEAR((-std::sin(heading) * n.x() + std::cos(heading) * n.y()) / n.z(), -0.025, 1e-6);
    EXPECT_NEAR(-(std::cos(heading) * n.x() + std::sin(heading) * n.y()) / n.z(), 5.7 / 210.0, 1e-6);
    const Eigen::Vector3d c = ContactOf(states.front(), i);
    EXPECT_NEAR(PointOf(Query(kN222, c.x(), c.y())).z_m, c.z(), 1e-6);
  }
  EXPECT_EQ(states.front().inside_world(), 1u);
}

// How many cars of a closing table asked the server at least once a step of a second.
std::size_t AskersIn(const std::string& table) {
  std::size_t askers = 0;
  std::istringstream lines(table);
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("car")) continue;
    if (std::stoull(line.substr(line.find_last_of(' ') + 1)) >= 1000) ++askers;
  }
  return askers;
}

// Four cars, each a process that asks the one road server for the ground under its wheels at every step, get what each
// finds in one process for itself: no question is answered with another asker's points.
TEST_F(Ground, SeveralClientsOfTheRoadServerAreAnsweredAtOnce) {
  std::string launch = "rodeira: launch/1\nworld: " + kN222 + "\nseed: 3\nnodes:\n  road: {kind: road}\n";
  const std::string standing = (kRoot / "tests/data/full_throttle.csv").string(),
                    car = (kRoot / "configs/vehicles/default.yaml").string();
  const std::vector<Eigen::Vector2d> starts = {
      {-1989, -543}, {-1895, -512}, {-1850, -560}, {-1700, -300}};  // on the road, and in the hills beside it
  for (std::size_t i = 0; i < starts.size(); ++i) {
    launch += fmt::format(
        "  driver{0}: {{kind: input, inputs: {{vehicle_state: [car{0}]}}, config: {{source: script, script: {1}}}}}\n",
        i, standing);
    launch += fmt::format(
        "  car{0}: {{kind: vehicle, inputs: {{controls: [driver{0}]}}, config: {{vehicle: {1}, ground: remote, start: "
        "{{x_m: {2}, y_m: {3}, heading_deg: 20}}}}}}\n",
        i, car, starts[i].x(), starts[i].y());
  }
  launch += "  recorder: {kind: recorder}\n";
  const auto file = folder_.Write("four.yaml", launch);
  const auto samples = [&](const std::string& name, std::vector<std::string> more) {
    const std::string recording = (folder_.path() / name).string();
    more.insert(more.begin(), {Bin("rodeira"), "run", file.string(), "--for", "1", "--record", recording});
    const Ended ended = RunCommand(more);
    EXPECT_EQ(ended.status, 0) << ended.out;
    if (name == "apart.mcap") {
      EXPECT_EQ(AskersIn(ended.out), starts.size()) << ended.out;
    }
    return SamplesOf(recording);
  };
  const auto apart = samples("apart.mcap", {}), together = samples("together.mcap", {"--in-process"});
  EXPECT_GE(apart.size(), 4u * 1001u);
  EXPECT_EQ(FirstDifference(apart, together), "");
  // And it is each car's own ground.
  std::set<double> heights;
  for (std::size_t i = 0; i < starts.size(); ++i) {
    const auto states = MessagesOf<msg::VehicleState>((folder_.path() / "apart.mcap").string(),
                                                      idl::topics::kVehicleState, fmt::format("car{}", i));
    ASSERT_EQ(states.size(), 1001u);
    const Eigen::Vector3d c = ContactOf(states.front(), 0);
    EXPECT_NEAR(PointOf(Query(kN222, c.x(), c.y())).z_m, c.z(), 1e-6) << i;
    heights.insert(c.z());
  }
  EXPECT_EQ(heights.size(), starts.size());
}

// A terrain of 100 m × 100 m; a car drives over its eastern edge.
TEST_F(Ground, BeyondTheTerrainsEdgeTheFlagIsClear) {
  const auto world =
      folder_.Write("small.yaml",
                    "rodeira: world/1\nname: small\nterrain:\n  surface: asphalt\n  generate: {seed: 1, columns: 11, "
                    "rows: 11, spacing_m: 10, west_m: 0, "
                    "south_m: 0, relief: [{wavelength_m: 50, amplitude_m: 0}]}\nstart: {x_m: 60, y_m: 50}\n");
  const auto states =
      Drive(LaunchFile("first_drive.yaml"), "4",
            {"--in-process", "--set", "world=" + world.string(), "--set", "nodes.ego.config.start={speed_mps: 20}"});
  ASSERT_EQ(states.size(), 4001u);
  bool left = false;
  for (const auto& state : states) {
    double foremost = -1e9;
    for (std::size_t i = 0; i < 4; ++i) foremost = std::max(foremost, ContactOf(state, i).x());
    if (foremost < 99.9) {
      EXPECT_EQ(state.inside_world(), left ? 0u : 1u) << state.header().step();
    } else if (foremost > 100.1) {
      EXPECT_EQ(state.inside_world(), 0u) << state.header().step();
      left = true;
    }
    ASSERT_TRUE(std::isfinite(state.position_w_m().z()));
  }
  EXPECT_TRUE(left);
}

}  // namespace
}  // namespace rodeira::system_test
