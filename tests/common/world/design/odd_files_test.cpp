// SPDX-License-Identifier: Apache-2.0
// What mutated files found: each is a road or a sentence.
#include <gmock/gmock.h>

#include "tests/names.hpp"

#include "tests/common/world/design/made_roads.hpp"

namespace rodeira::design {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

std::string Roads(const std::string& axis, const std::string& more) {
  return "rodeira: world/2\nroads:\n  - id: a\n    axis: [" + axis + "]\n    section: {template: rural}\n" + more;
}

TEST(OddFiles, ARoadOfACentimetreIsARoad) {
  const Design design = SoundDesign(Roads("line: {length_m: 0.01}", ""));
  ASSERT_NE(design.network, nullptr);
  EXPECT_DOUBLE_EQ(design.network->roads()[0].length_m(), 0.01);
}

TEST(OddFiles, ASurfaceWithoutAFileIsASentence) {
  EXPECT_THAT(FirstProblem(Roads("line: {length_m: 50}", "    surfaces: [{crg: {a: 1}}]\n")),
              HasSubstr("made.yaml:6: 'roads[0].surfaces[0].crg'"));
}

// A path that no file system takes.
TEST(OddFiles, AnIncludedNameThatIsTooLongIsASentence) {
  EXPECT_THAT(FirstProblem("rodeira: world/2\ninclude: [" + std::string(5000, 'x') + ".yaml]\n" +
                           Roads("line: {length_m: 50}", "").substr(17)),
              HasSubstr("made.yaml:2: "));
}

// One mistake is one sentence: nothing that only follows from it.
std::vector<std::string> Problems(const std::string& text) {
  std::vector<std::string> said;
  for (const auto& problem : DesignOf(text).problems) said.push_back(problem.Text());
  return said;
}

TEST(OddFiles, AnUnknownTemplateIsToldAlone) {
  EXPECT_THAT(
      Problems("rodeira: world/2\nroads:\n  - {id: a, axis: [line: {length_m: 50}], section: {template: rurall}}\n"),
      ElementsAre(Names("made.yaml:3: … 'rurall' … 'rural'")));
}

TEST(OddFiles, TwoHeightsAtOneStationAreToldAlone) {
  EXPECT_THAT(Problems(Roads("line: {length_m: 50}", "    vertical: [{s_m: 0, z_m: 0}, {s_m: 0, z_m: 1}]\n")),
              ElementsAre("made.yaml:6: the points of 'vertical' must come in ascending 's_m'"));
}

TEST(OddFiles, ARoadThatAJunctionDoesNotFindIsToldAlone) {
  const std::string other =
      "  - {id: b, start: {x_m: 25, y_m: -25, heading_deg: 90}, axis: [line: {length_m: 50}], section: {template: "
      "rural}}\n";
  EXPECT_THAT(Problems(Roads("line: {length_m: 50}",
                             other + "junctions: [{id: j, roads: [{road: a, s_m: 25}, {road: q, s_m: 25}]}]\n")),
              ElementsAre(HasSubstr("there is no road 'q'")));
}

TEST(OddFiles, MistakesOfJunctionsAreToldBesideThoseOfRoads) {
  EXPECT_THAT(
      Problems(Roads("line: {length: 50}",
                     "junctions: [{id: j, control: stpo, roads: [{road: a, s_m: 25}, {road: q, end: strt}]}]\n")),
      UnorderedElementsAre(HasSubstr("made.yaml:4: unknown key 'roads[0].axis[0].line.length'"),
                           HasSubstr("there is no road 'q'"), HasSubstr("is 'strt'; did you mean 'start'?"),
                           HasSubstr("is 'stpo'; did you mean 'stop'?")));
}

// 5.75 m of road to the inside, a corner of atan(60 / 80) = 36.87 degrees: the arc passes it R tan(18.43) tan(9.22) =
// 0.3274 m away where R = 5.75 / 0.95 m.
TEST(OddFiles, ACornerOfPointsThatFoldsSaysWhatWouldDo) {
  const auto points = [](const std::string& how) {
    return "rodeira: world/2\nroads:\n  - id: a\n    points: {list: [[0, 0], [100, 0], [180, 60]], " + how +
           "}\n    section: {template: rural}\n";
  };
  EXPECT_THAT(
      FirstProblem(points("smooth: false")),
      HasSubstr("; a corner of 37 degrees needs 'within_m' 0.33 or more between longer pieces, or 'smooth: true'"));
  EXPECT_EQ(FirstProblem(points("smooth: false, within_m: 0.33")), "none");
  EXPECT_EQ(FirstProblem(points("smooth: true")), "none");
}

TEST(OddFiles, AKinkOfTheGradeWithoutAParabolaIsAWarning) {
  const auto warnings = [](const std::string& middle) {
    return SoundDesign(
               Roads("line: {length_m: 300}", "    vertical: [{s_m: 0, z_m: 0}, " + middle + ", {s_m: 200, z_m: 0}]\n"))
        .warnings;
  };
  EXPECT_THAT(warnings("{s_m: 100, z_m: 10}"),
              ElementsAre("made.yaml:6: the grade kinks by -20.00 % at s = 100.000 m; a 'parabola_m' rounds it"));
  EXPECT_THAT(warnings("{s_m: 100, z_m: 10, parabola_m: 50}"), IsEmpty());
  EXPECT_THAT(warnings("{s_m: 100, z_m: 0.2}"), IsEmpty());  // 0.4 %
}

}  // namespace
}  // namespace rodeira::design
