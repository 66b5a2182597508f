// SPDX-License-Identifier: Apache-2.0
// What a window asks for becomes events of the run: the car stands elsewhere, the weather changes, and a recording has
// it all.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "common/core/base/files.hpp"
#include "common/core/base/temporary_folder.hpp"
#include "common/driving/scenario/request.hpp"
#include "common/runtime/launch/launch.hpp"
#include "common/runtime/lockstep/in_process.hpp"
#include "common/runtime/replay/recorded_run.hpp"
#include "common/world/road/world.hpp"
#include "idl/codec.hpp"
#include "idl/messages.hpp"
#include "idl/topics.hpp"
#include "launch/rodeira/replay/verify.hpp"
#include "launch/rodeira/run/local_nodes.hpp"
#include "nodes/view/run_connection/ask_place.hpp"
#include "tests/n222.hpp"

namespace rodeira {
namespace {

using lockstep::Step;
namespace topics = idl::topics;

struct Driven {
  lockstep::RunOutcome outcome;
  std::map<Step, std::vector<msg::ScenarioEvent>> events;
  std::map<Step, msg::VehicleState> car;
  std::map<Step, msg::WeatherState> weather;
};

launch::LiveRequest Wire(std::uint32_t number, const scenario::Request& request) {
  return {number, request.name, request.argument, request.x_m, request.y_m, request.value};
}

class Requests : public testing::Test {
 protected:
  // A script's drive on N222; `scenario` is the scenario node's config.
  launch::Launch LaunchOf(const std::string& scenario) const {
    const std::string configs = SourceDir() + "/configs";
    const std::string text = "rodeira: launch/1\nworld: " + configs +
                             "/worlds/n222.yaml\nseed: 5\nnodes:\n  road: {kind: road}\n"
                             "  driver: {kind: input, config: {source: script, script: " +
                             configs +
                             "/scenarios/first_drive.csv}}\n"
                             "  ego: {kind: vehicle, config: {vehicle: " +
                             configs +
                             "/vehicles/default.yaml}}\n"
                             "  others: {kind: traffic, config: {vehicles: 5}}\n"
                             "  story: {kind: scenario, config: " +
                             scenario +
                             "}\n"
                             "  recorder: {kind: recorder, config: {file: \"" +
                             File() + "\"}}\n";
    const auto path = folder_.path() / "requests.yaml";  // the recorder embeds it
    EXPECT_TRUE(base::WriteWhole(path, std::string_view(text)).ok());
    auto launch = launch::Launch::Load(path);
    EXPECT_TRUE(launch.ok()) << launch.error().Text();
    return std::move(launch).value();
  }
  std::string File() const { return (folder_.path() / "run.mcap").string(); }

  // `hands` is called with each of the story's samples, on its thread, before its next activation.
  static Driven Drive(const launch::Launch& launch, Step last,
                      const std::function<void(Step, launch::LiveRequestsSender&)>& hands) {
    launch::RunLogBoard log;
    auto nodes = cli::LocalNodes::Make(launch, {}, &log);
    EXPECT_TRUE(nodes.ok()) << nodes.error().Text();
    const auto window = nodes.value().requests().MakeSender();
    Driven run;
    lockstep::InProcessSettings settings;
    settings.last_step = last;
    settings.on_log = [&log](const lockstep::LogBatch& batch) { log.Say(batch); };
    settings.on_sample = [&](const lockstep::Sample& sample) {
      const auto& topic = launch.roster().source(sample.source()).topic;
      if (topic == topics::kScenarioEvents) {
        const auto events = idl::Decode<msg::ScenarioEvents>(*sample.payload).value();
        if (!events.events().empty()) run.events[sample.valid()] = events.events();
        if (hands) hands(sample.valid(), *window);
      } else if (topic == topics::kVehicleState) {
        run.car[sample.valid()] = idl::Decode<msg::VehicleState>(*sample.payload).value();
      } else if (topic == topics::kWeatherState) {
        run.weather[sample.valid()] = idl::Decode<msg::WeatherState>(*sample.payload).value();
      }
    };
    run.outcome = lockstep::RunThreaded(launch.roster(), nodes.value().nodes(), settings);
    EXPECT_TRUE(run.outcome.ok) << run.outcome.fault;
    return run;
  }
  void ExpectIdenticalFrom(std::initializer_list<Step> steps) const {
    const auto run = replay::RecordedRun::Open(File());
    ASSERT_TRUE(run.ok()) << run.error().Text();
    for (const Step from : steps) {
      const auto verdict = cli::Verify(run.value(), from);
      ASSERT_TRUE(verdict.ok()) << verdict.error().Text();
      EXPECT_FALSE(verdict.value().difference.has_value()) << verdict.value().difference->Text();
      EXPECT_EQ(verdict.value().substituted, std::vector<std::string>{"story"});
    }
  }

  base::TemporaryFolder folder_ = base::TemporaryFolder::Make("requests").value();
};

double HeadingOf(const msg::VehicleState& car) {
  const auto& q = car.attitude_wb();
  return std::atan2(2.0 * (q.w() * q.z() + q.x() * q.y()), 1.0 - 2.0 * (q.y() * q.y() + q.z() * q.z()));
}

// Asked twice with the same number it happens once: at the scenario's next sample, and the car's INI there at that very
// step.
TEST_F(Requests, TheCarStandsWhereItWasAskedToBeAndTheRecordingKnowsIt) {
  const auto world = N222();
  const Version1Road& road = N222Road();
  const Eigen::Vector3d place = road.Position(400.0, road.LaneCentre(-1));
  const double heading = road.Evaluate(400.0).heading_rad;
  const auto request =
      scenario::PlaceRequest({"ego", place.x(), place.y(), place.z()}, heading * 180.0 / 3.14159265358979323846);
  const auto launch = LaunchOf("{requests: true}");
  const Driven run = Drive(launch, 3000, [&](Step step, launch::LiveRequestsSender& window) {
    if (step == 1500 || step == 1510 || step == 1520) window.Say({Wire(1, request)});
    if (step == 1510) window.Say({});
  });
  ASSERT_EQ(run.events.size(), 1u);
  ASSERT_TRUE(run.events.contains(1510)) << run.events.begin()->first;
  const msg::ScenarioEvent& event = run.events.at(1510).front();
  EXPECT_EQ(event.name(), "vehicle.place");
  EXPECT_EQ(scenario::ParsePlace(event.argument()).value().x_m, place.x()) << "to the bit";
  const auto& before = run.car.at(1510);
  EXPECT_GT(std::hypot(before.position_w_m().x() - place.x(), before.position_w_m().y() - place.y()), 50.0);
  EXPECT_GT(before.odometer_m(), 0.1);
  const auto& after = run.car.at(1511);
  EXPECT_NEAR(after.position_w_m().x(), place.x(), 1e-3);
  EXPECT_NEAR(after.position_w_m().y(), place.y(), 1e-3);
  EXPECT_NEAR(after.position_w_m().z(), world->At(place.x(), place.y()).z_m, 0.2);
  EXPECT_NEAR(std::remainder(HeadingOf(after) - heading, 6.283185307179586), 0.0, 1e-3);
  EXPECT_LT(std::hypot(after.velocity_w_mps().x(), after.velocity_w_mps().y()), 0.05) << "INI: at rest";
  EXPECT_GT(run.car.at(3000).odometer_m(), 0.1) << "and it drives on from there";
  ExpectIdenticalFrom({0, 1200, 1511, 2000});
}

// What a window asks for to begin again (nodes/view/run_connection/ask_place): the pose of the run's
// first sample.
TEST_F(Requests, TheCarGoesBackToWhereItBegan) {
  const auto world = N222();
  scene::SceneSnapshot moment;
  moment.cars.resize(1);
  moment.cars[0].id = 5;
  const auto request = nodes::AskStart(*world, moment, 0, {{5, "ego"}}, {});
  ASSERT_TRUE(request.ok()) << request.error().Text();
  const auto launch = LaunchOf("{requests: true}");
  const Driven run = Drive(launch, 2600, [&](Step step, launch::LiveRequestsSender& window) {
    if (step == 2500) window.Say({Wire(1, request.value())});
  });
  ASSERT_TRUE(run.events.contains(2510));
  const auto &first = run.car.at(0), &before = run.car.at(2510), &after = run.car.at(2511);
  const auto apart_m = [](const msg::VehicleState& a, const msg::VehicleState& b) {
    return std::hypot(a.position_w_m().x() - b.position_w_m().x(), a.position_w_m().y() - b.position_w_m().y(),
                      a.position_w_m().z() - b.position_w_m().z());
  };
  EXPECT_GT(apart_m(before, first), 1.0) << "it has driven";
  EXPECT_LT(apart_m(after, first), 1e-3);
  EXPECT_NEAR(std::remainder(HeadingOf(after) - HeadingOf(first), 6.283185307179586), 0.0, 1e-6);
  ExpectIdenticalFrom({0, 2000});
}

TEST_F(Requests, WhereThereIsNoGroundTheCarStaysAndThatIsSaid) {
  const auto launch = LaunchOf("{requests: true}");
  testing::internal::CaptureStderr();
  const Driven run = Drive(launch, 1200, [&](Step step, launch::LiveRequestsSender& window) {
    if (step == 1000)
      window.Say({Wire(1, scenario::PlaceRequest({"ego", 9e5, 0.0, std::nullopt}, 0.0)),
                  Wire(2, scenario::PlaceRequest({"egon", 0.0, 0.0, std::nullopt}, 0.0)),
                  Wire(3, {"place", "ego", 0.0, NAN, 0.0}), Wire(4, {"fly", "ego", 0.0, 0.0, 0.0}),
                  Wire(5, scenario::WeatherRequest("hail", 1.0))});
  });
  const std::string said = testing::internal::GetCapturedStderr();
  ASSERT_EQ(run.events.size(), 1u) << "only the first one is an event";
  EXPECT_EQ(run.events.begin()->second.size(), 1u);
  const auto &before = run.car.at(1010), &after = run.car.at(1011);
  EXPECT_LT(std::hypot(after.position_w_m().x() - before.position_w_m().x(),
                       after.position_w_m().y() - before.position_w_m().y()),
            0.1);
  EXPECT_EQ(after.inside_world(), 1u);
  EXPECT_NE(said.find("node 'ego': warning: it stays where it is: "), std::string::npos) << said;
  EXPECT_NE(said.find("node 'story': warning: a request is refused: no vehicle 'egon' is wired to this scenario; did "
                      "you mean 'ego'?"),
            std::string::npos)
      << said;
  EXPECT_NE(said.find("is no place; "), std::string::npos) << said;
  EXPECT_NE(said.find("'fly' was asked for; place or weather was expected"), std::string::npos) << said;
  EXPECT_NE(said.find("'hail' is no weather"), std::string::npos) << said;
  ExpectIdenticalFrom({0});
}

// Evenly within 2 s from the step of the event on; what a snapshot in the middle goes on with is the same.
TEST_F(Requests, TheWeatherChangesFromTheStepOfItsEventOn) {
  const auto launch = LaunchOf("{requests: true}");
  const Driven run = Drive(launch, 3500, [&](Step step, launch::LiveRequestsSender& window) {
    if (step == 500) window.Say({Wire(1, scenario::WeatherRequest("rain", 2.0))});
  });
  ASSERT_TRUE(run.events.contains(510));
  EXPECT_EQ(run.events.at(510).front().name(), "weather");
  for (const Step step : {0, 500, 510, 1010, 1510, 2510, 3500}) {
    const double share = std::clamp(static_cast<double>(step - 510) / 2000.0, 0.0, 1.0);
    EXPECT_NEAR(run.weather.at(step).wetness(), 0.8 * share, 1e-12) << step;
    EXPECT_NEAR(run.weather.at(step).rain_mmph(), 12.0 * share, 1e-12) << step;
  }
  EXPECT_NEAR(run.car.at(3400).wheels()[0].friction() / run.car.at(100).wheels()[0].friction(), 1.0 - 0.8 * 0.3, 1e-3)
      << "asphalt keeps 0.7 of its friction";
  ExpectIdenticalFrom({0, 1000, 2000});
}

// The words of a scenario file do the same, without a request; then it is computed again, not taken from the
// recording.
TEST_F(Requests, AScenarioFilePlacesACarToo) {
  const auto path = folder_.path() / "story.yaml";
  ASSERT_TRUE(
      base::WriteWhole(
          path,
          std::string_view(
              "rodeira: scenario/1\nevents:\n  - {at_s: 1, name: vehicle.place, place: \"ego 30 5\", heading_deg: 90}\n"
              "  - {at_s: 1.2, name: weather, becomes: fog, over_s: 0}\n"))
          .ok());
  const auto launch = LaunchOf("{scenario: \"" + path.string() + "\"}");
  const Driven run = Drive(launch, 1500, {});
  EXPECT_NEAR(run.car.at(1001).position_w_m().x(), 30.0, 1e-3);
  EXPECT_NEAR(HeadingOf(run.car.at(1001)), 0.5 * 3.14159265358979323846, 1e-3);
  EXPECT_EQ(run.weather.at(1190).visibility_m(), 100'000.0);
  EXPECT_EQ(run.weather.at(1200).visibility_m(), 120.0);
  const auto recorded = replay::RecordedRun::Open(File());
  ASSERT_TRUE(recorded.ok()) << recorded.error().Text();
  const auto verdict = cli::Verify(recorded.value(), 0);
  ASSERT_TRUE(verdict.ok()) << verdict.error().Text();
  EXPECT_FALSE(verdict.value().difference.has_value()) << verdict.value().difference->Text();
  EXPECT_TRUE(verdict.value().substituted.empty());
}

// A gust from the north and a flat tyre move the car away from where it is without them; computed again, from a
// snapshot after they began too, it is the same.
TEST_F(Requests, AScenarioFileLetsWindAndAFlatTyreMeetACar) {
  const auto write = [&](const std::string& event) {
    const auto path = folder_.path() / "event.yaml";
    EXPECT_TRUE(
        base::WriteWhole(path, std::string_view("rodeira: scenario/1\nevents:\n  - {at_s: 0.5, " + event + "}\n"))
            .ok());
    return LaunchOf("{scenario: \"" + path.string() + "\"}");
  };
  const Driven calm = Drive(LaunchOf("{requests: true}"), 1500, {});
  for (const std::string event : {"name: vehicle.gust, gust: ego 90 0.6, speed_mps: 50",
                                  "name: vehicle.tyre_pressure, tyre: ego front_left 0.2, pressure_share: 0"}) {
    SCOPED_TRACE(event);
    std::filesystem::remove(File());
    const Driven run = Drive(write(event), 1500, {});
    const auto moved = [&](Step step) {
      const auto &with = run.car.at(step).position_w_m(), &without = calm.car.at(step).position_w_m();
      return std::hypot(with.x() - without.x(), with.y() - without.y(), with.z() - without.z());
    };
    EXPECT_EQ(moved(500), 0.0);
    EXPECT_GT(moved(800), 1e-4);
    EXPECT_GT(moved(1400), 1e-4);
    const auto recorded = replay::RecordedRun::Open(File());
    ASSERT_TRUE(recorded.ok()) << recorded.error().Text();
    for (const Step from : {0, 1000}) {
      const auto verdict = cli::Verify(recorded.value(), from);
      ASSERT_TRUE(verdict.ok()) << verdict.error().Text();
      EXPECT_FALSE(verdict.value().difference.has_value()) << verdict.value().difference->Text();
      EXPECT_TRUE(verdict.value().substituted.empty());
    }
  }
  for (const std::string event : {"name: vehicle.gust, gust: egg 90 0.6, speed_mps: 50",
                                  "name: vehicle.tyre_pressure, tyre: egg front_left 0.2, pressure_share: 0"}) {
    const auto nowhere = cli::LocalNodes::Make(write(event), {}, nullptr);
    ASSERT_FALSE(nowhere.ok()) << event;
    EXPECT_EQ(nowhere.error().id.text(), "launch.not_wired");
    EXPECT_EQ(nowhere.error().exit_status(), 2);
  }
}

// As docs/reference/view.md says: which files take requests, which are the same each time, and what is to be set for
// the others.
TEST(LaunchFiles, ThoseThatAPersonWatchesTakeRequests) {
  const auto takes = [](const std::string& name, const launch::Overrides& changes = {}) {
    const auto launch = launch::Launch::Load(std::filesystem::path(SourceDir()) / "launch" / (name + ".yaml"), changes);
    EXPECT_TRUE(launch.ok()) << launch.error().Text();
    return launch.ok() && std::any_of(launch.value().nodes().begin(), launch.value().nodes().end(),
                                      [](const launch::LaunchNode& node) { return node.takes_requests(); });
  };
  for (const char* watched : {"keyboard", "wheel", "haste", "three_screens"}) EXPECT_TRUE(takes(watched)) << watched;
  for (const char* same : {"demo", "first_drive", "lights", "two_pcs"}) {
    EXPECT_FALSE(takes(same)) << same;
    EXPECT_TRUE(takes(same, {{"nodes.story", "{kind: scenario, config: {requests: true}}"}})) << same;
  }
  for (const char* told : {"car_ahead", "rain"}) {
    EXPECT_FALSE(takes(told)) << told;
    EXPECT_TRUE(takes(told, {{"nodes.story.config.requests", "true"}})) << told;
  }
}

TEST(LiveRequestsMemory, EachRequestIsTakenOnceWhateverIsLostOrSaidAgain) {
  launch::LiveRequestsMemory memory;
  const auto numbers = [&] {
    std::vector<std::uint32_t> all;
    for (const auto& request : memory.Take()) all.push_back(request.number);
    return all;
  };
  memory.Hear({7, {{1, "a", "", 0, 0, 0}}});
  memory.Hear({7, {{1, "a", "", 0, 0, 0}, {2, "b", "", 0, 0, 0}}});
  memory.Hear({8, {{1, "c", "", 0, 0, 0}}});
  EXPECT_EQ(numbers(), (std::vector<std::uint32_t>{1, 2, 1}));
  memory.Hear({7, {{2, "b", "", 0, 0, 0}}});
  memory.Hear({7, {{1, "a", "", 0, 0, 0}}});
  EXPECT_TRUE(numbers().empty());
  memory.Hear({7, {{4, "d", "", 0, 0, 0}}});
  EXPECT_EQ(numbers(), (std::vector<std::uint32_t>{4}));
}

}  // namespace
}  // namespace rodeira
