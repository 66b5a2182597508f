// SPDX-License-Identifier: Apache-2.0
// The surface of a road: closed forms, rotations, derivatives against differences.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "common/core/base/random.hpp"
#include "tests/common/world/opendrive/sample.hpp"

namespace rodeira::network {
namespace {

using opendrive::Document;
using opendrive::MustRead;
using opendrive::RoadText;

TEST(Surface, FollowsArcAndGrade) {
  RoadText road;
  road.geometry = R"(<geometry s="0" x="10" y="20" hdg="0.5" length="100"><arc curvature="-0.02"/></geometry>)";
  road.elevation = R"(<elevation s="0" a="5" b="0.04" c="-0.0005" d="0"/>)";
  const auto network = MustRead(Document(road.Text()));
  for (const double s : {0.0, 13.0, 77.7, 100.0}) {
    for (const double t : {-3.5, 0.0, 2.0}) {
      // A circle of 50 m about the point 50 m to the right of the start.
      const Eigen::Vector2d centre(10.0 + 50.0 * std::sin(0.5), 20.0 - 50.0 * std::cos(0.5));
      const double angle = 0.5 - 0.02 * s;
      const Eigen::Vector2d p = centre + (50.0 + t) * Eigen::Vector2d(-std::sin(angle), std::cos(angle));
      const SurfaceSample at = network->roads()[0].Surface(s, t);
      EXPECT_NEAR((at.p_W - Eigen::Vector3d(p.x(), p.y(), 5.0 + 0.04 * s - 0.0005 * s * s)).norm(), 0.0, 1e-11);
      EXPECT_NEAR(at.ds_W.head<2>().norm(), 1.0 + 0.02 * t, 1e-13);
      EXPECT_NEAR(at.ds_W.z(), 0.04 - 0.001 * s, 1e-13);
    }
  }
}

TEST(Surface, SuperelevationTurnsTheSectionAboutTheClimbingLine) {
  RoadText road;
  const double heading = 0.8, grade = 0.3, roll = 0.25;
  road.geometry = R"(<geometry s="0" x="0" y="0" hdg="0.8" length="100"><line/></geometry>)";
  road.elevation = R"(<elevation s="0" a="2" b="0.3" c="0" d="0"/>)";
  road.lateral = R"(<superelevation s="0" a="0.25" b="0" c="0" d="0"/>)";
  const auto network = MustRead(Document(road.Text()));
  const Eigen::Matrix3d frame = (Eigen::AngleAxisd(heading, Eigen::Vector3d::UnitZ()) *
                                 Eigen::AngleAxisd(-std::atan(grade), Eigen::Vector3d::UnitY()) *
                                 Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX()))
                                    .toRotationMatrix();
  for (const double t : {-3.0, 1.5, 3.5}) {
    const Eigen::Vector3d line(40.0 * std::cos(heading), 40.0 * std::sin(heading), 2.0 + grade * 40.0);
    const SurfaceSample at = network->roads()[0].Surface(40.0, t);
    EXPECT_NEAR((at.p_W - (line + t * frame.col(1))).norm(), 0.0, 1e-12);
    EXPECT_NEAR((at.ds_W.cross(at.dt_W).normalized() - frame.col(2)).norm(), 0.0, 1e-12);  // the plane's normal
    EXPECT_GT(t * (at.p_W.z() - line.z()), 0.0);  // positive: the left side is higher
  }
}

TEST(Surface, LevelLanesAndLaneHeights) {
  RoadText road;
  road.lateral = R"(<superelevation s="0" a="0.1" b="0" c="0" d="0"/>)";
  road.left =
      R"(<lane id="2" type="sidewalk" level="true"><width sOffset="0" a="2" b="0" c="0" d="0"/>
          <height sOffset="0" inner="0.12" outer="0.16"/></lane>
                 <lane id="1" type="driving"><width sOffset="0" a="3.5" b="0" c="0" d="0"/></lane>)";
  const auto network = MustRead(Document(road.Text()));
  const Road& on = network->roads()[0];
  const double y = 3.5 * std::cos(0.1), z = 3.5 * std::sin(0.1);
  EXPECT_NEAR(on.Surface(50.0, 3.5).p_W.y(), y, 1e-12);
  EXPECT_NEAR(on.Surface(50.0, 3.5).p_W.z(), z, 1e-12);
  EXPECT_NEAR(on.Surface(50.0, 4.5).p_W.y(), y + 1.0, 1e-12);
  EXPECT_NEAR(on.Surface(50.0, 4.5).p_W.z(), z + 0.14, 1e-12);
  EXPECT_NEAR(on.Surface(50.0, 5.5).p_W.z(), z + 0.16, 1e-12);
}

TEST(Surface, ShapesCrossfallsAndStrips) {
  RoadText road;  // the crown of the standard's own example, on one half of the road growing to double height
  road.lateral =
      R"(<shape s="0" t="-4" a="0" b="0" c="0" d="0"/><shape s="0" t="-3" a="0" b="0.15" c="0" d="0"/>
          <shape s="0" t="0" a="0.45" b="-0.1" c="0" d="0"/>
                    <shape s="100" t="-4" a="0" b="0" c="0" d="0"/><shape s="100" t="-3" a="0" b="0.3" c="0" d="0"/>
                      <shape s="100" t="0" a="0.9" b="-0.2" c="0" d="0"/>)";
  auto network = MustRead(Document(road.Text()));
  EXPECT_NEAR(network->roads()[0].Surface(0.0, -3.4).p_W.z(), 0.0, 1e-12);
  EXPECT_NEAR(network->roads()[0].Surface(0.0, -1.0).p_W.z(), 0.3, 1e-12);
  EXPECT_NEAR(network->roads()[0].Surface(50.0, -1.0).p_W.z(), 0.45, 1e-12);
  EXPECT_NEAR(network->roads()[0].Surface(100.0, 2.0).p_W.z(), 0.5, 1e-12);

  road.lateral =
      R"(<crossfall side="left" s="0" a="0.02" b="0" c="0" d="0"/>
          <crossfall side="right" s="0" a="-0.03" b="0" c="0" d="0"/>)";
  network = MustRead(Document(road.Text()));
  EXPECT_NEAR(network->roads()[0].Surface(10.0, 3.0).p_W.z(), -3.0 * std::tan(0.02), 1e-12);
  EXPECT_NEAR(network->roads()[0].Surface(10.0, -3.0).p_W.z(), 3.0 * std::tan(0.03), 1e-12);

  road.lateral =
      R"(<crossSectionSurface><tOffset><coefficients s="0" a="0.5" b="0" c="0" d="0"/></tOffset><surfaceStrips>
    <strip id="1" mode="independent"><width><coefficients s="0" a="2" b="0" c="0" d="0"/></width><linear>
      <coefficients s="0" a="-0.02" b="0" c="0" d="0"/></linear></strip>
    <strip id="2" mode="relative"><quadratic><coefficients s="0" a="0.1" b="0" c="0" d="0"/></quadratic></strip>
    <strip id="-1" mode="independent"><constant><coefficients s="0" a="0.3" b="0.001" c="0" d="0"/></constant></strip>
      </surfaceStrips></crossSectionSurface>)";
  network = MustRead(Document(road.Text()));
  EXPECT_NEAR(network->roads()[0].Surface(20.0, 1.5).p_W.z(), -0.02, 1e-12);
  EXPECT_NEAR(network->roads()[0].Surface(20.0, 3.5).p_W.z(), -0.04 + 0.1, 1e-12);
  EXPECT_NEAR(network->roads()[0].Surface(20.0, -2.0).p_W.z(), 0.32, 1e-12);
}

// Everything at once, so that every derivative has something to say.
std::string Rich() {
  RoadText road;
  road.geometry =
      R"(<geometry s="0" x="3" y="-4" hdg="2.5" length="60"><spiral curvStart="0.001" curvEnd="0.02"/></geometry>)";
  road.length = 60.0;
  road.elevation = R"(<elevation s="0" a="10" b="0.05" c="0.001" d="-0.00001"/>)";
  road.lateral = R"(<superelevation s="0" a="0.02" b="0.002" c="-0.00001" d="0"/>
    <shape s="0" t="-8" a="0" b="0.02" c="0" d="0"/><shape s="0" t="0" a="0.16" b="-0.02" c="0" d="0"/>
    <shape s="60" t="-8" a="0" b="0.03" c="0.001" d="0"/><shape s="60" t="0" a="0.3" b="-0.03" c="0" d="0.0001"/>
    <crossfall side="both" s="0" a="0.01" b="0.0002" c="0" d="0"/>)";
  road.offset = R"(<laneOffset s="0" a="0.5" b="0.01" c="0" d="0"/>)";
  road.left =
      R"(<lane id="2" type="sidewalk" level="true"><width sOffset="0" a="2" b="0.01" c="0" d="0"/>
          <height sOffset="0" inner="0.1" outer="0.2"/><height sOffset="50" inner="0.15" outer="0.1"/></lane>
                 <lane id="1" type="driving"><width sOffset="0" a="3.5" b="0.02" c="-0.0001" d="0"/></lane>)";
  return Document(road.Text());
}

TEST(Surface, DerivativesAreThoseOfTheSurface) {
  const auto network = MustRead(Rich());
  const Road& road = network->roads()[0];
  const double h = 1e-5;
  int level = 0;
  for (std::uint64_t i = 0; i < 2000; ++i) {
    const double s = base::RandomUniform({i, 1}, 0.1, 59.9), t = base::RandomUniform({i, 2}, -2.5, 7.0);
    double outside;
    const LaneSpan span = road.SectionAt(s).At(t, road.CentreAt(s), s, outside);
    if (outside > 0.0 || std::fabs(t) < 1e-3 || std::fabs(t - span.inner_t_m) < 1e-3 ||
        std::fabs(t - span.outer_t_m) < 1e-3 || std::fabs(s - 50.0) < 1e-3)
      continue;
    level += span.lane->level ? 1 : 0;
    const SurfaceSample at = road.Surface(s, t);
    const Eigen::Vector3d ds = (road.Surface(s + h, t).p_W - road.Surface(s - h, t).p_W) / (2.0 * h);
    const Eigen::Vector3d dt = (road.Surface(s, t + h).p_W - road.Surface(s, t - h).p_W) / (2.0 * h);
    EXPECT_NEAR((at.ds_W - ds).norm(), 0.0, 1e-8) << s << " " << t;
    EXPECT_NEAR((at.dt_W - dt).norm(), 0.0, 1e-8) << s << " " << t;
  }
  EXPECT_GT(level, 100);
}

TEST(Surface, EdgesOfLanesAreTheSumsOfTheirWidthsWhereverTheseHaveTheirRecords) {
  LaneSection section;
  for (std::uint64_t i = 0; i < 12; ++i) {
    Lane& lane = section.left.emplace_back();
    lane.id = static_cast<int>(i) + 1;
    std::vector<geometry::Cubic> records;
    for (std::uint64_t k = 0; k < 1 + i % 5 * 4; ++k) {  // some alike, one without any but the first
      const double from = 7.0 * static_cast<double>(k) + (i % 3 == 0 ? 0.0 : base::RandomUniform({i, k, 1}, 0.0, 5.0));
      records.push_back({from, base::RandomUniform({i, k, 2}, -0.5, 4.0), 0.01, 1e-4, -1e-6});
    }
    lane.width = geometry::CubicTable(records);
  }
  const geometry::CubicPoint centre{0.4, 0.02, 0.0};
  for (std::uint64_t n = 0; n < 500; ++n) {
    const double s = base::RandomUniform({n, 9}, -5.0, 130.0);
    double edge = centre.value, slope = centre.slope;
    for (const Lane& lane : section.left) {
      const geometry::CubicPoint width = lane.width.Evaluate(s);
      if (width.value > 0.0) edge += width.value, slope += width.slope;
      const auto span = section.Span(lane.id, centre, s);
      ASSERT_TRUE(span.has_value());
      EXPECT_EQ(span->outer_t_m, edge) << s << " " << lane.id;
      EXPECT_EQ(span->outer_slope, slope) << s << " " << lane.id;
    }
    double outside;
    const LaneSpan last = section.At(edge + 2.0, centre, s, outside);
    EXPECT_EQ(last.lane, &section.left.back());
    EXPECT_EQ(last.outer_t_m, edge);
    EXPECT_EQ(outside, edge + 2.0 - edge);
  }
}

TEST(Surface, LocateLeadsBackAlsoWhereTheRoadIsRolled) {
  const auto network = MustRead(Rich());
  const Road& road = network->roads()[0];
  for (std::uint64_t i = 0; i < 2000; ++i) {
    const double s = base::RandomUniform({i, 1}, 0.2, 59.8), t = base::RandomUniform({i, 2}, -2.3, 5.9);
    const Eigen::Vector3d p = road.Surface(s, t).p_W;
    const auto place = network->Locate(p.x(), p.y(), p.z());
    ASSERT_TRUE(place.has_value());
    EXPECT_NEAR(place->s_m, s, 1e-8);
    EXPECT_NEAR(place->t_m, t, 1e-8);
    EXPECT_NEAR(place->z_m, p.z(), 1e-8);
    EXPECT_EQ(place->distance_m, 0.0);
  }
}

// A line, a bend and a clothoid of 40 m each, with lines by an integration of the heading, and with sections that are
// turned by rotations.
Eigen::Vector3d Turned(double k0, double rate, double s, double t, const geometry::Cubic& height,
                       const geometry::Cubic& roll) {
  Eigen::Vector2d line(0.0, 0.0);
  const auto heading = [&](double u) { return 0.3 + k0 * u + 0.5 * rate * u * u; };
  constexpr int kParts = 800;
  for (int i = 0; i < kParts; ++i) {  // Simpson's rule: right to 2e-14 m
    const double from = s * i / kParts, step = s / kParts;
    for (const auto& [at, weight] : {std::pair{0.0, 1.0}, {0.5, 4.0}, {1.0, 1.0}}) {
      const double angle = heading(from + at * step);
      line += weight * step / 6.0 * Eigen::Vector2d(std::cos(angle), std::sin(angle));
    }
  }
  const Eigen::Matrix3d frame = (Eigen::AngleAxisd(heading(s), Eigen::Vector3d::UnitZ()) *
                                 Eigen::AngleAxisd(-std::atan(height.Slope(s)), Eigen::Vector3d::UnitY()) *
                                 Eigen::AngleAxisd(roll.Value(s), Eigen::Vector3d::UnitX()))
                                    .toRotationMatrix();
  return Eigen::Vector3d(line.x(), line.y(), height.Value(s)) + t * frame.col(1);
}

TEST(Surface, APointOfABankIsFoundWhereRotationsPutIt) {
  const char* kElements[] = {"<line/>", R"(<arc curvature="0.02"/>)", R"(<spiral curvStart="-0.01" curvEnd="0.02"/>)"};
  const double kCurvature[] = {0.0, 0.02, -0.01}, kRate[] = {0.0, 0.0, 0.03 / 40.0};
  const geometry::Cubic kHeights[] = {
      {0.0, 3.0, 0.0, 0.0, 0.0}, {0.0, 3.0, 0.12, 0.0, 0.0}, {0.0, 3.0, 0.2, -0.004, 1e-5}};
  const geometry::Cubic kRolls[] = {
      {0.0, 0.08, 0.0, 0.0, 0.0}, {0.0, -0.6, 0.0, 0.0, 0.0}, {0.0, -0.05, 0.001, 2e-4, -2e-6}};
  const auto record = [](const char* kind, const geometry::Cubic& cubic) {
    return fmt::format(R"(<{} s="0" a="{}" b="{}" c="{}" d="{}"/>)", kind, cubic.a, cubic.b, cubic.c, cubic.d);
  };
  for (std::size_t element = 0; element < std::size(kElements); ++element) {
    for (const geometry::Cubic& height : kHeights) {
      for (const geometry::Cubic& roll : kRolls) {
        RoadText road;
        road.length = 40.0;
        road.geometry =
            fmt::format(R"(<geometry s="0" x="0" y="0" hdg="0.3" length="40">{}</geometry>)", kElements[element]);
        road.elevation = record("elevation", height);
        road.lateral = record("superelevation", roll);
        const auto network = MustRead(Document(road.Text()));
        std::vector<Surfacing> surfaces;
        for (std::uint64_t i = 0; i < 100; ++i) {
          const double s = base::RandomUniform({i, 1}, 1.0, 39.0), t = base::RandomUniform({i, 2}, -3.4, 3.4);
          const Eigen::Vector3d p = Turned(kCurvature[element], kRate[element], s, t, height, roll);
          network->Surfaces(p.x(), p.y(), surfaces);
          ASSERT_EQ(surfaces.size(), 1u);
          EXPECT_NEAR(surfaces[0].place.s_m, s, 2e-12);
          EXPECT_NEAR(surfaces[0].place.t_m, t, 2e-12);
          EXPECT_NEAR(surfaces[0].place.z_m, p.z(), 2e-12);
        }
        ASSERT_FALSE(HasFailure()) << kElements[element] << road.elevation << road.lateral;
      }
    }
  }
}

TEST(Surface, SpeedLimitsMarksAndMaterialsHoldUntilTheNext) {
  RoadText road;
  road.attributes = "junction=\"-1\" rule=\"LHT\"";
  road.more =
      R"(<type s="0" type="town"><speed max="50" unit="km/h"/></type><type s="60" type="motorway">
          <speed max="no limit"/></type>)";
  road.right =
      R"(<lane id="-1" type="driving"><width sOffset="0" a="3.5" b="0" c="0" d="0"/>
          <roadMark sOffset="0" type="solid" weight="standard" color="white" width="0.1"/>
      <roadMark sOffset="30" type="broken" color="yellow" width="0.12"><type name="b">
        <line length="3" space="6" tOffset="0.1" sOffset="0"/></type></roadMark>
      <material sOffset="20" surface="wet asphalt" friction="0.6"/><speed sOffset="80" max="30" unit="mph"/></lane>)";
  const auto network = MustRead(Document(road.Text()));
  const Road& on = network->roads()[0];
  const Lane& lane = on.spec().sections[0].right[0];
  EXPECT_NEAR(*on.SpeedLimitAt(lane, 10.0), 50.0 / 3.6, 1e-12);
  EXPECT_TRUE(std::isinf(*on.SpeedLimitAt(lane, 60.0)));
  EXPECT_NEAR(*on.SpeedLimitAt(lane, 80.0), 30.0 * 1609.344 / 3600.0, 1e-12);
  EXPECT_EQ(on.MarkAt(lane, 29.9)->type, "solid");
  EXPECT_EQ(on.MarkAt(lane, 30.0)->colour, "yellow");
  ASSERT_EQ(on.MarkAt(lane, 30.0)->lines.size(), 1u);
  EXPECT_EQ(on.MarkAt(lane, 30.0)->lines[0].space_m, 6.0);
  EXPECT_EQ(on.MaterialAt(lane, 10.0), nullptr);
  EXPECT_EQ(on.MaterialAt(lane, 99.0)->friction, 0.6);
  EXPECT_EQ(lane.direction, -1);  // the traffic keeps to the left
}

}  // namespace
}  // namespace rodeira::network
