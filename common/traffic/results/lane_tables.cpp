// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/results/lane_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "common/core/base/append_format.hpp"
#include "common/core/base/csv_cell.hpp"
#include "common/core/base/xml_text.hpp"
#include "common/traffic/motion/drivetrain.hpp"
#include "common/traffic/network/graph_bounds.hpp"
#include "common/traffic/results/names.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kMapWidth_px = 1000.0, kRim_px = 20.0, kMapTop_px = 40.0, kLane_m = 3.0;
constexpr int kSpeedShades = 20;

// From red over yellow to green.
std::string ShadeOf(int shade) {
  const double u = static_cast<double>(shade) / (kSpeedShades - 1);
  const int red = static_cast<int>(std::lround(u < 0.5 ? 205.0 : 205.0 - 350.0 * (u - 0.5))),
            green = static_cast<int>(std::lround(u < 0.5 ? 340.0 * u : 170.0));
  return fmt::format("#{:02x}{:02x}28", red, green);
}

const std::string& RoadOf(const lanes::Graph& graph, std::uint32_t track) {
  return graph.network().roads()[graph[track].lane.road].id();
}

std::string RoadCell(const lanes::Graph& graph, std::uint32_t track) { return base::CsvCell(RoadOf(graph, track)); }

}  // namespace

std::string LaneTable(const lanes::Graph& graph, const LaneStatistics& statistics) {
  std::string table = "road,lane,s_m,x_m,y_m,length_m,flow_vehph,density_vehpkm,speed_mps,fuel_mlpkm,free_mps\n";
  const double watched = statistics.watched_s();
  if (!(watched > 0.0)) return table;
  for (std::uint32_t track = 0; track < graph.tracks().size(); ++track) {
    const lanes::Track& lane = graph[track];
    const double length = statistics.CellLength_m(track);
    for (std::size_t i = 0; i < statistics.CellsOf(track).size(); ++i) {
      const LaneCell& cell = statistics.CellsOf(track)[i];
      const double d = (static_cast<double>(i) + 0.5) * length;
      const lanes::CurvePoint at = lane.curve.At(d);
      base::AppendFormat(
          table, "{},{},{:.2f},{:.2f},{:.2f},{:.4f},{:.3f},{:.3f},{},{},{:.3f}\n", RoadCell(graph, track),
          lane.lane.lane, lane.curve.StationAt(d), at.p_W.x(), at.p_W.y(), length,
          3600.0 * cell.Flow_vehps(length, watched), 1000.0 * cell.Density_vehpm(length, watched),
          cell.time_s > 0.0 ? fmt::format("{:.3f}", cell.Speed_mps()) : "",
          cell.distance_m > 0.0 ? fmt::format("{:.2f}", 1e6 * cell.fuel_mg / kFuelDensity_mgpl / cell.distance_m) : "",
          statistics.FreeSpeed_mps(track, i));
    }
  }
  return table;
}

std::string QueueTable(const lanes::Graph& graph, const LaneStatistics& statistics) {
  std::string table = "road,lane,length_m,queue_longest,queue_mean\n";
  for (std::uint32_t track = 0; track < graph.tracks().size(); ++track) {
    const lanes::Track& lane = graph[track];
    base::AppendFormat(table, "{},{},{:.2f},{},{:.4f}\n", RoadCell(graph, track), lane.lane.lane, lane.length_m(),
                       statistics.LongestQueue(track), statistics.MeanQueue(track));
  }
  return table;
}

std::string FlowTable(const lanes::Graph& graph, const LaneStatistics& statistics) {
  std::string table = "road,section,lane,began,in,out,there\n";
  for (std::uint32_t track = 0; track < graph.tracks().size(); ++track) {
    const network::LaneKey& lane = graph[track].lane;
    const LaneCount& count = statistics.CountOf(track);
    base::AppendFormat(table, "{},{},{},{},{},{},{}\n", RoadCell(graph, track), lane.section, lane.lane, count.began,
                       count.in, count.out, count.there());
  }
  return table;
}

std::string IntervalTable(const lanes::Graph& graph, const LaneIntervals& intervals) {
  std::string table =
      "from_s,to_s,road,section,lane,in,out,flow_vehph,density_vehpkm,speed_mps,queue_longest,queue_mean\n";
  for (const LaneIntervals::Interval& interval : intervals.all()) {
    const double watched = interval.to_s - interval.from_s;
    for (std::uint32_t track = 0; track < graph.tracks().size(); ++track) {
      const LaneIntervals::Track& of = interval.tracks[track];
      const LaneCell sum{of.distance_m, of.time_s, 0.0};
      const double length = graph[track].length_m();
      base::AppendFormat(
          table, "{:.2f},{:.2f},{},{},{},{},{},{:.3f},{:.3f},{},{},{:.4f}\n", interval.from_s, interval.to_s,
          RoadCell(graph, track), graph[track].lane.section, graph[track].lane.lane, of.in, of.out,
          3600.0 * sum.Flow_vehps(length, watched), 1000.0 * sum.Density_vehpm(length, watched),
          of.time_s > 0.0 ? fmt::format("{:.3f}", sum.Speed_mps()) : "", of.queue_longest,
          interval.looks > 0 ? static_cast<double>(of.queue_sum) / static_cast<double>(interval.looks) : 0.0);
    }
  }
  return table;
}

std::string TripTable(const lanes::Graph& graph, const LaneStatistics& statistics) {
  const auto place = [&](std::uint32_t track) {
    return base::CsvCell(fmt::format("{}:{}", RoadOf(graph, track), graph[track].lane.lane));
  };
  std::string table = "vehicle,kind,from,to,entered_s,travel_time_s,fuel_ml,delay_s,flow,left,left_s,way_m,waiting_s\n";
  for (const LaneTrip& trip : statistics.trips()) {
    base::AppendFormat(table, "{},{},{},{},{:.2f},{:.2f},{:.3f},{:.2f},{},{},{:.2f},{:.2f},{:.2f}\n", trip.id,
                       NameOf(trip.kind), place(trip.from), place(trip.to), trip.entered_s, trip.took_s,
                       1e3 * trip.fuel_mg / kFuelDensity_mgpl, trip.took_s - trip.free_s,
                       trip.flow < 0 ? "" : std::to_string(trip.flow + 1), NameOf(trip.left),
                       trip.entered_s + trip.took_s, trip.way_m, trip.waiting_s);
  }
  return table;
}

std::string SpeedMap(const lanes::Graph& graph, const LaneStatistics& statistics, const std::string& title) {
  const GraphBounds frame = BoundsOf(graph);
  const double scale = kMapWidth_px / std::max({frame.east_m - frame.west_m, frame.north_m - frame.south_m, 1.0});
  const double wide = 2.0 * kRim_px + scale * std::max(0.0, frame.east_m - frame.west_m),
               high = kMapTop_px + kRim_px + scale * std::max(0.0, frame.north_m - frame.south_m);
  std::string svg = fmt::format(
      "<svg xmlns='http://www.w3.org/2000/svg' width='{0:.0f}' height='{1:.0f}' viewBox='0 0 {0:.0f} {1:.0f}' "
      "font-family='sans-serif' font-size='12'>\n"
      "<rect width='{0:.0f}' height='{1:.0f}' fill='white'/>\n<text x='{2}' y='20' font-size='14'>{3}</text>\n<g "
      "fill='none' stroke-linejoin='round' stroke-width='{4:.2f}'>\n",
      std::max(wide, 420.0), high, kRim_px, base::XmlText(title), std::max(1.5, 0.8 * kLane_m * scale));
  const auto shade_of = [&](std::uint32_t track, std::size_t i) {
    const LaneCell& cell = statistics.CellsOf(track)[i];
    if (!(cell.time_s > 0.0)) return -1;
    const double limit = graph.SpeedLimit_mps(track, (static_cast<double>(i) + 0.5) * statistics.CellLength_m(track));
    return std::clamp(static_cast<int>(cell.Speed_mps() / limit * kSpeedShades), 0, kSpeedShades - 1);
  };
  for (std::uint32_t track = 0; track < graph.tracks().size(); ++track) {
    const std::size_t count = statistics.CellsOf(track).size();
    for (std::size_t i = 0; i < count;) {  // cells of one shade are one line
      const int shade = shade_of(track, i);
      std::size_t end = i;
      while (end < count && shade_of(track, end) == shade) ++end;
      base::AppendFormat(svg, "<polyline stroke='{}' points='", shade < 0 ? "#d0d0d0" : ShadeOf(shade));
      for (std::size_t k = i; k <= end; ++k) {
        const Eigen::Vector3d p = graph[track].curve.At(static_cast<double>(k) * statistics.CellLength_m(track)).p_W;
        base::AppendFormat(svg, "{:.1f},{:.1f} ", kRim_px + scale * (p.x() - frame.west_m),
                           kMapTop_px + scale * (frame.north_m - p.y()));
      }
      svg += "'/>\n";
      i = end;
    }
  }
  svg += "</g>\n";
  for (int shade = 0; shade < kSpeedShades; ++shade) {
    base::AppendFormat(svg, "<rect x='{}' y='26' width='6' height='8' fill='{}'/>", kRim_px + 6.0 * shade,
                       ShadeOf(shade));
  }
  base::AppendFormat(svg,
                     "<text x='{}' y='34'>mean speed, from standing to the limit; grey: no vehicle</text>\n</svg>\n",
                     kRim_px + 6.0 * kSpeedShades + 8.0);
  return svg;
}

}  // namespace rodeira::traffic
