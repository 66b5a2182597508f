// SPDX-License-Identifier: Apache-2.0
// What `rodeira world check` says of repaired OpenDRIVE files, and the repaired file that it writes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "common/core/base/files.hpp"
#include "common/world/road/network_world.hpp"
#include "common/world/road/world.hpp"
#include "tests/common/world/opendrive/sample.hpp"
#include "tests/common/world/road/netconvert.hpp"
#include "tests/launch/rodeira/temporary_folder.hpp"

namespace rodeira::road {
namespace {

using opendrive::Document;
using opendrive::RoadText;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// Twenty roads, each with its elevation records in the wrong order, and one more that leads to a road that is missing.
std::string Twenty() {
  std::string roads;
  for (int i = 0; i < 20; ++i) {
    RoadText road;
    road.id = std::to_string(i);
    road.geometry =
        fmt::format("<geometry s=\"0\" x=\"0\" y=\"{}\" hdg=\"0\" length=\"100\"><line/></geometry>", 20 * i);
    road.elevation = R"(<elevation s="50" a="1" b="0" c="0" d="0"/><elevation s="0" a="1" b="0" c="0" d="0"/>)";
    if (i == 19) road.link = R"(<successor elementType="road" elementId="77" contactPoint="start"/>)";
    roads += road.Text();
  }
  return Document(roads);
}

TEST(RepairedNetwork, EachKindIsOneWarningUnlessAllAreAskedFor) {
  const cli::TemporaryFolder folder;
  const auto file = folder.Write("it.xodr", Twenty());
  EXPECT_THAT(CheckNetwork(file, false).warnings,
              ElementsAre(AllOf(HasSubstr("it.xodr:7: road.elevation.elem_asc_order: road 0, s 0"),
                                HasSubstr("(20 of this kind); repaired: they are read in the order of s")),
                          HasSubstr("road.linkage.id: road 19, s 100")));
  EXPECT_EQ(CheckNetwork(file, false, true).warnings.size(), 21u);
  EXPECT_THAT(CheckNetwork(file, false).errors, IsEmpty());
  EXPECT_THAT(CheckNetwork(file, false).table, HasSubstr("driving lanes that are reached and lead on: 95.0 % of "
                                                         "4000.000 m as drawn, 100.0 % of 4000.000 m as read\n"));
  EXPECT_EQ(CheckNetwork(file, true).errors.size(), 20u);
  EXPECT_EQ(CheckNetwork(file, false, false, false).errors.size(), 20u);
}

TEST(RepairedNetwork, IsWrittenAndPassesStrictly) {
  const cli::TemporaryFolder folder;
  const std::string text = Twenty();
  const auto file = folder.Write("in.xodr", text);
  const auto out = folder.path() / "it.xodr", again = folder.path() / "again.xodr";
  const auto left = WriteRepaired(file, out);
  ASSERT_TRUE(left.ok());
  EXPECT_THAT(left.value(), IsEmpty());
  ASSERT_TRUE(WriteRepaired(out, again).ok());
  const std::string repaired = base::ReadText(out).value();
  EXPECT_EQ(base::ReadText(again).value(), repaired);
  // The records have changed places, the link is gone, and every other byte is as it was.
  std::string expected = text;
  const std::string wrong = R"(<elevation s="50" a="1" b="0" c="0" d="0"/><elevation s="0" a="1" b="0" c="0" d="0"/>)",
                    right = R"(<elevation s="0" a="1" b="0" c="0" d="0"/><elevation s="50" a="1" b="0" c="0" d="0"/>)",
                    link = R"(<successor elementType="road" elementId="77" contactPoint="start"/>)";
  for (std::size_t at = expected.find(wrong); at != std::string::npos; at = expected.find(wrong, at))
    expected.replace(at, wrong.size(), right);
  expected.erase(expected.find(link), link.size());
  EXPECT_EQ(repaired, expected);
  if (!HasNetconvert()) GTEST_SKIP() << "netconvert (sumo) is not installed";
  EXPECT_EQ(std::system(("[ -n \"$SUMO_HOME\" ] || export SUMO_HOME=/usr/share/sumo; netconvert --opendrive-files " +
                         out.string() + " -o " + (folder.path() / "it.net.xml").string() + " > /dev/null 2>&1")
                            .c_str()),
            0);
}

TEST(RepairedNetwork, SaysWhatIsLeft) {
  const cli::TemporaryFolder folder;
  RoadText road;
  road.geometry =
      "<geometry s=\"0\" x=\"0\" y=\"0\" hdg=\"0\" length=\"50\"><line/></geometry><geometry s=\"50\" x=\"50\" y=\"0\" "
      "hdg=\"0.02\" length=\"50\"><line/></geometry>";
  const auto left = WriteRepaired(folder.Write("in.xodr", Document(road.Text())), folder.path() / "it.xodr");
  ASSERT_TRUE(left.ok());
  EXPECT_THAT(left.value(), ElementsAre(HasSubstr("it.xodr:6: road.geometry.contact_heading: road 1, s 50")));
}

// A world brings one sentence a kind, however often something was repaired: 20 elevations, one link. What is only told
// is not among them.
TEST(RepairedNetwork, AWorldBringsASentenceAKind) {
  const cli::TemporaryFolder folder;
  std::string text = Twenty();
  text.replace(text.find("<road id=\"3\""), 12, "<road id=\"3\" colour=\"red\"");
  const auto file = folder.Write("it.xodr", text);
  EXPECT_EQ(CheckNetwork(file, false).warnings.size(), 3u);
  const auto two = ElementsAre(AllOf(HasSubstr("it.xodr:7: road.elevation.elem_asc_order: road 0, s 0"),
                                     HasSubstr("(20 of this kind); repaired: ")),
                               AllOf(HasSubstr("road.linkage.id: road 19, s 100"), HasSubstr("the road ends there")));
  const auto world = World::Load(file);
  ASSERT_TRUE(world.ok());
  EXPECT_THAT(world.value()->warnings(), two);
  const auto named =
      World::Load(folder.Write("named.yaml", "rodeira: world/2\nname: named\nnetwork: {file: it.xodr}\n"));
  ASSERT_TRUE(named.ok()) << named.error().Text();
  EXPECT_THAT(named.value()->warnings(), two);
  EXPECT_THAT(World::Load(folder.Write("good.xodr", Document(RoadText().Text()))).value()->warnings(), IsEmpty());
}

TEST(RepairedNetwork, WithoutALaneForDrivingIsRefused) {
  const cli::TemporaryFolder folder;
  RoadText road;
  road.left = "";
  road.right = "<lane id=\"-1\" type=\"sidewalk\"><width sOffset=\"0\" a=\"2\" b=\"0\" c=\"0\" d=\"0\"/></lane>";
  const NetworkCheck check = CheckNetwork(folder.Write("it.xodr", Document(road.Text())), false);
  ASSERT_EQ(check.errors.size(), 1u);
  const char* sentence =
      "it.xodr: the network has no lane for driving: its lanes are of the types sidewalk; driving was";
  EXPECT_THAT(check.errors[0].Text(), HasSubstr(sentence));
  // No command drives on it, either.
  const auto world = World::Load(folder.path() / "it.xodr");
  ASSERT_FALSE(world.ok());
  EXPECT_THAT(world.error().Text(), HasSubstr(sentence));
}

}  // namespace
}  // namespace rodeira::road
