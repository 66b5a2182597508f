// SPDX-License-Identifier: Apache-2.0
// The readers of roads (OpenDRIVE, traffic maps and their companions) against many seeded mutations of good files, as
// text_files_test.cpp does it for the others: what comes can be driven along and drawn, or is one sentence (law L6).
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "common/world/opendrive/import.hpp"
#include "common/world/traffic_map/companion_text.hpp"
#include "common/world/traffic_map/lane_map.hpp"
#include "common/world/traffic_map/map_plot.hpp"
#include "tests/common/world/opendrive/lit_crossing.hpp"
#include "tests/common/world/opendrive/sample.hpp"
#include "tests/common/world/traffic_map/sample_map.hpp"
#include "tests/property/fuzz.hpp"
#include "tests/property/good_file.hpp"

namespace rodeira::property {
namespace {

TEST(RoadFiles, OpenDrive) {
  opendrive::RoadText in, way;
  in.link = R"(<successor elementType="junction" elementId="9"/>)";
  in.geometry = R"(<geometry s="0" x="0" y="0" hdg="0.1" length="40"><spiral curvStart="0" curvEnd="0.01"/></geometry>
      <geometry s="40" x="39.53" y="6.62" hdg="0.3" length="60"><arc curvature="0.01"/></geometry>)";
  in.elevation = R"(<elevation s="0" a="1" b="0.02" c="0" d="0"/><elevation s="50" a="2" b="0.02" c="-0.0001" d="0"/>)";
  in.lateral =
      R"(<superelevation s="0" a="0.02" b="0.0001" c="0" d="0"/><shape s="0" t="-4" a="0" b="0.02" c="0" d="0"/>
      <shape s="50" t="-4" a="0.1" b="0.01" c="0" d="0"/>)";
  in.offset = R"(<laneOffset s="0" a="0" b="0.01" c="0" d="0"/>)";
  in.left =
      R"(<lane id="2" type="sidewalk" level="true"><width sOffset="0" a="2" b="0" c="0" d="0"/>
      <height sOffset="0" inner="0.1" outer="0.1"/></lane>
      <lane id="1" type="driving"><width sOffset="0" a="3.5" b="0" c="0" d="0"/>
      <roadMark sOffset="0" type="broken" color="white" width="0.12"/></lane>)";
  in.more =
      R"(<objects><object id="o" s="10" t="8" type="tree"/></objects><signals>
      <signal id="s" s="90" t="-5" type="274" value="50"/></signals>)";
  way.id = "7";
  way.attributes = "junction=\"9\"";
  way.geometry =
      R"(<geometry s="0" x="85" y="44" hdg="0.9" length="100">
      <paramPoly3 pRange="normalized" aU="0" bU="100" cU="0" dU="0" aV="0" bV="0" cV="3" dV="-1"/></geometry>)";
  const std::string junction =
      R"(<junction id="9"><connection id="0" incomingRoad="1" connectingRoad="7" contactPoint="start"/>
      <boundary><segment type="lane" roadId="7" boundaryLane="-1" sStart="begin" sEnd="end"/>
      <segment type="lane" roadId="7" boundaryLane="1" sStart="end" sEnd="begin"/></boundary>
      <planView><geometry s="0" x="75" y="32" hdg="0.9" length="130"><line/></geometry></planView>
      <elevationGrid sStart="0" gridSpacing="60"><elevation center="1" left="1" right="2"/>
      <elevation center="1.5" left="1" right="2"/><elevation center="1" left="2" right="1"/></elevationGrid>
      </junction>)";
  Fuzz("xodr",
       {opendrive::Document(opendrive::RoadText().Text()), opendrive::Document(in.Text() + way.Text() + junction)},
       [](const std::string& text) -> std::optional<base::Error> {
         opendrive::Tolerance loose;  // so that many mutated roads are driven on too
         loose.gap_m = 1e6;           // larger ones are tables of stations as long as they
         loose.kink_rad = 10.0;
         const auto import = opendrive::Read(text, "fuzz.xodr", loose);
         if (!import) return import.error();
         if (!import.value().errors.empty()) return opendrive::ToError(import.value().errors.front(), "fuzz.xodr");
         const network::Network& network = *import.value().network;
         std::vector<network::Surfacing> surfaces;
         for (const double x : {-20.0, 0.0, 30.0, 61.0, 1e6, 1e300}) {
           for (const double y : {-3.0, 0.0, 2.0, 40.0}) {
             const auto place = network.Locate(x, y, 0.5);
             const auto slow = network.LocateSlowly(x, y, 0.5);
             EXPECT_EQ(place.has_value(), slow.has_value());
             if (place) {
               EXPECT_LE(place->distance_m, slow->distance_m);
             }
             network.Surfaces(x, y, surfaces);
           }
         }
         for (const network::LaneKey& key : network.Lanes()) (void)network.Centre(key, network.Section(key).s_m);
         return std::nullopt;
       });
}

// By the usual tolerances: what is repaired is read again as it is, and repairing it once more changes nothing.
TEST(RoadFiles, RepairedOpenDrive) {
  opendrive::LitCrossing turned;
  turned.referenced = true, turned.outward[2] = true;
  Fuzz("xodr, repaired", {opendrive::LitCrossing().Text(), turned.Text()},
       [](const std::string& text) -> std::optional<base::Error> {
         const auto import = opendrive::Read(text, "fuzz.xodr");
         if (!import) return import.error();
         if (!import.value().errors.empty()) return opendrive::ToError(import.value().errors.front(), "fuzz.xodr");
         const opendrive::Reach reach = opendrive::ReachOf(*import.value().network);
         EXPECT_LE(reach.reached_m, reach.lanes_m + 1e-6);
         const std::string& repaired = import.value().repaired_text;
         if (repaired.empty()) return std::nullopt;
         const auto again = opendrive::Read(repaired, "again.xodr");
         if (!again) {
           ADD_FAILURE() << again.error().Text();
           return std::nullopt;
         }
         for (const opendrive::Finding& error : again.value().errors) ADD_FAILURE() << error.Text();
         EXPECT_TRUE(again.value().repaired_text.empty());
         return std::nullopt;
       });
}

// What is read comes back to the byte; what the check finds no error in can be driven along and drawn.
TEST(RoadFiles, Maps) {
  Fuzz("motors",
       {traffic_map::Figure18(), traffic_map::AppendixA15(), traffic_map::GoodMap(), traffic_map::GoodMap(),
        GoodFile("configs/maps/roundabout.motors")},
       [](const std::string& text) -> std::optional<base::Error> {
         const auto file = traffic_map::ParseMap(text, "fuzz.motors");
         if (!file) return file.error();
         EXPECT_EQ(traffic_map::WriteMap(file.value()), text);
         bool errors = false;
         for (const traffic_map::Finding& finding : traffic_map::CheckMap(file.value(), {})) {
           errors = errors || finding.severity == traffic_map::Severity::kError;
           EXPECT_FALSE(finding.Text().empty());
           EXPECT_TRUE(finding.element == traffic_map::Element::kMap || finding.line > 0) << finding.Text();
         }
         const auto made = traffic_map::MakeLaneMap(file.value(), {}, "fuzz.motors");
         EXPECT_EQ(made.ok(), !errors);
         if (!made) return std::nullopt;
         for (const traffic_map::MapLane& lane : made.value().lanes) {
           for (const double share : {0.0, 0.3, 1.0}) {
             const traffic_map::LanePoint at = lane.shape.At(share * lane.shape.length_m());
             EXPECT_TRUE(at.p_W.allFinite() && std::isfinite(at.width_m()) && std::isfinite(at.curvature_1pm));
           }
         }
         EXPECT_FALSE(traffic_map::PlotMap(made.value()).empty());
         return std::nullopt;
       });
}

TEST(RoadFiles, MapHeights) {
  Fuzz("heights",
       {GoodFile("configs/maps/overpass.motors.yaml"),
        "rodeira: motors/1\nheights_m: {1: [0, 1, 2, 3], -4: [0, 0, 0, 1]}\n",
        "# by hand\nrodeira: motors/1\nheights_m:\n  1: [0, 1, 2, 3]  # ramp\nlights:\n  - phases:\n      - {green: "
        "[1, 2], for_s: 20}\nsigns:\n  - {lane: 1, kind: speed_limit, limit_kmh: 30}\n  - lane: 2\n    kind: "
        "stop\nflows_vehph:\n  1: 300\n"},
       [](const std::string& text) -> std::optional<base::Error> {
         const auto heights = traffic_map::ParseHeights(text, "fuzz.motors.yaml");
         if (!heights) return heights.error();
         for (const auto& one : heights.value().curves) EXPECT_EQ(heights.value().Of(one.curve), one.z_m);
         // Unedited it keeps its bytes; edited it says what it should.
         EXPECT_EQ(traffic_map::CompanionText(heights.value(), heights.value(), text), text);
         traffic_map::Heights edited = heights.value();
         edited.curves.clear();
         edited.signs.push_back({7, traffic_map::SignKind::kGiveWay, 2.5, 0.0, 0});
         const auto again =
             traffic_map::ParseHeights(traffic_map::CompanionText(edited, heights.value(), text), "again.motors.yaml");
         EXPECT_TRUE(again.ok() && traffic_map::CompanionText(again.value()) == traffic_map::CompanionText(edited))
             << text;
         return std::nullopt;
       });
}

}  // namespace
}  // namespace rodeira::property
