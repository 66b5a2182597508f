#pragma once

#include <string>

#include "common/base/result.hpp"
#include "common/traffic/lane_statistics.hpp"

namespace rodeira::traffic {

// A row a cell of every lane: road, lane, s_m (of its middle), x_m, y_m, length_m, flow_vehph, density_vehpkm, speed_mps, fuel_mlpkm
// (a vehicle's in the mean).
std::string LaneTable(const lanes::Graph& graph, const LaneStatistics& statistics);

// A row a lane: road, lane, length_m, queue_longest, queue_mean.
std::string QueueTable(const lanes::Graph& graph, const LaneStatistics& statistics);

// The network seen from above, coloured by mean speed over the limit there (red: standing, green: as fast as may be; grey: nobody was there),
// as SVG.
std::string SpeedMap(const lanes::Graph& graph, const LaneStatistics& statistics, const std::string& title);

// A GeoTIFF of square pixels (their edges in metres, over 0) with four bands of 32-bit numbers: flow (vehicles an hour), density (vehicles a
// kilometre), mean speed (m/s), fuel (ml a vehicle kilometre), of all cells whose middle lies in a pixel; NaN where there is none.
// Failed where it cannot be written; wrong input where it would have more than 10^8 pixels.
base::Status WriteHeatRaster(const lanes::Graph& graph, const LaneStatistics& statistics, double pixel_m, const std::string& file);

}  // namespace rodeira::traffic
