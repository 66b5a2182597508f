// SPDX-License-Identifier: Apache-2.0
// Three views of one run, each a process with a screen of its own around the driver's seat.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "common/core/base/files.hpp"
#include "common/core/base/temporary_folder.hpp"
#include "tests/nodes/view/read_png.hpp"
#include "tests/system/command.hpp"
#include "tests/tree.hpp"

namespace rodeira::system_test {
namespace {

namespace fs = std::filesystem;

constexpr int kWidth = 320, kHeight = 180;

std::string View(const std::string& screen) {
  return "  " + screen + ": {kind: view, config: {screen: " + screen +
         ", window: never, instruments: false, mirrors: [], quality: low, width_px: 320, height_px: 180, frames: "
         "{times_s: [2, 5], folder: " +
         screen + "}}}\n";
}

// How far the colours at one picture's right edge are from those at the left edge of the next, 0 to 255.
double Seam(const nodes::Image& left, const nodes::Image& right) {
  double sum = 0.0;
  for (int y = 0; y < kHeight; ++y) {
    for (int part = 0; part < 3; ++part) sum += std::abs(left.At(kWidth - 1, y)[part] - right.At(0, y)[part]);
  }
  return sum / (3.0 * kHeight);
}

// Every view writes the frames of the same steps, and at each step what one screen shows goes on in the next: not so
// with another step's.
TEST(ThreeScreens, OfARunShowTheSameSteps) {
  const auto folder = base::TemporaryFolder::Make("screens").value();
  const fs::path configs = fs::path(SourceDir()) / "configs", file = folder.path() / "screens.yaml";
  ASSERT_TRUE(
      base::WriteWhole(
          file, "rodeira: launch/1\nname: screens\nlab: " + (configs / "labs/three_screens.yaml").string() +
                    "\nworld: " + (configs / "worlds/n222.yaml").string() +
                    "\nseed: 1\nduration_s: 5.1\nnodes:\n  road: {kind: road}\n  driver: {kind: input, config: "
                    "{source: autopilot, driver: " +
                    (configs / "drivers/default.yaml").string() +
                    ", vehicle: " + (configs / "vehicles/default.yaml").string() +
                    "}}\n  ego: {kind: vehicle, config: {vehicle: " + (configs / "vehicles/default.yaml").string() +
                    "}}\n" + View("left") + View("centre") + View("right"))
          .ok());
  const Ended run = RunCommand({Bin("rodeira"), "run", file.string(), "--pace", "max", "--no-record", "--quiet"});
  if (run.out.find("OpenGL") != std::string::npos) GTEST_SKIP() << "no OpenGL here: " << run.out;
  ASSERT_EQ(run.status, 0) << run.out;
  const auto picture = [&](const char* screen, const char* step) {
    return nodes::ReadPng(folder.path() / screen / ("step_00000" + std::string(step) + ".png"));
  };
  for (const auto& [step, other] : {std::pair("2000", "5000"), std::pair("5000", "2000")}) {
    const nodes::Image left = picture("left", step), centre = picture("centre", step), right = picture("right", step);
    ASSERT_EQ(std::pair(centre.width_px, centre.height_px), std::pair(kWidth, kHeight));
    const double one = Seam(left, centre), two = Seam(centre, right);
    EXPECT_LT(one, 6.0) << step;
    EXPECT_LT(two, 6.0) << step;
    EXPECT_GT(Seam(left, picture("centre", other)), 1.5 * one) << "of another step, " << step;
    EXPECT_GT(Seam(picture("centre", other), right), 1.5 * two) << "of another step, " << step;
  }
}

}  // namespace
}  // namespace rodeira::system_test
