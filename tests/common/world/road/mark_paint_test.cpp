// SPDX-License-Identifier: Apache-2.0
// Paint of OpenDRIVE roads under SUELO: against the dashes' closed form, and against all lines of real files looked
// through one by one.
#include "common/world/road/mark_paint.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "common/core/base/random.hpp"
#include "common/world/road/world.hpp"
#include "tests/launch/rodeira/temporary_folder.hpp"
#include "tests/tree.hpp"

namespace rodeira::road {
namespace {

// A straight road to the east with dashes of 3 m every 12 m, 0.16 m wide, in its middle, and with a right edge
// that, 3.5 m off, a solid line of 0.2 m.
TEST(MarkPaint, DashesAreRoadMarkWhereTheyAreByClosedForm) {
  const cli::TemporaryFolder folder;
  const auto file = folder.Write("straight.xodr",
                                 "<OpenDRIVE><header revMajor=\"1\" revMinor=\"7\"/><road id=\"1\" length=\"120\" "
                                 "junction=\"-1\"><planView><geometry s=\"0\" x=\"0\" y=\"0\" hdg=\"0\" "
                                 "length=\"120\"><line/></geometry></planView>"
                                 "<lanes><laneSection s=\"0\"><left><lane id=\"1\" type=\"driving\"><width "
                                 "sOffset=\"0\" a=\"3.5\" b=\"0\" c=\"0\" d=\"0\"/></lane></left>"
                                 "<center><lane id=\"0\"><roadMark sOffset=\"0\" type=\"broken\" color=\"white\" "
                                 "width=\"0.16\"><type name=\"broken\" width=\"0.16\"><line length=\"3\" space=\"9\" "
                                 "tOffset=\"0\" sOffset=\"0\" width=\"0.16\"/></type></roadMark></lane></center>"
                                 "<right><lane id=\"-1\" type=\"driving\"><width sOffset=\"0\" a=\"3.5\" b=\"0\" "
                                 "c=\"0\" d=\"0\"/><material sOffset=\"0\" surface=\"asphalt\" friction=\"0.7\"/>"
                                 "<roadMark sOffset=\"40\" type=\"solid\" color=\"white\" "
                                 "width=\"0.2\"/></lane></right></laneSection></lanes></road></OpenDRIVE>");
  const auto world = World::Load(file);
  ASSERT_TRUE(world.ok()) << world.error().Text();
  int painted = 0;
  for (std::uint64_t i = 0; i < 20'000; ++i) {
    const double x = base::RandomUniform({i, 1}, 0.0, 120.0),
                 y = base::RandomUniform({i, 2}, i % 2 == 0 ? -0.3 : -3.5, i % 2 == 0 ? 0.3 : -3.2);
    const double into = std::fmod(x, 12.0);
    if (std::min({into, std::fabs(into - 3.0), 12.0 - into, std::fabs(std::fabs(y) - 0.08), std::fabs(y + 3.4),
                  std::fabs(x - 40.0)}) < 1e-6)
      continue;
    const bool dash = std::fabs(y) < 0.08 && into < 3.0, edge = y < -3.4 && x > 40.0;
    const SurfacePoint at = world.value()->At(x, y);
    EXPECT_EQ(at.surface == ground::Surface::kRoadMark, dash || edge) << x << " " << y;
    EXPECT_EQ(at.friction, dash || edge ? 0.9 : y < 0.0 ? 0.7 : 1.0) << x << " " << y;
    painted += dash || edge;
  }
  EXPECT_GT(painted, 1000);
}

TEST(MarkPaint, OnRealRoadsItIsTheLinesThatTheViewDraws) {
  for (const char* name : {"carla_Town04", "esmini_e6mini", "esmini_fabriksgatan", "esmini_straight_500m_roadmarks",
                           "esmini_multi_intersections", "asamqc_positive_v18"}) {
    const auto file = std::filesystem::path(SourceDir()) / "../shared/data/road/xodr" / (std::string(name) + ".xodr");
    if (!std::filesystem::exists(file)) GTEST_SKIP() << "skipped: there is no " << file.string();
    const auto world = World::Load(file);
    ASSERT_TRUE(world.ok()) << world.error().Text();
    const network::Network& network = *world.value()->network();
    const std::shared_ptr<const network::Network> shared(world.value(), &network);
    const MarkPaint paint(shared);
    int painted = 0, asked = 0;
    for (std::uint32_t r = 0; r < network.roads().size(); ++r) {
      const network::Road& road = network.roads()[r];
      const auto markings = network::MarkingsOf(road);
      std::vector<std::vector<network::Stroke>> strokes;
      for (const network::Marking& line : markings) strokes.push_back(network::StrokesOf(road, line));
      for (std::size_t m = 0; m < markings.size(); ++m) {
        for (std::uint64_t i = 0; i < 40; ++i) {  // near the line, so that about half of the points lie on it
          const double s = base::RandomUniform({r, m, i}, markings[m].from_s_m, markings[m].to_s_m);
          const std::uint32_t section = static_cast<std::uint32_t>(road.SectionIndex(s));
          const double t = network::MarkingAt(road, markings[m], s).value +
                           base::RandomUniform({r, m, i, 1}, -1.0, 1.0) * markings[m].width_m;
          bool expected = false;
          for (std::size_t k = 0; k < markings.size(); ++k) {
            const network::Marking& line = markings[k];
            if (line.painted == nullptr && line.section != section) continue;
            if (std::fabs(t - network::MarkingAt(road, line, s).value) > 0.5 * line.width_m) continue;
            for (const network::Stroke& stroke : strokes[k])
              expected = expected || (s >= stroke.from_s_m && s < stroke.to_s_m);
          }
          EXPECT_EQ(paint.At(r, section, s, t), expected) << name << " road " << road.id() << " s " << s << " t " << t;
          painted += expected, ++asked;
        }
      }
    }
    EXPECT_GT(painted, asked / 10) << name;
    EXPECT_LT(painted, asked) << name;
  }
}

}  // namespace
}  // namespace rodeira::road
