// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <unistd.h>

#include "common/world/road/world.hpp"
#include "tests/tree.hpp"

namespace rodeira::scene {

inline std::filesystem::path SharedXodr(const std::string& name) {
  return std::filesystem::path(SourceDir()) / "../shared/data/road/xodr" / (name + ".xodr");
}

// A world of OpenDRIVE roads, by way of a file.
inline std::shared_ptr<const road::World> OpenDriveWorld(const std::string& roads) {
  static int number = 0;
  const auto file =
      std::filesystem::temp_directory_path() / fmt::format("rodeira_ground_{}_{}.xodr", ::getpid(), number++);
  std::ofstream(file) << "<?xml version=\"1.0\"?>\n<OpenDRIVE>\n<header revMajor=\"1\" revMinor=\"7\"/>\n"
                      << roads << "</OpenDRIVE>\n";
  auto world = road::World::Load(file);
  std::filesystem::remove(file);
  EXPECT_TRUE(world.ok()) << world.error().Text();
  return world.ok() ? world.value() : nullptr;
}

// A bend that climbs over a crest, banked, with a crown and marks of all kinds, through a raised kerb; and a road that
// crosses it 7 m higher. dx, dy: where it lies.
inline std::string BendUnderBridge(double dx_m = 0.0, double dy_m = 0.0) {
  const auto width = [](double a) { return fmt::format("<width sOffset=\"0\" a=\"{}\" b=\"0\" c=\"0\" d=\"0\"/>", a); };
  return fmt::format(
      "<road id=\"1\" length=\"160\" junction=\"-1\"><planView>"
      "<geometry s=\"0\" x=\"{}\" y=\"{}\" hdg=\"0.3\" length=\"50\"><spiral curvStart=\"0\" "
      "curvEnd=\"0.012\"/></geometry>"
      "<geometry s=\"50\" x=\"{}\" y=\"{}\" hdg=\"0.6\" length=\"110\"><arc "
      "curvature=\"0.012\"/></geometry></planView>"
      "<elevationProfile><elevation s=\"0\" a=\"3\" b=\"0.05\" c=\"0\" d=\"0\"/><elevation s=\"40\" a=\"5\" "
      "b=\"0.05\" c=\"-0.00125\" d=\"0\"/>"
      "<elevation s=\"80\" a=\"5\" b=\"-0.05\" c=\"0\" d=\"0\"/></elevationProfile>"
      "<lateralProfile><superelevation s=\"0\" a=\"0\" b=\"0.001\" c=\"0\" d=\"0\"/><superelevation s=\"60\" "
      "a=\"0.06\" b=\"0\" c=\"0\" d=\"0\"/></lateralProfile>"
      "<lanes><laneSection s=\"0\"><left><lane id=\"2\" type=\"sidewalk\">{}<height sOffset=\"0\" inner=\"0.12\" "
      "outer=\"0.12\"/></lane>"
      "<lane id=\"1\" type=\"driving\">{}<roadMark sOffset=\"0\" type=\"solid\" color=\"white\" "
      "width=\"0.15\"/></lane></left>"
      "<center><lane id=\"0\"><roadMark sOffset=\"0\" type=\"solid broken\" color=\"yellow\" "
      "width=\"0.12\"/></lane></center>"
      "<right><lane id=\"-1\" type=\"driving\">{}<roadMark sOffset=\"0\" type=\"broken\" color=\"white\" "
      "width=\"0.12\"/></lane>"
      "<lane id=\"-2\" type=\"shoulder\"><width sOffset=\"0\" a=\"1\" b=\"0.0125\" c=\"0\" "
      "d=\"0\"/></lane></right></laneSection></lanes></road>\n"
      "<road id=\"2\" length=\"160\" junction=\"-1\"><planView><geometry s=\"0\" x=\"{}\" y=\"{}\" hdg=\"2.9\" "
      "length=\"160\"><line/></geometry></planView>"
      "<elevationProfile><elevation s=\"0\" a=\"10.5\" b=\"0\" c=\"0\" d=\"0\"/></elevationProfile>"
      "<lanes><laneSection s=\"0\"><left><lane id=\"1\" type=\"driving\">{}</lane></left><center><lane "
      "id=\"0\"/></center>"
      "<right><lane id=\"-1\" type=\"driving\">{}</lane></right></laneSection></lanes></road>\n",
      dx_m, dy_m, dx_m + 45.870581, dy_m + 19.389643, width(2.0), width(3.5), width(3.5), dx_m + 157.22, dy_m + 48.35,
      width(3.0), width(3.0));
}

}  // namespace rodeira::scene
