// SPDX-License-Identifier: Apache-2.0
// Records out of order, twice at one place, with slips in their numbers, or in force over next to nothing. The oracle
// is the same file with its records as they should be.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "tests/common/world/opendrive/sample.hpp"

namespace rodeira::opendrive {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::IsEmpty;

std::vector<std::string> RepairsOf(const Import& import) {
  std::vector<std::string> names;
  for (const Finding& finding : OneEachKind(import.warnings)) {
    if (finding.repair.kind != RepairKind::kNone) names.push_back(finding.repair.Name());
  }
  return names;
}

// A kind of record: where it stands in a road, and the text of one that begins at s.
struct KindOfRecord {
  const char* name;
  std::string RoadText::*place;  // empty: in the right lane
  const char* text;              // {0}: where it begins, {1}: a number that differs
};
const KindOfRecord kRecords[] = {
    {"elevation", &RoadText::elevation, R"(<elevation s="{0}" a="{1}" b="0" c="0" d="0"/>)"},
    {"superelevation", &RoadText::lateral, R"(<superelevation s="{0}" a="{1}" b="0" c="0" d="0"/>)"},
    {"crossfall", &RoadText::lateral, R"(<crossfall side="both" s="{0}" a="{1}" b="0" c="0" d="0"/>)"},
    {"shape", &RoadText::lateral, R"(<shape s="{0}" t="0" a="{1}" b="0" c="0" d="0"/>)"},
    {"lane_offset", &RoadText::offset, R"(<laneOffset s="{0}" a="{1}" b="0" c="0" d="0"/>)"},
    {"width", nullptr, R"(<width sOffset="{0}" a="{1}" b="0" c="0" d="0"/>)"},
    {"height", nullptr, R"(<height sOffset="{0}" inner="{1}" outer="{1}"/>)"},
    {"road_mark", nullptr, R"(<roadMark sOffset="{0}" type="solid" width="{1}"/>)"},
    {"speed", nullptr, R"(<speed sOffset="{0}" max="{1}" unit="m/s"/>)"},
    {"material", nullptr, R"(<material sOffset="{0}" friction="{1}" roughness="0.01"/>)"},
    {"access", nullptr, R"(<access sOffset="{0}" rule="deny" restriction="bus"/>)"},
};

std::string FileOf(const KindOfRecord& kind, std::vector<std::pair<std::string, std::string>> records) {
  RoadText road;
  std::string text;
  for (const auto& [s, number] : records) text += fmt::format(fmt::runtime(kind.text), s, number);
  if (kind.place != nullptr) {
    road.*kind.place = text;
  } else {
    const bool is_width = std::string_view(kind.name) == "width";
    const std::string width = is_width ? "" : R"(<width sOffset="0" a="3.5" b="0" c="0" d="0"/>)";
    road.right = fmt::format("<lane id=\"-1\" type=\"driving\">{}{}</lane>", width, text);
  }
  return Document(road.Text());
}

class RecordsRepair : public testing::TestWithParam<KindOfRecord> {};

// Three and four records in every order: the repaired file is the sorted one, byte by byte.
TEST_P(RecordsRepair, AreSortedInEveryOrder) {
  std::vector<std::pair<std::string, std::string>> records = {
      {"0", "0.001"}, {"12.5", "0.002"}, {"60", "0.003"}, {"60.00001", "0.004"}};
  const std::string sorted = FileOf(GetParam(), records);
  ASSERT_TRUE(MustImport(sorted).repaired_text.empty());
  while (std::next_permutation(records.begin(), records.end())) {
    const Import import = MustImport(FileOf(GetParam(), records));
    ASSERT_EQ(import.repaired_text, sorted);
    EXPECT_THAT(RepairsOf(import), ElementsAre("element.sorted"));
  }
}

INSTANTIATE_TEST_SUITE_P(OfEachKind, RecordsRepair, testing::ValuesIn(kRecords),
                         [](const auto& kind) { return std::string(kind.param.name); });

// Two with other numbers at one place: the later one counts, which is told, and nothing jumps there.
TEST_P(RecordsRepair, OfTwoAtOnePlaceTheLaterCounts) {
  const std::set<std::string> cubics = {"elevation", "superelevation", "crossfall", "lane_offset", "width"};
  if (!cubics.contains(GetParam().name)) return;
  for (const Tolerance& tolerance : {Tolerance::Usual(), Tolerance::Strict()}) {
    const Import two = MustImport(FileOf(GetParam(), {{"0", "0.001"}, {"50", "2.5"}, {"50", "0.001"}}), tolerance);
    EXPECT_TRUE(two.repaired_text.empty());
    const std::vector<Finding> told = OneEachKind(two.warnings);
    EXPECT_EQ(std::count_if(told.begin(), told.end(),
                            [](const Finding& one) { return one.rule.ends_with("elem_asc_order"); }),
              1);
    EXPECT_TRUE(
        std::none_of(told.begin(), told.end(), [](const Finding& one) { return one.rule.ends_with("contact_point"); }));
    // The very same one twice is not worth a word.
    const Import same = MustImport(FileOf(GetParam(), {{"0", "0.001"}, {"50", "0.001"}, {"50", "0.001"}}), tolerance);
    EXPECT_TRUE(std::none_of(same.warnings.begin(), same.warnings.end(),
                             [](const Finding& one) { return one.rule.ends_with("elem_asc_order"); }));
  }
}

// 1e-8 m apart and in the wrong order, as other programs' rounding leaves them: the one written later counts.
TEST(RecordsNearlyAtOnePlace, TheLaterCounts) {
  RoadText road;
  road.offset = R"(<laneOffset s="0" a="0"/><laneOffset s="41.70000001" a="0.25"/><laneOffset s="41.7" a="0"/>)"
                R"(<laneOffset s="80" a="0" b="0.01"/>)";
  const Import import = MustImport(Document(road.Text()));
  EXPECT_EQ(import.network->roads()[0].CentreAt(60.0).value, 0.0);
  EXPECT_NEAR(import.network->roads()[0].CentreAt(90.0).value, 0.1, 1e-12);
  EXPECT_THAT(RepairsOf(import), ElementsAre("element.duplicate_dropped"));
}

// Twice at one place: the later one counts.
TEST(RecordsTwiceAtOnePlace, TheLaterCounts) {
  RoadText road;
  road.elevation = R"(<elevation s="0" a="1"/><elevation s="30" a="1" b="0.5"/><elevation s="30" a="1" b="0.01"/>)";
  road.right = R"(<lane id="-1" type="driving"><width sOffset="0" a="3" b="0"/><width sOffset="0" a="3.5"/></lane>)";
  const Import import = MustImport(Document(road.Text()));
  EXPECT_NEAR(import.network->roads()[0].spec().elevation.Value(80.0), 1.5, 1e-12);
  EXPECT_NEAR(import.network->Span({0, 0, -1}, 10.0)->width_m(), 3.5, 1e-12);
}

// Profiles across the road with records in any order of t: z at t is that of the record before it.
TEST(ShapesOfARoad, StandInAnyOrderOfT) {
  std::vector<std::pair<double, double>> profile = {{-6, 0.1}, {-2, 0.2}, {1, 0.3}, {3, 0.4}};  // t, a
  do {
    RoadText road;
    road.left = R"(<lane id="1" type="driving"><width sOffset="0" a="6"/></lane>)";
    road.right = R"(<lane id="-1" type="driving"><width sOffset="0" a="6"/></lane>)";
    for (const auto& [t, a] : profile) road.lateral += fmt::format("<shape s=\"0\" t=\"{}\" a=\"{}\"/>", t, a);
    const Import import = MustImport(Document(road.Text()));
    for (const auto& [t, z] : {std::pair(-5.0, 0.1), std::pair(-1.0, 0.2), std::pair(2.0, 0.3), std::pair(5.0, 0.4)})
      EXPECT_NEAR(import.network->roads()[0].Surface(50.0, t).p_W.z(), z, 1e-12);
  } while (std::next_permutation(profile.begin(), profile.end()));
}

// A lane that becomes 1 m wider within 1e-7 m, by a cubic that is level at both ends: w = 3 + 3e14 u^2 - 2e21 u^3. It
// is 3 m before, 3.5 m halfway, and 4 m behind. Likewise an elevation, a superelevation and a lane offset.
TEST(RecordsInForceOverNextToNothing, AreEvaluatedExactly) {
  const std::string ramp = "b=\"0\" c=\"3e14\" d=\"-2e21\"";
  RoadText road;
  road.right =
      "<lane id=\"-1\" type=\"driving\"><width sOffset=\"0\" a=\"3\" b=\"0\" c=\"0\" d=\"0\"/><width "
      "sOffset=\"40\" a=\"3\" " +
      ramp + "/><width sOffset=\"40.0000001\" a=\"4\" b=\"0\" c=\"0\" d=\"0\"/></lane>";
  road.elevation =
      "<elevation s=\"0\" a=\"0\"/><elevation s=\"25\" a=\"0\" b=\"0\" c=\"3e12\" d=\"-2e19\"/>"
      "<elevation s=\"25.0000001\" a=\"0.01\" b=\"0\" c=\"0\" d=\"0\"/>";
  road.offset =
      "<laneOffset s=\"0\" a=\"0\" b=\"0\" c=\"0\" d=\"0\"/><laneOffset s=\"70\" a=\"0\" b=\"0\" c=\"3e12\" "
      "d=\"-2e19\"/><laneOffset s=\"70.0000001\" a=\"0.01\" b=\"0\" c=\"0\" d=\"0\"/>";
  const Import import = MustImport(Document(road.Text()));
  EXPECT_THAT(RepairsOf(import), IsEmpty());
  const network::Road& read = import.network->roads()[0];
  const auto width = [&](double s) { return import.network->Span({0, 0, -1}, s)->width_m(); };
  EXPECT_NEAR(width(39.9), 3.0, 1e-12);
  EXPECT_NEAR(width(40.0), 3.0, 1e-12);
  EXPECT_NEAR(width(40.00000005), 3.5, 1e-6);
  EXPECT_NEAR(width(40.0000000999), 4.0, 1e-4);
  EXPECT_NEAR(width(40.0000001), 4.0, 1e-12);
  EXPECT_NEAR(width(90.0), 4.0, 1e-12);
  EXPECT_NEAR(read.spec().elevation.Value(25.00000005), 0.005, 1e-8);
  EXPECT_NEAR(read.spec().elevation.Value(60.0), 0.01, 1e-12);
  EXPECT_NEAR(read.CentreAt(70.00000005).value, 0.005, 1e-8);
}

// A coefficient that is as large over metres is no road's: the record is passed over, and the road stays.
TEST(RecordsInForceOverMetres, HaveNoSuchCoefficients) {
  RoadText road;
  road.elevation = R"(<elevation s="0" a="1"/><elevation s="50" a="1" b="0" c="0" d="1e19"/>)";
  const Import import = MustImport(Document(road.Text()));
  EXPECT_THAT(RepairsOf(import), ElementsAre("elevation.dropped"));
  EXPECT_EQ(import.network->roads()[0].spec().elevation.Value(90.0), 1.0);
}

// A number with a slip is read as what it begins with, and told with its line.
TEST(NumbersWithASlip, AreReadAsWhatTheyBeginWith) {
  const auto height = [](const std::string& said) {
    RoadText road;
    road.elevation = "<elevation s=\"0\" a=\"" + said + "\" b=\"0\" c=\"0\" d=\"0\"/>";
    const Import import = MustImport(Document(road.Text()));
    EXPECT_THAT(RepairsOf(import), ElementsAre("element.value_replaced")) << said;
    EXPECT_EQ(import.warnings.front().line, 7u);
    return import.network->roads()[0].spec().elevation.Value(50.0);
  };
  EXPECT_EQ(height("2.5m"), 2.5);
  EXPECT_EQ(height("2,25"), 2.25);
  EXPECT_EQ(height("1.500000+1"), 15.0);
  EXPECT_EQ(height("-3.0e0 m"), -3.0);
  EXPECT_EQ(height("4.000000000+e00"), 4.0);
  for (const char* none : {"", "nan", "inf", "m", "-", "1e999"}) {
    RoadText road;
    road.elevation = fmt::format("<elevation s=\"0\" a=\"{}\" b=\"0\" c=\"0\" d=\"0\"/>", none);
    EXPECT_THAT(RepairsOf(MustImport(Document(road.Text()))), ElementsAre("elevation.dropped")) << none;
  }
}

// Jumps of a width and of a lane offset within a section, up and down, on either side, near the section's end: the lane
// has the file's width before the jump and behind the stated length, and changes by at most 6 m for each metre between.
TEST(JumpsWithinASection, AreSmoothedOverAStatedLength) {
  for (const double jump : {-2.0, -0.4, 0.3, 1.8, 17.0}) {
    for (const bool on_left : {false, true}) {
      for (const double at : {20.0, 60.0}) {
        const double before = 3.25, behind = before + jump, length = std::clamp(6.0 * std::fabs(jump), 5.0, 100.0);
        RoadText road;
        const std::string lane = fmt::format(
            "<lane id=\"{}\" type=\"driving\"><width sOffset=\"0\" a=\"{}\" b=\"0\" c=\"0\" d=\"0\"/><width "
            "sOffset=\"{}\" a=\"{}\" b=\"0\" c=\"0\" d=\"0\"/></lane>",
            on_left ? 1 : -1, before, at, behind);
        road.left = on_left ? lane : "", road.right = on_left ? "" : lane;
        const Import import = MustImport(Document(road.Text()));
        EXPECT_THAT(RepairsOf(import), ElementsAre("lane.jump_smoothed"));
        const auto width = [&](double s) { return import.network->Span({0, 0, on_left ? 1 : -1}, s)->width_m(); };
        const double to = std::min(at + length, 100.0);
        EXPECT_NEAR(width(at), before, 1e-9);
        EXPECT_NEAR(width(0.5 * (at + to)), 0.5 * (before + behind), 1e-9);
        EXPECT_NEAR(width(to), behind, 1e-9);
        for (double s = at; s < to; s += 0.1)
          ASSERT_LE(std::fabs(width(s + 0.1) - width(s)), 0.1 * 1.5 * std::fabs(jump) / (to - at) + 1e-9);
        const auto strictly = Read(Document(road.Text()), "j.xodr", Tolerance::Strict());
        EXPECT_THAT(strictly.value().errors, testing::SizeIs(1));
      }
    }
  }
}

TEST(CentreLanes, HaveNoWidthWhereverItStands) {
  for (const char* record : {R"(<width sOffset="0" a="0" b="0" c="0" d="0"/>)", R"(<border sOffset="0" a="1"/>)",
                             R"(<width sOffset="0" a="2"/><width sOffset="40" a="3"/>)"}) {
    RoadText road;
    std::string text = road.Text();
    const std::string centre = "<lane id=\"0\" type=\"none\"/>";
    text.replace(text.find(centre), centre.size(), fmt::format("<lane id=\"0\" type=\"none\">{}</lane>", record));
    const Import import = MustImport(Document(text));
    EXPECT_THAT(RepairsOf(import), ElementsAre("lane.width_dropped"));
    EXPECT_NEAR(import.network->Centre({0, 0, 1}, 70.0).y(), 1.75, 1e-12);
  }
}

// A surface of 100 m that begins 20 m before its road and ends behind it: on the road u is s + 20 + the file's own
// offset, as it would be without the cut. One that lies wholly beside the road is passed over.
TEST(MeasuredSurfaces, AreCutAtTheRoadsEnds) {
  const auto laid = [](const std::string& stations) {
    RoadText road;
    road.more = "<surface><CRG file=\"a.crg\" orientation=\"same\" mode=\"attached\" " + stations + "/></surface>";
    return MustImport(Document(road.Text()));
  };
  const Import both = laid(R"(sStart="-20" sEnd="180" sOffset="3")"), end = laid(R"(sStart="30" sEnd="180")"),
               beside = laid(R"(sStart="120" sEnd="180")");
  EXPECT_THAT(RepairsOf(both), ElementsAre("surface.cut"));
  ASSERT_EQ(both.network->roads()[0].spec().crg.size(), 1u);
  const network::CrgSurface& cut = both.network->roads()[0].spec().crg[0];
  EXPECT_EQ(cut.s_start_m, 0.0);
  EXPECT_EQ(cut.s_end_m, 100.0);
  EXPECT_EQ(cut.s_offset_m, 23.0);
  EXPECT_THAT(RepairsOf(end), ElementsAre("surface.cut"));
  EXPECT_EQ(end.network->roads()[0].spec().crg[0].s_start_m, 30.0);
  EXPECT_EQ(end.network->roads()[0].spec().crg[0].s_end_m, 100.0);
  EXPECT_EQ(end.network->roads()[0].spec().crg[0].s_offset_m, 0.0);
  EXPECT_THAT(RepairsOf(beside), ElementsAre("CRG.dropped"));
  EXPECT_TRUE(beside.network->roads()[0].spec().crg.empty());
}

// Several slips in one file: each kind is told, and the road is what it should be.
TEST(SlipsTogether, AreEachRepaired) {
  RoadText road;
  road.length = 97.0;
  road.link = R"(<successor elementType="road" elementId="none" contactPoint="start"/>)";
  road.geometry = R"(<geometry s="50" x="50" y="0" hdg="0.02" length="50"><line/></geometry>)"
                  R"(<geometry s="0" x="0" y="0" hdg="0" length="50"><line/></geometry>)";
  road.elevation = R"(<elevation s="70" a="2"/><elevation s="0" a="2"/>)";
  road.offset = R"(<laneOffset s="0" a="0"/><laneOffset s="30" a="0.5"/>)";
  road.right = R"(<lane id="-1" type="driveing"><width sOffset="10" a="3"/><width sOffset="0" a="3"/></lane>)"
               R"(<lane id="-3" type="shoulder"><width sOffset="0" a="1"/></lane>)";
  const Import import = MustImport(Document(road.Text()));
  ASSERT_NE(import.network, nullptr);
  std::vector<std::string> repairs = RepairsOf(import);
  for (const char* one : {"element.sorted", "element.value_replaced", "geometry.kink_rounded", "lane.added",
                          "lane.jump_smoothed", "road.ended", "road.length_set"})
    EXPECT_THAT(repairs, Contains(one));
  EXPECT_EQ(import.network->roads()[0].length_m(), 100.0);
  EXPECT_NEAR(import.network->Span({0, 0, -3}, 80.0)->outer_t_m, 0.5 - 4.0, 1e-9);
  EXPECT_EQ(ReachOf(*import.network).share(), 1.0);
  EXPECT_TRUE(MustImport(import.repaired_text).repaired_text.empty());
}

}  // namespace
}  // namespace rodeira::opendrive
