// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace rodeira::cli {

// `rodeira world import FILE [--elevation FILE.tif] -o WORLD`
struct WorldImportOptions {
  std::string file;       // .osm, .net.xml, or one of them gzipped
  std::string out;        // WORLD.xodr, or WORLD.yaml with WORLD.xodr beside it
  std::string elevation;  // heights of the ground; empty: as the file says
  bool quiet = false;
  bool force = false;  // replaces files that exist
};

// Returns the exit status.
int WorldImport(const WorldImportOptions& options);

}  // namespace rodeira::cli
