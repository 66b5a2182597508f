// SPDX-License-Identifier: Apache-2.0
// Lanes of other widths behind a junction, and ways with kinks: a car can drive on.
#include "common/world/sumo/lane_joints.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "common/world/opendrive/import.hpp"

namespace rodeira::sumo {
namespace {

std::string Lanes(const std::vector<double>& widths_m, bool is_way) {
  std::string lanes;
  for (std::size_t i = 0; i < widths_m.size(); ++i) {
    const int id = -static_cast<int>(i) - 1;
    lanes += fmt::format(
        "<lane id=\"{0}\" type=\"driving\"><link>{1}</link><width sOffset=\"0\" a=\"{2}\" b=\"0\" c=\"0\" "
        "d=\"0\"/></lane>",
        id, is_way ? fmt::format("<predecessor id=\"{0}\"/><successor id=\"{0}\"/>", id) : "", widths_m[i]);
  }
  return lanes;
}

std::string Road(int id, double length_m, double x_m, double y_m, double heading_rad, const std::string& link,
                 const std::vector<double>& widths_m) {
  const bool is_way = id == 3;
  return fmt::format(
      "<road id=\"{}\" length=\"{}\" junction=\"{}\"><link>{}</link><planView><geometry s=\"0\" x=\"{}\" y=\"{}\" "
      "hdg=\"{:.17g}\" length=\"{}\"><line/></geometry></planView><lanes><laneSection s=\"0\"><center><lane id=\"0\" "
      "type=\"none\"/></center><right>{}</right></laneSection></lanes></road>",
      id, length_m, is_way ? "9" : "-1", link, x_m, y_m, heading_rad, length_m, Lanes(widths_m, is_way));
}

const std::string kInto = "<successor elementType=\"junction\" elementId=\"9\"/>";
const std::string kOutOf = "<predecessor elementType=\"junction\" elementId=\"9\"/>";
const std::string kOver =
    "<predecessor elementType=\"road\" elementId=\"1\" contactPoint=\"end\"/>"
    "<successor elementType=\"road\" elementId=\"2\" contactPoint=\"start\"/>";

std::string Drive(const std::string& roads, std::size_t lanes) {
  std::string links;
  for (std::size_t i = 1; i <= lanes; ++i) links += fmt::format("<laneLink from=\"-{0}\" to=\"-{0}\"/>", i);
  return "<OpenDRIVE><header revMajor=\"1\" revMinor=\"4\"/>" + roads +
         "<junction id=\"9\"><connection id=\"0\" incomingRoad=\"1\" connectingRoad=\"3\" contactPoint=\"start\">" +
         links + "</connection></junction></OpenDRIVE>";
}

template <class Change>
opendrive::Import Changed(const std::string& drive, const Change& change) {
  pugi::xml_document document;
  EXPECT_TRUE(document.load_string(drive.c_str()));
  change(document.child("OpenDRIVE"));
  std::ostringstream text;
  document.save(text);
  auto import = opendrive::Read(text.str(), "it.xodr");
  EXPECT_TRUE(import.ok() && import.value().network != nullptr);
  return std::move(import).value();
}

double Reached(const opendrive::Import& import) { return opendrive::ReachOf(*import.network).share(); }

std::vector<std::string> Repairs(const opendrive::Import& import) {
  std::vector<std::string> names;
  for (const opendrive::Finding& warning : import.warnings) {
    if (!warning.repair.Name().empty()) names.push_back(warning.repair.Name());
  }
  return names;
}

double WidthAt(const network::Network& network, const std::string& road, int lane, double s_m) {
  return network.Span({network.FindRoad(road).value(), 0, lane}, s_m)->width_m();
}

// The inner lane of the road behind is 2.52 m wider, as in CARLA's Town06.
std::string Stepped(double before_m, double behind_m) {
  return Drive(Road(1, before_m, -before_m, 0.0, 0.0, kInto, {1.66, 3.5, 3.5}) +
                   Road(2, behind_m, 3.0, 0.0, 0.0, kOutOf, {4.18, 3.5, 3.5}) +
                   Road(3, 3.0, 0.0, 0.0, 0.0, kOver, {4.18, 3.5, 3.5}),
               3);
}

TEST(LaneJoints, LanesOfOtherWidthsAreDrivenFromEndToEnd) {
  const auto nothing = [](pugi::xml_node) {};
  EXPECT_LT(Reached(Changed(Stepped(50.0, 100.0), nothing)), 0.9) << "netconvert's lanes lie 2.52 m aside";
  std::size_t fitted = 0;
  const auto import = Changed(Stepped(50.0, 100.0), [&](pugi::xml_node drive) { fitted = FitWidths(drive); });
  EXPECT_EQ(fitted, 1u);
  EXPECT_EQ(Reached(import), 1.0);
  EXPECT_THAT(Repairs(import), testing::IsEmpty());
  EXPECT_NEAR(WidthAt(*import.network, "1", -1, 25.0), 1.66, 1e-9);
  EXPECT_NEAR(WidthAt(*import.network, "3", -1, 1.5), 1.66, 1e-9);
  EXPECT_NEAR(WidthAt(*import.network, "2", -1, 0.0), 1.66, 1e-9);
  EXPECT_NEAR(WidthAt(*import.network, "2", -1, 3.0 * 2.52), 0.5 * (1.66 + 4.18), 1e-6) << "6 m for each metre";
  EXPECT_NEAR(WidthAt(*import.network, "2", -1, 6.0 * 2.52 + 0.01), 4.18, 1e-6);
}

TEST(LaneJoints, ARoadBehindThatIsTooShortKeepsItsWidths) {
  const auto import = Changed(Stepped(50.0, 4.0), [](pugi::xml_node drive) { FitWidths(drive); });
  EXPECT_EQ(Reached(import), 1.0);
  EXPECT_NEAR(WidthAt(*import.network, "2", -1, 0.0), 4.18, 1e-9);
  EXPECT_NEAR(WidthAt(*import.network, "1", -1, 50.0), 4.18, 1e-6);
  EXPECT_NEAR(WidthAt(*import.network, "1", -1, 50.0 - 6.0 * 2.52 - 0.01), 1.66, 1e-6);
}

TEST(LaneJoints, LanesThatMeetKeepTheirBytes) {
  const std::string same = Drive(Road(1, 50, -50, 0, 0, kInto, {3.5, 3.2}) + Road(2, 50, 3, 0, 0, kOutOf, {3.5, 3.2}) +
                                     Road(3, 3, 0, 0, 0, kOver, {3.5, 3.2}),
                                 2);
  pugi::xml_document document, untouched;
  ASSERT_TRUE(document.load_string(same.c_str()) && untouched.load_string(same.c_str()));
  EXPECT_EQ(FitWidths(document.child("OpenDRIVE")), 0u);
  EXPECT_EQ(BendKinkedWays(document.child("OpenDRIVE")), 0u);
  std::ostringstream a, b;
  document.save(a), untouched.save(b);
  EXPECT_EQ(a.str(), b.str());
}

// South on road 1, north again on road 2, `apart_m` to the left.
std::string TurningRound(double apart_m) {
  const double quarter = std::acos(-1.0) / 2.0;
  return Drive(Road(1, 50, 0, 50, -quarter, kInto, {3.5, 3.5}) + Road(2, 50, apart_m, 0, quarter, kOutOf, {3.5, 3.5}) +
                   Road(3, apart_m, 0, 0, 0, kOver, {3.5, 3.5}),
               2);
}

TEST(LaneJoints, AKinkedWayThatACarCanDriveIsACurve) {
  std::size_t bent = 0;
  const auto import = Changed(TurningRound(6.4), [&](pugi::xml_node drive) { bent = BendKinkedWays(drive); });
  EXPECT_EQ(bent, 1u);
  EXPECT_EQ(Reached(import), 1.0);
  EXPECT_THAT(Repairs(import), testing::IsEmpty());
  const network::Network& network = *import.network;
  const std::uint32_t way = network.FindRoad("3").value();
  for (const int lane : {-1, -2}) {  // one cubic is a half circle round (3.2, 0) within 1.84 % of its radius
    const double radius_m = 3.2 + (lane == -1 ? 1.75 : 5.25);
    for (double share = 0.0; share <= 1.0; share += 0.05) {
      const auto p = network.Centre({way, 0, lane}, share * network.roads()[way].length_m());
      EXPECT_NEAR(std::hypot(p.x() - 3.2, p.y()), radius_m, 0.0185 * 3.2);
    }
  }
}

TEST(LaneJoints, AWayThatNoCarCanDriveStaysAsItIs) {
  pugi::xml_document document;
  ASSERT_TRUE(document.load_string(TurningRound(3.2).c_str()));
  EXPECT_EQ(BendKinkedWays(document.child("OpenDRIVE")), 0u);
}

}  // namespace
}  // namespace rodeira::sumo
