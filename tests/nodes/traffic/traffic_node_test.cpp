// The colours of traffic lights in a run of one process.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>

#include "common/base/files.hpp"
#include "common/launch/launch.hpp"
#include "common/lockstep/in_process.hpp"
#include "common/network/lights.hpp"
#include "idl/codec.hpp"
#include "idl/messages.hpp"
#include "idl/topics.hpp"
#include "launch/local_nodes.hpp"

namespace rodeira {
namespace {

constexpr const char* kWorld = R"(rodeira: world/2
name: lights
roads:
  - {id: main, start: {x_m: 0, y_m: 0, heading_deg: 0}, axis: [line: {length_m: 300}], z_m: 0, section: {template: rural}, speed_limit_kmh: 50}
  - {id: cross, place: {road: main, s_m: 150, turn_deg: 90, own_s_m: 120}, axis: [line: {length_m: 240}], section: {template: rural}, speed_limit_kmh: 50}
junctions:
  - id: j
    roads: [{road: main, s_m: 150}, {road: cross, s_m: 120}]
    control: lights
    lights: {offset_s: 1, phases: [{green: [main], for_s: 6}, {green: [PHASE], for_s: 5}]}
)";

class Signals : public testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  launch::Launch LaunchOf(const std::string& second_phase) const {
    std::string world = kWorld;
    world.replace(world.find("PHASE"), 5, second_phase);
    EXPECT_TRUE(base::WriteWhole(folder_ / "world.yaml", std::string_view(world)).ok());
    auto launch = launch::Launch::Parse("rodeira: launch/1\nworld: world.yaml\nseed: 5\nnodes:\n  road: {kind: road}\n"
                                        "  others: {kind: traffic, config: {vehicles: 8}}\n",
                                        folder_ / "run.yaml");
    EXPECT_TRUE(launch.ok()) << launch.error().Text();
    return std::move(launch).value();
  }

  const std::filesystem::path folder_ = std::filesystem::temp_directory_path() / ("rodeira-signals-" + std::to_string(::getpid()));
};

// Each sample says the colours of the time at which it is valid, by the program as it is written: from 1 s on 6 s of green for
// the main road, 3 s of amber, 2 s of red for all, then 5 s for the other one; 21 s in all.
TEST_F(Signals, EachSampleSaysTheColoursOfItsTime) {
  const launch::Launch launch = LaunchOf("cross");
  auto nodes = front::LocalNodes::Make(launch);
  ASSERT_TRUE(nodes.ok()) << nodes.error().Text();
  int samples = 0;
  lockstep::InProcessSettings settings;
  settings.last_step = 30000;
  settings.on_sample = [&](const lockstep::Sample& sample) {
    if (launch.roster().source(sample.source()).topic != idl::topics::kSignalsState) return;
    const auto state = idl::Decode<msg::SignalsState>(*sample.payload).value();
    ASSERT_EQ(state.groups().size(), 2u);
    const double t = static_cast<double>(sample.valid()) * 1e-3;
    const auto at = [&](double green_from_s, double green_s) {
      const double u = std::fmod(t - green_from_s + 210.0, 21.0);
      return u < green_s ? 2u : u < green_s + 3.0 ? 3u : u >= 20.0 ? 1u : 0u;
    };
    const double near = std::fabs(std::remainder(t, 1.0));
    if (near > 1e-6) {  // beside the changes
      EXPECT_EQ(state.groups()[0].colour(), at(1.0, 6.0)) << t;
      EXPECT_EQ(state.groups()[1].colour(), at(12.0, 5.0)) << t;
    }
    EXPECT_EQ(state.groups()[0].controller(), "j-main");
    EXPECT_EQ(state.groups()[1].controller(), "j-cross");
    ++samples;
  };
  const auto outcome = lockstep::RunThreaded(launch.roster(), nodes.value().nodes(), settings);
  EXPECT_TRUE(outcome.ok) << outcome.fault;
  EXPECT_GE(samples, 3000);
}

TEST_F(Signals, ConflictingGreensAreRefusedBeforeTheRun) {
  const auto nodes = front::LocalNodes::Make(LaunchOf("cross, main"));
  EXPECT_TRUE(nodes.ok() || nodes.error().exit_status() == 2);
  ASSERT_FALSE(nodes.ok());
  EXPECT_NE(nodes.error().Text().find("j: cross"), std::string::npos) << nodes.error().Text();
  EXPECT_NE(nodes.error().Text().find("j: main"), std::string::npos) << nodes.error().Text();
}

}  // namespace
}  // namespace rodeira
