// SPDX-License-Identifier: Apache-2.0
// Measured surfaces (OpenCRG) that OpenDRIVE files lay on roads: every mode and orientation against the formula that
// they were made from.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <numbers>

#include "common/core/base/files.hpp"
#include "common/core/base/random.hpp"
#include "common/world/road/world.hpp"
#include "tests/common/world/opendrive/sample.hpp"
#include "tests/common/world/surface/made_crg.hpp"

namespace rodeira::road {
namespace {

using testing::HasSubstr;

constexpr double kBegin_m = 20.0, kLength_m = 10.0;  // of the measured stretch
constexpr double kRadius_m = 100.0;
constexpr double kHeight_m = 3.0, kGrade = 0.05;  // of the road

// Bilinear, so that a curved regular grid has it exactly.
double Made(double u, double v) { return 0.05 + 0.01 * u + 0.02 * v + 0.003 * u * v; }

class MeasuredRoad : public testing::Test {
 protected:
  MeasuredRoad() { std::filesystem::create_directories(folder_); }
  ~MeasuredRoad() override { std::filesystem::remove_all(folder_); }

  // An arc to the left about (0, 100) that climbs, with the made surface laid on it.
  base::Result<std::shared_ptr<const World>> Load(const std::string& attributes, const surface::MadeCrg& crg) const {
    return LoadWith(attributes, crg.Text());
  }
  base::Result<std::shared_ptr<const World>> LoadWith(const std::string& attributes, const std::string& crg) const {
    EXPECT_TRUE(base::WriteWhole(folder_ / "made.crg", std::string_view(crg)).ok());
    opendrive::RoadText road;
    road.geometry = fmt::format(R"(<geometry s="0" x="0" y="0" hdg="0" length="100"><arc curvature="{}"/></geometry>)",
                                1.0 / kRadius_m);
    road.elevation = fmt::format(R"(<elevation s="0" a="{}" b="{}" c="0" d="0"/>)", kHeight_m, kGrade);
    road.more = fmt::format(R"(<surface><CRG file="made.crg" sStart="{}" sEnd="{}" {}/></surface>)", kBegin_m,
                            kBegin_m + kLength_m, attributes);
    EXPECT_TRUE(base::WriteWhole(folder_ / "arc.xodr", std::string_view(opendrive::Document(road.Text()))).ok());
    return World::Load(folder_ / "arc.xodr");
  }
  std::shared_ptr<const World> MustLoad(const std::string& attributes, const surface::MadeCrg& crg) const {
    auto world = Load(attributes, crg);
    EXPECT_TRUE(world.ok()) << world.error().Text();
    return world.ok() ? world.value() : nullptr;
  }
  static surface::MadeCrg Crg() {
    surface::MadeCrg crg;
    crg.z = Made;
    return crg;
  }

  const std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("rodeira-measured-" + std::to_string(::getpid()));
};

struct OnArc {
  double s, t;
  Eigen::Vector2d p() const {
    return {(kRadius_m - t) * std::sin(s / kRadius_m), kRadius_m - (kRadius_m - t) * std::cos(s / kRadius_m)};
  }
};

// Where nothing fades: a metre from the stretch's ends, and off the lanes' edges.
OnArc Drawn(std::uint64_t i) {
  return {base::RandomUniform({i, 1}, kBegin_m + 1.01, kBegin_m + kLength_m - 1.01),
          base::RandomUniform({i, 2}, -1.4, 1.4)};
}

template <class Expected>
void ExpectHeights(const World& world, const Expected& expected) {
  constexpr double kStep = 1e-4;
  for (std::uint64_t i = 0; i < 400; ++i) {
    const OnArc at = Drawn(i);
    const Eigen::Vector2d p = at.p();
    const SurfacePoint ground = world.At(p.x(), p.y());
    ASSERT_TRUE(ground.inside);
    EXPECT_NEAR(ground.z_m, expected(at), 1e-9) << "s " << at.s << " t " << at.t;
    // The slopes are those of the heights; a line of the grid may lie between two of the points.
    const auto z = [&](double dx, double dy) { return world.At(p.x() + dx, p.y() + dy).z_m; };
    EXPECT_NEAR(ground.slope_x, (z(kStep, 0.0) - z(-kStep, 0.0)) / (2.0 * kStep), 1e-6);
    EXPECT_NEAR(ground.slope_y, (z(0.0, kStep) - z(0.0, -kStep)) / (2.0 * kStep), 1e-6);
  }
}

double OfRoad(double s) { return kHeight_m + kGrade * s; }

TEST_F(MeasuredRoad, AttachedStandsOnTheRoad) {
  ExpectHeights(*MustLoad(R"(orientation="same" mode="attached" tOffset="0.4" zOffset="0.02" zScale="2")", Crg()),
                [](const OnArc& at) { return OfRoad(at.s) + 2.0 * Made(at.s - kBegin_m, at.t - 0.4) + 0.02; });
  ExpectHeights(*MustLoad(R"(orientation="opposite" mode="attached" tOffset="0.4")", Crg()),
                [](const OnArc& at) { return OfRoad(at.s) + Made(kLength_m - (at.s - kBegin_m), 0.4 - at.t); });
}

TEST_F(MeasuredRoad, Attached0TakesTheRoadsPlace) {
  ExpectHeights(*MustLoad(R"(orientation="same" mode="attached0" zOffset="4")", Crg()),
                [](const OnArc& at) { return Made(at.s - kBegin_m, at.t) + 4.0; });
}

TEST_F(MeasuredRoad, GenuineKeepsItsOwnLineFromTheRoadOn) {
  surface::MadeCrg crg = Crg();
  crg.v = {-4.0, -2.0, 0.0, 2.0, 4.0};
  crg.road_keys = "REFERENCE_LINE_START_X = 700\nREFERENCE_LINE_START_Y = -50\nREFERENCE_LINE_START_PHI = 1.1\n";
  // A straight line from the arc's point at 20 m, 0.3 m to its left, 0.02 rad to the left of its direction there.
  const Eigen::Vector2d from = OnArc{kBegin_m, 0.3}.p();
  const double heading = kBegin_m / kRadius_m + 0.02;
  const Eigen::Vector2d ahead(std::cos(heading), std::sin(heading)), left(-ahead.y(), ahead.x());
  ExpectHeights(*MustLoad(R"(orientation="same" mode="genuine" tOffset="0.3" hOffset="0.02" zOffset="3.5")", crg),
                [&](const OnArc& at) {
                  const Eigen::Vector2d away = at.p() - from;
                  return Made(away.dot(ahead), away.dot(left)) + 3.5;
                });
  // Against the road: its end stands there, and it comes towards it.
  ExpectHeights(*MustLoad(R"(orientation="opposite" mode="genuine" tOffset="0.3" hOffset="0.02" zOffset="3.5")", crg),
                [&](const OnArc& at) {
                  const Eigen::Vector2d away = at.p() - from;
                  return Made(kLength_m - away.dot(ahead), -away.dot(left)) + 3.5;
                });
}

TEST_F(MeasuredRoad, GlobalLiesWhereItSays) {
  surface::MadeCrg crg = Crg();
  crg.v = {-4.0, -2.0, 0.0, 2.0, 4.0};
  crg.rows = 41;
  crg.road_keys = "REFERENCE_LINE_START_X = 15\nREFERENCE_LINE_START_Y = 3\nREFERENCE_LINE_START_PHI = 0\n";
  ExpectHeights(*MustLoad(R"(orientation="same" mode="global")", crg),
                [](const OnArc& at) { return Made(at.p().x() - 15.0, at.p().y() - 3.0); });
}

TEST_F(MeasuredRoad, PassesIntoTheRoadAtItsEnds) {
  const auto world = MustLoad(R"(orientation="same" mode="attached0" zOffset="4")", Crg());
  for (const double s : {kBegin_m, kBegin_m + kLength_m}) {
    for (const double beside : {-1e-7, 1e-7}) {
      const Eigen::Vector2d p = OnArc{s + beside, 0.5}.p();
      EXPECT_NEAR(world->At(p.x(), p.y()).z_m, OfRoad(s), 1e-7);
    }
  }
}

TEST_F(MeasuredRoad, FrictionIsMeasuredToo) {
  surface::MadeCrg crg = Crg();
  crg.z = [](double u, double) { return 0.3 + 0.01 * u; };
  const auto world = MustLoad(R"(orientation="same" mode="attached" purpose="friction")", crg);
  for (std::uint64_t i = 0; i < 100; ++i) {
    const OnArc at = Drawn(i);
    const SurfacePoint ground = world->At(at.p().x(), at.p().y());
    EXPECT_NEAR(ground.friction, 0.3 + 0.01 * (at.s - kBegin_m), 1e-9);
    EXPECT_NEAR(ground.z_m, OfRoad(at.s), 1e-9);
  }
  const Eigen::Vector2d behind = OnArc{40.0, 0.5}.p();
  EXPECT_EQ(world->At(behind.x(), behind.y()).friction, 1.0);
}

TEST_F(MeasuredRoad, ItsNumbersArePartOfTheContentHash) {
  const std::string attributes = R"(orientation="same" mode="attached")";
  surface::MadeCrg other = Crg();
  other.z = [](double u, double v) { return Made(u, v) + (u > 3.0 ? 1e-3 : 0.0); };
  EXPECT_EQ(MustLoad(attributes, Crg())->content_hash(), MustLoad(attributes, Crg())->content_hash());
  EXPECT_NE(MustLoad(attributes, Crg())->content_hash(), MustLoad(attributes, other)->content_hash());
}

// Each misspelt word is read as the nearest one, so the surface lies as if that stood there.
TEST_F(MeasuredRoad, MisspeltWordsAreReadAsTheNearest) {
  const std::string right = R"(orientation="opposite" mode="attached0" purpose="elevation")";
  const auto meant = MustLoad(right, Crg());
  for (const std::string wrong :
       {R"(orientation="oposite" mode="attached0")", R"(orientation="opposite" mode="Attached0")",
        R"(orientation="opposite" mode="attached0" purpose="elevatoin")"}) {
    const auto world = Load(wrong, Crg());
    ASSERT_TRUE(world.ok()) << world.error().Text();
    ExpectHeights(*world.value(), [&](const OnArc& at) { return meant->At(at.p().x(), at.p().y()).z_m; });
    EXPECT_THAT(world.value()->warnings(),
                testing::ElementsAre(testing::ContainsRegex("[.]xodr:[0-9]+: road.surface.crg.*it is read as '")));
  }
}

TEST_F(MeasuredRoad, AWordThatIsLikeNoneLeavesTheSurfaceOut) {
  for (const std::string wrong : {R"(orientation="left" mode="attached")", R"(orientation="same" mode="hovering")",
                                  R"(orientation="same" mode="attached" purpose="colour")"}) {
    const auto world = Load(wrong, Crg());
    ASSERT_TRUE(world.ok()) << world.error().Text();
    ExpectHeights(*world.value(), [](const OnArc& at) { return OfRoad(at.s); });
    EXPECT_THAT(world.value()->warnings(), testing::ElementsAre(HasSubstr("<CRG> is passed over")));
  }
}

TEST_F(MeasuredRoad, AMissingFileIsLeftOutWithOneWarningAndTheOthersAreLaid) {
  const std::string none =
      R"(/><CRG file="none.crg" sStart="40" sEnd="50"/><CRG file="none.crg" sStart="60" sEnd="70")";
  const auto missing = Load(R"(orientation="same" mode="attached")" + none, Crg());
  ASSERT_TRUE(missing.ok()) << missing.error().Text();
  EXPECT_THAT(missing.value()->warnings(),
              testing::ElementsAre(testing::ContainsRegex(
                  "[.]xodr:[0-9]+: rodeira.surface.file: road 1, s 40: .*'none.crg'.*no such file.*2 of this kind")));
  ExpectHeights(*missing.value(), [](const OnArc& at) { return OfRoad(at.s) + Made(at.s - kBegin_m, at.t); });
}

// A file that is cut in its head or in its numbers, or holds something else, is left out with a warning for all.
TEST_F(MeasuredRoad, ADamagedFileIsLeftOutWithOneWarning) {
  const std::string whole = Crg().Text(), head = Crg().Head();
  const std::string again = R"(orientation="same" mode="attached"/><CRG file="made.crg" sStart="60" sEnd="70")";
  for (const std::string& text : {whole.substr(0, head.size() / 2), whole.substr(0, head.size() + 150), std::string(),
                                  std::string("<html></html>"), std::string(head.size(), '\0')}) {
    const auto world = LoadWith(again, text);
    ASSERT_TRUE(world.ok()) << world.error().Text();
    EXPECT_THAT(world.value()->warnings(),
                testing::ElementsAre(testing::ContainsRegex(
                    "[.]xodr:[0-9]+: rodeira.surface.damaged: road 1, s 20: .*made.crg.*2 of this kind")));
    ExpectHeights(*world.value(), [](const OnArc& at) { return OfRoad(at.s); });
  }
}

}  // namespace
}  // namespace rodeira::road
