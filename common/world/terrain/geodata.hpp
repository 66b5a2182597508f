// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/core/base/result.hpp"
#include "common/world/terrain/elevation_file.hpp"
#include "common/world/terrain/geographic.hpp"
#include "common/world/terrain/picture_file.hpp"

// Everything that needs GDAL or PROJ lies in the shared object rodeira-geodata.so (common/world/geodata). A process
// loads it when it first needs it, so that a process that needs neither maps neither.
namespace rodeira::terrain {

// Between a map's x, y and places on the earth. For one thread at a time.
class MapTransform {
 public:
  virtual ~MapTransform() = default;
  // Map coordinates count east and north. Nothing where the projection has no such place.
  virtual std::optional<EarthPlace> ToEarth(double x_m, double y_m) const = 0;
  virtual std::optional<Eigen::Vector2d> ToMap(const EarthPlace& place) const = 0;
};

// A picture, three bytes a pixel (red, green, blue), rows from the top.
class PictureReader {
 public:
  virtual ~PictureReader() = default;
  virtual int width_px() const = 0;
  virtual int height_px() const = 0;
  // Reads into `rgb`, which holds all pixels. `ready(rows)` is called with the number of rows read; if it returns
  // false, reading ends with an error. Wrong input where the picture is broken.
  virtual base::Status ReadAll(std::uint8_t* rgb, const std::function<bool(int)>& ready) = 0;
  // The picture at an eighth of its size, width and height as given, where its file holds it so (JPEG); else nothing.
  virtual std::optional<std::vector<std::uint8_t>> ReadEighth(int width_px, int height_px) = 0;
};

// A raster of 32-bit numbers, north up; rows from the north, NaN where there is no value.
struct GeoTiff {
  double west_m = 0.0, north_m = 0.0, pixel_m = 1.0;
  int columns = 0, rows = 0;
  std::vector<std::string> bands;  // names
  // The values of a band, columns x rows of them; called once a band, in their order.
  std::function<const std::vector<float>&(std::size_t band)> values;
};

// What the shared object does. The functions of elevation_file.hpp, geographic.hpp and picture_file.hpp call it and say
// what it returns.
class Geodata {
 public:
  virtual ~Geodata() = default;
  virtual base::Result<LoadedGround> LoadGround(const std::filesystem::path& path, Registration registration) const = 0;
  virtual std::optional<std::filesystem::path> MissingProjection(const std::filesystem::path& path) const = 0;
  virtual base::Result<std::string> ProjectionWkt(std::string_view definition) const = 0;
  virtual base::Result<std::shared_ptr<const MapTransform>> MakeTransform(const std::string& definition) const = 0;
  virtual base::Result<std::optional<std::string>> ProjString(const std::string& definition) const = 0;
  virtual base::Result<PictureFacts> LookAtPicture(const std::filesystem::path& path) const = 0;
  virtual base::Result<PictureFile> ReadPicture(const std::filesystem::path& path) const = 0;
  // A PNG, JPEG, BMP or TIFF picture in `bytes`, which must outlive the reader, of at most `max_px` pixels a side.
  // Wrong input where it is none.
  virtual base::Result<std::unique_ptr<PictureReader>> OpenPicture(std::string_view bytes, int max_px) const = 0;
  virtual base::Result<std::string> EncodePng(const std::uint8_t* rgb, int width_px, int height_px) const = 0;
  // Fails where the file cannot be written.
  virtual base::Status WriteGeoTiff(const GeoTiff& raster, const std::string& file) const = 0;
};

inline constexpr std::string_view kGeodataLibrary = "rodeira-geodata.so";

// The places where the shared object is looked for, in their order: beside the program in `folder`, in the same
// installation, in the one that holds the shared data ($RODEIRA_DATA), in /usr/libexec/rodeira.
std::vector<std::filesystem::path> GeodataPlaces(const std::filesystem::path& folder);

// Loads the first of `places` that exists. Fails where none does; wrong input where it is of another build.
base::Result<const Geodata*> LoadGeodata(const std::vector<std::filesystem::path>& places);

// That of the running program, which is looked for once.
const base::Result<const Geodata*>& SharedGeodata();

// The text of the build, which program and shared object must have in common.
std::string GeodataBuild();

}  // namespace rodeira::terrain
