// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/core/base/result.hpp"
#include "common/world/terrain/bt.hpp"

class GDALDataset;

namespace rodeira::terrain::geodata {

// That a raster has another number of bands than one.
std::string BandsSentence(int bands);

// All heights of a raster of one band in metres, columns from west to east, each from south to north; voids as
// ElevationGrid::kVoid. Scale, offset and unit are the .bt header's where it is one, otherwise those that GDAL finds.
// Wrong input where they cannot be read or are no lengths.
base::Result<std::vector<float>> ReadHeights(GDALDataset& dataset, const std::optional<BtHeader>& header,
                                             const std::filesystem::path& path);

}  // namespace rodeira::terrain::geodata
