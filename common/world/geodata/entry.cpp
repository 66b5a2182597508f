// SPDX-License-Identifier: Apache-2.0
#include "common/world/geodata/functions.hpp"

namespace rodeira::terrain {
namespace {

class GeodataFunctions final : public Geodata {
 public:
  base::Result<LoadedGround> LoadGround(const std::filesystem::path& path, Registration registration) const override {
    return geodata::ReadGround(path, registration);
  }
  std::optional<std::filesystem::path> MissingProjection(const std::filesystem::path& path) const override {
    return geodata::FindMissingProjection(path);
  }
  base::Result<std::string> ProjectionWkt(std::string_view definition) const override {
    return geodata::ToProjectionWkt(definition);
  }
  base::Result<std::shared_ptr<const MapTransform>> MakeTransform(const std::string& definition) const override {
    return geodata::MakeTransform(definition);
  }
  base::Result<std::optional<std::string>> ProjString(const std::string& definition) const override {
    return geodata::ToProjString(definition);
  }
  base::Result<PictureFacts> LookAtPicture(const std::filesystem::path& path) const override {
    return geodata::ReadPictureFacts(path);
  }
  base::Result<PictureFile> ReadPicture(const std::filesystem::path& path) const override {
    return geodata::ReadPicturePixels(path);
  }
  base::Result<std::unique_ptr<PictureReader>> OpenPicture(std::string_view bytes, int max_px) const override {
    return geodata::OpenPicture(bytes, max_px);
  }
  base::Result<std::string> EncodePng(const std::uint8_t* rgb, int width_px, int height_px) const override {
    return geodata::EncodePng(rgb, width_px, height_px);
  }
  base::Status WriteGeoTiff(const GeoTiff& raster, const std::string& file) const override {
    return geodata::WriteGeoTiff(raster, file);
  }
};

}  // namespace
}  // namespace rodeira::terrain

extern "C" const char* rodeira_geodata_build() {
  static const std::string build = rodeira::terrain::GeodataBuild();
  return build.c_str();
}

extern "C" const rodeira::terrain::Geodata* rodeira_geodata_make() {
  static const rodeira::terrain::GeodataFunctions functions;
  return &functions;
}
