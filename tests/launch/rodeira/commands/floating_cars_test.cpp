// SPDX-License-Identifier: Apache-2.0
// `rodeira export --fcd` on short runs that are recorded here. The elements are compared with the recorded samples,
// decoded by the types that fastddsgen made.
#include <gmock/gmock.h>

#include <cmath>
#include <map>
#include <numbers>
#include <pugixml.hpp>

#include "common/world/road/world.hpp"
#include "launch/rodeira/commands/export_command.hpp"
#include "tests/launch/rodeira/replay/replay_fixture.hpp"
#include "tests/launch/rodeira/said.hpp"
#include "tests/names.hpp"

namespace rodeira::cli {
namespace {

using ::testing::HasSubstr;

class FloatingCars : public ReplayTest {
 protected:
  std::string Path(const char* name) const { return (folder_.path() / name).string(); }
  static Said Of(const ExportOptions& options) { return SaidBy<ExportOptions>(Export, options); }

  // The elements of each timestep, by hundredths of a second.
  static std::map<long, std::vector<pugi::xml_node>> Timesteps(const pugi::xml_document& file) {
    std::map<long, std::vector<pugi::xml_node>> steps;
    for (const pugi::xml_node step : file.child("fcd-export").children("timestep")) {
      auto& elements = steps[std::lround(100.0 * step.attribute("time").as_double())];
      for (const pugi::xml_node element : step.children()) elements.push_back(element);
    }
    return steps;
  }

  static void ExpectAt(const pugi::xml_node& element, double x, double y, double speed_mps) {
    EXPECT_NEAR(element.attribute("x").as_double(), x, 0.0051);
    EXPECT_NEAR(element.attribute("y").as_double(), y, 0.0051);
    EXPECT_NEAR(element.attribute("speed").as_double(), speed_mps, 0.0051);
  }
};

// The yaw of an attitude, counter-clockwise from east.
double Yaw(const msg::Quaternion& q) {
  return std::atan2(2.0 * (q.x() * q.y() + q.w() * q.z()), 1.0 - 2.0 * (q.y() * q.y() + q.z() * q.z()));
}

TEST_F(FloatingCars, HoldTheRecordedSamples) {
  const std::string drive = Record("drive.mcap", LaunchFile("car_ahead.yaml"), {"--for", "3"});
  ExportOptions options;
  options.recording = drive;
  options.fcd = Path("cars.xml");
  const Said said = Of(options);
  ASSERT_EQ(said.status, 0) << said.errors;
  EXPECT_THAT(said.out, HasSubstr("31 timesteps of 0.1 s"));
  pugi::xml_document file;
  ASSERT_TRUE(file.load_file(options.fcd.c_str()));
  const auto steps = Timesteps(file);
  ASSERT_EQ(steps.size(), 31u);

  const auto run = replay::RecordedRun::Open(drive);
  ASSERT_TRUE(run.ok());
  const auto world = road::World::Load(run.value().launch().world());
  ASSERT_TRUE(world.ok());
  std::set<std::string> roads;
  for (const network::Road& road : world.value()->network()->roads()) roads.insert(road.id());
  int vehicles = 0, agents = 0, on_lanes = 0;
  auto samples = run.value().Samples();
  for (auto next = samples.Next(); next.ok() && next.value(); next = samples.Next()) {
    const auto& sample = *next.value();
    if (sample.valid() % 100 != 0) continue;
    const auto& topic = run.value().roster().source(sample.source()).topic;
    const auto& elements = steps.at(sample.valid() / 10);
    const auto find = [&](const std::string& id) {
      const auto at = std::ranges::find_if(elements, [&](auto node) { return id == node.attribute("id").value(); });
      EXPECT_NE(at, elements.end()) << id;
      return at == elements.end() ? pugi::xml_node() : *at;
    };
    if (topic == idl::topics::kVehicleState) {
      const auto state = idl::Decode<msg::VehicleState>(*sample.payload).value();
      const double yaw = Yaw(state.attitude_wb()), front = static_cast<double>(state.front_m());
      const auto element = find("ego");
      EXPECT_NEAR(element.attribute("x").as_double(), state.position_w_m().x() + front * std::cos(yaw), 0.02);
      EXPECT_NEAR(element.attribute("y").as_double(), state.position_w_m().y() + front * std::sin(yaw), 0.02);
      EXPECT_NEAR(element.attribute("speed").as_double(),
                  std::hypot(state.velocity_w_mps().x(), state.velocity_w_mps().y()), 0.02);
      const double angle = std::numbers::pi / 180.0 * element.attribute("angle").as_double();
      EXPECT_NEAR(std::remainder(angle - (0.5 * std::numbers::pi - yaw), 2.0 * std::numbers::pi), 0.0, 2e-4);
      const std::string lane = element.attribute("lane").value();
      EXPECT_TRUE(roads.contains(lane.substr(0, lane.rfind('_')))) << lane;
      ++vehicles;
    } else if (topic == idl::topics::kTrafficState) {
      const auto state = idl::Decode<msg::TrafficState>(*sample.payload).value();
      EXPECT_EQ(elements.size(), state.agents().size() + 1);
      for (const msg::TrafficAgent& agent : state.agents()) {
        const double heading = static_cast<double>(agent.heading_rad());
        const double half =
            0.5 * static_cast<double>(agent.length_m()) * std::cos(static_cast<double>(agent.pitch_rad()));
        const auto element = find(std::to_string(agent.id()) + "." + std::to_string(agent.trip()));
        ExpectAt(element, agent.position_x_m() + half * std::cos(heading),
                 agent.position_y_m() + half * std::sin(heading), agent.speed_mps());
        on_lanes += std::string(element.attribute("lane").value()).empty() ? 0 : 1;
        ++agents;
      }
    }
  }
  EXPECT_EQ(vehicles, 31);
  EXPECT_GE(agents, 31);
  EXPECT_EQ(on_lanes, agents);
}

// A part of the time at another rate, on a plane without lanes.
TEST_F(FloatingCars, OfAPartOnAPlane) {
  ExportOptions options;
  options.recording = Drive(3.0);
  options.fcd = Path("cars.xml");
  options.rate_hz = 4.0;
  options.from = "1";
  options.to = "+1";
  ASSERT_EQ(Of(options).status, 0);
  pugi::xml_document file;
  ASSERT_TRUE(file.load_file(options.fcd.c_str()));
  std::vector<long> times;
  for (const auto& [time, elements] : Timesteps(file)) {
    times.push_back(time);
    ASSERT_EQ(elements.size(), 1u);
    EXPECT_TRUE(elements[0].attribute("lane").empty());
  }
  EXPECT_EQ(times, (std::vector<long>{100, 125, 150, 175}));

  const Said again = Of(options);
  EXPECT_EQ(again.status, 2);
  EXPECT_THAT(again.errors, HasSubstr("a file of that name is there already"));
  options.fcd = Path("other.xml");
  options.from = "3.5";
  const Said late = Of(options);
  EXPECT_EQ(late.status, 2);
  EXPECT_THAT(late.errors, Names("--from: … 3.5 s … 3.000 s"));
  EXPECT_FALSE(std::filesystem::exists(options.fcd));
  options.from = "mark:begin";
  const Said no_mark = Of(options);
  EXPECT_EQ(no_mark.status, 2);
  EXPECT_THAT(no_mark.errors, HasSubstr("no mark 'begin'"));
  EXPECT_FALSE(std::filesystem::exists(options.fcd));
}

TEST_F(FloatingCars, OfARecordingWithoutVehicles) {
  ExportOptions options;
  options.recording = Record("empty.mcap", LaunchFile("empty.yaml"), {"--for", "0.2"});
  options.fcd = Path("cars.xml");
  const Said said = Of(options);
  EXPECT_EQ(said.status, 2);
  EXPECT_THAT(said.errors, HasSubstr("neither a driven vehicle nor traffic"));
}

}  // namespace
}  // namespace rodeira::cli
