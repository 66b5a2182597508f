// SPDX-License-Identifier: Apache-2.0
// Points asked together against the same points asked one by one: not a bit differs.
#include "common/world/network/cluster.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

#include "common/core/base/random.hpp"
#include "tests/common/world/opendrive/sample.hpp"

namespace rodeira::network {
namespace {

using opendrive::Document;
using opendrive::MustRead;
using opendrive::RoadText;

bool SameBits(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }

// Whether `count` points about a middle were answered together, and then as they are alone.
bool QueryTogether(const Network& network, const Eigen::Vector2d& middle, double size_m, std::size_t count,
                   std::uint64_t seed) {
  Cluster cluster;
  cluster.feet.count = count;
  for (std::size_t i = 0; i < count; ++i) {
    cluster.feet.x_m[i] = middle.x() + base::RandomUniform({seed, i, 1}, -0.5, 0.5) * size_m;
    cluster.feet.y_m[i] = middle.y() + base::RandomUniform({seed, i, 2}, -0.5, 0.5) * size_m;
  }
  if (!network.QueryBatch(cluster)) return false;
  std::vector<Surfacing> alone;
  for (std::size_t i = 0; i < count; ++i) {
    network.Surfaces(cluster.feet.x_m[i], cluster.feet.y_m[i], alone);
    EXPECT_EQ(alone.size(), 1u);
    if (alone.size() != 1) return true;
    const Place& place = alone[0].place;
    const SurfaceSample& sample = alone[0].sample;
    EXPECT_EQ(place.lane, (LaneKey{cluster.road, cluster.section, cluster.LaneOf(i)}));
    EXPECT_EQ(cluster.leans, network.roads()[cluster.road].Leans(place.s_m));
    const double pace = 1.0 - cluster.feet.curvature_1pm[i] * cluster.feet.t_m[i];
    const double ds_x = cluster.leans ? cluster.ds_x[i] : pace * cluster.feet.tangent_x[i],
                 ds_y = cluster.leans ? cluster.ds_y[i] : pace * cluster.feet.tangent_y[i];
    const double dt_x = cluster.leans ? cluster.dt_x[i] : -cluster.feet.tangent_y[i],
                 dt_y = cluster.leans ? cluster.dt_y[i] : cluster.feet.tangent_x[i];
    EXPECT_TRUE(SameBits(cluster.s_m[i], place.s_m) && SameBits(cluster.feet.t_m[i], place.t_m) &&
                SameBits(cluster.z_m[i], sample.p_W.z()) && SameBits(cluster.z_by_s[i], sample.ds_W.z()) &&
                SameBits(cluster.z_by_t[i], sample.dt_W.z()) && SameBits(dt_x, sample.dt_W.x()) &&
                SameBits(dt_y, sample.dt_W.y()) && SameBits(ds_x, sample.ds_W.x()) && SameBits(ds_y, sample.ds_W.y()))
        << "road " << network.roads()[cluster.road].id() << " s " << place.s_m << " t " << place.t_m;
    if (testing::Test::HasFailure()) return true;
  }
  return true;
}

// How many of the clusters drawn on a network's roads were answered together.
double ShareTogether(const Network& network, double size_m, double wide_m, int clusters) {
  int together = 0;
  for (std::uint64_t i = 0; i < static_cast<std::uint64_t>(clusters); ++i) {
    const Road& road = network.roads()[base::RandomBits({i, 1}) % network.roads().size()];
    const double s = base::RandomUniform({i, 2}, 0.0, road.length_m());
    const geometry::PlanPoint at = road.axis().Evaluate(s);
    const Eigen::Vector2d middle = at.p_W + base::RandomUniform({i, 3}, -wide_m, wide_m) * at.left_W();
    together += QueryTogether(network, middle, size_m, 2 + base::RandomBits({i, 4}) % (Cluster::kMost - 1), i);
    if (testing::Test::HasFailure()) break;
  }
  return static_cast<double>(together) / clusters;
}

// A line, a clothoid, an arc; heights, crossfall, a width that changes, three lanes.
RoadText Varied() {
  RoadText road;
  road.length = 140.0;
  road.geometry = R"(<geometry s="0" x="0" y="0" hdg="0.3" length="40"><line/></geometry>)"
                  R"(<geometry s="40" x="38.2134595650" y="11.8208082664" hdg="0.3" length="40">
          <spiral curvStart="0" curvEnd="0.02"/></geometry>)"
                  R"(<geometry s="80" x="74.2618295399" y="28.4910729499" hdg="0.7" length="60"><arc curvature="0.02"/>
          </geometry>)";
  road.elevation =
      R"(<elevation s="0" a="3" b="0.02" c="0" d="0"/><elevation s="50" a="4" b="0.02" c="-0.0004" d="0.000001"/>)";
  road.left = R"(<lane id="1" type="driving"><width sOffset="0" a="3.5" b="0.01" c="0" d="0"/></lane>)"
              R"(<lane id="2" type="shoulder"><width sOffset="0" a="1.5" b="0" c="0" d="0"/></lane>)";
  road.lateral = R"(<crossfall side="both" s="0" a="0.02" b="0.0001" c="0" d="0"/>)";
  return road;
}

TEST(Cluster, IsItsPointsOnLinesClothoidsAndArcs) {
  auto import = opendrive::Read(Document(Varied().Text()), "sample.xodr", {});
  ASSERT_TRUE(import.ok());
  EXPECT_GT(ShareTogether(*import.value().network, 0.3, 3.0, 1000), 0.75);
}

// Steady and changing banks on steady and changing grades, steep enough for the library's sine too.
TEST(Cluster, IsItsPointsOnBankedRoads) {
  const char* kBanks[] = {
      R"(<superelevation s="0" a="0.06" b="0" c="0" d="0"/>)",
      R"(<superelevation s="0" a="0.02" b="0.001" c="-0.00001" d="1e-8"/>)",
      R"(<superelevation s="0" a="-0.5" b="0" c="0" d="0"/>)",
      R"(<superelevation s="0" a="0.25" b="0.001" c="0" d="0"/>)",
      R"(<superelevation s="0" a="0" b="0" c="0" d="0"/><superelevation s="60" a="0" b="0.001" c="0" d="0"/>)",
      R"(<superelevation s="0" a="0.3" b="0" c="0" d="0"/><superelevation s="60" a="0.3" b="-0.01" c="0" d="0"/>)"};
  const char* kGrades[] = {"", R"(<elevation s="0" a="3" b="-0.06" c="0" d="0"/>)",
                           R"(<elevation s="0" a="3" b="0.05" c="-0.0004" d="0.000001"/>)"};
  for (const char* bank : kBanks) {
    for (const char* grade : kGrades) {
      RoadText road = Varied();
      road.lateral = bank + (grade[0] == '\0' ? "" : road.lateral);  // with a crossfall too
      road.elevation = grade;
      auto import = opendrive::Read(Document(road.Text()), "sample.xodr", {});
      ASSERT_TRUE(import.ok());
      EXPECT_GT(ShareTogether(*import.value().network, 0.3, 3.0, 600), 0.7) << bank << grade;
      for (std::uint64_t i = 0; i < 200; ++i) {  // where another bank begins
        const double s = 60.0 + base::RandomUniform({i, 5}, -0.5, 0.5), t = base::RandomUniform({i, 6}, -3.0, 3.0);
        QueryTogether(*import.value().network, import.value().network->roads()[0].Surface(s, t).p_W.head<2>(), 0.2, 60,
                      i);
      }
      if (HasFailure()) return;
    }
  }
}

// A road that winds so tightly that its lanes reach over its centres of curvature on one side, and the bands of
// neighbouring panels over one another's; plain, climbing, banked.
TEST(Cluster, IsItsPointsWhereAPanelEnds) {
  for (const char* lateral : {"", R"(<superelevation s="0" a="0.06" b="-0.002" c="0" d="0"/>)"}) {
    RoadText road = Varied();
    road.geometry =
        R"(<geometry s="0" x="0" y="0" hdg="0" length="40"><spiral curvStart="0" curvEnd="0.1"/></geometry>)"
        R"(<geometry s="40" x="26.7038739265" y="19.9524742268" hdg="2" length="20"><arc curvature="0.1"/></geometry>)"
        R"(<geometry s="60" x="10.0428747049" y="22.3274420700" hdg="4" length="40">
            <spiral curvStart="0.1" curvEnd="-0.05"/></geometry>)";
    road.length = 100.0;
    road.lateral = lateral;
    road.left = R"(<lane id="1" type="driving"><width sOffset="0" a="14" b="0" c="0" d="0"/></lane>)";
    road.right = R"(<lane id="-1" type="driving"><width sOffset="0" a="14" b="0" c="0" d="0"/></lane>)";
    auto import = opendrive::Read(Document(road.Text()), "sample.xodr", {});
    ASSERT_TRUE(import.ok()) << import.error().Text();
    ASSERT_NE(import.value().network, nullptr);
    const Network& network = *import.value().network;
    const Road& on = network.roads()[0];
    int together = 0, asked = 0;
    for (const geometry::AxisPanel& panel : on.axis().panels()) {
      for (std::uint64_t i = 0; i < 60; ++i) {
        const double s = panel.end_s_m() + base::RandomUniform({i, panel.detail, 1}, -0.8, 0.8),
                     t = base::RandomUniform({i, panel.detail, 2}, -13.0, 13.0);
        if (s < 0.0 || s > on.length_m()) continue;
        ++asked;
        together += QueryTogether(network, on.Surface(s, t).p_W.head<2>(), 0.25, 20, i);
        if (HasFailure()) FAIL() << "s " << s << " t " << t << lateral;
      }
    }
    EXPECT_GT(together, asked / 10) << asked;
  }
}

// Inside of a kink two panels of a road hold the same points, and the nearer one answers.
TEST(Cluster, IsItsPointsAtAKink) {
  RoadText road;
  road.geometry =
      R"(<geometry s="0" x="0" y="0" hdg="0" length="50"><line/></geometry>
          <geometry s="50" x="50" y="0" hdg="0.3" length="50"><line/></geometry>)";
  road.left = R"(<lane id="1" type="driving"><width sOffset="0" a="14" b="0" c="0" d="0"/></lane>)";
  auto import = opendrive::Read(Document(road.Text()), "sample.xodr", {1.0, 1.0, false});
  ASSERT_TRUE(import.ok()) << import.error().Text();
  const Network& network = *import.value().network;
  int together = 0;
  for (std::uint64_t i = 0; i < 400; ++i) {
    const Eigen::Vector2d middle(base::RandomUniform({i, 1}, 40.0, 60.0), base::RandomUniform({i, 2}, -3.0, 13.0));
    together += QueryTogether(network, middle, 0.25, 20, i);
    if (HasFailure()) FAIL() << middle.transpose();
  }
  EXPECT_GT(together, 100);
}

TEST(Cluster, IsItsPointsOnRealFiles) {
  const auto files = opendrive::RealFiles();
  if (files.empty()) GTEST_SKIP() << "no real .xodr files beside the project";
  double most = 0.0;
  for (const auto& file : files) {
    const auto network = opendrive::LoadNetwork(file);
    ASSERT_TRUE(network.ok()) << network.error().Text();
    most = std::max(most, ShareTogether(*network.value(), 0.3, 6.0, 300));
    if (HasFailure()) FAIL() << file;
  }
  EXPECT_GT(most, 0.5);
}

TEST(Cluster, WhatIsFarApartOrNowhereIsLeftToEachPoint) {
  const auto network = MustRead(Document(RoadText().Text()));
  EXPECT_TRUE(QueryTogether(*network, {40.0, 1.5}, 0.3, 100, 1));
  EXPECT_TRUE(QueryTogether(*network, {40.0, 0.0}, 0.3, 100, 1));    // two lanes
  EXPECT_FALSE(QueryTogether(*network, {40.0, 0.0}, 3.0, 100, 1));   // as wide as the road
  EXPECT_FALSE(QueryTogether(*network, {40.0, 3.5}, 0.3, 100, 1));   // over its edge
  EXPECT_FALSE(QueryTogether(*network, {0.0, 1.5}, 0.3, 100, 1));    // over its end
  EXPECT_FALSE(QueryTogether(*network, {40.0, 20.0}, 0.3, 100, 1));  // beside it
  EXPECT_FALSE(QueryTogether(*network, {1e9, 1.5}, 0.3, 100, 1));
  EXPECT_FALSE(QueryTogether(*network, {std::nan(""), 1.5}, 0.3, 100, 1));
  EXPECT_FALSE(QueryTogether(*network, {40.0, std::numeric_limits<double>::infinity()}, 0.3, 100, 1));
}

}  // namespace
}  // namespace rodeira::network
