// SPDX-License-Identifier: Apache-2.0
#include "nodes/view/view_settings.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>

#include "common/core/base/files.hpp"
#include "common/core/base/temporary_folder.hpp"
#include "nodes/view/view_node.hpp"
#include "tests/names.hpp"
#include "tests/nodes/view/fake_run.hpp"
#include "tests/tree.hpp"

namespace rodeira::nodes {
namespace {

// What the node says to a configuration; empty where it takes it.
std::string Complaint(const std::string& config, const std::string& vehicle_period_s = "0.001") {
  const auto launch = launch::Launch::Parse(LaunchText(config, vehicle_period_s), "fake.yaml");
  EXPECT_TRUE(launch.ok()) << launch.error().Text();
  const PlainContext context(launch.value(), launch.value().roster().Find("picture"));
  const auto settings = ReadViewSettings(context);
  if (settings.ok()) return {};
  EXPECT_EQ(settings.error().exit_status(), 2);
  return settings.error().Text();
}

TEST(ViewSettings, NothingNeedsToBeSaid) {
  const auto launch = launch::Launch::Parse(LaunchText("{}"), "fake.yaml");
  ASSERT_TRUE(launch.ok());
  const PlainContext context(launch.value(), launch.value().roster().Find("picture"));
  const auto settings = ReadViewSettings(context);
  ASSERT_TRUE(settings.ok()) << settings.error().Text();
  EXPECT_EQ(settings.value().width_px, 1280);
  EXPECT_EQ(settings.value().window, WindowMode::kAuto);
  EXPECT_FALSE(settings.value().headset);
  EXPECT_TRUE(settings.value().frame_steps.empty());
}

TEST(ViewSettings, WrongOnesAreRefusedWithTheirPlace) {
  EXPECT_EQ(Complaint("{widht_px: 800}"),
            "fake.yaml:9: unknown key 'nodes.picture.config.widht_px'; did you mean 'width_px'?");
  EXPECT_NE(Complaint("{camera: chaise}").find("did you mean 'chase'"), std::string::npos)
      << Complaint("{camera: chaise}");
  EXPECT_NE(Complaint("{quality: hihg}").find("did you mean 'high'"), std::string::npos)
      << Complaint("{quality: hihg}");
  EXPECT_NE(Complaint("{width_px: 10}").find("width_px"), std::string::npos);
  EXPECT_EQ(Complaint("{follow: egg}"),
            "fake.yaml:9: 'egg' is no vehicle that this view is wired to; did you mean 'ego'?");
  EXPECT_EQ(Complaint("{mirrors: [left, middle]}"),
            "fake.yaml:9: 'middle' is no mirror; known are left, inside, right");
  EXPECT_EQ(Complaint("{mirrors: []}"), "");
  EXPECT_EQ(Complaint("{sound: false, volume: 0.3}"), "");
  EXPECT_NE(Complaint("{volume: 1.5}").find("fake.yaml:9: "), std::string::npos) << Complaint("{volume: 1.5}");
  EXPECT_EQ(Complaint("{headset: true}"), "");
  EXPECT_EQ(Complaint("{haedset: true}"),
            "fake.yaml:9: unknown key 'nodes.picture.config.haedset'; did you mean 'headset'?");
  EXPECT_EQ(Complaint("{follow: ego}"), "");
  EXPECT_NE(Complaint("{frames: {times_s: [1]}}").find("folder"), std::string::npos);
}

TEST(ViewSettings, KnowsByWhichKeysItsCarIsDriven) {
  const auto settings = [](const std::string& input) {
    std::string text = LaunchText("{}");
    text.replace(text.find("{kind: input}"), 13, "{kind: input, config: " + input + "}");
    const auto launch = launch::Launch::Parse(text, std::filesystem::path(SourceDir()) / "launch/fake.yaml");
    EXPECT_TRUE(launch.ok());
    const PlainContext context(launch.value(), launch.value().roster().Find("picture"));
    const auto read = ReadViewSettings(context);
    EXPECT_TRUE(read.ok()) << read.error().Text();
    return read.value();
  };
  EXPECT_FALSE(settings("{source: autopilot, driver: x.yaml, lane: -1}").drives)
      << "and what else stands there is not the view's to judge";
  EXPECT_FALSE(settings("[nonsense]").drives);
  const ViewSettings driven = settings("{source: keyboard, keyboard: ../configs/drivers/keyboard.yaml, nonsense: 1}");
  EXPECT_TRUE(driven.drives);
  EXPECT_NE(driven.driving_help.find("left, a  steer left"), std::string::npos) << driven.driving_help;
  EXPECT_TRUE(settings("{source: keyboard, keyboard: missing.yaml}").drives) << "the input says that it is missing";
  const std::string keys = "keyboard: ../configs/drivers/keyboard.yaml";
  EXPECT_TRUE(settings("{source: joystick, " + keys + "}").drives) << "they drive where no wheel is found";
  EXPECT_FALSE(settings("{source: joystick, " + keys + "}").driving_help.empty());
  EXPECT_TRUE(settings("{source: joystick, wheel: ~, " + keys + "}").drives);
  EXPECT_FALSE(settings("{source: joystick, wheel: ../configs/drivers/wheel.yaml, " + keys + "}").drives)
      << "a wheel that is named is the only hand";
  EXPECT_EQ(settings("{source: gamepad}").camera_buttons.size(), 1u);
  for (const char* found : {"{source: joystick}", "{source: joystick, wheel: ~}"}) {
    const auto buttons = settings(found).camera_buttons;
    EXPECT_EQ(std::count_if(buttons.begin(), buttons.end(), [](const WheelButtonUse& use) { return use.own; }), 1)
        << found;
    EXPECT_EQ(std::count_if(buttons.begin(), buttons.end(),
                            [](const WheelButtonUse& use) {
                              return !use.own && use.guid.empty() && use.button == kPadCameraButton;
                            }),
              1)
        << found;
  }
}

TEST(ViewSettings, ACarHasThePaintThatItWasGiven) {
  const auto launch = launch::Launch::Parse(LaunchText("{colours: {ego: \"#102030\"}}"), "fake.yaml");
  ASSERT_TRUE(launch.ok());
  const PlainContext context(launch.value(), launch.value().roster().Find("picture"));
  const auto settings = ReadViewSettings(context);
  ASSERT_TRUE(settings.ok()) << settings.error().Text();
  ASSERT_EQ(settings.value().paints.size(), 1u);
  scene::SceneSnapshot moment;
  moment.cars.resize(2);
  moment.cars[0].id = settings.value().paints.begin()->first;
  moment.cars[1].id = 99;
  const scene::Colour other = moment.cars[1].colour;
  const Picture picture = PictureOf(settings.value(), moment);
  EXPECT_EQ(picture.moment.cars[0].colour, (scene::Colour{0x10, 0x20, 0x30}));
  EXPECT_EQ(picture.moment.cars[1].colour, other) << "nobody gave it one";
  EXPECT_EQ(PaintOf("white").value(), PaintOf("e8e8e4").value());
  EXPECT_EQ(Complaint("{colours: {ego: blakc}}"),
            "fake.yaml:9: 'blakc' is no colour; a name or six hexadecimal digits were expected; did you mean 'black'?");
  EXPECT_THAT(Complaint("{colours: {egg: red}}"), Names("fake.yaml:9: 'egg' … vehicle … 'ego'"));
  EXPECT_NE(Complaint("{colours: {ego: 12345}}").find("'12345' is no colour"), std::string::npos);
}

TEST(ViewSettings, KnowsWhereItsCarBegins) {
  const auto start = [](const std::string& config) {
    std::string text = LaunchText("{}");
    const std::string ego = "ego: {kind: vehicle";
    EXPECT_NE(text.find(ego), std::string::npos) << text;
    text.replace(text.find(ego), ego.size(), ego + ", config: " + config);
    const auto launch = launch::Launch::Parse(text, "fake.yaml");
    EXPECT_TRUE(launch.ok()) << launch.error().Text();
    const PlainContext context(launch.value(), launch.value().roster().Find("picture"));
    const auto read = ReadViewSettings(context);
    EXPECT_TRUE(read.ok()) << read.error().Text();
    EXPECT_EQ(read.value().starts.size(), 1u);
    return read.value().starts.begin()->second;
  };
  const CarStart own = start("{start: {x_m: 1.5, y_m: -2e1, heading_deg: 30}}"),
                 turned = start("{start: {heading_deg: -90}}"), none = start("{}");
  EXPECT_EQ(std::tuple(own.x_m, own.y_m, own.heading_deg),
            std::tuple(std::optional(1.5), std::optional(-20.0), std::optional(30.0)));
  EXPECT_EQ(std::tuple(turned.x_m, turned.y_m, turned.heading_deg),
            std::tuple(std::optional<double>(), std::optional<double>(), std::optional(-90.0)));
  EXPECT_FALSE(none.x_m || none.y_m || none.heading_deg);
}

// The window takes the first button of the mouse that drives nothing.
TEST(ViewSettings, TheWindowHasAButtonOfTheMouseThatDoesNotDrive) {
  auto folder = base::TemporaryFolder::Make("buttons");
  ASSERT_TRUE(folder.ok());
  const auto button = [&](const std::string& throttle, const std::string& brake) {
    std::ofstream(folder.value().path() / "keys.yaml")
        << "rodeira: keyboard/1\nkeys: {steer_left: [a], steer_right: [d], throttle: " << throttle
        << ", brake: " << brake << "}\n";
    std::string text = LaunchText("{}");
    text.replace(text.find("{kind: input}"), 13, "{kind: input, config: {source: keyboard, keyboard: keys.yaml}}");
    const auto launch = launch::Launch::Parse(text, folder.value().path() / "fake.yaml");
    EXPECT_TRUE(launch.ok());
    const PlainContext context(launch.value(), launch.value().roster().Find("picture"));
    const auto read = ReadViewSettings(context);
    EXPECT_TRUE(read.ok() && read.value().drives && !read.value().driving_help.empty());
    return read.value().mouse_button;
  };
  EXPECT_EQ(button("[w, mouse_forward]", "[s]"), kLeftButton);
  EXPECT_EQ(button("[w, mouse_left]", "[s]"), kRightButton);
  EXPECT_EQ(button("[mouse_right]", "[s, mouse_left]"), kMiddleButton);
  EXPECT_EQ(button("[mouse_right, mouse_middle]", "[mouse_left]"), kNoButton);
}

TEST(ViewSettings, AFramesTimeMustBeASampleOfTheCar) {
  const std::string folder =
      (std::filesystem::temp_directory_path() / ("rodeira-view-settings-" + std::to_string(::getpid()))).string();
  const auto with = [&](const std::string& times) {
    return "{frames: {times_s: " + times + ", folder: " + folder + "}}";
  };
  EXPECT_EQ(Complaint(with("[2, 1.004, 1]")), "");
  EXPECT_EQ(Complaint(with("[1.0005]")), "fake.yaml:9: 1.0005 s is no multiple of the base step of 0.001 s");
  EXPECT_EQ(Complaint(with("[1.003]"), "0.005"),
            "fake.yaml:9: at 1.003 s ego.rodeira/vehicle_state has no sample; a multiple of its period of 0.005 s was "
            "expected");
  EXPECT_NE(Complaint(with("[-1]")), "");
  std::filesystem::remove_all(folder);
}

// 30 pictures a second of samples every 4 ms: each at the sample nearest to its time, none twice, and as many as the
// time has.
TEST(ViewSettings, AFilmsPicturesAreEvenlyApart) {
  const auto launch = launch::Launch::Parse(LaunchText("{}", "0.004"), "fake.yaml");
  ASSERT_TRUE(launch.ok());
  const lockstep::Roster& roster = launch.value().roster();
  std::vector<lockstep::SourceIndex> cars;
  for (lockstep::SourceIndex source = 0; source < roster.sources().size(); ++source) {
    if (roster.source(source).topic == idl::topics::kVehicleState) cars.push_back(source);
  }
  const auto steps = FilmSteps(roster, cars, 30.0, 2.0, 4.0);
  ASSERT_TRUE(steps.ok()) << steps.error().Text();
  ASSERT_EQ(steps.value().size(), 61u);
  for (std::size_t k = 0; k < 61; ++k) {
    EXPECT_EQ(steps.value()[k] % 4, 0);
    EXPECT_NEAR(static_cast<double>(steps.value()[k]) * 1e-3, 2.0 + static_cast<double>(k) / 30.0, 0.002 + 1e-9);
  }
  EXPECT_NE(Complaint("{frames: {fps: 25, to_s: 3, from_s: 4, folder: out}}").find("an end behind its beginning"),
            std::string::npos);
  EXPECT_NE(Complaint("{frames: {fps: 300, to_s: 3, folder: out}}", "0.004").find("at most 250"), std::string::npos);
  EXPECT_NE(Complaint("{frames: {fps: 25, folder: out}}").find("to_s"), std::string::npos);
}

TEST(ViewSettings, AFolderThatCannotBeIsRefusedAtTheStart) {
  const auto file = std::filesystem::temp_directory_path() / ("rodeira-view-file-" + std::to_string(::getpid()));
  ASSERT_TRUE(base::WriteWhole(file, "no folder").ok());
  const std::string said = Complaint("{frames: {times_s: [1], folder: " + (file / "frames").string() + "}}");
  EXPECT_NE(said.find("fake.yaml:9: '" + (file / "frames").string() + "' is no folder, and none can be made"),
            std::string::npos)
      << said;
  EXPECT_EQ(Complaint("{frames: {times_s: [1], folder: /proc}}").substr(0, 43),
            "fake.yaml:9: '/proc' cannot be written to (");
  std::filesystem::remove(file);
}

TEST(ViewNodeWithoutDisplay, AWindowThatMustBeIsRefused) {
  ::unsetenv("DISPLAY");
  ::unsetenv("WAYLAND_DISPLAY");
  const auto make = [](const std::string& config) {
    const auto launch = launch::Launch::Parse(LaunchText(config), "fake.yaml");
    EXPECT_TRUE(launch.ok());
    PlainContext context(launch.value(), launch.value().roster().Find("picture"));
    const auto node = nodes::MakeViewNode(context);
    return node.ok() ? std::string() : std::to_string(node.error().exit_status()) + " " + node.error().Text();
  };
  const std::string said = make("{window: always}");
  EXPECT_EQ(said.substr(0, 23), "2 a window is requested") << said;
  EXPECT_NE(said.find("'window: never'"), std::string::npos) << said;
  EXPECT_EQ(make("{window: auto}"), "") << "without frames and display there is nothing to do, and that is fine";
}

TEST(FrameName, HasTheStep) { EXPECT_EQ(FrameName(12340), "step_000012340.png"); }

}  // namespace
}  // namespace rodeira::nodes
