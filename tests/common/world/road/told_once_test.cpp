// SPDX-License-Identifier: Apache-2.0
// Mistakes of world files that passed in silence, or were followed by what only followed from them: each is one
// sentence with its line.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "common/core/base/files.hpp"
#include "common/world/lanes/lights.hpp"
#include "common/world/lanes/zones.hpp"
#include "common/world/road/world.hpp"
#include "common/world/road/world_report.hpp"
#include "common/world/terrain/bt.hpp"
#include "common/world/terrain/elevation_file.hpp"
#include "tests/common/world/road/sample_world.hpp"
#include "tests/launch/rodeira/temporary_folder.hpp"
#include "tests/names.hpp"

namespace rodeira::road {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::IsEmpty;

class ToldOnce : public testing::Test {
 protected:
  // Without the folder's name.
  std::string Plain(std::string text) const {
    const std::string folder = folder_.string() + "/";
    for (std::size_t at; (at = text.find(folder)) != std::string::npos;) text.erase(at, folder.size());
    return text;
  }
  std::vector<std::string> Problems(const std::string& yaml) {
    EXPECT_TRUE(base::WriteWhole(folder_ / "w.yaml", yaml).ok());
    std::vector<std::string> said;
    for (const base::Error& problem : WorldProblems(folder_ / "w.yaml")) said.push_back(Plain(problem.Text()));
    return said;
  }
  std::vector<std::string> Warnings(const std::string& yaml) {
    EXPECT_TRUE(base::WriteWhole(folder_ / "w.yaml", yaml).ok());
    std::vector<std::string> said;
    for (const std::string& warning : WorldWarnings(folder_ / "w.yaml")) said.push_back(Plain(warning));
    return said;
  }
  const cli::TemporaryFolder temporary_;
  const fs::path& folder_ = temporary_.path();
};

// Line 6 is the axis; things stand where only a road of 200 m has them.
std::string OnAPlane(const std::string& axis, const std::string& more = "") {
  return "rodeira: world/2\nname: w\nground: {kind: plane, z_m: 0}\nroads:\n  - id: main\n    axis: [" + axis +
         "]\n    z_m: 0\n    section: {template: rural}\n    markings: [{type: crossing, s_m: 120}]\n" + more;
}

// Where a mapping is wrong, what it was not read for is no unknown key; what is misspelt beside it still is.
TEST_F(ToldOnce, NoKeyIsUnknownThatWasNotReadForAnotherMistake) {
  EXPECT_THAT(Problems(OnAPlane("line: {length_m: 200}",
                                "    signs: [{type: bend_left, every_m: 0, from_s_m: 10, to_s_m: 90, t_m: 5}]\n")),
              ElementsAre(testing::HasSubstr("w.yaml:10: 'roads[0].signs[0].every_m' is 0; a number")));
  EXPECT_THAT(Problems(OnAPlane("{clothoid: {length_m: 60, a_m: 80, radius_end_m: 100}}, line: {length_m: 200}")),
              testing::SizeIs(1));
  EXPECT_THAT(Problems(OnAPlane("line: {length_m: 200}", "start: {road: main, lane: -1, s_m: 20, x_m: 3}\n")),
              ElementsAre("w.yaml:10: 'road' and 'x_m' say the same in two ways; one of both was expected"));
  EXPECT_THAT(Problems(OnAPlane("line: {length_m: 200}", "    vertical: [{s_m: 0, z_m: 0}, {s_m: 200, z_m: 4}]\n")),
              ElementsAre("w.yaml:7: 'vertical' and 'z_m' say the same in two ways; one of both was expected"));
  EXPECT_THAT(
      Problems(OnAPlane("line: {length_m: 200}", "    signs: [{type: bend_left, s_m: 20, side: left, t_m: 5}]\n")),
      ElementsAre("w.yaml:10: 't_m' and 'side' say the same in two ways; one of both was expected"));
  EXPECT_THAT(
      Problems(OnAPlane("line: {length_m: 200}", "    objects: [{type: tree, s_m: 20, every_m: -1, besid_m: 4}]\n")),
      testing::Contains(testing::HasSubstr("unknown key 'roads[0].objects[0].besid_m'; did you mean 'beside_m'?")));
}

TEST_F(ToldOnce, ListsWithPointsBehindTheRoadsEnd) {
  const auto on = [this](const std::string& more) { return Warnings(OnAPlane("line: {length_m: 200}", more)); };
  EXPECT_THAT(on("    superelevation: [{s_m: 0, slope: 0}, {s_m: 200, slope: 0.02}]\n"), IsEmpty());
  EXPECT_THAT(on("    superelevation: [{s_m: 0, slope: 0}, {s_m: 2000, slope: 0.02}]\n"),
              ElementsAre("w.yaml:10: 'superelevation' has a point at s = 2000 m; road 'main' is 200.0 m long"));
  EXPECT_THAT(on("    speed_limits: [{s_m: 0, speed_kmh: 80},\n                   {s_m: 900, speed_kmh: 50}]\n"),
              ElementsAre("w.yaml:11: 'speed_limits' has a point at s = 900 m; road 'main' is 200.0 m long"));
  const auto graded = [this](const char* end) {
    return Warnings(
        "rodeira: world/2\nname: w\nground: {kind: plane, z_m: 0}\nroads:\n  - id: main\n    axis: [line: {length_m: "
        "200}]\n    vertical: [{s_m: 0, z_m: 0}, {s_m: " +
        std::string(end) +
        ", z_m: 1}]\n    section: {lanes: [{id: -1, widths: [{s_m: 0, width_m: 3}, {s_m: 400, width_m: 4}]}]}\n");
  };
  EXPECT_THAT(graded("290"), ElementsAre("w.yaml:8: 'widths' has a point at s = 400 m; road 'main' is 200.0 m long"));
  EXPECT_THAT(graded("2000"), ElementsAre("w.yaml:7: 'vertical' has a point at s = 2000 m; road 'main' is 200.0 m long",
                                          "w.yaml:8: 'widths' has a point at s = 400 m; road 'main' is 200.0 m long"));
}

TEST_F(ToldOnce, ABridgeAndATunnelAtOnePlace) {
  EXPECT_THAT(
      Problems(OnAPlane("line: {length_m: 200}",
                        "    bridges: [{from_s_m: 20, to_s_m: 60}]\n    tunnels: [{from_s_m: 50, to_s_m: 90}]\n")),
      ElementsAre("w.yaml:11: from s = 50 to 60 m there is a bridge already"));
}

TEST_F(ToldOnce, AMisspeltElementOfAnAxisIsReadAsTheOneThatWasMeant) {
  EXPECT_THAT(Problems(OnAPlane("line: {length_m: 200}")), IsEmpty());
  EXPECT_THAT(Problems(OnAPlane("lin: {length_m: 200}")),
              ElementsAre("w.yaml:6: 'lin' is no element of an axis; did you mean 'line'?"));
  EXPECT_THAT(Problems(OnAPlane("clothiod: {length_m: 150, radius_end_m: 100}, arc: {radius_m: 100, length_m: 50}")),
              ElementsAre("w.yaml:6: 'clothiod' is no element of an axis; did you mean 'clothoid'?"));
  EXPECT_THAT(Problems(OnAPlane("lin: {length_m: 100}")),
              ElementsAre("w.yaml:6: 'lin' is no element of an axis; did you mean 'line'?",
                          "w.yaml:9: 'roads[0].markings[0].s_m' is 120; a number from 0 to 100 was expected"));
  EXPECT_THAT(Problems(OnAPlane("{from: {x_m: 0, y_m: 0, heading_deg: 0}, lin: {length_m: 200}}")),
              ElementsAre("w.yaml:6: 'lin' is no element of an axis; did you mean 'line'?"));
  EXPECT_THAT(Problems(OnAPlane("{lin: {length_m: 100}}, {ark: {radius_m: 100, length_m: 60}}")),
              ElementsAre("w.yaml:6: 'lin' is no element of an axis; did you mean 'line'?",
                          "w.yaml:6: 'ark' is no element of an axis; did you mean 'arc'?"));
}

TEST_F(ToldOnce, AnUnknownElementMakesNothingElseWrong) {
  EXPECT_THAT(Problems(OnAPlane("{bend: {angle: 7}}")),
              ElementsAre(Names("w.yaml:6: … 'bend' … known are line, arc, clothoid")));
  EXPECT_THAT(Problems(OnAPlane("{bend: {angle: 7}}, {arc: {radius_m: 50, length_m: 20}}")),
              ElementsAre(Names("w.yaml:6: … 'bend' … known are line, arc, clothoid")));
  EXPECT_THAT(Warnings(OnAPlane("{bend: {angle: 7}}, {arc: {radius_m: 50, length_m: 20}}")),
              ElementsAre(testing::HasSubstr("w.yaml:6: the curvature jumps")));
}

TEST_F(ToldOnce, AlsoInVersion1) {
  std::string text = kSample;
  text.replace(text.find("- arc: {length_m: 25"), 20, "- ark: {length_m: 25");
  EXPECT_THAT(Problems(text), ElementsAre(Names("w.yaml:27: … 'ark' … 'arc'")));
}

// Line 15 is the junction.
std::string Lit(const std::string& control) {
  return "rodeira: world/2\nname: w\nground: {kind: plane, z_m: 0}\nroads:\n  - id: main\n    axis: [line: {length_m: "
         "200}]\n    z_m: 0\n    section: {template: rural}\n"
         "  - id: cross\n    start: {x_m: 100, y_m: -100, heading_deg: 90}\n    axis: [line: {length_m: 200}]\n    "
         "z_m: 0\n    section: {template: rural}\njunctions:\n"
         "  - {id: j, roads: [{road: main, s_m: 100}, {road: cross, s_m: 100}], " +
         control + "}\n";
}

TEST_F(ToldOnce, LightsWithoutPhasesHaveALine) {
  EXPECT_THAT(Problems(Lit("control: lights")), ElementsAre(Names("w.yaml:15: … 'junctions[0].lights' is missing")));
  EXPECT_THAT(Problems(Lit("control: lights, lights: {amber_s: 3}")),
              ElementsAre("w.yaml:15: key 'junctions[0].lights.phases' is missing; a list was expected"));
  EXPECT_THAT(Problems(Lit("control: lights, lights: {phases: []}")),
              ElementsAre("w.yaml:15: 'phases' is empty; one or more were expected"));
  EXPECT_THAT(
      Problems(Lit("control: lights, lights: {phases: [{green: [main], for_s: 9}, {green: [cros], for_s: 9}]}")),
      ElementsAre("w.yaml:15: no road 'cros' meets junction 'j'; did you mean 'cross'?"));
}

TEST_F(ToldOnce, LightsThatAreGreenTogetherAreToldAtTheirPhase) {
  const auto world = World::Parse(Lit("control: lights, lights: {phases: [\n      {green: [main], for_s: 9},\n      "
                                      "{green: [cross, main], for_s: 9}]}"),
                                  "w.yaml");
  ASSERT_TRUE(world.ok()) << world.error().Text();
  const lanes::Graph graph(*world.value()->network());
  const auto status = lanes::CheckLights(graph, lanes::Zones(graph));
  ASSERT_FALSE(status.ok());
  EXPECT_THAT(status.error().Text(), testing::StartsWith("w.yaml:17: the lights 'j: main'"));
}

TEST_F(ToldOnce, ALaneWithoutTrafficIsNoStart) {
  const auto at = [](int lane) {
    return OnAPlane("line: {length_m: 200}", "start: {road: main, lane: " + std::to_string(lane) + ", s_m: 20}\n");
  };
  EXPECT_THAT(Problems(at(-1)), IsEmpty());
  EXPECT_THAT(Problems(at(-2)), ElementsAre("w.yaml:10: lane -2 of road 'main' is one of the type 'shoulder': no "
                                            "vehicle drives there; driven on are -1, 1"));
  EXPECT_THAT(Problems(at(9)), ElementsAre("w.yaml:10: road 'main' has no lane 9"));
}

TEST_F(ToldOnce, ATownWithoutANameIsSaid) {
  const auto with = [](const std::string& sign) {
    return OnAPlane("line: {length_m: 200}", "    signs:\n      - {type: " + sign + ", s_m: 20, side: right}\n");
  };
  EXPECT_THAT(Warnings(with("town")),
              ElementsAre("w.yaml:11: the sign 'town' names no town: its 'text' is what stands on it"));
  EXPECT_THAT(Warnings(with("end_of_town")),
              ElementsAre("w.yaml:11: the sign 'end_of_town' names no town: its 'text' is what stands on it"));
  EXPECT_THAT(Warnings(with("town, text: Freixo")), IsEmpty());
}

TEST_F(ToldOnce, AProjectionThatIsMissingIsSaid) {
  for (const int zone : {0, 29}) {
    terrain::BtHeader header;
    header.columns = header.rows = 3;
    header.left = 0.0, header.right = 20.0, header.bottom = 0.0, header.top = 20.0;
    header.external_projection = true, header.utm_zone = zone;
    base::Bytes bytes = terrain::BtHeaderBytes(header);
    bytes.resize(header.file_bytes());
    ASSERT_TRUE(
        base::WriteWhole(folder_ / "h.bt", std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()))
            .ok());
    const std::string yaml = "rodeira: world/1\nname: w\nterrain:\n  file: h.bt\n";
    fs::remove(folder_ / "h.prj");
    EXPECT_THAT(Problems(yaml), IsEmpty());
    EXPECT_THAT(Warnings(yaml),
                ElementsAre(testing::HasSubstr(
                    "w.yaml:4: 'h.bt' says that its coordinates are those of 'h.prj', which is not there: ")));
    const auto projection = terrain::ProjectionWkt("EPSG:3763");
    ASSERT_TRUE(projection.ok());
    ASSERT_TRUE(base::WriteWhole(folder_ / "h.prj", projection.value()).ok());
    EXPECT_THAT(Warnings(yaml), IsEmpty());
  }
}

}  // namespace
}  // namespace rodeira::road
