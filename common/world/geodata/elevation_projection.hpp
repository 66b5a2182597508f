// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ogr_spatialref.h>

#include <filesystem>
#include <string>

#include "common/core/base/result.hpp"

class GDALDataset;

namespace rodeira::terrain::geodata {

// A coordinate system of a file, made metric.
struct Projection {
  std::string wkt;             // WKT 1 in the spelling of .prj files, its unit the metre; empty: the file names none
  double metres_a_unit = 1.0;  // of the coordinates in the file
  std::string own_wkt;         // as the file says it, in its own unit
  std::string
      geographic_wkt;  // not empty: the file's coordinates are degrees of this system, and the two above say nothing
};

// Wrong input where the coordinates are degrees.
base::Result<Projection> MetricProjection(const OGRSpatialReference& reference);

// What the .prj of a file is called.
std::filesystem::path ProjectionBeside(const std::filesystem::path& path, bool gzipped);

// The .prj beside the file (trusted before everything else), or what GDAL found in the file, or nothing. Degrees are
// none of its errors.
base::Result<Projection> ReadProjection(const std::filesystem::path& path, bool gzipped, GDALDataset& dataset);

}  // namespace rodeira::terrain::geodata
