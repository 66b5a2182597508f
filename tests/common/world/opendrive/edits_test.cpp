// SPDX-License-Identifier: Apache-2.0
// Changes of a text that leave its other bytes as they are. Expected texts are written by hand.
#include <gmock/gmock.h>

#include "common/world/opendrive/edits.hpp"
#include "tests/common/world/opendrive/sample.hpp"

namespace rodeira::opendrive {
namespace {

std::string After(const std::string& text, std::vector<Edit> edits) {
  return Apply(text, Compatible(std::move(edits)));
}

TEST(Edits, AnElementEndsBehindItsEndTag) {
  const std::string text = "<a><b x='>'/><!-- </a> --><c><![CDATA[</a>]]></c></a><d/>";
  EXPECT_EQ(ElementEnd(text, 0), text.size() - 4);
  EXPECT_EQ(ElementEnd(text, 3), 13u);
  EXPECT_EQ(TagEnd(text, 3), 13u);
}

TEST(Edits, AnAttributeIsReplacedOrAdded) {
  const std::string text = "<a x = '1' xy=\"2\"/>";
  EXPECT_EQ(After(text, {SetAttribute(text, 0, "x", "9")}), "<a x = '9' xy=\"2\"/>");
  EXPECT_EQ(After(text, {SetAttribute(text, 0, "xy", "")}), "<a x = '1' xy=\"\"/>");
  EXPECT_EQ(After(text, {SetAttribute(text, 0, "y", "3")}), "<a y=\"3\" x = '1' xy=\"2\"/>");
  EXPECT_EQ(After("<a/>", {SetAttribute("<a/>", 0, "y", "3")}), "<a y=\"3\"/>");
}

TEST(Edits, AChildIsAppended) {
  EXPECT_EQ(After("<a b=\"1\"/>", {AppendChild("<a b=\"1\"/>", 0, "<c/>")}), "<a b=\"1\"><c/></a>");
  EXPECT_EQ(After("<a><b/></a>", {AppendChild("<a><b/></a>", 0, "<c/>")}), "<a><b/><c/></a>");
}

TEST(Edits, TheLongerOfTwoThatMeetIsKept) {
  EXPECT_EQ(After("0123456789", {{2, 4, "x"}, {1, 6, ""}, {6, 6, "y"}, {6, 6, "z"}, {8, 9, "-"}}), "0y67-9");
}

TEST(Edits, OffsetsAreThoseOfTheTextBefore) {
  const std::vector<Edit> edits = {{2, 4, "abc"}, {6, 6, "y"}};
  ASSERT_EQ(Apply("0123456789", edits), "01abc45y6789");
  const OffsetMap map(edits);
  EXPECT_EQ(map.Before(1), 1u);
  EXPECT_EQ(map.Before(3), 2u);   // within what was put in
  EXPECT_EQ(map.Before(5), 4u);   // "4"
  EXPECT_EQ(map.Before(7), 6u);   // "y"
  EXPECT_EQ(map.Before(11), 9u);  // "9"
}

// With a byte order mark, too, and with comments and quotes of either kind about what is changed.
TEST(Edits, HitWhatTheyMean) {
  RoadText road;
  road.left = "";
  road.link = "<!-- <successor/> --><successor elementType='road' elementId=\"7\" contactPoint='start'/>";
  const std::string text = "\xEF\xBB\xBF" + Document(road.Text());
  const Import import = MustImport(text);
  std::string expected = text;
  expected.replace(expected.find("<successor element"), 66, "");
  EXPECT_EQ(import.repaired_text, expected);
}

}  // namespace
}  // namespace rodeira::opendrive
