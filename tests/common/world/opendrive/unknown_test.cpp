// SPDX-License-Identifier: Apache-2.0
// Names and words that OpenDRIVE does not have, and elements that stand twice.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cctype>
#include <set>

#include "common/core/base/files.hpp"
#include "common/world/opendrive/known_elements.hpp"
#include "tests/common/world/opendrive/sample.hpp"
#include "tests/names.hpp"

namespace rodeira::opendrive {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

std::vector<std::string> WarningsOf(const std::string& text) {
  std::vector<std::string> said;
  for (const Finding& warning : MustImport(text).warnings) said.push_back(warning.Text());
  return said;
}

// What becomes of an element is documented: each has its place in the document.
TEST(Unknown, EveryKnownElementStandsInTheTable) {
  const std::string text = base::ReadText(std::filesystem::path(SourceDir()) / "docs/reference/opendrive.md").value();
  const std::size_t begin = text.find("\n## Elements\n"), end = text.find("\n## ", begin + 5);
  ASSERT_NE(end, std::string::npos);
  std::set<std::string> said;
  std::string word;
  for (std::size_t i = begin; i <= end; ++i) {
    if (std::isalnum(static_cast<unsigned char>(text[i])) != 0) {
      word += text[i];
    } else if (!word.empty()) {
      said.insert(std::move(word));
      word.clear();
    }
  }
  ASSERT_FALSE(KnownNames().empty());
  for (const std::string& name : KnownNames()) EXPECT_TRUE(said.contains(name)) << name;
}

TEST(Unknown, NothingIsSaidOfAFileThatIsRight) { EXPECT_THAT(WarningsOf(Document(RoadText().Text())), IsEmpty()); }

TEST(Unknown, AMisspeltElementIsToldWithTheOneThatWasMeant) {
  RoadText road;
  road.right = R"(<lane id="-1" type="driving"><widht sOffset="0" a="3.5" b="0" c="0" d="0"/></lane>)";
  EXPECT_THAT(WarningsOf(Document(road.Text())),
              ElementsAre("not_known: OpenDRIVE knows no <widht> of <lane>; did you mean 'width'?",
                          "road.lane.width.missing: a lane of type 'driving' has neither <width> nor <border>: it is "
                          "read as 0 m wide"));
  road = {};
  road.elevation = R"(<elevatio s="0" a="1" b="0" c="0" d="0"/>)";
  EXPECT_THAT(WarningsOf(Document(road.Text())),
              ElementsAre("not_known: OpenDRIVE knows no <elevatio> of <elevationProfile>; did you mean 'elevation'?"));
}

TEST(Unknown, EachKindIsSaidOnceWithItsLineAndHowOften) {
  RoadText road;
  road.right = R"(<lane id="-1" type="driving"><width sOffset="0" a="3.5" b="0" c="0" d="0"/>
<roadMrk sOffset="0" type="solid"/><roadMrk sOffset="9" type="solid"/></lane>)";
  const std::string text = Document(road.Text());
  const Import import = MustImport(text);
  ASSERT_EQ(import.warnings.size(), 1u);
  EXPECT_EQ(import.warnings[0].Text(),
            "not_known: OpenDRIVE knows no <roadMrk> of <lane>; did you mean 'roadMark'? (2 times)");
  EXPECT_EQ(import.warnings[0].line,
            static_cast<std::size_t>(
                1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(text.find("<roadMrk")), '\n')));
}

TEST(Unknown, AttributesAndWordsAreLookedAt) {
  RoadText road;
  road.right =
      R"(<lane id="-1" type="driving" levle="true"><width sOffset="0" a="3.5" b="0" c="0" d="0"/>
          <roadMark sOffset="0" type="soild" color="xstandard" laneChange="BOTH"/></lane>)";
  EXPECT_THAT(WarningsOf(Document(road.Text())),
              testing::UnorderedElementsAre(
                  Names("not_known: <lane> of <right> … 'levle' … 'level'"),
                  "not_known: the attribute 'type' of <roadMark> is 'soild'; did you mean 'solid'?",
                  "not_known: the attribute 'color' of <roadMark> is 'xstandard'; did you mean 'standard'?"));
}

// What users add is theirs, whatever it is called.
TEST(Unknown, DataOfUsersIsNotLookedAt) {
  RoadText road;
  road.more =
      R"(<userData code="x" value="y"><vectorScene program="z" widht="1"><laneSectoin/></vectorScene></userData>)";
  EXPECT_THAT(WarningsOf(Document(road.Text())), IsEmpty());
}

TEST(Unknown, WhatMayStandOnceIsRefusedTwice) {
  for (const std::string twice : {"<lanes></lanes>", "<planView></planView>", "<surface/><surface/>"}) {
    RoadText road;
    road.more = twice;
    const auto import = Read(Document(road.Text()), "sample.xodr", Tolerance::Unrepaired());
    ASSERT_TRUE(import.ok());
    ASSERT_FALSE(import.value().errors.empty()) << twice;
    const std::string name = twice.substr(0, twice.find_first_of(">/"));
    EXPECT_EQ(import.value().errors.front().Text(),
              "core.once: road 1: a second " + name + "> of <road> was found; at most one was expected");
    EXPECT_GT(import.value().errors.front().line, 0u);
  }
}

// A line that goes over into an arc of 20 m at once.
TEST(Curvature, JumpsAreToldOnceAFile) {
  RoadText road;
  road.geometry =
      R"(<geometry s="0" x="0" y="0" hdg="0" length="50"><line/></geometry>
          <geometry s="50" x="50" y="0" hdg="0" length="20"><arc curvature="0.05"/></geometry>)"
      R"(<geometry s="70" x="66.829419696157930" y="9.193953882637205" hdg="1" length="30"><arc curvature="0.04"/>
          </geometry>)";
  EXPECT_THAT(WarningsOf(Document(road.Text())),
              ElementsAre(Names("road.geometry.curvature: road 1, s 50: … 0.05000 1/m, the largest of 2 jumps")));
}

}  // namespace
}  // namespace rodeira::opendrive
