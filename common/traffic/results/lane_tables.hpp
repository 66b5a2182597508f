// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "common/core/base/result.hpp"
#include "common/traffic/results/lane_intervals.hpp"
#include "common/traffic/results/lane_statistics.hpp"

namespace rodeira::traffic {

// A row a cell of every lane: road, lane, s_m (of its middle), x_m, y_m, length_m, flow_vehph, density_vehpkm,
// speed_mps, fuel_mlpkm (a vehicle's in the mean), free_mps. Speed and fuel are empty where no vehicle was. Names of
// roads are cells of RFC 4180, here and below.
std::string LaneTable(const lanes::Graph& graph, const LaneStatistics& statistics);

// A row a lane: road, lane, length_m, queue_longest, queue_mean.
std::string QueueTable(const lanes::Graph& graph, const LaneStatistics& statistics);

// A row a lane: road, section, lane, began, in, out, there (LaneCount).
std::string FlowTable(const lanes::Graph& graph, const LaneStatistics& statistics);

// A row a stretch of time and lane: from_s, to_s, road, section, lane, in, out, flow_vehph, density_vehpkm, speed_mps
// (empty where no vehicle was), queue_longest, queue_mean.
std::string IntervalTable(const lanes::Graph& graph, const LaneIntervals& intervals);

// A row a trip, in the order of their ends: vehicle, kind, from and to (ROAD:LANE), entered_s (since the watching
// began), travel_time_s, fuel_ml, delay_s (beyond what its way takes at the free speed of each place), flow (its number
// among the settings', from 1 on; empty: none), left (NameOf(LeaveReason)), left_s (since the watching began), way_m,
// waiting_s (slower than 0.1 m/s).
std::string TripTable(const lanes::Graph& graph, const LaneStatistics& statistics);

// The network seen from above, coloured by mean speed over the limit there (red: standing, green: as fast as may be;
// grey: no vehicle was there), as SVG.
std::string SpeedMap(const lanes::Graph& graph, const LaneStatistics& statistics, const std::string& title);

// A GeoTIFF of square pixels (their edges in metres, over 0) with five bands of 32-bit numbers: flow (vehicles an
// hour), density (vehicles a kilometre), mean speed (m/s), fuel (ml a vehicle kilometre), free speed (m/s), of all
// cells with a middle in a pixel; NaN where there is none. Failed where it cannot be written; wrong input where it
// would have more than 10^8 pixels, which CheckHeatRaster alone looks at.
base::Status CheckHeatRaster(const lanes::Graph& graph, double pixel_m, const std::string& file);
base::Status WriteHeatRaster(const lanes::Graph& graph, const LaneStatistics& statistics, double pixel_m,
                             const std::string& file);

}  // namespace rodeira::traffic
