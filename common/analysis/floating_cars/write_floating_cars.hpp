// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>

#include "common/core/base/result.hpp"
#include "common/data/csv/selection.hpp"
#include "common/data/decode/aliases.hpp"
#include "common/data/record/mcap_reader.hpp"
#include "common/world/network/network.hpp"

// A recording as floating car data for SUMO's tools.
namespace rodeira::floating_cars {

// What of a recording is written.
struct FloatingCarsQuery {
  const decode::Aliases* aliases = nullptr;    // names of older recordings; may be null
  const network::Network* network = nullptr;   // of the world that the recording embeds; null: no lanes are written
  csv::Selection selection;                    // its times and rate; 10 timesteps a second where it has no rate
  std::function<bool(double share)> progress;  // false ends the writing with an Error; may be empty
};

// What has been written.
struct FloatingCarsReport {
  double period_s = 0.0;  // between two timesteps: of the slowest source, where that is slower than the rate
  std::uint64_t timesteps = 0, vehicles = 0, persons = 0;  // elements of the file
  std::uint64_t bytes = 0;
};

// Writes driven vehicles (by the name of their node), agents ("7.2": id and trip) and pedestrians into a new file,
// which appears whole or not at all. A vehicle in no driving lane has no lane and position. Wrong input where the file
// is there already, or the recording has no vehicle or is none of Rodeira's; failed where the disk does not take it.
base::Result<FloatingCarsReport> WriteFloatingCars(const record::McapReader& reader, const std::filesystem::path& file,
                                                   const FloatingCarsQuery& query);

}  // namespace rodeira::floating_cars
