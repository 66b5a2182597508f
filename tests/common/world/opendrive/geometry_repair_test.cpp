// SPDX-License-Identifier: Apache-2.0
// Reference lines that do not hang together, after each kind of element and on either side: gaps, kinks, lengths and
// stations. Where an element ends is what geometry's own tests compare with Fresnel tables and closed forms.
#include <gmock/gmock.h>

#include <cmath>
#include <tuple>

#include "common/world/lanes/curve.hpp"
#include "tests/common/world/opendrive/sample.hpp"

namespace rodeira::opendrive {
namespace {

using testing::AnyOf;
using testing::Contains;
using testing::ElementsAre;
using testing::IsEmpty;

std::string Element(double s_m, double x_m, double y_m, double heading_rad, double length_m, const std::string& kind) {
  return fmt::format("<geometry s=\"{}\" x=\"{}\" y=\"{}\" hdg=\"{}\" length=\"{}\">{}</geometry>", s_m, x_m, y_m,
                     heading_rad, length_m, kind);
}

std::vector<std::string> NamesOf(const Import& import) {
  std::vector<std::string> names;
  for (const Finding& finding : OneEachKind(import.warnings)) {
    if (finding.repair.kind != RepairKind::kNone) names.push_back(finding.repair.Name());
  }
  return names;
}

Import MadeOf(const std::string& geometry, double length_m) {
  RoadText road;
  road.geometry = geometry, road.length = length_m;
  return MustImport(Document(road.Text()));
}

const geometry::PlanAxis& AxisOf(const Import& import) { return import.network->roads()[0].axis(); }

// Names of the kinds, so that a failure says which one it is.
struct KindOfElement {
  const char *name, *xml;
};
constexpr KindOfElement kElements[] = {
    {"line", "<line/>"},
    {"left", "<arc curvature=\"0.013\"/>"},
    {"right", "<arc curvature=\"-0.02\"/>"},
    {"spiral", "<spiral curvStart=\"0.001\" curvEnd=\"-0.015\"/>"},
    {"normalized",
     "<paramPoly3 pRange=\"normalized\" aU=\"0\" bU=\"50\" cU=\"0\" dU=\"0\" aV=\"0\" bV=\"0\" cV=\"3\" dV=\"-1\"/>"},
    {"arclength",
     "<paramPoly3 pRange=\"arcLength\" aU=\"0\" bU=\"1\" cU=\"0\" dU=\"0\" aV=\"0\" bV=\"0\" cV=\"0.0012\" "
     "dV=\"-8e-06\"/>"},
};
constexpr double kFirst_m = 50.0;

class GapsRepair : public testing::TestWithParam<std::tuple<KindOfElement, double, double>> {
 protected:
  const std::string first_ = Element(0, -7, 12, 0.3, kFirst_m, std::get<0>(GetParam()).xml);
  const double along_m_ = std::get<1>(GetParam()), across_m_ = std::get<2>(GetParam());
  // The file with the gap; without it, both elements meet.
  Import With(double along_m, double across_m) const {
    const Import alone = MadeOf(first_, kFirst_m);
    const geometry::PlanPoint end = AxisOf(alone).Evaluate(kFirst_m);
    const Eigen::Vector2d ahead(std::cos(end.heading_rad), std::sin(end.heading_rad)), left(-ahead.y(), ahead.x());
    const Eigen::Vector2d p = end.p_W + along_m * ahead + across_m * left;
    return MadeOf(first_ + Element(kFirst_m, p.x(), p.y(), end.heading_rad, 30, "<line/>"), kFirst_m + 30.0);
  }
};

TEST_P(GapsRepair, AreBridgedOrEndTheRoad) {
  const Import good = With(0.0, 0.0), import = With(along_m_, across_m_);
  EXPECT_THAT(NamesOf(good), IsEmpty());
  ASSERT_NE(import.network, nullptr);
  const geometry::PlanAxis &axis = AxisOf(import), &as_drawn = AxisOf(good);
  // Up to 0.3 m along and 0.1 m across.
  const bool bridged = std::fabs(along_m_) < 0.3 && std::fabs(across_m_) < 0.1;
  EXPECT_THAT(NamesOf(import), ElementsAre(bridged ? "geometry.gap_bridged" : "road.ended"));
  EXPECT_NEAR(axis.length_m(), bridged ? kFirst_m + 30.0 : kFirst_m, 1e-9);
  // What was consistent has not moved.
  for (const double s : {0.0, 10.0, 44.0})
    EXPECT_LT((axis.Evaluate(s).p_W - as_drawn.Evaluate(s).p_W).norm(), 1e-9) << s;
  if (!bridged) return;
  const geometry::PlanPoint end = as_drawn.Evaluate(kFirst_m);
  const Eigen::Vector2d gap = along_m_ * end.tangent_W + across_m_ * end.left_W();
  for (const double s : {kFirst_m + 0.01, 60.0, 80.0})
    EXPECT_LT((axis.Evaluate(s).p_W - as_drawn.Evaluate(s).p_W - gap).norm(), 1e-6) << s;
  // No jump and no kink anywhere: 1 cm on, the line is at most 1.1 cm farther, and turns by less than 20 mrad.
  for (double s = 0.0; s < axis.length_m() - 0.01; s += 0.01) {
    const geometry::PlanPoint here = axis.Evaluate(s), there = axis.Evaluate(s + 0.01);
    ASSERT_LT((here.p_W - there.p_W).norm(), 0.011) << s;
    ASSERT_LT(std::fabs(std::remainder(here.heading_rad - there.heading_rad, 6.283185307179586)), 0.02) << s;
  }
  if (import.repaired_text.empty()) return;
  EXPECT_TRUE(MustImport(import.repaired_text).repaired_text.empty()) << "a second repair changes the file";
}

INSTANTIATE_TEST_SUITE_P(OfEachKind, GapsRepair,
                         testing::Combine(testing::ValuesIn(kElements), testing::Values(-0.32, -0.28, 0.0, 0.28, 0.32),
                                          testing::Values(-0.12, -0.08, 0.06, 0.09, 0.11)),
                         [](const auto& each) {
                           const auto number = [](double value) {
                             return (value < 0.0 ? "m" : "p") + std::to_string(std::lround(std::fabs(value) * 100.0));
                           };
                           return std::string(std::get<0>(each.param).name) + "_" + number(std::get<1>(each.param)) +
                                  "_" + number(std::get<2>(each.param));
                         });

// Half a circle of chords of 4 m, to the left and to the right: each corner lies where the file has it, and the lanes'
// middle turns round it within 1 m, so with a mean radius of 1 m over the kink.
TEST(ChainsOfLines, AreDrawnAsTheyAreAndDrivenRound) {
  for (const double kink : {0.005, -0.0125, 0.07, -0.3}) {
    std::string geometry;
    std::vector<Eigen::Vector2d> corners;
    Eigen::Vector2d p(3.0, -8.0);
    double heading = -0.4;
    constexpr int kLines = 9;
    for (int i = 0; i < kLines; ++i) {
      geometry += Element(4.0 * i, p.x(), p.y(), heading, 4.0, "<line/>");
      corners.push_back(p);
      p += 4.0 * Eigen::Vector2d(std::cos(heading), std::sin(heading));
      heading += kink;
    }
    const Import import = MadeOf(geometry, 4.0 * kLines);
    EXPECT_THAT(NamesOf(import), ElementsAre("geometry.kink_rounded"));
    EXPECT_THAT(OneEachKind(import.warnings).front().message, testing::HasSubstr("(8 of this kind)"));
    EXPECT_TRUE(import.repaired_text.empty());
    for (std::size_t i = 0; i < corners.size(); ++i)
      EXPECT_LT((AxisOf(import).Evaluate(4.0 * static_cast<double>(i)).p_W - corners[i]).norm(), 1e-9);
    const lanes::Curve curve(*import.network, {0, 0, -1}, true);
    // Within 1 cm the lane's middle turns by less than 15 % of a kink; unrounded it would by all of it.
    for (double d = 0.0; d < curve.length_m(); d += 0.01) {
      const lanes::CurvePoint here = curve.At(d), there = curve.At(d + 0.01);
      const double turned = std::fabs(std::remainder(
          std::atan2(there.ahead_W.y(), there.ahead_W.x()) - std::atan2(here.ahead_W.y(), here.ahead_W.x()),
          6.283185307179586));
      ASSERT_LT(turned, 0.15 * std::fabs(kink)) << kink << " at " << d;
    }
  }
}

// A line that folds back on itself ends the road.
TEST(ChainsOfLines, EndWhereTheyFold) {
  const Import import = MadeOf(Element(0, 0, 0, 0, 60, "<line/>") + Element(60, 60, 0, 1.4, 40, "<line/>"), 100.0);
  EXPECT_THAT(NamesOf(import), ElementsAre("road.ended"));
  EXPECT_EQ(AxisOf(import).length_m(), 60.0);
}

// A curve that begins elsewhere than its element, farther than can be surveyed, is read as a line; a network that
// reached so far could not be indexed.
TEST(Curves, BeginWhereTheirElementsDo) {
  for (const char* far : {"aU=\"1e15\" aV=\"0\"", "aU=\"0\" aV=\"-3e14\""}) {
    const Import import = MadeOf(Element(0, 5, 6, 0, 40,
                                         std::string("<paramPoly3 pRange=\"normalized\" ") + far +
                                             " bU=\"40\" cU=\"0\" dU=\"0\" bV=\"0\" cV=\"0\" dV=\"0\"/>"),
                                 40.0);
    EXPECT_THAT(NamesOf(import), ElementsAre("geometry.read_as_line"));
    EXPECT_NEAR(AxisOf(import).Evaluate(40.0).p_W.x(), 45.0, 1e-9);
  }
}

TEST(LengthsOfRoads, AreThoseOfTheirElements) {
  const std::string two = Element(0, 0, 0, 0, 40, "<line/>") + Element(40, 40, 0, 0, 25, "<arc curvature=\"0.01\"/>");
  for (const double said_m : {64.0, 66.0, 10.0, 4000.0, 0.0, -65.0}) {
    const Import import = MadeOf(two, said_m);
    ASSERT_NE(import.network, nullptr) << said_m;
    EXPECT_THAT(NamesOf(import), ElementsAre("road.length_set")) << said_m;
    EXPECT_EQ(import.network->roads()[0].length_m(), 65.0) << said_m;
    EXPECT_TRUE(MustImport(import.repaired_text).repaired_text.empty());
  }
  // Up to 5 cm are no repair.
  EXPECT_THAT(NamesOf(MadeOf(two, 65.03)), IsEmpty());
}

TEST(LengthsOfElements, OfNothingArePassedOver) {
  const std::string none = Element(0, 0, 0, 0, 0, "<line/>"),
                    middle = Element(40, 40, 0, 0, 0, "<arc curvature=\"1\"/>"),
                    last = Element(90, 90, 0, 0, 0, "<spiral curvStart=\"0\" curvEnd=\"1\"/>");
  const std::string a = Element(0, 0, 0, 0, 40, "<line/>"), b = Element(40, 40, 0, 0, 50, "<line/>");
  for (const std::string& geometry : {none + a + b, a + middle + b, a + b + last, none + a + middle + b + last}) {
    const Import import = MadeOf(geometry, 90.0);
    EXPECT_EQ(AxisOf(import).length_m(), 90.0);
    EXPECT_NEAR(AxisOf(import).Evaluate(70.0).p_W.x(), 70.0, 1e-12);
    EXPECT_THAT(NamesOf(import), IsEmpty());
  }
  // Each is told, once a kind; strictly too.
  RoadText road;
  road.geometry = a + middle + middle + b, road.length = 90.0;
  for (const Tolerance& tolerance : {Tolerance::Usual(), Tolerance::Strict()}) {
    const Import import = MustImport(Document(road.Text()), tolerance);
    ASSERT_EQ(OneEachKind(import.warnings).size(), 1u);
    EXPECT_EQ(OneEachKind(import.warnings).front().Text(),
              "road.geometry.length: road 1, s 40: an element has no length: it is passed over (2 of this kind)");
  }
  const Import all = MadeOf(none + none, 0.15);
  EXPECT_THAT(NamesOf(all), ElementsAre("geometry.read_as_line"));
  EXPECT_NEAR(AxisOf(all).Evaluate(0.15).p_W.x(), 0.15, 1e-12);
  // Below nothing.
  const Import below = MadeOf(a + Element(40, 40, 0, 0, -3, "<line/>") + b, 90.0);
  EXPECT_THAT(NamesOf(below), ElementsAre("geometry.dropped"));
  EXPECT_EQ(AxisOf(below).length_m(), 90.0);
}

// Elements that hang together but count s wrongly: they are counted anew, and the road is as long as they are.
TEST(StationsOfElements, AreCountedAnew) {
  const auto with = [](double second_s, double third_s) {
    return MadeOf(Element(0, 0, 0, 0, 40, "<line/>") + Element(second_s, 40, 0, 0, 20, "<line/>") +
                      Element(third_s, 60, 0, 0, 30, "<line/>"),
                  90.0);
  };
  for (const auto& [second_s, third_s] : {std::pair(45.0, 65.0), std::pair(35.0, 55.0), std::pair(40.0, 61.5)}) {
    const Import import = with(second_s, third_s);
    EXPECT_THAT(NamesOf(import), ElementsAre("element.station_moved"));
    EXPECT_EQ(AxisOf(import).length_m(), 90.0);
    EXPECT_NEAR(AxisOf(import).Evaluate(75.0).p_W.x(), 75.0, 1e-9);
  }
  const Import first = MadeOf(Element(12, 0, 0, 0, 40, "<line/>"), 40.0);
  EXPECT_THAT(NamesOf(first), Contains("element.station_moved"));
  EXPECT_EQ(AxisOf(first).length_m(), 40.0);
}

}  // namespace
}  // namespace rodeira::opendrive
