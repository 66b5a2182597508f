// SPDX-License-Identifier: Apache-2.0
// Measured and made surfaces of a world that is written as OpenDRIVE: read again from another folder they are the same
// heights.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "common/core/base/files.hpp"
#include "common/core/base/random.hpp"
#include "common/world/opendrive/import.hpp"
#include "common/world/road/measured_files.hpp"
#include "common/world/road/world_export.hpp"
#include "tests/common/world/opendrive/sample.hpp"
#include "tests/common/world/road/sample_world.hpp"
#include "tests/common/world/surface/made_crg.hpp"
#include "tests/launch/rodeira/temporary_folder.hpp"
#include "tests/tree.hpp"

namespace rodeira::road {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

const fs::path kMeasured = fs::path(SourceDir()) / "../shared/data/road/crg";

class MeasuredExport : public testing::Test {
 protected:
  void Put(const fs::path& name, const std::string& text) const {
    fs::create_directories((folder_.path() / name).parent_path());
    ASSERT_TRUE(base::WriteWhole(folder_.path() / name, std::string_view(text)).ok());
  }
  std::shared_ptr<const World> Load(const fs::path& name) const {
    auto world = World::Load(folder_.path() / name);
    EXPECT_TRUE(world.ok()) << world.error().Text();
    return world.ok() ? world.value() : nullptr;
  }
  // The world as OpenDRIVE, moved to where nothing is found but what was written, and valid by ASAM's own rules.
  std::shared_ptr<const World> ThereAndBack(const World& world) const {
    fs::create_directories(folder_.path() / "out");
    const auto written = WriteOpenDrive(world, folder_.path() / "out/it.xodr");
    EXPECT_TRUE(written.ok()) << written.error().Text();
    fs::rename(folder_.path() / "out", folder_.path() / "moved");
    fs::remove_all(folder_.path() / "in");
    const auto import = opendrive::Load(folder_.path() / "moved/it.xodr", opendrive::Tolerance::Strict());
    EXPECT_TRUE(import.ok()) << import.error().Text();
    for (const auto& finding : import.value().errors) ADD_FAILURE() << finding.Text();
    return Load("moved/it.xodr");
  }
  const cli::TemporaryFolder folder_;
};

// A straight, a clothoid and a bend that climb, with what is laid on them.
std::string Bend(const std::string& surfaces) {
  return "rodeira: world/2\nname: measured\nground: {kind: plane, z_m: 5}\nroads:\n  - id: r\n    start: {x_m: 10, "
         "y_m: -20, heading_deg: 30}\n"
         "    axis: [line: {length_m: 60}, clothoid: {length_m: 40, radius_end_m: 80}, arc: {length_m: 100, radius_m: "
         "80}]\n"
         "    vertical: [{s_m: 0, z_m: 5}, {s_m: 100, z_m: 8, parabola_m: 40}, {s_m: 200, z_m: 7}]\n"
         "    section: {lanes: [{id: -1, width_m: 3.5}, {id: 1, width_m: 3.5}], crossfall: {kind: crown, fall: 0.02},\n"
         "      shoulders: {left: {width_m: 1, fall: 0.03}, right: {width_m: 1, fall: 0.03}}, verge: {width_m: 1, "
         "fall: 0.05}}\n" +
         surfaces;
}

// The farthest of the heights at the same s and t from each other, and how high the surfaces stand.
struct Heights {
  double apart_m = 0.0, over_m = 0.0;
};

Heights Compare(const World& world, const World& even, const World& again, double from_s_m, double to_s_m) {
  Heights heights;
  const network::Road& road = world.network()->roads()[0];
  for (std::uint64_t i = 0; i < 20'000; ++i) {
    const double s = base::RandomUniform({i, 1}, from_s_m, to_s_m), t = base::RandomUniform({i, 2}, -4.45, 4.45);
    const Eigen::Vector3d p = road.Surface(s, t).p_W;
    const SurfacePoint ours = world.At(p.x(), p.y()), theirs = again.At(p.x(), p.y());
    EXPECT_TRUE(theirs.inside);
    heights.apart_m = std::max(heights.apart_m, std::fabs(ours.z_m - theirs.z_m));
    heights.over_m = std::max(heights.over_m, std::fabs(ours.z_m - even.At(p.x(), p.y()).z_m));
    EXPECT_NEAR(ours.slope_x, theirs.slope_x, 1e-6) << s << " " << t;
    EXPECT_NEAR(ours.slope_y, theirs.slope_y, 1e-6) << s << " " << t;
  }
  return heights;
}

TEST_F(MeasuredExport, RealFilesComeBackWithTheSameHeights) {
  for (const char* name :
       {"belgian_block.crg", "handmade_arc.crg", "handmade_sloped_opts.crg", "handmade_straight.crg"}) {
    if (!fs::exists(kMeasured / name)) GTEST_SKIP() << "skipped: there is no " << (kMeasured / name);
    Put(fs::path("in") / name, base::ReadText(kMeasured / name).value());
  }
  Put("in/w.yaml", Bend("    surfaces:\n"
                        "      - {crg: belgian_block.crg, from_s_m: 20, to_s_m: 29.5, t_offset_m: -1.75, z_offset_m: "
                        "-2.1, s_offset_m: 0.25}\n"
                        "      - {crg: belgian_block.crg, from_s_m: 120, to_s_m: 129.5, orientation: opposite, "
                        "z_scale: 0.5, z_offset_m: -1.05}\n"
                        "      - {crg: handmade_straight.crg, from_s_m: 70, to_s_m: 90}\n"
                        "      - {crg: handmade_arc.crg, from_s_m: 95, to_s_m: 115, t_offset_m: 1}\n"
                        "      - {crg: handmade_sloped_opts.crg, from_s_m: 150, to_s_m: 170}\n"
                        "      - {iso_8608: D, seed: 18446744, from_s_m: 60, to_s_m: 180}\n"));
  Put("even.yaml", Bend(""));
  const auto world = Load("in/w.yaml"), even = Load("even.yaml"), again = ThereAndBack(*world);
  const Heights heights = Compare(*world, *even, *again, 0.01, 199.99);
  EXPECT_LT(heights.apart_m, 1e-6);  // asked: 0.1 mm
  EXPECT_GT(heights.over_m, 0.02);
}

// The exported file says itself what other programs can know: where the file is laid, by a path beside it.
TEST_F(MeasuredExport, TheFileIsNamedBesideIt) {
  surface::MadeCrg crg;
  Put("in/made.crg", crg.Text());
  crg.z = [](double u, double) { return 0.01 * u; };
  Put("in/other/made.crg", crg.Text());
  Put("in/w.yaml", Bend("    surfaces: [{crg: made.crg, from_s_m: 20, to_s_m: 30, z_scale: 2}, {crg: other/made.crg, "
                        "from_s_m: 40, to_s_m: 50, orientation: opposite}, "
                        "{crg: made.crg, from_s_m: 60, to_s_m: 70}]\n"));
  (void)ThereAndBack(*Load("in/w.yaml"));
  const std::string text = base::ReadText(folder_.path() / "moved/it.xodr").value();
  EXPECT_THAT(text,
              HasSubstr(R"(<CRG file="it_surfaces/made.crg" sStart="20" sEnd="30" orientation="same" mode="attached" )"
                        R"(purpose="elevation" sOffset="0" tOffset="0" zOffset="0" zScale="2"/>)"));
  EXPECT_THAT(text, HasSubstr(R"(<CRG file="it_surfaces/made_2.crg" sStart="40" sEnd="50" orientation="opposite")"));
  EXPECT_THAT(text, HasSubstr(R"(<CRG file="it_surfaces/made.crg" sStart="60" sEnd="70")"));
  EXPECT_EQ(base::ReadText(folder_.path() / "moved/it_surfaces/made_2.crg").value(), crg.Text());
}

// A .crg may name another one for its numbers; both come along, and its own options and modifiers still count.
TEST_F(MeasuredExport, AFileThatNamesAnotherComesWithIt) {
  surface::MadeCrg crg;
  crg.z = [](double u, double v) { return 0.02 + 0.003 * u + 0.004 * v; };
  Put("in/far away/num!bers.crg", crg.Text());
  Put("in/far away/made.crg", crg.Text());
  const std::string naming =
      "$CT\nnames another\n$\n$ROAD_CRG_FILE ! where the numbers are\n* a remark\n  ../far away/\n  "
      "made.crg\n$ROAD_CRG_MODS\nSCALE_Z_GRID = 3\n$\n";
  Put("in/named/made.crg", naming);
  Put("in/w.yaml", Bend("    surfaces: [{crg: named/made.crg, from_s_m: 20, to_s_m: 30}, {crg: 'far "
                        "away/num!bers.crg', from_s_m: 40, to_s_m: 50}]\n"));
  Put("even.yaml", Bend(""));
  const auto world = Load("in/w.yaml"), even = Load("even.yaml"), again = ThereAndBack(*world);
  EXPECT_LT(Compare(*world, *even, *again, 15.0, 55.0).apart_m, 1e-6);
  const Eigen::Vector3d p = world->network()->roads()[0].Surface(25.0, 0.0).p_W;
  EXPECT_NEAR(again->At(p.x(), p.y()).z_m - even->At(p.x(), p.y()).z_m, 3.0 * (0.02 + 0.003 * 5.0), 1e-6);
  EXPECT_TRUE(fs::exists(folder_.path() / "moved/it_surfaces/num_bers.crg"));
}

// A surface that goes on through a junction is not faded at its mouth, in the exported file neither.
TEST_F(MeasuredExport, ASurfaceGoesOnAtAJunction) {
  const auto roads = [](const std::string& surfaces) {
    const std::string section =
        "    section: {lanes: [{id: -1, width_m: 3.5}, {id: 1, width_m: 3.5}], crossfall: {kind: crown, fall: 0},\n"
        "      shoulders: {left: {width_m: 1, fall: 0}, right: {width_m: 1, fall: 0}}, verge: {width_m: 1, fall: 0}}\n";
    return "rodeira: world/2\nname: crossed\nground: {kind: plane, z_m: 5}\nroads:\n"
           "  - id: main\n    start: {x_m: 0, y_m: 0, heading_deg: 0}\n    z_m: 5\n    axis: [line: {length_m: "
           "200}]\n" +
           section + surfaces +
           "  - id: cross\n    place: {road: main, s_m: 100, turn_deg: 90, own_s_m: 60}\n    axis: [line: {length_m: "
           "120}]\n" +
           section + "junctions:\n  - {id: j, roads: [{road: main, s_m: 100}, {road: cross, s_m: 60}]}\n";
  };
  surface::MadeCrg crg;
  crg.rows = 261;
  crg.z = [](double u, double v) { return 0.01 + 0.0004 * u + 0.002 * v; };
  Put("in/made.crg", crg.Text());
  Put("in/w.yaml", roads("    surfaces: [{crg: made.crg, from_s_m: 50, to_s_m: 150, s_offset_m: 7}, {iso_8608: C, "
                         "seed: 3, from_s_m: 20, to_s_m: 180}]\n"));
  Put("even.yaml", roads(""));
  const auto world = Load("in/w.yaml"), even = Load("even.yaml"), again = ThereAndBack(*world);
  const double mouth_m = world->network()->roads()[0].length_m();
  ASSERT_GT(mouth_m, 80.0);
  const Heights heights = Compare(*world, *even, *again, 10.0, mouth_m - 1.01);
  EXPECT_LT(heights.apart_m, 1e-6);
  EXPECT_GT(heights.over_m, 0.03);
  // Over its last metre, and over the first one behind the junction: the lanes themselves, without their shoulders,
  // which end there.
  for (double before = 0.005; before < 2.0; before += 0.01) {
    for (const double x : {mouth_m - before, 200.0 - mouth_m + before})
      EXPECT_NEAR(again->At(x, 0.7).z_m, world->At(x, 0.7).z_m, 1e-6) << x;
  }
  EXPECT_GT(std::fabs(again->At(mouth_m - 0.001, 0.7).z_m - 5.0), 0.01);
}

TEST_F(MeasuredExport, ACopyOfAnOpenDriveFileHasItsSurfaces) {
  surface::MadeCrg crg;
  crg.z = [](double u, double) { return 0.01 * u; };
  Put("in/road/made.crg", crg.Text());
  Put("beside.crg", crg.Text());
  opendrive::RoadText road;
  road.more = R"(<surface><CRG file="road/made.crg" sStart="20" sEnd="30"/></surface>)";
  Put("in/it.xodr", opendrive::Document(road.Text()));
  fs::create_directories(folder_.path() / "out");
  const fs::path copy = folder_.path() / "out/world.xodr";
  fs::copy(folder_.path() / "in/it.xodr", copy);
  ASSERT_NE(Load("out/world.xodr")->content_hash(), Load("in/it.xodr")->content_hash()) << "its surface is left out";
  const auto copied = CopyMeasured(folder_.path() / "in/it.xodr", copy);
  ASSERT_TRUE(copied.ok()) << copied.error().Text();
  EXPECT_THAT(copied.value(), testing::IsEmpty());
  EXPECT_EQ(Load("out/world.xodr")->content_hash(), Load("in/it.xodr")->content_hash());
  road.more = R"(<surface><CRG file="../beside.crg" sStart="20" sEnd="30"/></surface>)";
  Put("in/it.xodr", opendrive::Document(road.Text()));
  EXPECT_THAT(CopyMeasured(folder_.path() / "in/it.xodr", copy).value(),
              testing::ElementsAre(HasSubstr("'../beside.crg' is not found from here")));
}

TEST_F(MeasuredExport, WhatIsWrongInTheDataOfUsersIsSaid) {
  const auto errors = [](const std::string& surface) {
    opendrive::RoadText road;
    road.more = "<surface>" + surface + "</surface>";
    std::string all;
    const auto import =
        opendrive::Read(opendrive::Document(road.Text()), "it.xodr", opendrive::Tolerance::Unrepaired());
    for (const auto& finding : import.value().errors) all += finding.Text() + "\n";
    return all;
  };
  EXPECT_EQ(errors(
                R"(<userData code="rodeira:iso_8608" value="-1 30 0 0.000064 18446744073709551615"/>
              <userData code="another" value="x"/>)"),
            "");
  for (const char* wrong : {"", "1 2 3 0.1", "1 2 3 0.1 -1", "1 2 3 0.1 1 1", "2 1 3 0.1 1", "1 2 3 7 1", "1 2 3 nan 1",
                            "1 2 1e9 0.1 1", "1 2 3 0.1 x"}) {
    EXPECT_THAT(errors(fmt::format(R"(<userData code="rodeira:iso_8608" value="{}"/>)", wrong)),
                HasSubstr("a made surface is '" + std::string(wrong) + "'; five numbers"))
        << wrong;
  }
  const auto goes_on = [](const char* value) {
    return fmt::format(R"(<CRG file="a.crg" sStart="0" sEnd="9"><userData code="rodeira:goes_on" value="{}"/></CRG>)",
                       value);
  };
  EXPECT_EQ(errors(goes_on("1 0.5")), "");
  for (const char* wrong : {"", "1", "1 -1", "1 1 1", "inf 1"})
    EXPECT_THAT(errors(goes_on(wrong)), HasSubstr("two numbers were expected")) << wrong;
}

}  // namespace
}  // namespace rodeira::road
