// SPDX-License-Identifier: Apache-2.0
// Curved regular grids against closed forms: bilinear functions, circles, and every continuation beyond the borders.
#include "common/world/surface/crg_surface.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <filesystem>

#include "common/core/base/random.hpp"
#include "tests/common/world/surface/made_crg.hpp"

namespace rodeira::surface {
namespace {

double Bilinear(double u, double v) { return 0.3 + 0.02 * u - 0.05 * v + 0.01 * u * v; }

CrgSurface Made(const MadeCrg& made) {
  const auto file = made.Parse();
  EXPECT_TRUE(file.ok()) << (file.ok() ? "" : file.error().Text());
  return *file.value().surface;
}

std::string Options(const std::string& keys) { return "$ROAD_CRG_OPTS\n" + keys + "$\n"; }

TEST(CrgSurface, ABilinearFunctionComesOutOfEveryFormat) {
  for (const auto& [format, tolerance] :
       {std::pair("LRFI", 1e-7), std::pair("LDFI", 1e-12), std::pair("KRBI", 3e-7), std::pair("KDBI", 1e-14)}) {
    MadeCrg made;
    made.format = format;
    made.z = Bilinear;
    made.begin_u = 100.0;
    made.v = {-2.0, -1.5, 0.0, 1.0, 1.75};
    const CrgSurface surface = Made(made);
    for (std::uint64_t i = 0; i < 2000; ++i) {
      const double u = base::RandomUniform({i, 1}, 100.0, 110.0), v = base::RandomUniform({i, 2}, -2.0, 1.75);
      const CrgPoint point = surface.At(u, v);
      ASSERT_TRUE(point.inside);
      ASSERT_NEAR(point.z_m, Bilinear(u, v), tolerance) << format;
      ASSERT_NEAR(point.dz_du, 0.02 + 0.01 * v, 10.0 * tolerance) << format;
      ASSERT_NEAR(point.dz_dv, -0.05 + 0.01 * u, 10.0 * tolerance) << format;
    }
  }
}

TEST(CrgSurface, SectionsMayBeCountedFromTheRight) {
  MadeCrg made;
  made.z = Bilinear;
  made.counted = true;
  for (const char* keys : {"LONG_SECTION_V_RIGHT = -2\nLONG_SECTION_V_LEFT = 2\n", "LONG_SECTION_V_INCREMENT = 1\n",
                           "LONG_SECTION_V_RIGHT = -2\nLONG_SECTION_V_INCREMENT = 1\n",
                           "LONG_SECTION_V_LEFT = 2\nLONG_SECTION_V_INCREMENT = 1\n"}) {
    made.road_keys = keys;
    const CrgSurface surface = Made(made);
    EXPECT_EQ(surface.shape().v_m, made.v) << keys;
    EXPECT_NEAR(surface.At(3.3, -1.1).z_m, Bilinear(3.3, -1.1), 1e-12);
  }
}

TEST(CrgSurface, ManySectionsGoOverSeveralLinesOfText) {
  MadeCrg made;
  made.v.clear();
  for (int i = 0; i < 23; ++i) made.v.push_back(-1.0 + 0.1 * i);
  made.z = Bilinear;
  for (const char* format : {"LRFI", "LDFI"}) {
    made.format = format;
    EXPECT_NEAR(Made(made).At(9.9, 1.15).z_m, Bilinear(9.9, 1.15), 2e-7);
  }
}

TEST(CrgSurface, WithoutAnEndTheRowsAreThoseThatAreThere) {
  MadeCrg made;
  made.z = Bilinear;
  made.says_end = false;
  for (const char* format : {"LDFI", "KDBI", "KRBI"}) {
    made.format = format;
    for (const int rows : {7, 8, 16, 20, 21}) {  // with and without a filling of NaN at the end
      made.rows = rows;
      EXPECT_EQ(Made(made).rows(), static_cast<std::size_t>(rows)) << format;
    }
  }
}

TEST(CrgSurface, SlopeAndBankingAddUp) {
  MadeCrg made;
  made.rows = 41;
  made.slope = [](double u) { return 0.01 * u; };  // the middle of each step: z = 0.005 u^2 exactly in the rows
  made.banking = [](double u) { return 0.02 * std::sin(u); };
  made.road_keys = "REFERENCE_LINE_START_Z = 7\n";
  const CrgSurface surface = Made(made);
  for (int row = 0; row < 41; ++row) {
    const double u = 0.5 * row;
    for (const double v : {-2.0, 0.3, 1.9}) {
      EXPECT_NEAR(surface.At(u, v).z_m, 7.0 + 0.005 * u * u + 0.02 * std::sin(u) * v, 1e-11) << u << " " << v;
    }
  }
}

// The chord polygon of a circle: its points stand on the circle of radius R = step / (2 sin(turn/2)).
MadeCrg Circle(double turn_a_step_rad) {
  MadeCrg made;
  made.format = "KDBI";
  made.rows = 61;
  made.heading = [turn_a_step_rad, step = made.step](double u) {
    return turn_a_step_rad * u / step;
  };  // of a step's middle
  made.z = [](double u, double v) { return 0.1 * std::sin(0.7 * u) + 0.05 * v; };
  return made;
}

TEST(CrgSurface, ThePointsOfABendStandOnItsCircle) {
  for (const double turn : {0.02, -0.05}) {
    const CrgSurface surface = Made(Circle(turn));
    const double radius = 0.5 / (2.0 * std::sin(0.5 * turn));
    for (int row = 0; row <= 60; ++row) {  // the first step begins at (0, 0) in the direction 0.5 turn
      const double angle = turn * row;
      const Eigen::Vector2d expected(radius * std::sin(angle), radius * (1.0 - std::cos(angle)));
      EXPECT_NEAR((surface.line().Position(0.5 * row, 0.0) - expected).norm(), 0.0, 1e-12);
      if (row == 0 || row == 60) continue;
      // Beside the corners: on the bisecting line, farther out by 1 / cos(turn / 2).
      const double out = radius - 1.3 / std::cos(0.5 * turn);
      const Eigen::Vector2d beside(out * std::sin(angle), radius - out * std::cos(angle));
      EXPECT_NEAR((surface.line().Position(0.5 * row, 1.3) - beside).norm(), 0.0, 1e-12);
    }
  }
}

TEST(CrgSurface, TheWayToThePlaneAndBackIsTheSamePlace) {
  for (const double turn : {0.0, 0.02, -0.05}) {
    MadeCrg made = Circle(turn);
    made.begin_u = 12.5;
    const CrgSurface surface = Made(made);
    for (std::uint64_t i = 0; i < 5000; ++i) {
      const double u = base::RandomUniform({i, 3}, 2.5, 52.5), v = base::RandomUniform({i, 4}, -3.0, 3.0);
      const Eigen::Vector2d p = surface.line().Position(u, v);
      const CrgFoot foot = surface.line().Project(p.x(), p.y());
      ASSERT_NEAR(foot.u_m, u, 1e-11) << v;
      ASSERT_NEAR(foot.v_m, v, 1e-11) << u;
    }
  }
}

TEST(CrgSurface, SlopesInTheWorldAreThoseOfNeighbouringPoints) {
  const CrgSurface surface = Made(Circle(-0.05));
  constexpr double h = 1e-6;
  int compared = 0;
  for (std::uint64_t i = 0; i < 3000; ++i) {
    const Eigen::Vector2d p =
        surface.line().Position(base::RandomUniform({i, 5}, -3.0, 33.0), base::RandomUniform({i, 6}, -2.5, 2.5));
    const CrgGround here = surface.Ground(p.x(), p.y());
    ASSERT_TRUE(here.inside);
    const auto cell = [](const CrgGround& at) { return std::pair(std::floor(at.u_m / 0.5), std::floor(at.v_m)); };
    const CrgGround east = surface.Ground(p.x() + h, p.y()), west = surface.Ground(p.x() - h, p.y());
    const CrgGround north = surface.Ground(p.x(), p.y() + h), south = surface.Ground(p.x(), p.y() - h);
    if (cell(east) != cell(west) || cell(north) != cell(south)) continue;
    ++compared;
    ASSERT_NEAR(here.slope_x, (east.z_m - west.z_m) / (2.0 * h), 2e-8) << i;
    ASSERT_NEAR(here.slope_y, (north.z_m - south.z_m) / (2.0 * h), 2e-8) << i;
  }
  EXPECT_GT(compared, 2900);
}

TEST(CrgSurface, NoCrackBetweenCellsNorAtTheCornersOfTheLine) {
  const CrgSurface surface = Made(Circle(-0.05));
  for (std::uint64_t i = 0; i < 4000; ++i) {
    const double u =
        i % 2 == 0 ? 0.5 * std::floor(base::RandomUniform({i, 7}, 0.0, 60.0)) : base::RandomUniform({i, 7}, 0.0, 30.0);
    const double v =
        i % 3 == 0 ? std::floor(base::RandomUniform({i, 8}, -2.0, 2.0)) : base::RandomUniform({i, 8}, -2.0, 2.0);
    const Eigen::Vector2d p = surface.line().Position(u, v);
    const double angle = base::RandomUniform({i, 9}, 0.0, 6.28);
    const CrgGround a = surface.Ground(p.x() - 1e-10 * std::cos(angle), p.y() - 1e-10 * std::sin(angle));
    const CrgGround b = surface.Ground(p.x() + 1e-10 * std::cos(angle), p.y() + 1e-10 * std::sin(angle));
    ASSERT_NEAR(a.z_m, b.z_m, 1e-9);
  }
}

struct Border {
  int mode;
  std::function<double(double)> u;  // where in the grid the height beyond comes from
};

TEST(CrgSurface, BeyondItsBordersItGoesOnAsTheFileSays) {
  const auto keep = [](double x) { return std::clamp(x, 0.0, 10.0); };
  const auto repeat = [](double x) { return x - 10.0 * std::floor(x / 10.0); };
  const auto reflect = [](double x) {
    const double back = x - 20.0 * std::floor(x / 20.0);
    return back <= 10.0 ? back : 20.0 - back;
  };
  for (const Border& border : {Border{2, keep}, Border{3, repeat}, Border{4, reflect}}) {
    MadeCrg made;
    made.z = Bilinear;
    made.v = {0.0, 2.5, 10.0};
    made.sections = Options(fmt::format("BORDER_MODE_U = {0}\nBORDER_MODE_V = {0}\n", border.mode));
    const CrgSurface surface = Made(made);
    for (std::uint64_t i = 0; i < 1000; ++i) {
      const double u = base::RandomUniform({i, 10}, -35.0, 45.0), v = base::RandomUniform({i, 11}, -35.0, 45.0);
      const CrgPoint point = surface.At(u, v);
      ASSERT_TRUE(point.inside);
      ASSERT_NEAR(point.z_m, Bilinear(border.u(u), border.u(v)), 1e-11) << border.mode << " " << u << " " << v;
      constexpr double h = 1e-6;
      const double du = (border.u(u + h) - border.u(u - h)) / (2.0 * h),
                   dv = (border.u(v + h) - border.u(v - h)) / (2.0 * h);
      if (std::fabs(du) > 2.0 || std::fabs(dv) > 2.0) continue;  // across a jump
      ASSERT_NEAR(point.dz_du, (0.02 + 0.01 * border.u(v)) * du, 1e-7);
      ASSERT_NEAR(point.dz_dv, (-0.05 + 0.01 * border.u(u)) * dv, 1e-7);
    }
  }
}

TEST(CrgSurface, NoGroundOrZeroBeyondItsBordersAndOffsetsThere) {
  MadeCrg made;
  made.z = Bilinear;
  made.sections = Options("BORDER_MODE_U = 0\nBORDER_MODE_V = 1\nBORDER_OFFSET_V = 0.25\n");
  const CrgSurface surface = Made(made);
  EXPECT_FALSE(surface.At(-1e-9, 0.0).inside);
  EXPECT_FALSE(surface.At(std::nextafter(10.0, 11.0), 0.0).inside);
  EXPECT_TRUE(surface.At(0.0, -2.0).inside);  // all four borders belong to it
  EXPECT_TRUE(surface.At(10.0, 2.0).inside);
  EXPECT_EQ(surface.At(5.0, 2.1).z_m, 0.25);
  EXPECT_EQ(surface.At(5.0, 2.1).dz_du, 0.0);
  EXPECT_FALSE(surface.At(std::nan(""), 0.0).inside);
  made.sections = Options("BORDER_MODE_U = 2\nBORDER_OFFSET_U = -1\n");
  EXPECT_NEAR(Made(made).At(12.0, 1.0).z_m, Bilinear(10.0, 1.0) - 1.0, 1e-12);
}

TEST(CrgSurface, SmoothingZonesGrowFromTheLinesHeight) {
  MadeCrg made;
  made.z = [](double, double) { return 0.4; };
  made.road_keys = "REFERENCE_LINE_START_Z = 2\n";
  made.sections = Options("BORDER_SMOOTH_UBEG = 4\nBORDER_SMOOTH_UEND = 2\n");
  const CrgSurface surface = Made(made);
  EXPECT_NEAR(surface.At(0.0, 1.0).z_m, 2.0, 1e-12);
  EXPECT_NEAR(surface.At(1.0, 1.0).z_m, 2.1, 1e-12);
  EXPECT_NEAR(surface.At(1.0, 1.0).dz_du, 0.1, 1e-12);
  EXPECT_NEAR(surface.At(5.0, 1.0).z_m, 2.4, 1e-12);
  EXPECT_NEAR(surface.At(9.5, 1.0).z_m, 2.1, 1e-12);
  EXPECT_NEAR(surface.At(9.5, 1.0).dz_du, -0.2, 1e-12);
  EXPECT_NEAR(surface.At(11.0, 1.0).z_m, 2.0, 1e-12);
  EXPECT_EQ(surface.At(11.0, 1.0).dz_du, 0.0);
}

TEST(CrgSurface, MissingHeightsAreFilledFromTheInsideOrTakeTheirCellsAway) {
  MadeCrg made;
  made.z = [](double, double v) { return std::fabs(v) > 1.5 ? std::nan("") : 1.0 + 0.1 * v; };
  EXPECT_NEAR(Made(made).At(3.0, -1.9).z_m, 0.9, 1e-12);
  EXPECT_NEAR(Made(made).At(3.0, 1.9).z_m, 1.1, 1e-12);
  made.sections = "$ROAD_CRG_MODS\nGRID_NAN_MODE = 2\nGRID_NAN_OFFSET = 0.5\n$\n";
  EXPECT_NEAR(Made(made).At(3.0, 2.0).z_m, 1.6, 1e-12);
  made.sections = "$ROAD_CRG_MODS\nGRID_NAN_MODE = 1\nGRID_NAN_OFFSET = 0.5\n$\n";
  EXPECT_NEAR(Made(made).At(3.0, 2.0).z_m, 0.5, 1e-12);
  made.sections = "$ROAD_CRG_MODS\n$\n";  // an empty section takes the usual filling away
  EXPECT_FALSE(Made(made).At(3.0, 1.9).inside);
  EXPECT_TRUE(Made(made).At(3.0, 1.0).inside);  // on the last line that is there
}

TEST(CrgSurface, AClosedTrackGoesOnAtItsBeginning) {
  // A ring of 60 steps: the end stands at the beginning.
  MadeCrg made = Circle(2.0 * 3.14159265358979323846 / 60.0);
  made.z = [](double u, double v) { return 0.1 * std::sin(2.0 * 3.14159265358979323846 * u / 30.0) + 0.01 * v; };
  made.sections = Options("REFLINE_CONTINUATION = 1\n");
  const CrgSurface ring = Made(made);
  ASSERT_TRUE(ring.closed());
  for (std::uint64_t i = 0; i < 500; ++i) {
    const double u = base::RandomUniform({i, 12}, 0.0, 30.0), v = base::RandomUniform({i, 13}, -2.0, 2.0);
    EXPECT_NEAR(ring.At(u + 60.0, v).z_m, ring.At(u, v).z_m, 1e-9);
    EXPECT_NEAR(ring.At(u - 30.0, v).z_m, ring.At(u, v).z_m, 1e-9);
  }
  made.heading = nullptr;  // straight: nothing to close
  EXPECT_FALSE(Made(made).closed());
}

TEST(CrgSurface, ModifiersScale) {
  MadeCrg made = Circle(0.02);
  made.slope = [](double) { return 0.01; };
  made.banking = [](double) { return 0.02; };
  const CrgSurface plain = Made(made);
  made.sections =
      "$ROAD_CRG_MODS\nSCALE_Z_GRID = 2\nSCALE_SLOPE = 3\nSCALE_BANKING = 4\nSCALE_LENGTH = 5\nSCALE_WIDTH = "
      "0.5\nSCALE_CURVATURE = 0.5\n$\n";
  const CrgSurface scaled = Made(made);
  EXPECT_NEAR(scaled.length_m(), 150.0, 1e-9);
  EXPECT_EQ(scaled.shape().v_m.back(), 1.0);
  for (const double u : {0.5, 7.5, 29.0}) {
    const double grid = plain.At(u, 1.0).z_m - 0.01 * u - 0.02;
    EXPECT_NEAR(scaled.At(5.0 * u, 0.5).z_m, 2.0 * grid + 3.0 * 0.01 * 5.0 * u + 4.0 * 0.02 * 0.5, 1e-9);
  }
  const double radius = 2.5 / (2.0 * std::sin(0.5 * 0.01));  // half the turn a step, five times the step
  const Eigen::Vector2d chord = scaled.line().points_W()[2] - scaled.line().points_W()[0];
  EXPECT_NEAR(chord.norm(), 2.0 * radius * std::sin(0.01), 1e-9);
}

TEST(CrgSurface, ModifiersMoveTheReferencePointToItsPlace) {
  MadeCrg made = Circle(0.02);
  made.sections =
      "$ROAD_CRG_MODS\nREFPOINT_U_FRACTION = 0.5\nREFPOINT_U_OFFSET = 0.2\nREFPOINT_V = 1.5\nREFPOINT_X = "
      "100\nREFPOINT_Y = "
      "-40\nREFPOINT_Z = 12\nREFPOINT_PHI = 1\n$\n";
  const CrgSurface surface = Made(made);
  const Eigen::Vector2d p = surface.line().Position(15.2, 1.5);
  EXPECT_NEAR((p - Eigen::Vector2d(100.0, -40.0)).norm(), 0.0, 1e-10);
  EXPECT_NEAR(surface.At(15.2, 1.5).z_m, 12.0, 1e-12);
  const Eigen::Vector2d direction = surface.line().DirectionAt(15.2);
  EXPECT_NEAR(std::atan2(direction.y(), direction.x()), 1.0, 1e-12);

  const CrgSurface plain = Made(Circle(0.02));
  made.sections =
      "$ROAD_CRG_MODS\nREFLINE_ROTCENTER_X = 3\nREFLINE_ROTCENTER_Y = 4\nREFLINE_OFFSET_PHI = 0.5\nREFLINE_OFFSET_X = "
      "10\nREFLINE_OFFSET_Y = 20\nREFLINE_OFFSET_Z = 30\n$\n";
  const CrgSurface turned = Made(made);
  for (const double u : {0.0, 11.3, 30.0}) {
    const Eigen::Vector2d from = plain.line().Position(u, 0.7) - Eigen::Vector2d(3.0, 4.0);
    const Eigen::Vector2d expected(13.0 + std::cos(0.5) * from.x() - std::sin(0.5) * from.y(),
                                   24.0 + std::sin(0.5) * from.x() + std::cos(0.5) * from.y());
    EXPECT_NEAR((turned.line().Position(u, 0.7) - expected).norm(), 0.0, 1e-10);
    EXPECT_NEAR(turned.At(u, 0.7).z_m, plain.At(u, 0.7).z_m + 30.0, 1e-10);
  }
}

TEST(CrgSurface, AGapToTheEndThatTheHeaderNamesIsShared) {
  MadeCrg made;
  made.heading = [](double) { return 0.0; };
  made.slope = [](double) { return 0.0; };
  made.road_keys =
      "REFERENCE_LINE_START_X = 0\nREFERENCE_LINE_START_Y = 0\nREFERENCE_LINE_END_X = 10\nREFERENCE_LINE_END_Y = "
      "0.05\nREFERENCE_LINE_START_Z = 1\nREFERENCE_LINE_END_Z = 1.02\n";
  const auto file = made.Parse();
  ASSERT_TRUE(file.ok()) << file.error().Text();
  EXPECT_EQ(file.value().warnings.size(), 2u);
  EXPECT_NEAR(file.value().surface->line().points_W()[10].y(), 0.025, 1e-12);
  EXPECT_NEAR(file.value().surface->At(5.0, 0.0).z_m, 1.01, 1e-12);
}

RC_GTEST_PROP(CrgSurface, TheOrderOfQuestionsNeverChangesABit, (std::uint64_t seed)) {
  static const CrgSurface surface = Made(Circle(-0.05));
  std::vector<Eigen::Vector2d> places;
  for (std::uint64_t i = 0; i < 50; ++i) {
    places.emplace_back(base::RandomUniform({seed, i, 1}, -10.0, 25.0), base::RandomUniform({seed, i, 2}, -25.0, 10.0));
  }
  std::vector<CrgGround> forward, backward;
  for (const auto& p : places) forward.push_back(surface.Ground(p.x(), p.y()));
  for (auto p = places.rbegin(); p != places.rend(); ++p) backward.push_back(surface.Ground(p->x(), p->y()));
  for (std::size_t i = 0; i < places.size(); ++i) {
    const CrgGround &a = forward[i], &b = backward[places.size() - 1 - i];
    RC_ASSERT(a.z_m == b.z_m && a.u_m == b.u_m && a.v_m == b.v_m && a.slope_x == b.slope_x && a.slope_y == b.slope_y);
  }
}

}  // namespace
}  // namespace rodeira::surface
