// SPDX-License-Identifier: Apache-2.0
// Lights that a file puts on or under the road are put where a driver can see them; others stay where they are.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "common/world/network/network.hpp"
#include "common/world/opendrive/import.hpp"
#include "tests/common/world/opendrive/sample.hpp"

namespace rodeira::opendrive {
namespace {

std::string Signal(const std::string& id, double z_m, const std::string& height, const std::string& type = "1000001",
                   const std::string& dynamic = "yes", const std::string& inside = "") {
  return fmt::format(
      "<signal id=\"{}\" name=\"Signal_3Light_Post01\" s=\"50\" t=\"-5\" zOffset=\"{}\" orientation=\"+\" "
      "dynamic=\"{}\" country=\"OpenDRIVE\" type=\"{}\" subtype=\"-1\" {} width=\"0.4\">{}</signal>",
      id, z_m, dynamic, type, height, inside);
}

Import WithSignals(const std::string& signals) {
  RoadText road;
  road.more = "<signals>" + signals + "</signals>\n";
  return MustImport(Document(road.Text()));
}

std::vector<Finding> Raised(const Import& import) {
  std::vector<Finding> raised;
  std::ranges::copy_if(import.warnings, std::back_inserter(raised),
                       [](const Finding& finding) { return finding.rule == "rodeira.light_height"; });
  return raised;
}

double Height_m(const Import& import, const std::string& id) {
  for (const network::Signal& signal : import.network->roads()[0].spec().signals) {
    if (signal.id == id) return signal.z_offset_m;
  }
  ADD_FAILURE() << "no signal " << id;
  return 0.0;
}

// As in CARLA's Town07 and Town10HD: the housing's lower end is half a metre under the road.
TEST(SignalHeights, ALightUnderTheRoadIsPutWhereItIsSeen) {
  const Import import = WithSignals(Signal("buried", -0.449, "height=\"1.16\"") +
                                    Signal("on_it", 0.0, "height=\"0.9\"") + Signal("without", 0.0, ""));
  for (const char* id : {"buried", "on_it", "without"}) EXPECT_EQ(Height_m(import, id), 2.2) << id;
  const std::vector<Finding> told = Raised(import);
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0].road, "1");
  EXPECT_EQ(told[0].s_m, 50.0);
  EXPECT_EQ(told[0].repair.kind, RepairKind::kLightRaised);
}

// A height with its post (esmini), a light for bicycles, a display, a sign, and a light with a place of its own.
TEST(SignalHeights, WhatStandsAsItsFileSaysStays) {
  const std::string elsewhere = "<positionInertial x=\"1\" y=\"2\" z=\"0.2\" hdg=\"0\" pitch=\"0\" roll=\"0\"/>";
  const Import import = WithSignals(
      Signal("with_post", 0.0, "height=\"2.62\"") + Signal("bicycles", 0.9, "height=\"0.3\"", "1000013") +
      Signal("sign", 0.0, "height=\"0.6\"", "206") + Signal("display", 0.0, "height=\"0.6\"", "274", "yes") +
      Signal("elsewhere", 0.1, "height=\"0.5\"", "1000001", "yes", elsewhere));
  EXPECT_TRUE(Raised(import).empty());
  EXPECT_EQ(Height_m(import, "with_post"), 0.0);
  EXPECT_EQ(Height_m(import, "bicycles"), 0.9);
  EXPECT_EQ(Height_m(import, "sign"), 0.0);
  EXPECT_EQ(Height_m(import, "display"), 0.0);
  EXPECT_EQ(Height_m(import, "elsewhere"), 0.1);
}

}  // namespace
}  // namespace rodeira::opendrive
