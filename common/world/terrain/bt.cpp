// SPDX-License-Identifier: Apache-2.0
#include "common/world/terrain/bt.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <string>

#include "common/core/base/files.hpp"

namespace rodeira::terrain {
namespace {

constexpr int kMaxEdgePosts = 100'000;  // along one edge

template <class T>
T At(std::span<const std::byte> bytes, std::size_t offset) {
  T value;
  std::memcpy(&value, bytes.data() + offset, sizeof(T));
  return value;
}

// Version 1.0 kept its fields elsewhere and its extents in single precision.
void ParseVersion10(std::span<const std::byte> bytes, BtHeader& header) {
  header.bytes_a_post = At<std::int32_t>(bytes, 18);
  header.metres_a_unit = At<std::int16_t>(bytes, 22) != 0 ? 1.0 : 0.0;
  header.utm_zone = At<std::int16_t>(bytes, 24);
  header.left = static_cast<double>(At<float>(bytes, 26));
  header.right = static_cast<double>(At<float>(bytes, 30));
  header.bottom = static_cast<double>(At<float>(bytes, 34));
  header.top = static_cast<double>(At<float>(bytes, 38));
  header.floating = At<std::int16_t>(bytes, 42) != 0;
}

void ParseLater(std::span<const std::byte> bytes, BtHeader& header) {
  constexpr double kUnits[] = {0.0, 1.0, 0.3048, 1200.0 / 3937.0};  // degrees, metre, foot, US survey foot
  const auto unit = At<std::int16_t>(bytes, 22);
  header.bytes_a_post = At<std::int16_t>(bytes, 18);
  header.floating = At<std::int16_t>(bytes, 20) != 0;
  header.metres_a_unit = unit >= 0 && unit <= 3 ? kUnits[unit] : -1.0;
  header.utm_zone = At<std::int16_t>(bytes, 24);
  header.datum = At<std::int16_t>(bytes, 26);
  header.left = At<double>(bytes, 28);
  header.right = At<double>(bytes, 36);
  header.bottom = At<double>(bytes, 44);
  header.top = At<double>(bytes, 52);
  if (header.version_tenths >= 12) header.external_projection = At<std::int16_t>(bytes, 60) == 1;
  if (header.version_tenths >= 13) {
    const auto scale = static_cast<double>(At<float>(bytes, 62));
    header.vertical_scale = scale == 0.0 ? 1.0 : scale;
  }
}

base::Status Check(const BtHeader& header) {
  if (header.columns < 2 || header.rows < 2 || header.columns > kMaxEdgePosts || header.rows > kMaxEdgePosts) {
    return base::WrongInput("terrain.wrong_elevation_file",
                            fmt::format("the .bt header says {} columns and {} rows; 2 to {} of each were expected",
                                        header.columns, header.rows, kMaxEdgePosts));
  }
  if (!(header.bytes_a_post == 4 || (header.bytes_a_post == 2 && !header.floating))) {
    return base::WrongInput(
        "terrain.wrong_elevation_file",
        fmt::format("the .bt header says {} heights of {} bytes; integers of 2 or 4 bytes or floats of 4 were expected",
                    header.floating ? "float" : "integer", header.bytes_a_post));
  }
  if (header.metres_a_unit < 0.0)
    return base::WrongInput("terrain.wrong_elevation_file", "the .bt header's horizontal unit is none of 0 to 3");
  if (!ExtentsHold(header.left, header.bottom, header.right, header.top, header.columns, header.rows)) {
    return base::WrongInput(
        "terrain.wrong_elevation_file",
        fmt::format("the .bt header's extents enclose nothing: left {}, right {}, bottom {}, top {}", header.left,
                    header.right, header.bottom, header.top));
  }
  if (!std::isfinite(header.vertical_scale) || header.vertical_scale < 0.0) {
    return base::WrongInput("terrain.wrong_elevation_file",
                            fmt::format("the .bt header's vertical scale is {}; a number greater than 0 was expected",
                                        header.vertical_scale));
  }
  return {};
}

}  // namespace

bool ExtentsHold(double west, double south, double east, double north, int columns, int rows) {
  constexpr double kFarthest = 1e10, kNarrowest = 1e-6;
  for (const double edge : {west, south, east, north}) {
    if (!(std::fabs(edge) <= kFarthest)) return false;
  }
  return east - west >= kNarrowest * columns && north - south >= kNarrowest * rows;
}

bool LooksLikeBt(std::span<const std::byte> bytes) {
  return bytes.size() >= 7 && std::memcmp(bytes.data(), "binterr", 7) == 0;
}

base::Result<BtHeader> ParseBtHeader(std::span<const std::byte> bytes) {
  if (bytes.size() < kBtHeaderBytes) {
    return base::WrongInput(
        "terrain.wrong_elevation_file",
        fmt::format("the file is cut short: {} bytes, and a .bt header alone is {}", bytes.size(), kBtHeaderBytes));
  }
  std::string magic(10, '\0');
  std::memcpy(magic.data(), bytes.data(), magic.size());
  BtHeader header;
  const bool known = magic.starts_with("binterr1.") && magic[9] >= '0' && magic[9] <= '3';
  if (!known) {
    for (char& letter : magic) letter = letter >= ' ' && letter <= '~' ? letter : '?';
    return base::WrongInput(
        "terrain.wrong_elevation_file",
        fmt::format("the file begins with '{}'; a .bt begins with 'binterr1.0' to 'binterr1.3'", magic));
  }
  header.version_tenths = 10 + (magic[9] - '0');
  header.columns = At<std::int32_t>(bytes, 10);
  header.rows = At<std::int32_t>(bytes, 14);
  if (header.version_tenths == 10)
    ParseVersion10(bytes, header);
  else
    ParseLater(bytes, header);
  if (const auto fine = Check(header); !fine) return fine.error();
  return header;
}

base::Bytes BtHeaderBytes(const BtHeader& header) {
  std::int16_t unit = 1;
  if (header.metres_a_unit == 0.0)
    unit = 0;
  else if (header.metres_a_unit == 0.3048)
    unit = 2;
  else if (header.metres_a_unit != 1.0)
    unit = 3;
  base::ByteWriter out;
  out.PutRaw(std::as_bytes(std::span("binterr1.3", 10)));
  out.Put(static_cast<std::int32_t>(header.columns));
  out.Put(static_cast<std::int32_t>(header.rows));
  out.Put(static_cast<std::int16_t>(header.bytes_a_post));
  out.Put(static_cast<std::int16_t>(header.floating ? 1 : 0));
  out.Put(unit);
  out.Put(static_cast<std::int16_t>(header.utm_zone));
  out.Put(static_cast<std::int16_t>(header.datum));
  for (const double edge : {header.left, header.right, header.bottom, header.top}) out.Put(edge);
  out.Put(static_cast<std::int16_t>(header.external_projection ? 1 : 0));
  out.Put(static_cast<float>(header.vertical_scale));
  out.bytes().resize(kBtHeaderBytes);
  return std::move(out.bytes());
}

base::Bytes BtBytes(const ElevationGrid& grid) {
  const ElevationGrid::Frame& frame = grid.frame();
  BtHeader header;
  header.columns = frame.columns;
  header.rows = frame.rows;
  header.left = frame.west_m;
  header.right = frame.east_m;
  header.bottom = frame.south_m;
  header.top = frame.north_m;
  header.external_projection = !grid.projection_wkt().empty();
  base::Bytes bytes = BtHeaderBytes(header);
  const auto heights = std::as_bytes(grid.heights_m());
  bytes.insert(bytes.end(), heights.begin(), heights.end());
  return bytes;
}

base::Status WriteBt(const std::filesystem::path& path, const ElevationGrid& grid) {
  if (const auto written = base::WriteWhole(path, std::span<const std::byte>(BtBytes(grid))); !written) return written;
  if (grid.projection_wkt().empty()) return {};
  auto beside = path;
  return base::WriteWhole(beside.replace_extension(".prj"), grid.projection_wkt() + "\n");
}

}  // namespace rodeira::terrain
