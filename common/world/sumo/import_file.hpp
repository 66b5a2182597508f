// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "common/core/base/result.hpp"

// Maps of OpenStreetMap and networks of SUMO as OpenDRIVE.
namespace rodeira::sumo {

// What is read, and what messages call the result.
struct ImportOptions {
  std::filesystem::path file;       // .osm, .net.xml, or one of them gzipped
  std::filesystem::path named;      // the OpenDRIVE file that is made, for messages
  std::filesystem::path elevation;  // heights of the ground (GeoTIFF …); empty: roads are as high as the file says
  std::function<bool()> stop;       // asked often; true: the import ends
};

// The result of an import; nothing is written to the disk.
struct Imported {
  std::string drive;                  // the text of the OpenDRIVE file
  std::vector<std::string> warnings;  // one sentence each
  std::string table;                  // for people, ending in a newline
};

// Has netconvert make OpenDRIVE of the file, writes into it what OpenDRIVE by netconvert does not have (programs of
// lights, right of way, permissions of lanes, ids of edges), and repairs it. Wrong input: the file, or netconvert is
// missing. Failed: the environment, or `stop`.
base::Result<Imported> ImportFile(const ImportOptions& options);

}  // namespace rodeira::sumo
