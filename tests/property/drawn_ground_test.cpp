// SPDX-License-Identifier: Apache-2.0
// Small OpenDRIVE files, mutated, as they are drawn (tests/property/fuzz.hpp): what a reader takes must not break, or
// hold up for ever, on any thread.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "common/core/base/files.hpp"
#include "tests/common/world/opendrive/sample.hpp"
#include "tests/property/drawn_ground.hpp"
#include "tests/property/fuzz.hpp"

namespace rodeira::property {
namespace {

// One road with marks of all kinds, bank, kerb, objects and signs; and a second one that crosses over it.
std::string Marked() {
  opendrive::RoadText road;
  road.length = 60.0;
  road.geometry =
      R"(<geometry s="0" x="0" y="0" hdg="0.1" length="30"><spiral curvStart="0" curvEnd="0.01"/></geometry>
          <geometry s="30" x="29.633522475" y="4.478380053" hdg="0.25" length="30"><arc curvature="0.01"/></geometry>)";
  road.elevation =
      R"(<elevation s="0" a="1" b="0.02" c="0" d="0"/><elevation s="30" a="1.6" b="0.02" c="-0.0001" d="0"/>)";
  road.lateral = R"(<superelevation s="0" a="0.02" b="0.0001" c="0" d="0"/>)";
  road.offset = R"(<laneOffset s="0" a="0" b="0.01" c="0" d="0"/>)";
  road.left =
      R"(<lane id="2" type="sidewalk"><width sOffset="0" a="2" b="0" c="0" d="0"/>
          <height sOffset="0" inner="0.12" outer="0.12"/></lane>
      <lane id="1" type="driving"><width sOffset="0" a="3.5" b="0" c="0.001" d="0"/>
        <roadMark sOffset="0" type="broken" color="white" width="0.12"/></lane>)";
  road.right =
      R"(<lane id="-1" type="driving"><width sOffset="0" a="3.5" b="0" c="0" d="0"/>
          <width sOffset="40" a="3.5" b="0.05" c="0" d="0"/>
          <roadMark sOffset="0" type="broken" color="yellow" width="0.12"><type name="x" width="0.12">
      <line length="3" space="6" tOffset="0.1" sOffset="1" width="0.12"/></type>
        <sway ds="0" a="0" b="0.01" c="0" d="0"/></roadMark></lane>)";
  road.more =
      R"(<objects><object id="o" s="10" t="8" type="tree" height="6" radius="1"/>
          <object id="p" s="40" t="-9" type="parkingSpace" length="5" width="2.5"/>
      <object id="b" s="5" t="7" type="barrier" height="1" width="0.3">
        <repeat s="5" length="50" distance="0" tStart="7" tEnd="7.5" heightStart="1" heightEnd="1" widthStart="0.3"
        widthEnd="0.3"/></object>
      <object id="c" s="30" t="0" type="crosswalk" hdg="1.57" length="7" width="3"/>
        <object id="l" s="9" t="-6" type="pole" height="5" radius="0.1">
        <repeat s="9" length="40" distance="10" tStart="-6" tEnd="-6"/></object>
      <object id="f" s="20" t="9" type="building"><outline><cornerLocal u="-2" v="-2" z="0" height="3"/>
        <cornerLocal u="2" v="-2" z="0" height="3"/><cornerLocal u="0" v="2" z="0" height="3"/></outline></object>
        </objects>
      <signals><signal id="s" s="50" t="-5" zOffset="2" dynamic="no" orientation="+" type="274" country="DE"
        value="50"/></signals>)";
  return opendrive::Document(road.Text());
}

std::string Crossing() {
  opendrive::RoadText below, above;
  above.id = "2", above.length = 50.0;
  above.geometry = R"(<geometry s="0" x="60" y="-20" hdg="1.4" length="50"><line/></geometry>)";
  above.elevation = R"(<elevation s="0" a="7" b="0" c="0" d="0"/>)";
  below.lateral =
      R"(<shape s="0" t="-4" a="0" b="0.02" c="0" d="0"/><shape s="50" t="-4" a="0.1" b="0.01" c="0" d="0"/>)";
  below.more = R"(<objects><bridge id="x" s="10" length="20" type="concrete"/></objects>)";
  return opendrive::Document(below.Text() + above.Text());
}

TEST(DrawnGround, OfOpenDriveFiles) {
  const auto folder = std::filesystem::temp_directory_path() / ("rodeira-drawn-property-" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  Fuzz("xodr as it is drawn", {Marked(), Crossing()}, [&](const std::string& text) -> std::optional<base::Error> {
    if (const auto written = base::WriteWhole(folder / "fuzz.xodr", std::string_view(text)); !written.ok())
      ADD_FAILURE() << written.error().Text();
    const auto world = road::World::Load(folder / "fuzz.xodr");
    if (!world) return world.error();
    EXPECT_EQ(DrawnWrongly(*world.value()), "");
    return std::nullopt;
  });
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace rodeira::property
