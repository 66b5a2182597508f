// SPDX-License-Identifier: Apache-2.0
#include "common/world/terrain/geodata.hpp"

#include <fmt/format.h>

#include <system_error>
#include <utility>

#include "common/core/base/installation.hpp"
#include "common/core/base/shared_object.hpp"
#include "common/world/terrain/plain_projection.hpp"

namespace rodeira::terrain {
namespace {

// Grows if the meaning of what passes changes and no size does, or if Geodata gets another function.
constexpr std::size_t kLayoutVersion = 1;

}  // namespace

std::string GeodataBuild() {
  std::size_t layout = kLayoutVersion;
  for (const std::size_t size :
       {sizeof(LoadedGround), sizeof(MapOrigin), sizeof(ElevationGrid), sizeof(EarthPlace), sizeof(PictureFacts),
        sizeof(PictureFile), sizeof(GeoTiff), sizeof(base::Error), sizeof(base::Result<LoadedGround>)})
    layout = layout * 1'000'003 + size;
  return base::BuildText(layout);
}

std::vector<std::filesystem::path> GeodataPlaces(const std::filesystem::path& folder) {
  const std::string name(kGeodataLibrary);
  std::vector<std::filesystem::path> places = {base::FindProgram(name, folder)};
  // Data in PREFIX/share/rodeira.
  if (const std::filesystem::path data = base::SharedDataFolder(folder); !data.empty())
    places.push_back((data / "../../libexec/rodeira" / name).lexically_normal());
  places.push_back(std::filesystem::path("/usr/libexec/rodeira") / name);
  return places;
}

base::Result<const Geodata*> LoadGeodata(const std::vector<std::filesystem::path>& places) {
  std::string tried;
  for (const std::filesystem::path& place : places) {
    std::error_code problem;
    if (!std::filesystem::exists(place, problem)) {
      tried += (tried.empty() ? "" : ", ") + place.string();
      continue;
    }
    const auto make = base::LoadSharedObject(
        place, {"rodeira_geodata_build", "rodeira_geodata_make", "common/world/geodata"}, GeodataBuild());
    if (!make) return make.error();
    return reinterpret_cast<const Geodata* (*)()>(make.value())();
  }
  return base::Failed(
      "terrain.no_geodata",
      fmt::format(
          "{} is missing, which reads elevation files and pictures and computes projections: looked for {}; the "
          "package rodeira-headless has it",
          kGeodataLibrary, tried));
}

const base::Result<const Geodata*>& SharedGeodata() {
  static const base::Result<const Geodata*> shared = LoadGeodata(GeodataPlaces(base::ProgramFolder()));
  return shared;
}

base::Result<LoadedGround> LoadGround(const std::filesystem::path& path, Registration registration) {
  const auto& geodata = SharedGeodata();
  return geodata ? geodata.value()->LoadGround(path, registration) : geodata.error();
}

base::Result<std::shared_ptr<const ElevationGrid>> LoadElevation(const std::filesystem::path& path,
                                                                 Registration registration) {
  auto loaded = LoadGround(path, registration);
  if (!loaded) return loaded.error();
  return std::move(loaded).value().grid;
}

std::optional<std::filesystem::path> MissingProjection(const std::filesystem::path& path) {
  const auto& geodata = SharedGeodata();
  return geodata ? geodata.value()->MissingProjection(path) : std::nullopt;
}

base::Result<std::string> ProjectionWkt(std::string_view definition) {
  if (auto wkt = PlainProjectionWkt(definition)) return std::move(*wkt);
  const auto& geodata = SharedGeodata();
  return geodata ? geodata.value()->ProjectionWkt(definition) : geodata.error();
}

base::Result<Geographic> Geographic::Make(const std::string& definition) {
  const auto& geodata = SharedGeodata();
  if (!geodata) return geodata.error();
  auto transform = geodata.value()->MakeTransform(definition);
  if (!transform) return transform.error();
  return Geographic(std::move(transform).value());
}

std::optional<EarthPlace> Geographic::ToEarth(double x_m, double y_m) const { return transform_->ToEarth(x_m, y_m); }

std::optional<Eigen::Vector2d> Geographic::ToMap(const EarthPlace& place) const { return transform_->ToMap(place); }

base::Result<std::optional<std::string>> ProjString(const std::string& definition) {
  const auto& geodata = SharedGeodata();
  return geodata ? geodata.value()->ProjString(definition) : geodata.error();
}

base::Result<PictureFacts> LookAtPicture(const std::filesystem::path& path) {
  const auto& geodata = SharedGeodata();
  return geodata ? geodata.value()->LookAtPicture(path) : geodata.error();
}

base::Result<PictureFile> ReadPicture(const std::filesystem::path& path) {
  const auto& geodata = SharedGeodata();
  return geodata ? geodata.value()->ReadPicture(path) : geodata.error();
}

}  // namespace rodeira::terrain
