// SPDX-License-Identifier: Apache-2.0
// Keyboard and wheel files, and the sentences for wrong ones.
#include <gtest/gtest.h>

#include "common/vehicle/input_devices/keyboard_driver.hpp"
#include "common/vehicle/input_devices/keyboard_schema.hpp"
#include "common/vehicle/input_devices/wheel_driver.hpp"
#include "common/vehicle/input_devices/wheel_schema.hpp"
#include "tests/common/core/config/every_key.hpp"
#include "tests/tree.hpp"

namespace rodeira::input_devices {
namespace {

const std::filesystem::path kDrivers = std::filesystem::path(SourceDir()) / "configs/drivers";

std::string KeyboardProblem(const std::string& text) {
  auto file = config::File::Parse(text, "keys.yaml");
  if (!file) return file.error().Text();
  (void)ReadKeyboard(file.value().root());
  const auto status = file.value().Finish();
  return status.ok() ? "" : status.error().Text();
}

std::string WheelProblem(const std::string& text) {
  auto file = config::File::Parse(text, "wheel.yaml");
  if (!file) return file.error().Text();
  (void)ReadWheel(file.value().root());
  const auto status = file.value().Finish();
  return status.ok() ? "" : status.error().Text();
}

std::string KeyboardComplaint(const std::string& text) { return KeyboardProblem("rodeira: keyboard/1\n" + text); }
std::string WheelComplaint(const std::string& text) { return WheelProblem("rodeira: wheel/1\n" + text); }

const std::string kKeys = "keys: {steer_left: [left], steer_right: [right], throttle: [up], brake: [down]}\n";
const std::string kDevice = "devices: {rim: 030000006d0400004fc2000011010000}\n";

TEST(KeyNames, GoThereAndBack) {
  ASSERT_FALSE(KeyNames().empty());
  for (const std::string& name : KeyNames()) EXPECT_EQ(NameOf(KeyOf(name).value()), name);
  EXPECT_EQ(KeyOf("a"), 4u);  // USB HID usage tables, page 7
  EXPECT_EQ(KeyOf("1"), 30u);
  EXPECT_EQ(KeyOf("f12"), 69u);
  EXPECT_EQ(KeyOf("up"), 82u);
  EXPECT_FALSE(KeyOf("any").has_value());
}

TEST(KeyboardFile, TheProjectsOwnDrivesWithArrowsAndLetters) {
  const auto settings = LoadKeyboard(kDrivers / "keyboard.yaml");
  ASSERT_TRUE(settings.ok()) << settings.error().Text();
  EXPECT_EQ(settings.value().KeysOf(Action::kBrake), (std::vector<Key>{*KeyOf("down"), *KeyOf("s")}));
  const std::string help = KeyboardHelp(settings.value());
  EXPECT_NE(help.find("up, w  throttle"), std::string::npos) << help;
}

TEST(KeyboardFile, EveryDeclaredKeyKeepsItsTypeAndBounds) { config::ExpectEveryKey(KeyboardSchema(), KeyboardProblem); }

// The ends of an axis and its centre are bounds of each other.
TEST(WheelFile, EveryDeclaredKeyKeepsItsTypeAndBounds) {
  std::set<std::string> no_bounds;
  for (const std::string axis : {"steering", "throttle", "brake", "clutch", "handbrake", "pedals"})
    no_bounds.insert({axis + ".min", axis + ".max", axis + ".centre"});
  config::ExpectEveryKey(WheelSchema(), WheelProblem, {{"force.most_Nm", {{"force.device_Nm", "50"}}}}, no_bounds);
}

TEST(KeyboardFile, WrongOnesAreRefusedWithTheirPlace) {
  EXPECT_EQ(KeyboardComplaint(kKeys), "");
  EXPECT_EQ(KeyboardComplaint("keys: {steer_left: [lefft], steer_right: [right], throttle: [up], brake: [down]}\n"),
            "keys.yaml:2: there is no key 'lefft'; did you mean 'left'?");
  EXPECT_EQ(KeyboardComplaint("keys:\n  steer_left: [left]\n  steer_right: [k]\n  throttle: [up]\n  brake: [down]\n"),
            "keys.yaml:4: 'k' cannot drive: the window keeps it (camera)");
  EXPECT_EQ(
      KeyboardComplaint(
          "keys: {steer_left: [left], steer_right: [right], throttle: [up], brake: [down], handbrake: [space]}\n"),
      "keys.yaml:2: 'space' cannot drive: the window keeps it (pause the run, and go on)");
  EXPECT_EQ(KeyboardComplaint("keys: {steer_left: [left], steer_right: [left], throttle: [up], brake: [down]}\n"),
            "keys.yaml:2: 'left' is taken for 'steer_left' already; a key that does nothing else was expected");
  EXPECT_EQ(KeyboardComplaint("keys: {steer_left: [left], steer_right: [right], throttle: [up]}\n"),
            "keys.yaml:2: 'keys.brake' is missing; a list of keys was expected");
  EXPECT_NE(KeyboardComplaint(kKeys + "steering: {turn_ms: 300}\n").find("'turn_s'"), std::string::npos);
  EXPECT_NE(KeyboardComplaint(kKeys + "brake: {press_s: 0}\n").find("brake.press_s"), std::string::npos);
}

TEST(WheelFile, TheProjectsOwnIsRead) {
  const auto settings = LoadWheel(kDrivers / "wheel.yaml");
  ASSERT_TRUE(settings.ok()) << settings.error().Text();
  EXPECT_TRUE(settings.value().AxisOf(WheelAxis::kThrottle)->inverted);
}

TEST(WheelFile, WrongOnesAreRefusedWithTheirPlace) {
  EXPECT_EQ(WheelComplaint(kDevice + "steering: {axis: 0}\n"), "");
  EXPECT_EQ(WheelComplaint("devices: {rim: 0300}\nsteering: {axis: 0}\n"),
            "wheel.yaml:2: 'devices.rim' is '0300'; a GUID of 32 hexadecimal digits was expected, as `rodeira "
            "joysticks` lists them");
  EXPECT_EQ(WheelComplaint(kDevice + "steering: {axis: 0}\nbrake: {device: rimm, axis: 1}\n"),
            "wheel.yaml:4: there is no device 'rimm'; did you mean 'rim'?");
  EXPECT_EQ(
      WheelComplaint(kDevice + "steering: {axis: 0}\nbrake: {axis: 1, min: 5, max: -5}\n"),
      "wheel.yaml:4: 'max' is -5 and 'min' 5; a larger 'max' was expected ('inverted: true' turns an axis round)");
  EXPECT_EQ(WheelComplaint(kDevice + "steering: {axis: 0, centre: 40000}\n"),
            "wheel.yaml:3: 'centre' is 40000; a number between 'min' (-32768) and 'max' (32767) was expected");
  EXPECT_EQ(
      WheelComplaint(kDevice + "steering: {axis: 0}\npedals: {axis: 1}\nbrake: {axis: 2}\n"),
      "wheel.yaml:4: 'pedals' is throttle and brake on one axis; either it or 'throttle' and 'brake' was expected");
  EXPECT_EQ(WheelComplaint(kDevice + "steering: {axis: 0}\nlever: {7: {button: 3}}\n"),
            "wheel.yaml:4: '7' is no place of the lever; reverse or a gear from 1 to 5 was expected");
  EXPECT_NE(WheelComplaint(kDevice).find("steering"), std::string::npos);
  EXPECT_NE(WheelComplaint("steering: {axis: 0}\n").find("devices"), std::string::npos);
}

}  // namespace
}  // namespace rodeira::input_devices
