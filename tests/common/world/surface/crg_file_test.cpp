// SPDX-License-Identifier: Apache-2.0
// OpenCRG files of others against the values of ASAM's OpenCRG library (C, 1.2), and what is refused.
#include "common/world/surface/crg_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <limits>

#include "common/core/base/files.hpp"
#include "common/world/surface/crg_report.hpp"
#include "tests/common/world/surface/made_crg.hpp"
#include "tests/launch/rodeira/temporary_folder.hpp"
#include "tests/names.hpp"
#include "tests/tree.hpp"

namespace rodeira::surface {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

const fs::path kFolder = fs::path(SourceDir()) / "../shared/data/road/crg";

struct Known {
  double u, v, x, y, z;
};

void ExpectValues(const char* name, std::initializer_list<Known> values, double z_tolerance, double xy_tolerance) {
  if (!fs::exists(kFolder / name)) GTEST_SKIP() << "skipped: there is no " << (kFolder / name);
  const auto file = LoadCrg(kFolder / name);
  ASSERT_TRUE(file.ok()) << file.error().Text();
  EXPECT_THAT(file.value().warnings, ElementsAre());
  const CrgSurface& surface = *file.value().surface;
  for (const Known& known : values) {
    const Eigen::Vector2d p = surface.line().Position(known.u, known.v);
    EXPECT_NEAR((p - Eigen::Vector2d(known.x, known.y)).norm(), 0.0, xy_tolerance) << name << " " << known.u;
    EXPECT_NEAR(surface.At(known.u, known.v).z_m, known.z, z_tolerance) << name << " " << known.u;
    EXPECT_NEAR(surface.Ground(known.x, known.y).z_m, known.z, 10.0 * z_tolerance) << name << " " << known.u;
  }
}

// x, y, z by crgEvaluv2xy and crgEvaluv2z, heights missing at the sides kept on, no other modifier.
TEST(CrgFile, BelgianBlockIsTheLibrarys) {
  ExpectValues("belgian_block.crg",
               {{730.004, -1.655, 234.769449092043, 79.181230915534, 2.120807552338},
                {732.3456, 0.789, 231.545745618483, 78.249103421450, 2.082424487114},
                {735.5, 0.0, 229.438607799580, 80.780649865836, 2.096626043320},
                {738.8123, -0.4567, 227.337838350809, 83.348525926677, 2.162564870858},
                {739.999, 1.6999, 224.937777409266, 82.757806405035, 2.158110757589},
                {729.0, 0.3, 234.737773043686, 76.983781822525, 2.138782501221},
                {741.0, -0.7, 226.047932112128, 85.109216025487, 2.134370088577},
                {734.0, 2.5, 229.129269029769, 77.847284375376, 2.091854572296}},
               1e-11, 1e-11);
}

// The library keeps heights in single precision: 0.0333333 becomes 0.03333330154.
TEST(CrgFile, TheHandMadeArcIsTheLibrarys) {
  ExpectValues("handmade_arc.crg",
               {{1.0, -1.4, 1.021903527648, -1.4, 0.0},
                {17.3, 0.77, 16.352971567651, 4.260482514860, 0.008330547378},
                {40.1, 1.2, 26.826219423609, 19.154897265817, 0.002499997546},
                {76.0, 0.0, -3.723646049844, 33.309634078583, 0.033333301544},
                {90.0, 1.1, -17.739969962440, 32.442071990204, 0.0},
                {-2.0, 0.4, -2.0, 0.4, 0.0}},
               2e-9, 1e-11);
}

TEST(CrgFile, TheHandMadeSlopeIsTheLibrarys) {
  ExpectValues("handmade_sloped_opts.crg",
               {{1.5, -1.4, 1.5, -1.4, 0.0055},
                {10.25, 0.77, 10.25, 0.77, 0.538305540041},
                {15.1, 1.2, 15.1, 1.2, 0.966711129653},
                {21.0, -0.3, 21.0, -0.3, 1.217777770143},
                {25.0, 0.1, 25.0, 0.1, 1.21}},
               2e-9, 1e-11);
}

// By hand from the file: row 7, u = 7: *missing* at v = -1.5 and 1.5, 0.0111111 and 0.0222222 beside them.
TEST(CrgFile, TheHandMadeStraightHasItsGapsFilled) {
  if (!fs::exists(kFolder / "handmade_straight.crg")) GTEST_SKIP() << "skipped: there is no " << kFolder;
  const CrgSurface surface = *LoadCrg(kFolder / "handmade_straight.crg").value().surface;
  EXPECT_EQ(surface.rows(), 23u);
  EXPECT_NEAR(surface.At(7.0, -1.5).z_m, 0.0111111, 1e-12);
  EXPECT_NEAR(surface.At(7.0, 1.5).z_m, 0.0222222, 1e-12);
  EXPECT_NEAR(surface.At(7.0, 1.0).z_m, 0.0222222, 1e-12);
  EXPECT_NEAR(surface.At(14.5, 1.25).z_m, (-0.0222222 - 0.0111111 - 0.0333333 - 0.0222222) / 4.0,
              1e-12);  // rows 14 and 15
}

TEST(CrgFile, AFileMayNameAnotherRelativeToItself) {
  if (fs::exists(kFolder / "testOptionBorderMode.crg")) {  // it names a missing file
    const auto file = LoadCrg(kFolder / "testOptionBorderMode.crg");
    ASSERT_FALSE(file.ok());
    EXPECT_EQ(file.error().exit_status(), 2);
    EXPECT_THAT(file.error().Text(), Names("testOptionBorderMode.crg: $ROAD_CRG_FILE names "
                                           "'../../../crg-txt/handmade_sloped_opt.crg': … no such file"));
  }
  const cli::TemporaryFolder temporary;
  const fs::path& folder = temporary.path();
  fs::create_directory(folder / "numbers");
  MadeCrg made;
  made.z = [](double, double) { return 1.0; };
  made.sections = "$ROAD_CRG_MODS\nSCALE_Z_GRID = 7\n$\n$ROAD_CRG_OPTS\nBORDER_OFFSET_U = 1\n$\n";
  ASSERT_TRUE(base::WriteWhole(folder / "numbers/made.crg", made.Text()).ok());
  ASSERT_TRUE(
      base::WriteWhole(folder / "master.crg",
                       std::string_view("$CT\n$\n$ROAD_CRG_FILE\n* a long name\n  numbers/\n  made.crg ! goes on\n$\n"
                                        "$ROAD_CRG_MODS\nSCALE_Z_GRID = 3\n$\n"))
          .ok());
  const auto file = LoadCrg(folder / "master.crg");
  ASSERT_TRUE(file.ok()) << file.error().Text();
  EXPECT_NEAR(file.value().surface->At(1.0, 0.0).z_m, 3.0, 1e-12);   // its modifiers replace the other's
  EXPECT_NEAR(file.value().surface->At(-1.0, 0.0).z_m, 4.0, 1e-12);  // its options are the other's
  ASSERT_TRUE(base::WriteWhole(folder / "third.crg", std::string_view("$ROAD_CRG_FILE\nmaster.crg\n$\n")).ok());
  EXPECT_THAT(LoadCrg(folder / "third.crg").error().Text(), HasSubstr("names a third one"));
  ASSERT_TRUE(
      base::WriteWhole(folder / "environment.crg", std::string_view("$ROAD_CRG_FILE\n $HOME/made.crg\n$\n")).ok());
  EXPECT_THAT(LoadCrg(folder / "environment.crg").error().Text(),
              HasSubstr("environment.crg:2: the file name '$HOME/made.crg' begins with an environment variable"));
}

std::string Refusal(const std::string& text) {
  const auto file = ParseCrg(std::as_bytes(std::span(text)), "made.crg");
  EXPECT_FALSE(file.ok());
  if (file.ok()) return {};
  EXPECT_EQ(file.error().exit_status(), 2);
  return file.error().Text();
}

std::string Replaced(std::string text, std::string_view what, std::string_view by) {
  const auto at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), by);
}

TEST(CrgFile, WhatIsWrongIsSaidWithItsLine) {
  MadeCrg made;
  const std::string good = made.Text();
  const auto refusal = [&good](std::string_view what, std::string_view by) {
    return Refusal(Replaced(good, what, by));
  };
  EXPECT_THAT(Refusal(""), HasSubstr("this is no OpenCRG file"));
  EXPECT_THAT(Refusal("$ROAD_CRG\nREFERENCE_LINE_INCREMENT = 1\n$\n"), HasSubstr("this is no OpenCRG file"));
  EXPECT_THAT(refusal("INCREMENT = 0.5", "INCREMENT = 0,5"),
              HasSubstr("made.crg:5:29: 'reference_line_increment' is '0,5'; a number was expected"));
  EXPECT_THAT(refusal("INCREMENT = 0.5", "INCREMENT = -1"),
              HasSubstr("'reference_line_increment' is -1; a number from"));
  EXPECT_THAT(refusal("REFERENCE_LINE_INCREMENT = 0.5", ""), HasSubstr("key 'REFERENCE_LINE_INCREMENT' is missing"));
  EXPECT_THAT(refusal("#:LDFI", "#:LRBI"),
              HasSubstr("made.crg:10: the numbers' format is 'lrbi'; LRFI, LDFI, KRBI or KDBI was expected"));
  EXPECT_THAT(refusal("#:LDFI", ""), HasSubstr("does not say how the numbers are written"));
  EXPECT_THAT(refusal("D:long section at v = -1,m", "D:long section at v = -2,m"),
              HasSubstr("two long sections lie at v = -2 and -2"));
  EXPECT_THAT(refusal("D:long section at v = -1,m", "D:long section 2,m"), HasSubstr("one way for all was expected"));
  EXPECT_THAT(refusal("v = -1,m", "v = -1,mm"),
              HasSubstr("made.crg:13: column 'long section at v = -1' is in 'mm'; 'm' was expected"));
  EXPECT_THAT(refusal("v = -1,m", "v = one,m"), HasSubstr("'long section at v = METRES'"));
  EXPECT_THAT(refusal("D:long section at v = -1,m", "D:reference line heading,rad"),
              HasSubstr("column 'reference line heading' is unknown"));
  EXPECT_THAT(refusal("end_u = 10", "end_u = 11"),
              HasSubstr("21 rows of numbers were found; from u = 0 to 11 every 0.5 m are 23"));
  EXPECT_THAT(refusal("end_u = 10", "end_u = -10"), HasSubstr("at least 2 rows were expected"));
  EXPECT_THAT(refusal("0.000000000000e+00", "0.00000000x000e+00"),
              HasSubstr("made.crg:19: '0.00000000x000e+00' was found in columns 1 to 20"));
  EXPECT_THAT(Refusal(good.substr(0, good.size() - 21)),
              HasSubstr("the file ends within a row: 4 of 5 numbers are there"));
  made.sections = "$ROAD_CRG_OPTS\nBORDER_MODE_U = 2.5\n$\n";
  EXPECT_THAT(Refusal(made.Text()), HasSubstr("'border_mode_u' is 2.5; a whole number from 0 to 4 was expected"));
}

// A file that ends within its last number says another height: it is refused, wherever it was cut.
TEST(CrgFile, TextThatIsCutWithinItsLastNumberIsRefused) {
  MadeCrg made;
  made.format = "LRFI";
  made.says_end = false;
  made.z = [](double u, double v) { return 0.123456 + 0.001 * u + 0.01 * v; };
  std::string whole = made.Text();
  ASSERT_TRUE(whole.ends_with('\n'));
  whole.pop_back();
  const auto read = [](const std::string& text) { return ParseCrg(std::as_bytes(std::span(text)), "made.crg"); };
  ASSERT_TRUE(read(whole).ok()) << "the last line's end may be missing";
  for (std::size_t cut = 1; cut <= 8; ++cut) {
    const auto file = read(whole.substr(0, whole.size() - cut));
    ASSERT_FALSE(file.ok()) << cut;
    EXPECT_THAT(file.error().Text(), HasSubstr("the file is cut short within a number: it ends after '")) << cut;
  }
}

TEST(CrgFile, BinaryNumbersThatAreCutShortOrInfiniteAreRefused) {
  MadeCrg made;
  made.format = "KRBI";
  std::string text = made.Text();
  EXPECT_THAT(Refusal(text.substr(0, text.size() - 100)),
              HasSubstr("the file is cut short: 19 rows of 5 numbers are there, and the header asks for 21"));
  made.z = [](double, double) { return std::numeric_limits<double>::infinity(); };
  EXPECT_THAT(Refusal(made.Text()), HasSubstr("the number in row 1, column 1 is inf; at most 1e9 was expected"));
}

TEST(CrgFile, PartsThatDoNotFitAreRefused) {
  const auto refusal = [](auto&& change) {
    MadeCrg made;
    change(made);
    return Refusal(made.Text());
  };
  EXPECT_THAT(refusal([](MadeCrg& made) { made.v = {0.0}; }), HasSubstr("1 long sections were found; at least 2"));
  EXPECT_THAT(refusal([](MadeCrg& made) { made.counted = true; }),
              HasSubstr("nothing says where the long sections lie"));
  EXPECT_THAT(refusal([](MadeCrg& made) {
                made.counted = true;
                made.road_keys = "LONG_SECTION_V_RIGHT = -2\nLONG_SECTION_V_LEFT = 2\nLONG_SECTION_V_INCREMENT = 0.9\n";
              }),
              HasSubstr("5 long sections from v = -2 to 2 lie 1 m apart; LONG_SECTION_V_INCREMENT says 0.9"));
  EXPECT_THAT(refusal([](MadeCrg& made) { made.heading = [](double u) { return u < 5.0 ? 0.0 : 2.0; }; }),
              HasSubstr("turns by 2 rad in row 11"));
  EXPECT_THAT(refusal([](MadeCrg& made) { made.heading = [](double u) { return u < 5.0 ? 0.0 : std::nan(""); }; }),
              HasSubstr("heading in row 12 is nan"));
  EXPECT_THAT(refusal([](MadeCrg& made) { made.road_keys = "REFERENCE_LINE_END_X = 11\nREFERENCE_LINE_END_Y = 0\n"; }),
              HasSubstr("the reference line's plan ends 1 m beside the end"));
  EXPECT_THAT(refusal([](MadeCrg& made) { made.rows = 1; }), HasSubstr("at least 2 rows were expected"));
}

TEST(CrgFile, WhatIsUnknownIsPassedOverWithAWarning) {
  MadeCrg made;
  made.road_keys = "REFERENCE_LINE_STRAT_X = 4\n";
  made.sections = "$ROAD_CRG_MPRO\nanything\n$\n$SOMETHING\nelse\n$\n$ROAD_CRG_OPTS\nLOG_EVAL = 20\n$\n";
  const auto file = made.Parse();
  ASSERT_TRUE(file.ok()) << file.error().Text();
  EXPECT_THAT(file.value().warnings, ElementsAre(HasSubstr("line 8: key 'reference_line_strat_x' is unknown and passed "
                                                           "over; did you mean 'reference_line_start_x'?"),
                                                 HasSubstr("section '$something' is unknown")));
}

// ASAM's library reads the number before a misspelt exponent of nothing. Others are refused where they go wrong.
TEST(CrgFile, AMisspeltNumberIsToldWithItsColumn) {
  MadeCrg made;
  made.sections = "$ROAD_CRG_OPTS\n BORDER_OFFSET_U = 1.500+e00 ! typo\n$\n";
  const auto file = made.Parse();
  ASSERT_TRUE(file.ok()) << file.error().Text();
  EXPECT_THAT(file.value().warnings,
              ElementsAre(Names("line 10: column 25: 'border_offset_u' is '1.500+e00'; … read as 1.5")));
  for (const auto& [number, column] : {std::pair("1.5+e01", 22), std::pair("1.5 m", 22), std::pair("x", 19)}) {
    made.sections = fmt::format("$ROAD_CRG_OPTS\nBORDER_OFFSET_U = {}\n$\n", number);
    const auto wrong = made.Parse();
    ASSERT_FALSE(wrong.ok()) << number;
    EXPECT_THAT(wrong.error().Text(),
                HasSubstr(fmt::format(":10:{}: 'border_offset_u' is '{}'; a number was expected", column, number)));
  }
}

TEST(CrgReport, SaysWhatTheFileHolds) {
  MadeCrg made;
  made.z = [](double u, double v) { return std::fabs(v) > 1.5 ? std::nan("") : 0.01 * u; };
  made.sections = "$ROAD_CRG_MODS\n$\n$ROAD_CRG_OPTS\nBORDER_MODE_U = 3\n$\n";
  const CrgFile file = made.Parse().value();
  const std::string text = DescribeCrg(file);
  EXPECT_THAT(text, HasSubstr("LDFI"));
  EXPECT_THAT(text, HasSubstr("rows             21, u from 0 m to 10 m every 0.5 m"));
  EXPECT_THAT(text, HasSubstr("heights          0 m to 0.1 m, mean 0.05 m"));
  EXPECT_THAT(text, HasSubstr("missing heights  42 of 105"));
  EXPECT_THAT(text, HasSubstr("along u repeated, across v the last height"));
  const std::string svg = PlotCrg(*file.surface);
  EXPECT_TRUE(svg.starts_with("<svg") && svg.ends_with("</svg>\n"));
  EXPECT_EQ(svg.find("nan"), std::string::npos);
}

}  // namespace
}  // namespace rodeira::surface
