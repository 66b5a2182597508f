// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/world/road/network_world.hpp"
#include "common/world/road/plot_labels.hpp"

namespace rodeira::road {
namespace {

using network::LaneKey;
using network::LaneType;
using network::Network;

constexpr double kNetworkPlotSize = 1400.0;  // the longer edge, in SVG units
constexpr double kMargin_m = 15.0;
constexpr double kChord_m = 0.05;  // how far an edge's chord may stand off

const char* Colour(LaneType type, bool in_junction) {
  if (network::IsDrivable(type)) return in_junction ? "#5d6068" : "#43464d";
  switch (type) {
    case LaneType::kNone:
    case LaneType::kMedian:
      return "#8fae78";
    case LaneType::kSidewalk:
    case LaneType::kWalking:
      return "#c9c2b6";
    case LaneType::kCurb:
      return "#a39c90";
    case LaneType::kBiking:
      return "#b0675a";
    case LaneType::kParking:
      return "#5a6a80";
    default:
      return "#777b82";
  }
}

struct PlotFrame {
  double west, north, scale;
  std::string Point(const Eigen::Vector3d& p, bool first) const {
    return fmt::format("{}{:.2f} {:.2f}", first ? "M" : "L", (p.x() - west) * scale, (north - p.y()) * scale);
  }
};

// Stations of a lane section, close enough for its bends.
std::vector<double> SectionStations(const network::Road& road, const network::LaneSection& section, double scale) {
  std::vector<double> stations{section.s_m};
  while (stations.back() < section.end_s_m) {
    const double s = stations.back();
    const double k = std::fabs(road.axis().Evaluate(s).curvature_1pm);
    const double step = std::clamp(std::sqrt(8.0 * std::max(kChord_m, 0.3 / scale) / std::max(k, 1e-6)), 0.5, 5.0);
    stations.push_back(std::min(s + step, section.end_s_m));
    if (stations.size() > 100'000) break;
  }
  return stations;
}

std::string Edge(const Network& network, const LaneKey& key, const std::vector<double>& stations,
                 const PlotFrame& frame, bool outer, bool back, bool first) {
  std::string path;
  const network::Road& road = network.roads()[key.road];
  for (std::size_t i = 0; i < stations.size(); ++i) {
    const double s = road.Held(key.section, stations[back ? stations.size() - 1 - i : i]);
    const auto span = network.Span(key, s);
    path += frame.Point(road.Surface(s, outer ? span->outer_t_m : span->inner_t_m, network.Section(key), *span).p_W,
                        first && i == 0);
  }
  return path;
}

// A line on the lane's outer edge, and for the first lanes on the centre too.
std::string Line(const network::RoadMark* mark, const std::string& path, double scale) {
  if (mark == nullptr || mark->type == "none" || mark->type == "curb" || mark->type == "grass" || mark->type == "edge")
    return "";
  const bool broken = mark->type.starts_with("broken");
  const char* colour = mark->colour == "yellow" ? "#e6c14d" : "#f4f4f0";
  const double stroke = mark->lines.empty() ? 3.0 : mark->lines[0].length_m,
               gap = mark->lines.empty() ? 6.0 : mark->lines[0].space_m;
  const std::string dashes =
      broken && gap > 0.0 ? fmt::format(" stroke-dasharray=\"{:.2f} {:.2f}\"", stroke * scale, gap * scale) : "";
  return fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{:.2f}\"{}/>\n", path, colour,
                     std::max(0.35, 0.15 * scale), dashes);
}

// Each road's own stations and the radii of its arcs, where there is room: a dot and how far it is from the road's
// beginning.
std::string StationsAndRadii(const Network& network, const PlotFrame& frame, PlotLabels& labels) {
  constexpr double kDot = 2.0;
  double step_m = 50.0;
  while (step_m * frame.scale < 60.0) step_m *= 2.0;
  std::string dots;
  const auto on_picture = [&](const network::Road& road, double s_m) {
    const Eigen::Vector3d p = road.Surface(s_m, 0.0).p_W;
    return Eigen::Vector2d((p.x() - frame.west) * frame.scale, (frame.north - p.y()) * frame.scale);
  };
  // Beside the road, where they are read; on it where there is no other room.
  const auto half_width = [&](const network::Road& road, double s_m) {
    double right, left;
    road.SectionAt(s_m).Bounds(road.spec().lane_offset, s_m, s_m, right, left);
    return std::max(std::fabs(right), std::fabs(left)) * frame.scale;
  };
  for (const network::Road& road : network.roads()) {
    for (double s = 0.0; s < road.length_m();) {
      const double half = std::max(1.0, half_width(road, s));
      labels.Avoid(on_picture(road, s), half);
      s += half / frame.scale;
    }
  }
  for (const network::Road& road : network.roads()) {
    if (!road.spec().junction.empty()) continue;
    for (double s = step_m; s < road.length_m(); s += step_m) {
      const Eigen::Vector2d at = on_picture(road, s);
      const PlotLabels before = labels;
      if (!labels.Keep(at - Eigen::Vector2d::Constant(kDot), Eigen::Vector2d::Constant(2.0 * kDot)) ||
          !labels.Put(at, half_width(road, s) + 3.0, 8.0, "#101010", fmt::format("{:.0f} m", s))) {
        labels = before;
        continue;
      }
      dots += fmt::format(
          "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\" fill=\"#ffffff\" stroke=\"#303038\" stroke-width=\"0.6\"/>\n",
          at.x(), at.y(), kDot);
    }
    for (const geometry::PlanElement& element : road.axis().elements()) {
      const double k = element.curvature_start_1pm;
      if (element.kind != geometry::PlanElement::Kind::kClothoid || k == 0.0 || k != element.curvature_end_1pm ||
          element.length_m * frame.scale < 15.0)
        continue;
      const double middle_m = std::min(element.s_m + 0.5 * element.length_m, road.length_m());
      labels.Put(on_picture(road, middle_m), half_width(road, middle_m) + 3.0, 8.0, "#203060",
                 fmt::format("R{:.0f}", 1.0 / std::fabs(k)));
    }
  }
  return dots;
}

}  // namespace

std::string PlotNetwork(const Network& network) {
  auto [low, high] = network.Bounds();
  low.array() -= kMargin_m;
  high.array() += kMargin_m;
  const Eigen::Vector2d size = high - low;
  const PlotFrame frame{low.x(), high.y(), kNetworkPlotSize / size.maxCoeff()};
  std::string areas, ways, lines;
  for (const LaneKey& key : network.Lanes()) {
    const network::Road& road = network.roads()[key.road];
    const network::LaneSection& section = network.Section(key);
    const network::Lane& lane = *network.Find(key);
    const auto stations = SectionStations(road, section, frame.scale);
    const bool in_junction = !road.spec().junction.empty();
    const std::string outer = Edge(network, key, stations, frame, true, false, true);
    const char* colour = Colour(lane.type, in_junction);
    const std::string area = fmt::format("<path d=\"{}{}Z\" fill=\"{}\" stroke=\"{}\" stroke-width=\"0.2\"/>\n", outer,
                                         Edge(network, key, stations, frame, false, true, false), colour, colour);
    (network::IsDrivable(lane.type) ? ways : areas) += area;
    lines += Line(road.MarkAt(lane, section.s_m), outer, frame.scale);
    if (key.lane == 1 || (key.lane == -1 && section.left.empty())) {
      lines += Line(road.MarkAt(section.centre, section.s_m), Edge(network, key, stations, frame, false, false, true),
                    frame.scale);
    }
  }
  const double height = size.y() * frame.scale;
  PlotLabels names(size.x() * frame.scale, height);
  for (const network::Road& road : network.roads()) {
    if (!road.spec().junction.empty() || road.length_m() * frame.scale < 25.0) continue;
    for (const double part : {0.5, 0.25, 0.75}) {
      const Eigen::Vector3d p = road.Surface(part * road.length_m(), 0.0).p_W;
      if (names.Put({(p.x() - frame.west) * frame.scale, (frame.north - p.y()) * frame.scale}, 1.0, 9.0, "#b03020",
                    fmt::format("{:.12}", road.id())))
        break;
    }
  }
  const std::string dots = StationsAndRadii(network, frame, names);
  const double bar = std::pow(10.0, std::floor(std::log10(0.3 * size.x())));
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} {1:.0f}\" width=\"{0:.0f}\" "
      "height=\"{1:.0f}\">\n",
      size.x() * frame.scale, height + 30.0);
  svg += "<rect width=\"100%\" height=\"100%\" fill=\"#eef0ea\"/>\n" + areas + ways + lines + dots + names.svg();
  svg += fmt::format(
      "<path d=\"M12 {0:.1f}h{1:.1f}\" stroke=\"#202020\" stroke-width=\"2\"/><text x=\"{2:.1f}\" y=\"{3:.1f}\" "
      "font-family=\"sans-serif\" font-size=\"12\">{4:g} m, {5} roads, {6} junctions</text>\n",
      height + 15.0, bar * frame.scale, 18.0 + bar * frame.scale, height + 19.0, bar, network.roads().size(),
      network.junctions().size());
  return svg + "</svg>\n";
}

}  // namespace rodeira::road
