// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "common/core/base/result.hpp"
#include "common/world/terrain/geodata.hpp"

// What rodeira-geodata.so does. terrain::Geodata says what each function returns.
namespace rodeira::terrain::geodata {

// LoadGround and MissingProjection of elevation_file.hpp.
base::Result<LoadedGround> ReadGround(const std::filesystem::path& path, Registration registration);
std::optional<std::filesystem::path> FindMissingProjection(const std::filesystem::path& path);
// ProjectionWkt of elevation_file.hpp.
base::Result<std::string> ToProjectionWkt(std::string_view definition);

// As Geographic::Make.
base::Result<std::shared_ptr<const MapTransform>> MakeTransform(const std::string& definition);
// ProjString of geographic.hpp.
base::Result<std::optional<std::string>> ToProjString(const std::string& definition);

// LookAtPicture and ReadPicture of picture_file.hpp.
base::Result<PictureFacts> ReadPictureFacts(const std::filesystem::path& path);
base::Result<PictureFile> ReadPicturePixels(const std::filesystem::path& path);
base::Result<std::unique_ptr<PictureReader>> OpenPicture(std::string_view bytes, int max_px);
base::Result<std::string> EncodePng(const std::uint8_t* rgb, int width_px, int height_px);

// Failed where the file cannot be written.
base::Status WriteGeoTiff(const GeoTiff& raster, const std::string& file);

}  // namespace rodeira::terrain::geodata
