// SPDX-License-Identifier: Apache-2.0
#include "common/world/road/world_profile.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <vector>

#include "common/world/road/road_chains.hpp"

namespace rodeira::road {
namespace {

constexpr double kWidth = 1000.0, kHeight = 120.0, kGap = 34.0, kLeft = 70.0, kTop = 50.0;  // SVG units
constexpr int kPoints = 1500;
constexpr int kDiagrams = 4;
constexpr std::size_t kMaxRoads = 40;

// Values along a road; NaN where there is none.
struct Curve {
  std::string_view colour;
  std::vector<double> values;
};

std::string Number(double value) { return fmt::format("{:.4g}", value + 0.0); }

std::string EscapedName(std::string_view text) {
  std::string out;
  for (const char c : text) out += c == '<' ? "&lt;" : c == '&' ? "&amp;" : std::string(1, c);
  return out;
}

// One diagram: its curves between the least and the greatest value, zero drawn where it lies within.
std::string Diagram(double top, std::string_view title, const std::vector<Curve>& curves) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Curve& curve : curves) {
    for (const double value : curve.values) {
      if (std::isnan(value)) continue;
      low = std::min(low, value);
      high = std::max(high, value);
    }
  }
  if (!(high - low > 1e-9)) low -= 0.5, high += 0.5;
  const auto y = [&](double value) { return top + kHeight * (0.95 - 0.9 * (value - low) / (high - low)); };
  std::string svg = fmt::format("<text x='{}' y='{}'>{}</text>\n", kLeft, top - 5.0, title);
  svg += fmt::format("<rect x='{}' y='{}' width='{}' height='{}' fill='none' stroke='#999'/>\n", kLeft, top, kWidth,
                     kHeight);
  for (const double value : {low, high}) {
    svg += fmt::format("<text x='{}' y='{:.1f}' text-anchor='end'>{}</text>\n", kLeft - 5.0, y(value) + 4.0,
                       Number(value));
  }
  if (low < 0.0 && high > 0.0) {
    svg += fmt::format("<path d='M{} {:.1f}h{}' stroke='#ccc'/>\n", kLeft, y(0.0), kWidth);
  }
  for (const Curve& curve : curves) {
    std::string path;
    bool drawing = false;
    for (std::size_t i = 0; i < curve.values.size(); ++i) {
      const double value = curve.values[i];
      if (!std::isnan(value)) {
        const double x = kLeft + kWidth * static_cast<double>(i) / static_cast<double>(curve.values.size() - 1);
        path += fmt::format("{}{:.1f} {:.1f}", drawing ? "L" : "M", x, y(value));
      }
      drawing = !std::isnan(value);
    }
    svg += fmt::format("<path d='{}' fill='none' stroke='{}'/>\n", path, curve.colour);
  }
  return svg;
}

// The radii of the arcs, over their middles; those of short arcs on a long road would hide one another.
std::string Radii(const network::Network& network, const RoadChain& chain, double top) {
  std::string svg;
  double free_from = 0.0;
  for (const RoadChain::Part& part : chain.parts) {
    for (const geometry::PlanElement& element : network.roads()[part.road].axis().elements()) {
      const double k = element.curvature_start_1pm;
      const double middle = kLeft + kWidth * (part.from_s_m + element.s_m + 0.5 * element.length_m) / chain.length_m;
      if (element.kind != geometry::PlanElement::Kind::kClothoid || k == 0.0 || k != element.curvature_end_1pm ||
          middle < free_from)
        continue;
      free_from = middle + 26.0;
      const double y = k < 0.0 ? top + 10.0 : top + kHeight - 3.0;  // where the curve is not
      svg += fmt::format("<text x='{:.1f}' y='{:.1f}' font-size='9' text-anchor='middle' fill='#555'>{:.0f}</text>\n",
                         middle, y, 1.0 / std::fabs(k));
    }
  }
  return svg;
}

// The slope across beside the axis, rising to the left positive.
double CrossSlope_percent(const network::Road& road, double s_m, double aside_m) {
  const network::SurfaceSample sample = road.Surface(s_m, road.CentreAt(s_m).value + aside_m);
  return 100.0 * sample.dt_W.z() / sample.dt_W.head<2>().norm();
}

std::string Profile(const World& world, const RoadChain& chain, double top) {
  const network::Network& network = *world.network();
  Curve axis{"#c02020", {}}, terrain{"#2a8b3f", {}}, grade{"#1f5f8b", {}}, curvature{"#1f5f8b", {}};
  Curve left{"#1f5f8b", {}}, right{"#c02020", {}};
  for (int i = 0; i <= kPoints; ++i) {
    const auto [road, s] = chain.At(network, chain.length_m * i / kPoints);
    const geometry::PlanPoint at = road->axis().Evaluate(s);
    const geometry::CubicPoint z = road->spec().elevation.Evaluate(s);
    const SurfacePoint ground = world.TerrainAt(at.p_W.x(), at.p_W.y());
    axis.values.push_back(z.value);
    terrain.values.push_back(ground.inside ? ground.z_m : std::numeric_limits<double>::quiet_NaN());
    grade.values.push_back(100.0 * z.slope);
    curvature.values.push_back(at.curvature_1pm);
    left.values.push_back(CrossSlope_percent(*road, s, 1.0));
    right.values.push_back(CrossSlope_percent(*road, s, -1.0));
  }
  const auto place = [top](int k) { return top + 20.0 + k * (kHeight + kGap); };
  std::string svg = fmt::format("<text x='{}' y='{}' font-size='14'>road {}, {:.1f} m</text>\n", kLeft, top,
                                EscapedName(chain.name), chain.length_m);
  svg += Diagram(place(0), "height in m: axis (red), terrain under it (green)", {axis, terrain});
  svg += Diagram(place(1), "grade in %, uphill positive", {grade});
  svg += Diagram(place(2), "curvature in 1/m, to the left positive; radii of arcs in m", {curvature}) +
         Radii(network, chain, place(2));
  svg += Diagram(
      place(3),
      "slope across in %, rising to the left positive: left of the axis (blue), right of it (red); equal: one slope",
      {left, right});
  for (int i = 0; i <= 10; ++i) {
    svg += fmt::format("<text x='{}' y='{}' text-anchor='middle'>{:.0f} m</text>\n", kLeft + kWidth * i / 10.0,
                       place(kDiagrams - 1) + kHeight + 14.0, chain.length_m * i / 10.0);
  }
  return svg;
}

}  // namespace

std::string PlotProfiles(const World& world) {
  if (world.network() == nullptr || world.network()->roads().empty()) return {};
  std::vector<RoadChain> chains = ChainsOf(*world.network());
  std::stable_sort(chains.begin(), chains.end(),
                   [](const RoadChain& a, const RoadChain& b) { return a.length_m > b.length_m; });
  chains.resize(std::min(chains.size(), kMaxRoads));
  const double a_road = 40.0 + kDiagrams * (kHeight + kGap);
  std::string svg = fmt::format(
      "<svg xmlns='http://www.w3.org/2000/svg' width='{0:.0f}' height='{1:.0f}' viewBox='0 0 {0:.0f} {1:.0f}' "
      "font-family='sans-serif' font-size='11'>\n<rect width='100%' height='100%' fill='white'/>\n",
      kLeft + kWidth + 40.0, kTop + a_road * static_cast<double>(chains.size()));
  double top = 0.5 * kTop;
  for (const RoadChain& chain : chains) {
    svg += Profile(world, chain, top);
    top += a_road;
  }
  return svg + "</svg>\n";
}

}  // namespace rodeira::road
