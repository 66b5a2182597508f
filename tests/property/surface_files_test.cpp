// SPDX-License-Identifier: Apache-2.0
// Files of surfaces and lines, against seeded mutations of good ones (tests/property/fuzz.hpp).
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "common/core/geometry/polyline_offset.hpp"
#include "common/world/surface/crg_report.hpp"
#include "tests/common/world/surface/made_crg.hpp"
#include "tests/property/fuzz.hpp"

namespace rodeira::property {
namespace {

TEST(SurfaceFiles, OpenCrg) {
  std::vector<std::string> good;
  for (const char* format : {"LRFI", "LDFI", "KRBI", "KDBI"}) {
    surface::MadeCrg made;
    made.format = format;
    made.rows = 6;
    made.v = {-1.0, 0.0, 0.5};
    made.heading = [](double u) { return 0.1 * u; };
    made.banking = [](double u) { return 0.01 * u; };
    made.z = [](double u, double v) { return u > 1.0 && v > 0.2 ? std::nan("") : 0.01 * u * v; };
    made.road_keys = "REFERENCE_LINE_START_X = 3\nREFERENCE_LINE_START_Y = 4\nREFERENCE_LINE_START_S = 0.01\n";
    made.sections =
        "$ROAD_CRG_OPTS\nBORDER_MODE_U = 3\nBORDER_MODE_V = 4\nBORDER_SMOOTH_UBEG = 1\nREFLINE_CONTINUATION = 1\n$\n"
        "$ROAD_CRG_MODS\nSCALE_LENGTH = 2\nSCALE_CURVATURE = 0.5\nGRID_NAN_MODE = 2\nREFPOINT_U_FRACTION = "
        "0.5\nREFPOINT_X = "
        "7\n$\n";
    good.push_back(made.Text());
    made.sections.clear();
    made.counted = true;
    made.road_keys = "LONG_SECTION_V_RIGHT = -1\nLONG_SECTION_V_INCREMENT = 1\n";
    good.push_back(made.Text());
  }
  Fuzz("OpenCRG", good, [](const std::string& text) -> std::optional<base::Error> {
    const auto file = surface::ParseCrg(std::as_bytes(std::span(text)), "fuzz.crg");
    if (!file) return file.error();
    const surface::CrgSurface& grid = *file.value().surface;
    for (const double x : {0.0, 3.5, -7.25, 1e4, -1e300}) {
      const auto ground = grid.Ground(x, 0.3 * x);
      EXPECT_TRUE(!ground.inside || std::isfinite(ground.z_m + ground.slope_x + ground.slope_y)) << x;
    }
    EXPECT_FALSE(surface::DescribeCrg(file.value()).empty());
    if (text.size() % 16 == 0) {  // costs more than all else
      EXPECT_EQ(surface::PlotCrg(grid).find("nan"), std::string::npos);
    }
    return std::nullopt;
  });
}

TEST(SurfaceFiles, Polylines) {
  Fuzz("polyline",
       {"x_m,y_m,z_m\n0,0,0\n10,0,1\n10,10,2\n0,10.5,2\n-3.5,4e0,1\n", "# plan only\ny_m,x_m\n1,2\n\n3,2.5\n4,1\n"},
       [](const std::string& text) -> std::optional<base::Error> {
         const auto line = geometry::ReadPolyline(text, "fuzz.csv");
         if (!line) return line.error();
         for (const double left : {1.0, -20.0}) {
           const geometry::OffsetLine offset = geometry::Offset(line.value(), left);
           for (const Eigen::Vector3d& p : offset.line.points_W) EXPECT_TRUE(p.allFinite());
           for (const auto& fault : offset.faults) EXPECT_FALSE(geometry::FaultText(fault, left).empty());
         }
         const auto again = geometry::ReadPolyline(geometry::PolylineCsv(line.value()), "again.csv");
         EXPECT_TRUE(again.ok() && again.value().points_W == line.value().points_W);
         return std::nullopt;
       });
}

}  // namespace
}  // namespace rodeira::property
