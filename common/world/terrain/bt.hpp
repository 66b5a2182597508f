// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

#include "common/core/base/bytes.hpp"
#include "common/core/base/result.hpp"
#include "common/world/terrain/elevation_grid.hpp"

// VTP's Binary Terrain, versions 1.0 to 1.3 (http://vterrain.org/Implementation/Formats/BT.html): the header and our
// writer. Files are read through GDAL (elevation_file.hpp), which needs the header for what GDAL leaves open.
namespace rodeira::terrain {

inline constexpr std::size_t kBtHeaderBytes = 256;

// The header's fields; extents in metres, feet or degrees as metres_a_unit says.
struct BtHeader {
  int version_tenths = 13;  // 10 to 13
  int columns = 0;
  int rows = 0;
  int bytes_a_post = 4;  // 2 or 4
  bool floating = true;
  double metres_a_unit = 1.0;  // horizontally; 0: degrees
  int utm_zone = 0;            // 0: none, the .prj says what the coordinates are
  int datum = -2;              // unknown
  // Of the outermost posts, in the file's unit.
  double left = 0.0, right = 0.0, bottom = 0.0, top = 0.0;
  bool external_projection = false;  // a .prj beside the file says more
  double vertical_scale = 1.0;       // metres a unit of height

  std::uint64_t file_bytes() const {
    return kBtHeaderBytes + static_cast<std::uint64_t>(columns) * static_cast<std::uint64_t>(rows) *
                                static_cast<std::uint64_t>(bytes_a_post);
  }
};

// Whether a grid can stand within these edges: finite, none farther than 1e10 from 0, a millionth and more a column and
// row.
bool ExtentsHold(double west, double south, double east, double north, int columns, int rows);

// Whether the bytes begin as a .bt does, whatever follows.
bool LooksLikeBt(std::span<const std::byte> bytes);
// Wrong input where it is no header that can be used: unknown version, sizes or units, extents that enclose nothing.
// The context is left for the caller, which knows the file's name.
base::Result<BtHeader> ParseBtHeader(std::span<const std::byte> bytes);

// The 256 bytes of a version 1.3 header that says the same.
base::Bytes BtHeaderBytes(const BtHeader& header);
// The grid as a .bt 1.3 of 32-bit floats, metres. The same grid gives the same bytes; read again it is the same grid.
base::Bytes BtBytes(const ElevationGrid& grid);
// Writes them, and beside them a .prj where the grid has a projection. Failed where the disk refuses.
base::Status WriteBt(const std::filesystem::path& path, const ElevationGrid& grid);

}  // namespace rodeira::terrain
