// SPDX-License-Identifier: Apache-2.0
// Elevation files: GDAL reads them from a disk, so each is one; what is taken answers finite heights or none.
#include <unistd.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "common/world/terrain/elevation_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("rodeira-fuzz-" + std::to_string(::getpid()) + ".bt");
  std::ofstream(file, std::ios::binary | std::ios::trunc)
      .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  const auto grid = rodeira::terrain::LoadElevation(file);
  (void)rodeira::terrain::MissingProjection(file);
  std::filesystem::remove(file);
  if (!grid) return 0;
  const auto& frame = grid.value()->frame();
  const auto at = grid.value()->At(0.5 * (frame.west_m + frame.east_m), 0.5 * (frame.south_m + frame.north_m));
  if (at.inside && !std::isfinite(at.z_m)) std::abort();
  return 0;
}
