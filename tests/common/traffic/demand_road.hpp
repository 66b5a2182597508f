// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "common/traffic/traffic_model.hpp"
#include "tests/common/world/opendrive/sample.hpp"

namespace rodeira::traffic {

// A traffic file's content below its first line.
inline TrafficSettings Settings(const std::string& yaml, std::uint64_t seed = 1) {
  auto file = config::File::Parse("rodeira: traffic/1\n" + yaml, "t.yaml").value();
  (void)file.root().Text("rodeira");
  TrafficSettings settings = ReadTraffic(file.root(), seed);
  const auto status = file.Finish();
  EXPECT_TRUE(status.ok()) << (status.ok() ? "" : status.error().Text());
  return settings;
}

// A road of two lanes to the east; the right one goes on into an exit, the left one straight on.
inline std::shared_ptr<const network::Network> Exit(double length_m, const std::string& more = "") {
  const auto lane = [](int id, int to, double width, const char* mark) {
    return fmt::format(
        "<lane id=\"{}\" type=\"driving\"><link>{}</link><width sOffset=\"0\" a=\"{}\" b=\"0\" c=\"0\" d=\"0\"/>"
        "<roadMark sOffset=\"0\" type=\"{}\" color=\"white\" width=\"0.12\"/><speed sOffset=\"0\" max=\"20\" "
        "unit=\"m/s\"/></lane>",
        id, to == 0 ? "" : fmt::format("<successor id=\"{}\"/>", to), width, mark);
  };
  const auto line = [](double x, double y, double heading, double length) {
    return fmt::format("<geometry s=\"0\" x=\"{}\" y=\"{}\" hdg=\"{}\" length=\"{}\"><line/></geometry>", x, y, heading,
                       length);
  };
  opendrive::RoadText road, on, off;
  road.left = on.left = off.left = "";
  road.length = length_m;
  road.geometry = line(0.0, 0.0, 0.0, length_m);
  road.right = lane(-1, 0, 3.5, "broken") + lane(-2, 0, 3.5, "solid");
  road.link = "<successor elementType=\"junction\" elementId=\"9\"/>";
  on.id = "2", on.length = 300.0;
  on.geometry = line(length_m, 0.0, 0.0, 300.0);
  on.right = lane(-1, 0, 3.5, "solid");
  off.id = "3", off.length = 300.0;
  off.geometry = line(length_m, -3.5, 0.0, 300.0);
  off.right = lane(-1, 0, 3.5, "solid");
  on.link = off.link = "<predecessor elementType=\"road\" elementId=\"1\" contactPoint=\"end\"/>";
  const std::string junction =
      "<junction id=\"9\" name=\"exit\" type=\"direct\">"
      "<connection id=\"0\" incomingRoad=\"1\" linkedRoad=\"2\" contactPoint=\"start\"><laneLink from=\"-1\" "
      "to=\"-1\"/></connection>"
      "<connection id=\"1\" incomingRoad=\"1\" linkedRoad=\"3\" contactPoint=\"start\"><laneLink from=\"-2\" "
      "to=\"-1\"/></connection></junction>";
  on.link = off.link = "<predecessor elementType=\"junction\" elementId=\"9\"/>";
  return opendrive::MustRead(opendrive::Document(road.Text() + on.Text() + off.Text() + junction + more));
}

}  // namespace rodeira::traffic
