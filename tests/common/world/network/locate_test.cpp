// SPDX-License-Identifier: Apache-2.0
// Where a point lies: closed forms, the index against all bands one by one, hints.
#include <gtest/gtest.h>

#include <cmath>

#include "common/core/base/random.hpp"
#include "common/core/geometry/angle.hpp"
#include "tests/common/world/opendrive/sample.hpp"
#include "tests/setting.hpp"

namespace rodeira::network {
namespace {

using opendrive::Document;
using opendrive::MustRead;
using opendrive::RoadText;

TEST(Locate, SaysLaneAndDistance) {
  const auto network = MustRead(Document(RoadText().Text()));
  const auto at = network->Locate(30.0, -1.0);
  ASSERT_TRUE(at.has_value());
  EXPECT_EQ(at->lane, (LaneKey{0, 0, -1}));
  EXPECT_NEAR(at->s_m, 30.0, 1e-14);
  EXPECT_EQ(at->t_m, -1.0);
  EXPECT_EQ(at->distance_m, 0.0);
  EXPECT_EQ(network->Locate(30.0, 3.5)->lane.lane, 1);  // an edge belongs to the road
  EXPECT_EQ(network->Locate(30.0, 3.5)->distance_m, 0.0);
  EXPECT_EQ(network->Locate(30.0, 0.0)->lane.lane, 1);  // the centre to the left
  const auto beside = network->Locate(30.0, 13.5);
  EXPECT_EQ(beside->lane.lane, 1);
  EXPECT_EQ(beside->distance_m, 10.0);
  EXPECT_EQ(beside->t_m, 13.5);
  EXPECT_NEAR(network->Locate(104.0, -6.5)->distance_m, 5.0, 1e-12);  // 3 aside, 4 ahead
  EXPECT_NEAR(network->Locate(30.0, 1.0, 12.0)->distance_m, 12.0 - Network::kLevel_m, 1e-12);
  EXPECT_EQ(network->Locate(30.0, 1.0, 1.5)->distance_m, 0.0);
  EXPECT_FALSE(network->Locate(std::nan(""), 0.0).has_value());
  EXPECT_FALSE(network->Locate(0.0, HUGE_VAL).has_value());
}

// A bridge over a road.
std::string Crossing() {
  RoadText below, above;
  above.id = "2";
  above.geometry = R"(<geometry s="0" x="50" y="-50" hdg="1.5707963267948966" length="100"><line/></geometry>)";
  above.elevation = R"(<elevation s="0" a="6" b="0" c="0" d="0"/>)";
  return Document(below.Text() + above.Text());
}

TEST(Locate, TheHeightChoosesTheLevel) {
  const auto network = MustRead(Crossing());
  EXPECT_EQ(network->Locate(50.0, 1.0)->lane.road, 1u);  // the top one
  EXPECT_EQ(network->Locate(50.0, 1.0, 0.3)->lane.road, 0u);
  EXPECT_EQ(network->Locate(50.0, 1.0, 5.5)->lane.road, 1u);
  EXPECT_EQ(network->Locate(50.0, 1.0, 2.9)->lane.road, 0u);  // between them: the nearer
  std::vector<Surfacing> surfaces;
  network->Surfaces(50.0, 1.0, surfaces);
  ASSERT_EQ(surfaces.size(), 2u);
  EXPECT_EQ(surfaces[0].sample.p_W.z(), 6.0);
  EXPECT_EQ(surfaces[1].sample.p_W.z(), 0.0);
  network->Surfaces(20.0, 1.0, surfaces);
  EXPECT_EQ(surfaces.size(), 1u);
  network->Surfaces(20.0, 4.0, surfaces);
  EXPECT_TRUE(surfaces.empty());
}

TEST(Locate, AClosedLoopIsFoundAllRound) {
  RoadText road;  // a circle of 80 m in two halves
  road.length = 160.0 * geometry::kPi;
  road.geometry = fmt::format(
      R"(<geometry s="0" x="0" y="0" hdg="0" length="{0}"><arc curvature="0.0125"/></geometry>
          <geometry s="{0}" x="0" y="160" hdg="{1}" length="{0}"><arc curvature="0.0125"/></geometry>)",
      80.0 * geometry::kPi, geometry::kPi);
  const auto network = MustRead(Document(road.Text()));
  for (std::uint64_t i = 0; i < 5000; ++i) {
    const double angle = base::RandomUniform({i, 1}, 1e-4, 2.0 * geometry::kPi - 1e-4),
                 t = base::RandomUniform({i, 2}, -3.4, 3.4);
    const auto at = network->Locate((80.0 - t) * std::sin(angle), 80.0 - (80.0 - t) * std::cos(angle));
    ASSERT_TRUE(at.has_value());
    EXPECT_NEAR(at->s_m, 80.0 * angle, 1e-9);
    EXPECT_NEAR(at->t_m, t, 1e-9);
  }
}

TEST(Locate, SmallGapsBetweenElementsAreClosed) {
  RoadText road;  // a joint with 4 cm of gap and a kink of 0.9 mrad
  road.geometry =
      R"(<geometry s="0" x="0" y="0" hdg="0" length="50"><line/></geometry>
          <geometry s="50" x="50.04" y="0" hdg="0.0009" length="50"><line/></geometry>)";
  const auto import = opendrive::MustImport(Document(road.Text()));
  EXPECT_EQ(import.warnings.size(), 2u);
  for (const double x : {50.0, 50.01, 50.02, 50.039, 50.041}) {
    for (const double y : {-3.4, -0.1, 3.4}) {
      const auto at = import.network->Locate(x, y);
      EXPECT_EQ(at->distance_m, 0.0) << x << " " << y;
      EXPECT_NEAR(at->s_m, 50.0, 0.05);
    }
  }
}

// The same with the index, with any hint, and without any index: bit by bit. RODEIRA_NETWORK_POINTS asks for more
// points.
void ExpectTheIndexChangesNothing(const Network& network, const std::string& name) {
  const std::uint64_t points = Setting("RODEIRA_NETWORK_POINTS", 3000);
  Hint warm;
  for (std::uint64_t i = 0; i < points; ++i) {
    const auto road_index = static_cast<std::size_t>(base::RandomBits({i, 1}) % network.roads().size());
    const Road& road = network.roads()[road_index];
    const double s = base::RandomUniform({i, 2}, -20.0, road.length_m() + 20.0);
    const double wide = i % 10 == 0 ? 300.0 : 15.0;
    const Eigen::Vector3d about = road.Surface(std::clamp(s, 0.0, road.length_m()), 0.0).p_W;
    const double x = about.x() + base::RandomUniform({i, 3}, -wide, wide),
                 y = about.y() + base::RandomUniform({i, 4}, -wide, wide);
    std::optional<double> z;
    if (i % 2 == 0) z = about.z() + base::RandomUniform({i, 5}, -8.0, 8.0);
    const auto slow = network.LocateSlowly(x, y, z);
    Hint strange{static_cast<std::uint32_t>(base::RandomBits({i, 6}) % 5000)};
    for (const auto& fast :
         {network.Locate(x, y, z), network.Locate(x, y, z, &warm), network.Locate(x, y, z, &strange)}) {
      ASSERT_TRUE(fast.has_value() && slow.has_value());
      ASSERT_TRUE(fast->lane == slow->lane && fast->s_m == slow->s_m && fast->t_m == slow->t_m &&
                  fast->z_m == slow->z_m && fast->distance_m == slow->distance_m)
          << name << " (" << x << ", " << y << ", " << z.value_or(NAN) << "): road "
          << network.roads()[fast->lane.road].id() << " s " << fast->s_m << " t " << fast->t_m << " distance "
          << fast->distance_m << "; slowly road " << network.roads()[slow->lane.road].id() << " s " << slow->s_m
          << " t " << slow->t_m << " distance " << slow->distance_m;
    }
  }
}

TEST(Locate, TheIndexChangesNothing) { ExpectTheIndexChangesNothing(*MustRead(Crossing()), "crossing"); }

TEST(Locate, TheIndexChangesNothingOnRealFiles) {
  const auto files = opendrive::RealFiles();
  if (files.empty()) GTEST_SKIP() << "no real .xodr files beside the project";
  for (const auto& file : files) {
    const auto network = opendrive::LoadNetwork(file);
    ASSERT_TRUE(network.ok()) << network.error().Text();
    ExpectTheIndexChangesNothing(*network.value(), file.filename());
    if (testing::Test::HasFatalFailure()) return;
  }
}

// An oracle that knows nothing of bands: the lanes' surfaces, sampled. No sample is nearer than what Locate says, and
// some sample is about as near.
TEST(Locate, NoSampleOfAnyLaneIsNearer) {
  const auto files = opendrive::RealFiles();
  if (files.empty()) GTEST_SKIP() << "no real .xodr files beside the project";
  for (const auto& file : files) {
    const auto network = opendrive::LoadNetwork(file).value();
    std::vector<Eigen::Vector2d> samples;
    constexpr double kStep_m = 1.0;
    for (const LaneKey& key : network->Lanes()) {
      const Road& road = network->roads()[key.road];
      const LaneSection& section = network->Section(key);
      const int count = 1 + static_cast<int>((section.end_s_m - section.s_m) / kStep_m);
      for (int i = 0; i <= count; ++i) {
        const double s = section.s_m + (section.end_s_m - section.s_m) * i / count;
        const auto span = network->Span(key, s);
        const int across = 1 + static_cast<int>(span->width_m() / kStep_m);
        for (int j = 0; j <= across; ++j) {
          const double t = span->inner_t_m + (span->outer_t_m - span->inner_t_m) * j / across;
          samples.push_back(road.Surface(road.Held(key.section, s), t, section, *span).p_W.head<2>());
        }
      }
    }
    for (std::uint64_t i = 0; i < 300; ++i) {
      const Eigen::Vector2d p =
          samples[base::RandomBits({i, 1}) % samples.size()] +
          Eigen::Vector2d(base::RandomUniform({i, 2}, -30.0, 30.0), base::RandomUniform({i, 3}, -30.0, 30.0));
      double nearest = 1e9;
      for (const Eigen::Vector2d& sample : samples) nearest = std::min(nearest, (sample - p).norm());
      const auto at = network->Locate(p.x(), p.y());
      ASSERT_TRUE(at.has_value());
      // Across the road, where the nearest point of an edge that runs obliquely may lie a little ahead.
      EXPECT_LE(at->distance_m, 1.04 * nearest + 0.12) << file.filename() << " " << p.transpose();
      EXPECT_GE(at->distance_m, nearest - 1.5 * kStep_m) << file.filename() << " " << p.transpose();
    }
  }
}

}  // namespace
}  // namespace rodeira::network
