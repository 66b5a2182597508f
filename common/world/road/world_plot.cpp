// SPDX-License-Identifier: Apache-2.0
#include "common/world/road/world_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "common/core/geometry/angle.hpp"
#include "common/world/road/network_world.hpp"
#include "common/world/road/plot_labels.hpp"
#include "common/world/road/road_chains.hpp"

namespace rodeira::road {
namespace {

constexpr double kWorldPlotSize = 1000.0;  // the longer edge, in SVG units
constexpr int kTiles = 160;                // shaded squares and contour cells along that edge

// Heights seen through a raster of points, and the way from world to picture.
struct View {
  Extents extents;
  double scale;
  int columns, rows;
  std::vector<double> heights;  // NaN outside
  double low, high;

  double X(double x_m) const { return (x_m - extents.west_m) * scale; }
  double Y(double y_m) const { return (extents.north_m - y_m) * scale; }
  Eigen::Vector2d At(int column, int row) const {
    return {extents.west_m + (extents.east_m - extents.west_m) * column / columns,
            extents.south_m + (extents.north_m - extents.south_m) * row / rows};
  }
  double Height(int column, int row) const {
    return heights[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns + 1) +
                   static_cast<std::size_t>(column)];
  }
};

// A plane has no edge: the picture then shows the roads, or 100 m about the start.
Extents PlotExtents(const World& world) {
  Extents extents = world.extents();
  if (world.grid() != nullptr) return extents;
  extents = {world.start().x_m - 100.0, world.start().y_m - 100.0, world.start().x_m + 100.0,
             world.start().y_m + 100.0};
  if (world.network() != nullptr && !world.network()->roads().empty()) {
    const auto [low, high] = world.network()->Bounds();
    extents.west_m = std::min(extents.west_m, low.x() - 50.0);
    extents.south_m = std::min(extents.south_m, low.y() - 50.0);
    extents.east_m = std::max(extents.east_m, high.x() + 50.0);
    extents.north_m = std::max(extents.north_m, high.y() + 50.0);
  }
  if (world.props() != nullptr) {
    const auto hold = [&](const Eigen::Vector2d& p) {
      extents.west_m = std::min(extents.west_m, p.x() - 50.0), extents.east_m = std::max(extents.east_m, p.x() + 50.0);
      extents.south_m = std::min(extents.south_m, p.y() - 50.0),
      extents.north_m = std::max(extents.north_m, p.y() + 50.0);
    };
    for (const auto& thing : world.props()->placements) hold(thing.at_W);
    for (const auto& run : world.props()->runs) std::for_each(run.points_W.begin(), run.points_W.end(), hold);
  }
  return extents;
}

View FitView(const World& world) {
  View view{PlotExtents(world),
            0.0,
            0,
            0,
            {},
            std::numeric_limits<double>::infinity(),
            -std::numeric_limits<double>::infinity()};
  const double width = view.extents.east_m - view.extents.west_m, height = view.extents.north_m - view.extents.south_m;
  view.scale = kWorldPlotSize / std::max(width, height);
  view.columns = std::max(1, static_cast<int>(kTiles * width / std::max(width, height)));
  view.rows = std::max(1, static_cast<int>(kTiles * height / std::max(width, height)));
  for (int row = 0; row <= view.rows; ++row) {
    for (int column = 0; column <= view.columns; ++column) {
      const Eigen::Vector2d p = view.At(column, row);
      const SurfacePoint point = world.At(p.x(), p.y());
      view.heights.push_back(point.inside ? point.z_m : std::numeric_limits<double>::quiet_NaN());
      if (!point.inside) continue;
      view.low = std::min(view.low, point.z_m);
      view.high = std::max(view.high, point.z_m);
    }
  }
  return view;
}

// Green valleys, brown hills, pale tops; darker where the slope turns away from a light in the north-west.
std::string Shades(const View& view) {
  std::string svg = "<g shape-rendering=\"crispEdges\">\n";
  const double dx = (view.extents.east_m - view.extents.west_m) / view.columns,
               dy = (view.extents.north_m - view.extents.south_m) / view.rows;
  for (int row = 0; row < view.rows; ++row) {
    for (int column = 0; column < view.columns; ++column) {
      const double z = view.Height(column, row);
      const double slope_x = (view.Height(column + 1, row) - z) / dx, slope_y = (view.Height(column, row + 1) - z) / dy;
      if (std::isnan(slope_x + slope_y)) continue;
      const double light =
          (1.0 + 0.9 * slope_x - 0.9 * slope_y) / (1.6 * std::sqrt(1.0 + slope_x * slope_x + slope_y * slope_y));
      const double shade = 0.35 + 0.65 * std::clamp(light, 0.0, 1.0);
      const double u = view.high > view.low ? (z - view.low) / (view.high - view.low) : 0.5;
      const auto mix = [&](double valley, double hill, double top) {
        const double value = u < 0.5 ? valley + (hill - valley) * 2.0 * u : hill + (top - hill) * (2.0 * u - 1.0);
        return static_cast<int>(std::clamp(value * shade, 0.0, 255.0));
      };
      const Eigen::Vector2d p = view.At(column, row + 1);
      svg += fmt::format(
          "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"#{:02x}{:02x}{:02x}\"/>\n",
          view.X(p.x()), view.Y(p.y()), dx * view.scale + 0.3, dy * view.scale + 0.3, mix(120, 205, 250),
          mix(170, 180, 245), mix(105, 125, 235));
    }
  }
  return svg + "</g>\n";
}

double ContourStep(double range_m) {
  for (const double step : {1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0}) {
    if (range_m / step <= 25.0) return step;
  }
  return 500.0;
}

// Where a level crosses the two triangles of each cell.
std::string Contours(const View& view, double step) {
  std::string path;
  for (int row = 0; row < view.rows; ++row) {
    for (int column = 0; column < view.columns; ++column) {
      for (const int half : {0, 1}) {
        const std::array<std::array<int, 2>, 3> corners = {
            {{column + half, row + half}, {column + 1, row}, {column, row + 1}}};
        std::array<double, 3> z{};
        for (std::size_t i = 0; i < 3; ++i) z[i] = view.Height(corners[i][0], corners[i][1]);
        const auto [low, high] = std::minmax_element(z.begin(), z.end());
        if (std::isnan(z[0] + z[1] + z[2])) continue;
        for (double level = std::ceil(*low / step) * step; level < *high; level += step) {
          bool first = true;
          for (std::size_t i = 0; i < 3; ++i) {
            const std::size_t j = (i + 1) % 3;
            if ((z[i] < level) == (z[j] < level)) continue;
            const double u = (level - z[i]) / (z[j] - z[i]);
            const Eigen::Vector2d p =
                (1.0 - u) * view.At(corners[i][0], corners[i][1]) + u * view.At(corners[j][0], corners[j][1]);
            path += fmt::format("{}{:.1f} {:.1f}", first ? "M" : "L", view.X(p.x()), view.Y(p.y()));
            first = false;
          }
        }
      }
    }
  }
  return path;
}

// A line along a road's part at the middle of its lanes of one kind, as a path.
std::string Along(const network::Road& road, const View& view, bool first) {
  std::string path;
  const int steps = std::max(1, static_cast<int>(std::ceil(road.length_m() / std::max(2.0, 1.5 / view.scale))));
  for (int i = 0; i <= steps; ++i) {
    const Eigen::Vector2d p = road.axis().Evaluate(road.length_m() * i / steps).p_W;
    path += fmt::format("{}{:.2f} {:.2f}", first && i == 0 ? "M" : "L", view.X(p.x()), view.Y(p.y()));
  }
  return path;
}

double PavedWidth(const network::Road& road) {
  double width = 0.0;
  for (const auto* side : {&road.spec().sections[0].left, &road.spec().sections[0].right}) {
    for (const network::Lane& lane : *side) {
      if (lane.type != network::LaneType::kNone)
        width += lane.bordered() ? road.SpanAt(0, lane.id, 0.0)->width_m() : lane.width.Value(0.0);
    }
  }
  return width;
}

// What is written on the plan, the more important first: names, stations along the chains, radii of arcs.
class Writer {
 public:
  Writer(const World& world, const View& view)
      : network_(*world.network()),
        view_(view),
        labels_((view.extents.east_m - view.extents.west_m) * view.scale,
                (view.extents.north_m - view.extents.south_m) * view.scale) {
    for (RoadChain& chain : ChainsOf(network_)) {
      if (chain.length_m * view.scale >= 12.0) chains_.push_back(std::move(chain));
    }
    for (const network::Road& road : network_.roads()) {
      const double half = std::max(1.0, 0.5 * PavedWidth(road) * view.scale), step = std::max(1.0, half / view.scale);
      for (double s = 0.0; s <= road.length_m(); s += step) labels_.Avoid(OnPicture(road.axis().Evaluate(s).p_W), half);
    }
  }

  std::string Write() {
    Names();
    Stations();
    Radii();
    return dots_ + labels_.svg();
  }

 private:
  static constexpr double kDot = 3.0, kBeside = 6.0;

  Eigen::Vector2d OnPicture(const Eigen::Vector2d& p_W) const { return {view_.X(p_W.x()), view_.Y(p_W.y())}; }

  // A dot on the road with words beside it; false where there is no room.
  bool Dot(const RoadChain& chain, double s, std::string_view text) {
    const auto [road, own_s] = chain.At(network_, s);
    const Eigen::Vector2d at = OnPicture(road->axis().Evaluate(own_s).p_W),
                          corner = at - Eigen::Vector2d::Constant(kDot);
    const PlotLabels before = labels_;
    if (!labels_.Keep(corner, Eigen::Vector2d::Constant(2.0 * kDot)) ||
        !labels_.Put(at, kBeside, 12.0, "#000000", text)) {
      labels_ = before;
      return false;
    }
    dots_ += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\" fill=\"#ffffff\" stroke=\"#303038\"/>\n", at.x(),
                         at.y(), kDot);
    return true;
  }

  // At the chain's beginning, or somewhere along it.
  void Names() {
    for (const RoadChain& chain : chains_) {
      for (const double part : {0.0, 1.0, 0.5, 0.25, 0.75}) {
        if (Dot(chain, part * chain.length_m, chain.name)) break;
      }
    }
  }

  void Stations() {
    double step = 100.0;
    while (step * view_.scale < 45.0) step *= step == 200.0 || step == 2000.0 ? 2.5 : 2.0;
    for (const RoadChain& chain : chains_) {
      for (double s = step; s <= chain.length_m; s += step)
        Dot(chain, s, step < 1000.0 ? fmt::format("{:.0f} m", s) : fmt::format("{:g} km", s / 1000.0));
    }
  }

  void Radii() {
    for (const network::Road& road : network_.roads()) {
      if (!road.spec().junction.empty()) continue;
      for (const geometry::PlanElement& element : road.axis().elements()) {
        const double k = element.curvature_start_1pm;
        if (element.kind != geometry::PlanElement::Kind::kClothoid || k == 0.0 || k != element.curvature_end_1pm)
          continue;
        const geometry::PlanPoint at = road.axis().Evaluate(element.s_m + 0.5 * element.length_m);
        labels_.Put(OnPicture(at.p_W), 0.5 * PavedWidth(road) * view_.scale + 3.0, 9.0, "#203060",
                    fmt::format("R{:.0f}", 1.0 / std::fabs(k)));
      }
    }
  }

  const network::Network& network_;
  const View& view_;
  PlotLabels labels_;
  std::vector<RoadChain> chains_;
  std::string dots_;
};

std::string Roads(const World& world, const View& view) {
  if (world.network() == nullptr) return "";
  std::string under, over;
  for (const network::Road& road : world.network()->roads()) {
    if (!road.spec().junction.empty() && road.spec().sections[0].left.empty()) continue;  // ways that turn
    const std::string path = Along(road, view, true);
    const double width = std::max(2.0, PavedWidth(road) * view.scale);
    under +=
        fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"#ffffff\" stroke-width=\"{:.1f}\"/>\n", path, width + 2.0);
    over += fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"#303038\" stroke-width=\"{:.1f}\"/>\n", path, width);
  }
  for (const network::Junction& junction : world.network()->junctions()) {
    std::string path;
    for (const Eigen::Vector2d& p : junction.paved_W)
      path += fmt::format("{}{:.2f} {:.2f}", path.empty() ? "M" : "L", view.X(p.x()), view.Y(p.y()));
    if (!path.empty()) over += fmt::format("<path d=\"{}Z\" fill=\"#303038\"/>\n", path);
  }
  return under + over + Writer(world, view).Write();
}

// What stands at no road: trees and bushes as wide as they are, other things as they lie, walls and rails as lines.
std::string StaticObjectsSvg(const World& world, const View& view) {
  if (world.props() == nullptr) return "";
  std::string svg;
  for (const network::Props::Placement& thing : world.props()->placements) {
    const network::Object& object = world.props()->objects[thing.object];
    const double x = view.X(thing.at_W.x()), y = view.Y(thing.at_W.y());
    if (object.radius_m > 0.0) {
      svg += fmt::format("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"{:.2f}\" fill=\"#4c7a3a\"/>\n", x, y,
                         std::max(1.0, object.radius_m * view.scale));
      continue;
    }
    const double length = std::max(2.0, object.length_m * view.scale),
                 width = std::max(2.0, object.width_m * view.scale);
    svg += fmt::format(
        "<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" fill=\"#7a6a5a\" "
        "transform=\"translate({:.2f} {:.2f}) rotate({:.1f})\"/>\n",
        -0.5 * length, -0.5 * width, length, width, x, y, -thing.heading_rad * 180.0 / geometry::kPi);
  }
  for (const network::Props::Run& run : world.props()->runs) {
    std::string path;
    for (const Eigen::Vector2d& p : run.points_W)
      path += fmt::format("{}{:.2f} {:.2f}", path.empty() ? "M" : "L", view.X(p.x()), view.Y(p.y()));
    svg += fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"#7a6a5a\" stroke-width=\"{:.1f}\"/>\n", path,
                       std::max(1.0, world.props()->objects[run.object].width_m * view.scale));
  }
  return svg;
}

}  // namespace

std::string PlotWorld(const World& world) {
  if (world.open_drive()) return PlotNetwork(*world.network());
  const View view = FitView(world);
  const double width = (view.extents.east_m - view.extents.west_m) * view.scale;
  const double height = (view.extents.north_m - view.extents.south_m) * view.scale;
  const double step = ContourStep(view.high - view.low);
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} {1:.0f}\" width=\"{0:.0f}\" "
      "height=\"{1:.0f}\">\n",
      width, height + 24.0);
  svg += "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n" + Shades(view);
  svg += fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"#5a4630\" stroke-opacity=\"0.45\" stroke-width=\"0.6\"/>\n",
                     Contours(view, step));
  svg += StaticObjectsSvg(world, view) + Roads(world, view);
  const double sx = view.X(world.start().x_m), sy = view.Y(world.start().y_m);
  svg += fmt::format(
      "<path d=\"M0 0L-11 5L-11 -5Z\" fill=\"#c02020\" transform=\"translate({:.1f} {:.1f}) rotate({:.1f})\"/>\n", sx,
      sy, -world.start().heading_rad * 180.0 / geometry::kPi);
  svg += fmt::format(
      "<text x=\"4\" y=\"{:.0f}\" font-family=\"sans-serif\" font-size=\"14\">{:.0f} m wide, heights {:.1f} to {:.1f} "
      "m, contours every {:.0f} m</text>\n",
      height + 17.0, view.extents.east_m - view.extents.west_m, view.low, view.high, step);
  return svg + "</svg>\n";
}

}  // namespace rodeira::road
