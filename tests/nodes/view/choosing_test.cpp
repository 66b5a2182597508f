// SPDX-License-Identifier: Apache-2.0
// How a person chooses a vehicle, and what is then said and shown of it.
#include <SDL.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <sstream>

#include "common/runtime/launch/launch.hpp"
#include "common/vehicle/input_devices/key_names.hpp"
#include "common/vehicle/input_devices/keyboard_driver.hpp"
#include "common/view/scene/camera/camera.hpp"
#include "nodes/view/dynamic_objects/driver_aims.hpp"
#include "nodes/view/window/view_window.hpp"
#include "tests/nodes/view/pictures.hpp"
#include "tests/nodes/view/screen_hands.hpp"
#include "tests/tree.hpp"

namespace rodeira::nodes {
namespace {

// A window's screen on a plane, or in another world.
class Choosing : public testing::Test {
 protected:
  void SetUp() override { RODEIRA_NEEDS_PICTURES(); }
  void Open(int width_px, int height_px, const std::string& world = "plane.yaml") {
    world_ = road::World::Load(SourceDir() + "/configs/worlds/" + world).value();
    settings_.width_px = width_px;
    settings_.height_px = height_px;
    screen_.reset();  // at most one at a time
    auto screen = ViewWindow::Open(SurfaceKind::kOffscreen, settings_, *world_, false, "help");
    ASSERT_TRUE(screen.ok()) << screen.error().Text();
    screen_ = std::move(screen).value();
  }
  Image Shown(const scene::SceneSnapshot& moment) { return nodes::Shown(*screen_, moment); }
  bool Click(const Eigen::Vector2d& at, int button = SDL_BUTTON_LEFT) { return nodes::Click(*screen_, at, button); }

  ViewSettings settings_;
  std::shared_ptr<const road::World> world_;
  std::unique_ptr<ViewWindow> screen_;
};

// A click on a car of the traffic, seen from behind: it pulses with simulated time, its panel stands there; a click
// beside it ends that.
TEST_F(Choosing, AClickChoosesAVehicle) {
  settings_.instruments = false;
  ASSERT_NO_FATAL_FAILURE(Open(960, 540));
  scene::SceneSnapshot moment;
  moment.time_ns = 400'000'000;  // half of the pulse's 0.8 s: at its most
  moment.cars.push_back(CarAt({12.0, 7.0, 0.0}, 0.6));
  scene::AgentPose agent;
  agent.id = 5;
  agent.colour = scene::Colour::Of(0x1040e0);
  agent.p_WB_W = moment.cars[0].p_WB_W + moment.cars[0].q_WB * Eigen::Vector3d(14.0, 4.0, 0.0);
  agent.q_WB = moment.cars[0].q_WB;
  moment.agents.push_back(agent);
  const scene::Camera camera = scene::ChaseCamera(moment.cars[0], *world_);
  const Eigen::Vector3d tail_W = agent.p_WB_W + agent.q_WB * Eigen::Vector3d(-1.95, 0.0, 0.80);
  const auto shown = [&] { return Shown(moment); };
  const Image before = shown();
  EXPECT_TRUE(ProbeAt(before, camera, tail_W).IsBlue()) << ProbeAt(before, camera, tail_W);
  EXPECT_TRUE(Click(*camera.Project(tail_W, 960, 540)));
  const Image chosen = shown();
  EXPECT_GT(ProbeAt(chosen, camera, tail_W).red, ProbeAt(before, camera, tail_W).red + 80.0)
      << ProbeAt(chosen, camera, tail_W);
  EXPECT_LT(ProbeAt(chosen, 330, 540 - 40, 3).green, 0.75 * ProbeAt(before, 330, 540 - 40, 3).green)
      << "the panel's box";
  moment.time_ns = 800'000'000;
  EXPECT_TRUE(ProbeAt(shown(), camera, tail_W).IsBlue()) << "between two pulses";
  moment.time_ns = 400'000'000;
  EXPECT_TRUE(Click({480.0, 20.0}));
  EXPECT_EQ(shown().rgb, before.rgb);
}

// A car and two of the traffic before it, on a plane.
scene::SceneSnapshot CarAndTwoOthers() {
  scene::SceneSnapshot moment;
  moment.time_ns = 800'000'000;
  moment.cars.push_back(CarAt({12.0, 7.0, 0.0}, 0.6));
  for (const int number : {1, 2}) {
    scene::AgentPose agent;
    agent.id = static_cast<std::uint64_t>(number) << 24;
    agent.speed_mps = 4.0 * number;
    agent.p_WB_W = moment.cars[0].p_WB_W + moment.cars[0].q_WB * Eigen::Vector3d(12.0 * number, 4.0, 0.0);
    agent.q_WB = moment.cars[0].q_WB;
    moment.agents.push_back(agent);
  }
  return moment;
}

// The key goes from vehicle to vehicle: the camera goes with each, it pulses, and its panel stands there; back at the
// window's own car none is chosen.
TEST_F(Choosing, TabChoosesOneVehicleAfterTheOtherAndComesHome) {
  ASSERT_NO_FATAL_FAILURE(Open(640, 360));
  scene::SceneSnapshot moment = CarAndTwoOthers();
  moment.time_ns = 400'000'000;  // the pulse's middle
  const auto expected = [&](std::size_t followed, std::optional<std::size_t> chosen) {
    Picture picture = PictureOf(settings_, moment);
    picture.followed = followed;
    picture.chosen = chosen;
    Chosen panel;
    panel.Choose(moment, chosen);
    picture.panel = panel.Panel(moment);
    EXPECT_EQ(picture.panel.empty(), !chosen);
    screen_->renderer().Draw(picture);
    return screen_->renderer().Read();
  };
  const auto press = [&](int shift) {
    EXPECT_TRUE(screen_->TakeKey(SDLK_TAB, true, shift));
    return Shown(moment).rgb;
  };
  const auto home = Shown(moment).rgb;
  EXPECT_EQ(home, expected(0, std::nullopt).rgb);
  EXPECT_EQ(press(KMOD_NONE), expected(1, 1).rgb);
  EXPECT_EQ(press(KMOD_NONE), expected(2, 2).rgb);
  EXPECT_EQ(press(KMOD_NONE), home);
  EXPECT_EQ(press(KMOD_LSHIFT), expected(2, 2).rgb);
  EXPECT_EQ(press(KMOD_RSHIFT), expected(1, 1).rgb);
}

// Where the left button drives the right one chooses, and turns the camera about the car; whatever button the window
// has, the others are not its own.
TEST_F(Choosing, ChoosingAndTurningHaveAButtonThatDoesNotDrive) {
  settings_.quality = Quality::kLow;  // every pixel of two pictures of the same quality is compared
  for (const int own : {kLeftButton, kRightButton, kMiddleButton, kNoButton}) {
    settings_.mouse_button = own;
    ASSERT_NO_FATAL_FAILURE(Open(640, 360));
    const scene::SceneSnapshot moment = CarAndTwoOthers();
    const auto shown = [&] { return Shown(moment).rgb; };
    const auto before = shown();
    const Eigen::Vector2d at = *scene::ChaseCamera(moment.cars[0], *world_)
                                    .Project(moment.agents[0].p_WB_W + Eigen::Vector3d(0.0, 0.0, 0.8), 640, 360);
    for (const int button : {kLeftButton, kRightButton, kMiddleButton}) {
      EXPECT_EQ(Click(at, button), button == own);
      EXPECT_EQ(shown() != before, button == own) << button << " of " << own;
      (void)Click({320.0, 8.0}, button);  // on none
      SDL_Event drawn{};
      drawn.type = SDL_MOUSEMOTION;
      drawn.motion.state = static_cast<Uint32>(SDL_BUTTON(button));
      drawn.motion.xrel = 50;
      EXPECT_EQ(screen_->TakeMouse(drawn), button == own);
    }
    for (int i = 0; i < 3; ++i) (void)screen_->TakeKey(SDLK_k, true);  // chase, driver, bonnet, orbit
    Picture picture = PictureOf(settings_, moment);
    picture.camera = scene::CameraKind::kOrbit;
    screen_->renderer().Draw(picture);
    const auto not_turned = screen_->renderer().Read().rgb;
    EXPECT_EQ(shown() == not_turned, own == kNoButton) << own;
  }
}

// With the keys of the project's keyboard file below it, a window of 720 pixels has room for 34 lines.
TEST(WindowHelp, HasEveryKeyOnceAndRoomInAWindow) {
  const std::string help = WindowHelp(kLeftButton);
  ASSERT_FALSE(input_devices::WindowKeys().empty());
  for (const input_devices::WindowKey& key : input_devices::WindowKeys()) {
    int lines = 0;
    std::istringstream all(help);
    for (std::string line; std::getline(all, line);) {
      const auto gap = line.find("  ");
      const bool named = (" " + line.substr(0, gap) + " ").find(" " + std::string(key.name) + " ") != std::string::npos;
      if (named && line.find(key.does, gap) != std::string::npos) ++lines;
    }
    EXPECT_EQ(lines, 1) << key.name << " in:\n" << help;
  }
  const auto keyboard = input_devices::LoadKeyboard(SourceDir() + "/configs/drivers/keyboard.yaml");
  ASSERT_TRUE(keyboard.ok());
  const std::string whole = help + "\n\n" + input_devices::KeyboardHelp(keyboard.value());
  EXPECT_LE(std::count(whole.begin(), whole.end(), '\n') + 1, 34) << whole;
}

TEST(WindowHelp, SaysWhichButtonOfTheMouseIsTheWindows) {
  EXPECT_NE(WindowHelp(kRightButton).find("\nright mouse button  choose a vehicle"), std::string::npos)
      << WindowHelp(kRightButton);
  EXPECT_EQ(WindowHelp(kNoButton).find("mouse button"), std::string::npos);
  EXPECT_NE(WindowHelp(kNoButton).find("\nmouse wheel  "), std::string::npos);
}

// What the driver of a chosen car of the traffic goes by: where it points and how fast it is to be, the point that it
// steers for and the line to it, where its path leads, how far it looks; five things from five numbers, gone with the
// choice.
TEST_F(Choosing, TheVectorsOfAChosenDriverStandInTheScene) {
  settings_.instruments = false;
  ASSERT_NO_FATAL_FAILURE(Open(960, 540));
  scene::SceneSnapshot moment;
  moment.time_ns = 800'000'000;  // between two pulses
  moment.cars.push_back(CarAt({12.0, 7.0, 0.0}, 0.6));
  const auto from_car = [&](double ahead, double left, double up) -> Eigen::Vector3d {
    return moment.cars[0].p_WB_W + moment.cars[0].q_WB * Eigen::Vector3d(ahead, left, up);
  };
  scene::AgentPose agent;
  agent.id = 5;
  agent.colour = scene::Colour::Of(0x1040e0);
  agent.p_WB_W = from_car(14.0, 4.0, 0.0);
  agent.q_WB = moment.cars[0].q_WB;
  agent.detail.emplace();
  agent.detail->look_ahead_W = from_car(26.0, 1.0, 0.0).head<2>();
  agent.detail->target_B = {7.0, -2.0};
  agent.detail->path_turn_rad = -0.3;
  agent.detail->target_speed_mps = 15.0;
  moment.agents.push_back(agent);
  const scene::Camera camera = scene::ChaseCamera(moment.cars[0], *world_);
  const auto shown = [&] { return Shown(moment); };
  const Image before = shown();
  EXPECT_TRUE(Click(*camera.Project(from_car(12.05, 4.0, 0.8), 960, 540)));
  const Image chosen = shown();
  const auto post = ProbeAt(chosen, camera, from_car(26.0, 1.0, 1.1), 1),
             tip = ProbeAt(chosen, camera, from_car(28.7, 4.0, agent.height_m + 0.4), 0);
  EXPECT_TRUE(post.green > post.red + 60.0 && post.blue > post.red + 60.0) << "cyan: " << post;
  EXPECT_TRUE(tip.green > tip.red + 60.0 && tip.green > tip.blue + 60.0) << "green, a second of 15 m/s ahead: " << tip;
  const Eigen::Vector3d on_path_W = from_car(16.0 + 3.0 * std::cos(0.3), 4.0 - 3.0 * std::sin(0.3), 0.5);
  const auto path = ProbeAt(chosen, camera, on_path_W, 0);
  EXPECT_TRUE(path.red > path.blue + 60.0 && path.green > path.blue + 60.0) << "yellow: " << path;
  const double high_m = agent.height_m + 0.9;
  for (const double share : {0.5, 1.0}) {
    const auto target = ProbeAt(chosen, camera, from_car(14.0 + 7.0 * share, 4.0 - 2.0 * share, high_m), 0);
    EXPECT_TRUE(target.red > target.green + 60.0 && target.blue > target.green + 60.0)
        << "magenta: " << target << " at " << share;
  }
  // Each goes by a number of its own.
  const Eigen::Vector3d ball_W = from_car(21.0, 2.0, high_m), post_W = from_car(26.0, 1.0, 1.1);
  moment.agents[0].detail->path_turn_rad = 0.3;
  const Image turned = shown();
  EXPECT_NE(ProbeAt(turned, camera, on_path_W, 0), path);
  EXPECT_EQ(ProbeAt(turned, camera, ball_W, 0), ProbeAt(chosen, camera, ball_W, 0));
  moment.agents[0].detail->target_B = {0.3, 0.0};  // MOTORS' driver's, above its car
  const Image near = shown();
  const auto above = ProbeAt(near, camera, from_car(14.3, 4.0, high_m), 0);
  EXPECT_TRUE(above.red > above.green + 60.0 && above.blue > above.green + 60.0) << "magenta: " << above;
  EXPECT_EQ(ProbeAt(near, camera, post_W, 1), post);
  moment.agents[0].detail.reset();
  const auto bare = ProbeAt(shown(), camera, from_car(26.0, 1.0, 1.1), 1);
  EXPECT_LT(bare.blue, bare.red + 60.0) << "nothing is said of it: " << bare;
  moment.agents[0].detail = agent.detail;
  EXPECT_EQ(shown().rgb, chosen.rgb);
  EXPECT_TRUE(Click({480.0, 20.0}));
  EXPECT_EQ(shown().rgb, before.rgb);
}

// The driver of a driven car goes by the same things where it is the autopilot: on a straight road in the middle of its
// lane the point that it steers for lies 0.9 s of its way ahead of the rear axle, its path leads straight on, it looks
// 150 m ahead of the bumper. Published is none of it.
TEST_F(Choosing, TheAutopilotsVectorsOfADrivenCarStandInTheSceneToo) {
  const auto launch = launch::Launch::Load(SourceDir() + "/launch/demo.yaml");
  ASSERT_TRUE(launch.ok()) << launch.error().Text();
  const auto autopilot = AutopilotOf(launch.value(), launch.value().roster().Find("ego"));
  ASSERT_TRUE(autopilot.has_value());
  settings_.instruments = false;
  settings_.autopilots[0] = *autopilot;
  ASSERT_NO_FATAL_FAILURE(Open(960, 540, "n222.yaml"));
  const network::Road& road = world_->network()->roads()[0];
  const auto at = [&](double s_m, double high_m) -> Eigen::Vector3d {
    return road.Surface(s_m, -1.45).p_W + Eigen::Vector3d(0.0, 0.0, high_m);
  };
  scene::SceneSnapshot moment;
  moment.time_ns = 800'000'000;  // between two pulses
  moment.cars.push_back(CarAt(at(20.0, 0.0), road.axis().Evaluate(20.0).heading_rad));
  moment.cars[0].speed_mps = 15.0;
  const scene::Camera camera = scene::ChaseCamera(moment.cars[0], *world_);
  const Image before = Shown(moment);
  ASSERT_TRUE(Click(*camera.Project(at(20.0, 0.9), 960, 540)));
  const Image chosen = Shown(moment);
  const double rear_m = 20.0 - 0.5 * moment.cars[0].wheelbase_m, high_m = moment.cars[0].height_m + 0.9;
  const auto target = ProbeAt(chosen, camera, at(rear_m + 13.5, high_m), 0);
  EXPECT_TRUE(target.red > target.green + 60.0 && target.blue > target.green + 60.0) << "magenta: " << target;
  const DriverAim aim = *DriverAims(settings_.autopilots, *world_).Of(moment.cars[0]);
  EXPECT_LT((aim.look_ahead_W - at(20.0 + moment.cars[0].front_m + 150.0, 0.0).head<2>()).norm(), 2.0)
      << "distances are the lane's, not the axis'";
  EXPECT_NEAR(aim.target_B.x(), 13.5 - 0.5 * moment.cars[0].wheelbase_m, 0.2);
  EXPECT_NEAR(aim.target_B.y(), 0.0, 0.2);
  EXPECT_NEAR(aim.path_turn_rad, 0.0, 0.02);
  EXPECT_GT(aim.speed_mps, 5.0);
  EXPECT_LT(aim.speed_mps, 70.0 / 3.6) << "N222's limit";
  EXPECT_TRUE(Click({480.0, 20.0}));
  EXPECT_EQ(Shown(moment).rgb, before.rgb);
  // What a person goes by is unknown.
  moment.cars[0].id = 5;
  (void)Shown(moment);
  ASSERT_TRUE(Click(*camera.Project(at(20.0, 0.9), 960, 540)));
  const auto none = ProbeAt(Shown(moment), camera, at(rear_m + 13.5, high_m), 0);
  EXPECT_EQ(none, ProbeAt(before, camera, at(rear_m + 13.5, high_m), 0));
}

// The file and lane of the autopilot: those of the input that is wired to the car, where it is one.
TEST(DriverAims, AreOfTheInputThatDrivesTheCar) {
  const auto of = [](const std::string& launch_file, const launch::Overrides& overrides = {}) {
    const auto launch = launch::Launch::Load(SourceDir() + "/launch/" + launch_file, overrides);
    EXPECT_TRUE(launch.ok()) << launch.error().Text();
    return AutopilotOf(launch.value(), launch.value().roster().Find("ego"));
  };
  const auto demo = of("three_screens.yaml"), lane = of("three_screens.yaml", {{"nodes.driver.config.lane", "1"}});
  ASSERT_TRUE(demo && lane);
  EXPECT_EQ(demo->driver.filename(), "default.yaml");
  EXPECT_TRUE(std::filesystem::exists(demo->driver));
  EXPECT_FALSE(demo->lane.has_value());
  EXPECT_EQ(lane->lane, 1);
  EXPECT_FALSE(of("three_screens.yaml", {{"nodes.driver.config.source", "script"}})) << "whatever else stands there";
  EXPECT_FALSE(of("keyboard.yaml")) << "a person";
}

TEST(Chosen, SaysWhatTheCarDoesAndSinceWhen) {
  scene::SceneSnapshot moment;
  moment.cars.emplace_back();
  scene::CarPose& car = moment.cars[0];
  car.id = 3;
  car.speed_mps = 25.0;
  car.gear = 4;
  car.engine_rpm = 2900.0;
  car.throttle = 0.4;
  car.fuel_used_l = 3.00;
  car.fuel_lph = 5.4;  // at 90 km/h: 6 l for 100 km
  car.odometer_m = 1000.0;
  Chosen chosen;
  chosen.Choose(moment, 0);
  EXPECT_NE(chosen.Panel(moment).find("90.0 km/h   gear 4   2900 1/min\nthrottle 40 %   brake 0 %"), std::string::npos)
      << chosen.Panel(moment);
  EXPECT_NE(chosen.Panel(moment).find("now 6.0 l/100 km"), std::string::npos) << chosen.Panel(moment);
  moment.time_ns = 80'000'000'000;
  car.odometer_m = 3000.0;
  car.fuel_used_l = 3.14;
  EXPECT_NE(chosen.Panel(moment).find("mean 7.0 l/100 km over 2.00 km"), std::string::npos) << chosen.Panel(moment);
  moment.time_ns = 0;
  car.odometer_m = 500.0;  // back in a recording: counted from there
  EXPECT_NE(chosen.Panel(moment).find("mean -"), std::string::npos) << chosen.Panel(moment);
  car.id = 4;
  EXPECT_EQ(chosen.Panel(moment), "") << "it has left";
  EXPECT_FALSE(chosen.In(moment));
}

TEST(Chosen, SaysOfTheTrafficWhatItPublishes) {
  scene::SceneSnapshot moment;
  moment.agents.emplace_back();
  scene::AgentPose& agent = moment.agents[0];
  agent.id = std::uint64_t{7} << 24;
  agent.speed_mps = 10.0;
  Chosen chosen;
  chosen.Choose(moment, 0);
  EXPECT_EQ(chosen.Panel(moment), "traffic 7\n36.0 km/h\nwheels 0.0 deg") << "of recordings that say no more";
  agent.detail = scene::AgentDetail{0.3, 0.0, 0.0, 2, 2100.0, 2.88, 1.5, 12.5, {0.0, 0.0}, 0.0, {0.0, 0.0}};
  chosen.Choose(moment, 0);
  EXPECT_EQ(chosen.Panel(moment),
            "traffic 7   36.0 km/h of 45\ngear 2   2100 1/min\nthrottle 30 %   brake 0 %\nclutch 0 %   wheels 0.0 "
            "deg\nnow 8.0 l/100 km\nmean -");
  for (int i = 1; i <= 100; ++i) {  // 1 km in 100 s; it burns 0.07 l
    moment.time_ns = i * 1'000'000'000LL;
    agent.p_WB_W.x() = 10.0 * i;
    agent.detail->fuel_used_l = 1.5 + 0.0007 * i;
    (void)chosen.Panel(moment);
  }
  EXPECT_NE(chosen.Panel(moment).find("mean 7.0 l/100 km over 1.00 km"), std::string::npos) << chosen.Panel(moment);
  moment.time_ns = 0;  // back in a recording
  EXPECT_NE(chosen.Panel(moment).find("mean -"), std::string::npos) << chosen.Panel(moment);
}

}  // namespace
}  // namespace rodeira::nodes
