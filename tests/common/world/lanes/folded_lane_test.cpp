// SPDX-License-Identifier: Apache-2.0
// A lane's middle on the inner side of a bend that is tighter than the lane is far from the road's line: there the
// middle of the drawn lane goes back. Its traffic goes on all the same, and d is the way that it goes.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "common/core/geometry/plane.hpp"
#include "common/world/lanes/graph.hpp"
#include "tests/common/world/opendrive/sample.hpp"

namespace rodeira::lanes {
namespace {

// A road of one lane to the right of its line, which goes through these elements: length (m) and curvature (1/m), or a
// kink (rad) before a straight element.
struct Element {
  double length_m, curvature_1pm = 0.0, kink_rad = 0.0;
};

std::shared_ptr<const network::Network> RoadOf(const std::vector<Element>& elements, double inner_m, double width_m) {
  opendrive::RoadText road;
  road.length = 0.0, road.geometry = "", road.left = "";
  double x = 0.0, y = 0.0, heading = 0.0;
  for (const Element& element : elements) {
    heading += element.kink_rad;
    const std::string shape =
        element.curvature_1pm == 0.0 ? "<line/>" : fmt::format("<arc curvature=\"{}\"/>", element.curvature_1pm);
    road.geometry +=
        fmt::format("<geometry s=\"{}\" x=\"{:.12f}\" y=\"{:.12f}\" hdg=\"{:.15f}\" length=\"{}\">{}</geometry>",
                    road.length, x, y, heading, element.length_m, shape);
    const double turns = element.length_m * element.curvature_1pm, chord = heading + 0.5 * turns,
                 length = turns == 0.0 ? element.length_m : 2.0 * std::sin(0.5 * turns) / element.curvature_1pm;
    x += length * std::cos(chord), y += length * std::sin(chord), heading += turns;
    road.length += element.length_m;
  }
  const auto lane = [](int id, const char* type, double width) {
    return fmt::format("<lane id=\"{}\" type=\"{}\"><width sOffset=\"0\" a=\"{}\" b=\"0\" c=\"0\" d=\"0\"/></lane>", id,
                       type, width);
  };
  road.right = lane(-1, "none", inner_m) + lane(-2, "driving", width_m);
  return opendrive::MustRead(opendrive::Document(road.Text()));
}

void ExpectGoesOn(const network::Network& network, double least_m, double most_m) {
  const Graph graph(network);
  ASSERT_EQ(graph.tracks().size(), 1u);
  const Curve& curve = graph[0].curve;
  constexpr double kStep_m = 0.02;
  Eigen::Vector2d last = curve.At(0.0).p_W.head<2>();
  for (double d = kStep_m; d < curve.length_m(); d += kStep_m) {
    const CurvePoint at = curve.At(d);
    const Eigen::Vector2d gone = at.p_W.head<2>() - last;
    EXPECT_GT(gone.dot(at.ahead_W), 0.9 * kStep_m) << d;
    EXPECT_LT(gone.norm(), 1.1 * kStep_m) << d;
    last = at.p_W.head<2>();
  }
  EXPECT_GT(curve.length_m(), least_m);
  EXPECT_LT(curve.length_m(), most_m);
  // Both ends are the drawn lane's, and look as the road does.
  const network::Road& road = network.roads()[0];
  for (const double s : {0.0, road.spec().length_m}) {
    const CurvePoint at = curve.At(s == 0.0 ? 0.0 : curve.length_m());
    EXPECT_LT((at.p_W - network.Centre(graph[0].lane, s)).norm(), 1e-6) << s;
    const Eigen::Vector3d across = road.Surface(s, 0.0).dt_W;
    EXPECT_NEAR(geometry::Cross(at.ahead_W, across.head<2>()), 1.0, 1e-6) << s;
  }
}

TEST(FoldedLane, GoesOnThroughABendThatIsTighterThanItIsFarFromTheLine) {
  // 90° with a radius of 2 m; the middle is 4 m to the right. Its straight parts would cross 2 m before their ends.
  const auto network = RoadOf({{20.0}, {M_PI, -0.5}, {20.0}}, 2.0, 4.0);
  ExpectGoesOn(*network, 30.0, 40.0);
}

TEST(FoldedLane, GoesOnToTheEndOfARoadThatEndsInTheBend) {
  ExpectGoesOn(*RoadOf({{10.0}, {1.2, -0.6}}, 0.5, 4.0), 9.0, 11.5);
}

TEST(FoldedLane, GoesOnThroughTheKinksOfAChainOfLines) {
  // Seven kinks of 0.22 rad, 2.4 m apart; the middle is 5 m to the right: 5 · 7 · 0.22 m are lost on the inner side.
  std::vector<Element> lines{{20.0}};
  for (int i = 0; i < 7; ++i) lines.push_back({2.4, 0.0, -0.22});
  lines.push_back({20.0});
  const double drawn_m = 40.0 + 7 * 2.4;
  ExpectGoesOn(*RoadOf(lines, 3.0, 4.0), drawn_m - 7.7 - 1.0, drawn_m - 7.7 + 1.0);
}

}  // namespace
}  // namespace rodeira::lanes
