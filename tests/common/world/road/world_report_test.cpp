// SPDX-License-Identifier: Apache-2.0
// What `rodeira world check | info | query | build` say.
#include "common/world/road/world_report.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <regex>

#include "common/core/base/files.hpp"
#include "common/core/geometry/angle.hpp"
#include "common/world/road/plot_labels.hpp"
#include "common/world/road/world_plot.hpp"
#include "common/world/road/world_profile.hpp"
#include "tests/common/world/opendrive/sample.hpp"
#include "tests/common/world/road/sample_world.hpp"
#include "tests/common/world/surface/made_crg.hpp"
#include "tests/launch/rodeira/temporary_folder.hpp"
#include "tests/names.hpp"
#include "tests/tree.hpp"

namespace rodeira::road {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

class WorldReport : public ::testing::Test {
 protected:
  void SetUp() override { ASSERT_TRUE(base::WriteWhole(folder_ / "w.yaml", kSample).ok()); }
  const cli::TemporaryFolder temporary_;
  const fs::path& folder_ = temporary_.path();
};

TEST_F(WorldReport, QueryTellsTheCratersOracle) {
  const fs::path crater = fs::path(SourceDir()) / "../shared/data/road/bt/crater_0513.bt";
  if (!fs::exists(crater)) GTEST_SKIP() << crater << " is not on this machine";
  const auto world = World::Parse(
      "rodeira: world/1\nname: crater\nterrain: {file: \"" + fs::absolute(crater).string() + "\"}\n", "crater.yaml");
  ASSERT_TRUE(world.ok()) << world.error().Text();
  const ground::GroundPoint at = world.value()->MakeGround()->At(566300.0, 4754000.0);
  EXPECT_NEAR(at.z_m, 2123.4310516, 1e-6);
  EXPECT_NEAR((at.normal_W - Eigen::Vector3d(-0.191350, -0.176795, 0.965468)).norm(), 0.0, 1e-6);
  const std::string text = DescribePoint(*world.value(), 566300.0, 4754000.0);
  EXPECT_THAT(text, HasSubstr("z_m: 2123.4310516\n"));
  EXPECT_THAT(text, HasSubstr("surface: grass\n"));
}

TEST_F(WorldReport, QueryTellsThePlaceOnTheRoad) {
  const Eigen::Vector3d p = SampleRoad().Position(140.0, -1.625);
  const std::string text = DescribePoint(*Sample(), p.x(), p.y());
  EXPECT_THAT(text, HasSubstr("road: main\ns_m: 140.000000\nt_m: -1.625000\nlane: -1 (driving)\n"));
  EXPECT_THAT(text, HasSubstr("surface: asphalt"));
  EXPECT_THAT(DescribePoint(*Sample(), 0.0, 200.0), HasSubstr("lane: none, "));
  EXPECT_THAT(DescribePoint(*Sample(), 1e6, 0.0), HasSubstr("inside: false\nextents_m: x -100.000 to 410.000"));
}

// On a bend of 100 m radius: what lies around a place on its lane.
TEST_F(WorldReport, QueryTellsWhatLiesAroundAPlaceOnALane) {
  const auto world = MustParse(R"(rodeira: world/2
name: around
ground: {kind: plane, surface: grass}
roads:
  - id: a
    axis: [line: {length_m: 40}]
    z_m: 0
    section: {lanes: [{id: -1, width_m: 3}, {id: 1, width_m: 3.5}]}
    successor: {road: b, end: start}
  - id: b
    start: {x_m: 40, y_m: 0}
    axis: [arc: {length_m: 60, radius_m: 100}]
    z_m: 0
    section: {lanes: [{id: -2, type: shoulder, width_m: 1}, {id: -1, width_m: 3}, {id: 1, width_m: 3.5}]}
    lines: [{lane: 0, kind: dashed, stroke_m: 3, gap_m: 6}, {lane: -1, kind: continuous, width_m: 0.15, colour: yellow}]
    signs: [{type: speed_limit, value: 70, s_m: 20}, {type: stop, s_m: 50, for: against}]
)");
  ASSERT_NE(world, nullptr);
  const Eigen::Vector3d p = world->network()->roads()[1].Surface(30.0, -1.25).p_W;
  const std::string text = DescribePoint(*world, p.x(), p.y());
  for (const char* part :
       {"road: b\ns_m: 30.000000\nt_m: -1.250000\nlane: -1 (driving)\n",
        "lane_width_m: 3.000000\nlane_edges_t_m: 0.000000 -3.000000\nlane_middle_t_m: -1.500000\n",
        "curvature_1pm: 0.010000000\n", "lane_left: 1\nlane_right: -2\n", "lanes_ahead: none\nlanes_behind: a:-1\n",
        "line: t_m 0.000000, 0.12 m wide, white, strokes of 3 m, gaps of 6 m\n",
        "line: t_m -3.000000, 0.15 m wide, yellow, continuous\n", "sign: s_m 20.000, 274 speed_limit 70\n"}) {
    EXPECT_THAT(text, HasSubstr(part));
  }
  EXPECT_THAT(text, Not(HasSubstr("206 stop")));  // it is for the others
  const Eigen::Vector3d q = world->network()->roads()[1].Surface(30.0, 1.0).p_W;
  const std::string other = DescribePoint(*world, q.x(), q.y());
  EXPECT_THAT(other, testing::AllOf(HasSubstr("lane: 1 (driving)"), HasSubstr("lanes_ahead: a:1\nlanes_behind: none\n"),
                                    HasSubstr("sign: s_m 50.000, 206 stop\n"), Not(HasSubstr("speed_limit 70"))));
}

// Hills in UTM zone 29, around its meridian 9 degrees west: x = 500 000 m lies on it, whatever y is.
TEST_F(WorldReport, TellsWhereOnTheEarthAPointLies) {
  const auto world = World::Parse(
      "rodeira: world/2\nname: zone 29\nterrain:\n  generate: {seed: 1, columns: 5, rows: 5, spacing_m: 50, west_m: "
      "499900, south_m: 4553000, relief: [], projection: "
      "\"+proj=utm +zone=29 +datum=WGS84 +units=m\"}\n",
      "zone.yaml");
  ASSERT_TRUE(world.ok()) << world.error().Text();
  const std::string text = DescribePoint(*world.value(), 500000.0, 4553100.0);
  EXPECT_THAT(text, HasSubstr("longitude_deg: -9.000000000\nlatitude_deg: 41.1"));
  const auto back = PlaceOnMap(*world.value(), -9.0, std::stod(text.substr(text.find("latitude_deg: ") + 14)));
  ASSERT_TRUE(back.ok()) << back.error().Text();
  EXPECT_NEAR(back.value().x(), 500000.0, 1e-6);
  EXPECT_NEAR(back.value().y(), 4553100.0, 1e-4);  // nine digits of a degree
  EXPECT_THAT(DescribePoint(*Sample(), 0.0, 0.0), Not(HasSubstr("longitude")));
  EXPECT_THAT(PlaceOnMap(*Sample(), -9.0, 41.0).error().Text(), HasSubstr("no position on the earth"));
}

TEST_F(WorldReport, InfoTellsWhatTheWorldHolds) {
  const std::string text = DescribeWorld(*Sample());
  for (const char* part :
       {"world sample\n", "61 x 51 heights every 8.5 m", "network: 1 roads with 0 junctions\nroad main\n",
        "length_m: 305.500", "smallest_radius_m: 45", "(road main, lane -1, s_m 12.500)"}) {
    EXPECT_THAT(text, HasSubstr(part));
  }
  EXPECT_THAT(text, HasSubstr(base::Hex(Sample()->content_hash())));
}

TEST_F(WorldReport, BuildWritesTheSameWorldOnAFile) {
  const auto report = BuildWorld(folder_ / "w.yaml", folder_ / "built");
  ASSERT_TRUE(report.ok()) << report.error().Text();
  EXPECT_THAT(report.value(), HasSubstr(base::Hex(Sample()->content_hash())));
  const auto built = World::Load(folder_ / "built/w.yaml");
  ASSERT_TRUE(built.ok()) << built.error().Text();
  EXPECT_EQ(built.value()->content_hash(), Sample()->content_hash());
  const auto text = base::ReadText(folder_ / "built/w.yaml");
  EXPECT_THAT(text.value(), HasSubstr("file: w.bt"));
  EXPECT_THAT(text.value(), Not(HasSubstr("seed")));
  EXPECT_FALSE(fs::exists(folder_ / "built/w.prj"));  // no projection was named
}

TEST_F(WorldReport, BuildWritesTheProjectionWhereThereIsOne) {
  ASSERT_TRUE(base::WriteWhole(folder_ / "p.yaml",
                               SampleWith("    seed: 7\n", "    seed: 7   # lucky\n    projection: \"EPSG:3763\"\n"))
                  .ok());
  ASSERT_TRUE(BuildWorld(folder_ / "p.yaml", folder_ / "built").ok());
  const auto built = World::Load(folder_ / "built/p.yaml");
  ASSERT_TRUE(built.ok()) << built.error().Text();
  EXPECT_THAT(built.value()->grid()->projection_wkt(), HasSubstr("Transverse_Mercator"));
}

// With its includes, pictures, points and surfaces, which are copied.
TEST_F(WorldReport, BuildWritesTheExampleWorldOnAFile) {
  const fs::path example = fs::path(SourceDir()) / "configs/worlds/example/world.yaml";
  const auto report = BuildWorld(example, folder_ / "built");
  ASSERT_TRUE(report.ok()) << report.error().Text();
  const auto ours = World::Load(example), built = World::Load(folder_ / "built/world.yaml");
  ASSERT_TRUE(built.ok()) << built.error().Text();
  EXPECT_EQ(built.value()->content_hash(), ours.value()->content_hash());
  ASSERT_NE(built.value()->ground_picture(), nullptr);
  terrain::LaidPicture picture = *built.value()->ground_picture();
  EXPECT_EQ(fs::path(picture.file).lexically_normal(), (folder_ / "built/fields.png").lexically_normal());
  EXPECT_EQ(base::ReadBytes(picture.file).value(), base::ReadBytes(example.parent_path() / "fields.png").value());
  picture.file = ours.value()->ground_picture()->file;
  EXPECT_EQ(picture, *ours.value()->ground_picture());
}

TEST_F(WorldReport, BuildRefusesToOverwriteAndToBuildNothing) {
  const auto itself = BuildWorld(folder_ / "w.yaml", folder_);
  ASSERT_FALSE(itself.ok());
  EXPECT_THAT(itself.error().Text(), HasSubstr("would be overwritten"));
  EXPECT_FALSE(fs::exists(folder_ / "w.bt"));
  ASSERT_TRUE(
      base::WriteWhole(folder_ / "plane.yaml", std::string_view("rodeira: world/1\nname: p\nground: {kind: plane}\n"))
          .ok());
  EXPECT_THAT(BuildWorld(folder_ / "plane.yaml", folder_ / "built").error().Text(),
              HasSubstr("there is nothing to build"));
  EXPECT_FALSE(fs::exists(folder_ / "built"));
}

TEST_F(WorldReport, ThePlotIsAWholeSvg) {
  const std::string svg = PlotWorld(*Sample());
  EXPECT_TRUE(svg.starts_with("<svg "));
  EXPECT_TRUE(svg.ends_with("</svg>\n"));
  EXPECT_THAT(svg, HasSubstr("main</text>"));
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
  EXPECT_THAT(PlotWorld(*MustParse("rodeira: world/1\nname: p\nground: {kind: plane}\n")), Not(HasSubstr("nan")));
}

// A station each hundred metres, and the radii of all arcs: of a world file, and of each road of an OpenDRIVE file.
TEST_F(WorldReport, ThePlanHasStationsAndRadii) {
  const std::string svg = PlotWorld(*Sample());
  for (const char* word : {">100 m</text>", ">200 m</text>", ">300 m</text>", ">R45</text>", ">R60</text>"})
    EXPECT_THAT(svg, HasSubstr(word));
  EXPECT_THAT(svg, Not(HasSubstr(">400 m</text>")));
  const fs::path file = folder_ / "bend.xodr";
  ASSERT_TRUE(
      base::WriteWhole(
          file, std::string_view(
                    "<?xml version=\"1.0\"?>\n<OpenDRIVE>\n<header revMajor=\"1\" revMinor=\"7\"/>\n<road id=\"bend\" "
                    "length=\"160\" junction=\"-1\"><planView>"
                    "<geometry s=\"0\" x=\"0\" y=\"0\" hdg=\"0\" length=\"60\"><line/></geometry><geometry s=\"60\" "
                    "x=\"60\" y=\"0\" hdg=\"0\" length=\"100\"><arc curvature=\"-0.0125\"/></geometry></planView>"
                    "<lanes><laneSection s=\"0\"><center><lane id=\"0\"/></center><right><lane id=\"-1\" "
                    "type=\"driving\"><width sOffset=\"0\" a=\"3\" b=\"0\" c=\"0\" "
                    "d=\"0\"/></lane></right></laneSection></lanes></road>\n"
                    "</OpenDRIVE>\n"))
          .ok());
  const std::string network = PlotWorld(*World::Load(file).value());
  for (const char* word : {">50 m</text>", ">100 m</text>", ">150 m</text>", ">R80</text>", ">bend</text>"})
    EXPECT_THAT(network, HasSubstr(word));
  EXPECT_THAT(network, Not(HasSubstr(">200 m</text>")));
}

TEST_F(WorldReport, TheProfileShowsGradesRadiiAndSlopes) {
  const std::string svg = PlotProfiles(*Sample());
  EXPECT_TRUE(svg.starts_with("<svg ") && svg.ends_with("</svg>\n"));
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
  for (const char* text : {"grade in %", "curvature in 1/m", "slope across in %", "height in m"})
    EXPECT_THAT(svg, HasSubstr(text));
  const Version1Road& road = SampleRoad();
  double steepest = 0.0, sharpest = 0.0;  // told at the diagrams' edges, to four digits
  for (int i = 0; i <= 1500; ++i) {
    const RoadFrame at = road.Evaluate(road.length_m() * i / 1500);
    steepest = std::max(steepest, 100.0 * at.grade);
    sharpest = std::min(sharpest, at.curvature_1pm);
  }
  EXPECT_THAT(svg, HasSubstr(fmt::format(">{:.4g}</text>", steepest)));
  EXPECT_THAT(svg, HasSubstr(fmt::format(">{:.4g}</text>", sharpest)));
  int arcs = 0;
  for (const geometry::PlanPiece& piece : road.plan().pieces()) {
    if (piece.curvature_start_1pm != 0.0 && piece.curvature_start_1pm == piece.curvature_end_1pm) {
      ++arcs;
      EXPECT_THAT(svg, HasSubstr(fmt::format(">{:.0f}</text>", 1.0 / std::fabs(piece.curvature_start_1pm))));
    }
  }
  EXPECT_GT(arcs, 0);
  const auto plane =
      World::Parse("rodeira: world/1\nname: p\nground: {kind: plane}\nstart: {x_m: 0, y_m: 0}\n", "p.yaml");
  EXPECT_TRUE(PlotProfiles(*plane.value()).empty());
}

// A bank that turns from 3 to -5 degrees over a road of its own: slopes across are its tangents, left and right of the
// axis alike.
TEST_F(WorldReport, TheProfileShowsSuperelevation) {
  const fs::path file = folder_ / "bank.xodr";
  ASSERT_TRUE(
      base::WriteWhole(
          file, fmt::format("<?xml version=\"1.0\"?>\n<OpenDRIVE>\n<header revMajor=\"1\" revMinor=\"7\"/>\n<road "
                            "id=\"bank\" length=\"100\" junction=\"-1\"><planView>"
                            "<geometry s=\"0\" x=\"0\" y=\"0\" hdg=\"0\" "
                            "length=\"100\"><line/></geometry></planView><lateralProfile><superelevation s=\"0\" "
                            "a=\"{}\" b=\"{}\" c=\"0\" d=\"0\"/></lateralProfile>"
                            "<lanes><laneSection s=\"0\"><left><lane id=\"1\" type=\"driving\"><width sOffset=\"0\" "
                            "a=\"3\" b=\"0\" c=\"0\" d=\"0\"/></lane></left><center><lane id=\"0\"/></center>"
                            "<right><lane id=\"-1\" type=\"driving\"><width sOffset=\"0\" a=\"3\" b=\"0\" c=\"0\" "
                            "d=\"0\"/></lane></right></laneSection></lanes></road>\n</OpenDRIVE>\n",
                            3.0 / 180.0 * geometry::kPi, -8.0 / 180.0 * geometry::kPi / 100.0))
          .ok());
  const std::string svg = PlotProfiles(*World::Load(file).value());
  const std::string across = svg.substr(svg.find("slope across in %"));
  EXPECT_THAT(across, HasSubstr(fmt::format(">{:.4g}</text>", 100.0 * std::tan(3.0 / 180.0 * geometry::kPi))));
  EXPECT_THAT(across, HasSubstr(fmt::format(">{:.4g}</text>", 100.0 * std::tan(-5.0 / 180.0 * geometry::kPi))));
}

// The rectangles in which a picture's words stand, as wide and high as DejaVu Sans has digits.
struct Words {
  double left, top, right, bottom;
  std::string text;
};

std::vector<Words> WordsOf(const std::string& svg) {
  std::vector<Words> words;
  const std::regex text(
      R"re(<text x="([-0-9.]+)" y="([-0-9.]+)" font-family="sans-serif" font-size="([0-9.]+)"[^>]*>([^<]*)</text>)re");
  for (std::sregex_iterator i(svg.begin(), svg.end(), text), end; i != end; ++i) {
    const double x = std::stod((*i)[1]), y = std::stod((*i)[2]), size = std::stod((*i)[3]);
    const std::string word = std::regex_replace((*i)[4].str(), std::regex("&[a-z]+;"), "?");
    words.push_back({x, y - 0.73 * size, x + 0.636 * size * static_cast<double>(word.length()), y, word});
  }
  return words;
}

void ExpectNoWordOverAnother(const std::vector<std::filesystem::path>& worlds) {
  for (const auto& path : worlds) {
    const auto world = World::Load(path);
    ASSERT_TRUE(world.ok()) << world.error().Text();
    const std::vector<Words> words = WordsOf(PlotWorld(*world.value()));
    EXPECT_FALSE(words.empty()) << path;
    for (std::size_t i = 0; i < words.size(); ++i) {
      for (std::size_t k = 0; k < i; ++k) {
        const bool apart = words[i].right <= words[k].left || words[k].right <= words[i].left ||
                           words[i].bottom <= words[k].top || words[k].bottom <= words[i].top;
        EXPECT_TRUE(apart) << path << ": '" << words[i].text << "' and '" << words[k].text << "'";
      }
    }
  }
}

TEST(WorldPlot, NoWordStandsOverAnother) {
  const std::filesystem::path configs = std::filesystem::path(SourceDir()) / "configs/worlds";
  std::vector<std::filesystem::path> worlds = {configs / "example/world.yaml"};
  for (const char* name : {"flat", "haste", "lights", "motorway", "n222", "plane", "ring"})
    worlds.push_back(configs / (std::string(name) + ".yaml"));
  ExpectNoWordOverAnother(worlds);
}

TEST(WorldPlot, NoWordStandsOverAnotherOnRealRoads) {
  const std::filesystem::path roads = std::filesystem::path(SourceDir()) / "../shared/data/road/xodr";
  if (!std::filesystem::exists(roads)) GTEST_SKIP() << "skipped: there is no " << roads.string();
  ExpectNoWordOverAnother({roads / "carla_Town04.xodr", roads / "esmini_fabriksgatan.xodr"});
}

// Eight words fit around a point, and no ninth.
TEST(WorldPlot, WordsWithoutRoomAreLeftOut) {
  PlotLabels labels(200.0, 200.0);
  for (int i = 0; i < 8; ++i) EXPECT_TRUE(labels.Put({100.0, 100.0}, 20.0, 10.0, "#000000", "word"));
  EXPECT_FALSE(labels.Put({100.0, 100.0}, 20.0, 10.0, "#000000", "word"));
  EXPECT_TRUE(labels.Put({195.0, 30.0}, 2.0, 10.0, "#000000", "a<b"));  // to the left, within the picture
  EXPECT_EQ(WordsOf(labels.svg()).size(), 9u);
  EXPECT_NE(labels.svg().find(">a&lt;b</text>"), std::string::npos);
  for (const Words& word : WordsOf(labels.svg())) EXPECT_LE(word.right, 200.0);
}

// What else is wrong with a file of another version is not told: its keys are not known here.
TEST_F(WorldReport, AnotherVersionIsToldAlone) {
  ASSERT_TRUE(base::WriteWhole(folder_ / "v.yaml", "rodeira: world/3\nname: c\nearth: {}\n").ok());
  const auto problems = WorldProblems(folder_ / "v.yaml");
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_THAT(problems[0], IsError("config.other_version", "v.yaml:1: … 'world/3' … 'world/2' … 'world/1'"));
}

// A measured surface 2.1 m over the height that it is laid on, and one that is laid where it belongs.
TEST_F(WorldReport, AMeasuredSurfaceThatIsAWallIsTold) {
  surface::MadeCrg crg;
  crg.rows = 81;
  crg.z = [](double u, double) { return 2.1 + 0.001 * u; };
  ASSERT_TRUE(base::WriteWhole(folder_ / "made.crg", std::string_view(crg.Text())).ok());
  const auto warnings = [&](const std::string& more) {
    EXPECT_TRUE(
        base::WriteWhole(folder_ / "c.yaml",
                         "rodeira: world/2\nname: c\nground: {kind: plane}\nroads:\n  - {id: a, axis: [line: "
                         "{length_m: 100}], z_m: 0, section: {lanes: [{id: -1, width_m: 1.5}, {id: 1, width_m: 1.5}]}, "
                         "surfaces: [{crg: made.crg, from_s_m: 20, to_s_m: 60" +
                             more + "}]}\n")
            .ok());
    EXPECT_THAT(WorldProblems(folder_ / "c.yaml"), ::testing::IsEmpty());
    return WorldWarnings(folder_ / "c.yaml");
  };
  // A metre behind its beginning it has 2.101 m, a metre before its end 2.139 m.
  EXPECT_THAT(
      warnings(""),
      ::testing::ElementsAre(
          HasSubstr("c.yaml: the measured surface 'made.crg' begins at s = 20.0 m of road 'a' 2.10 m above the road, a "
                    "wall within 1 m; a z offset of -2.101 m lays it on the road there"),
          HasSubstr(
              "ends at s = 60.0 m of road 'a' 2.14 m above the road, a wall within 1 m; a z offset of -2.139 m")));
  EXPECT_THAT(warnings(", z_offset_m: -2.12"), ::testing::IsEmpty());
}

// A slip in a measured surface's numbers, and a key that is not known: told once, with line and column, for a world
// file and for an OpenDRIVE file.
TEST_F(WorldReport, SlipsInAMeasuredSurfaceAreTold) {
  surface::MadeCrg crg;
  crg.rows = 81;
  crg.sections = "$ROAD_CRG_OPTS\nBORDER_MODE_U = 2.000000000+e00\nBORDER_MOOD_V = 2\n$\n";
  ASSERT_TRUE(base::WriteWhole(folder_ / "made.crg", std::string_view(crg.Text())).ok());
  const std::string made = (folder_ / "made.crg").string(), head = crg.Head();
  const auto line =
      std::count(head.begin(), head.begin() + static_cast<std::ptrdiff_t>(head.find("BORDER_MODE_U")), '\n') + 1;
  const auto is_told = ::testing::ElementsAre(
      ::testing::AllOf(::testing::StartsWith(fmt::format("{}: line {}: column 28: ", made, line)),
                       ::testing::EndsWith(" (2 warnings)")));
  ASSERT_TRUE(base::WriteWhole(folder_ / "c.yaml",
                               std::string_view("rodeira: world/2\nname: c\nground: {kind: plane}\nroads:\n  - {id: a, "
                                                "axis: [line: {length_m: 100}], z_m: 0, section: {lanes: [{id: -1, "
                                                "width_m: 1.5}]}, surfaces: [{crg: made.crg, from_s_m: 20, to_s_m: "
                                                "60}]}\n"))
                  .ok());
  EXPECT_THAT(WorldWarnings(folder_ / "c.yaml"), is_told);
  opendrive::RoadText road;
  road.more = R"(<surface><CRG file="made.crg" sStart="20" sEnd="60" mode="attached" purpose="elevation"/></surface>)";
  ASSERT_TRUE(base::WriteWhole(folder_ / "c.xodr", std::string_view(opendrive::Document(road.Text()))).ok());
  EXPECT_THAT(WorldWarnings(folder_ / "c.xodr"), is_told);
}

}  // namespace
}  // namespace rodeira::road
