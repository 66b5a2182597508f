// SPDX-License-Identifier: Apache-2.0
#include "common/world/geodata/elevation_projection.hpp"

#include <fmt/format.h>
#include <gdal_priv.h>

#include <algorithm>
#include <array>
#include <memory>

#include "common/core/base/files.hpp"
#include "common/world/geodata/functions.hpp"
#include "common/world/geodata/gdal_quiet.hpp"

namespace rodeira::terrain::geodata {
namespace {

base::Result<OGRSpatialReference> FromDefinition(std::string_view definition) {
  const QuietGdal quiet;
  OGRSpatialReference reference;
  const std::string text(definition);
  const bool fine =
      reference.SetFromUserInput(text.c_str(), OGRSpatialReference::SET_FROM_USER_INPUT_LIMITATIONS) == OGRERR_NONE;
  if (!fine) {
    return base::WrongInput(
        "terrain.wrong_projection",
        fmt::format("'{}' is no coordinate system that PROJ knows; an EPSG code or WKT was expected",
                    text.substr(0, std::min<std::size_t>(60, text.find('\n')))));
  }
  return reference;
}

base::Result<Projection> AnyProjection(const OGRSpatialReference& reference) {
  char* text = nullptr;
  const OGRErr failed = reference.exportToWkt(&text);
  std::string wkt = text == nullptr || failed != OGRERR_NONE ? "" : text;
  CPLFree(text);
  if (reference.IsGeographic() == 0) {
    auto projection = MetricProjection(reference);
    if (projection) projection.value().own_wkt = std::move(wkt);
    return projection;
  }
  if (wkt.empty())
    return base::WrongInput("terrain.wrong_projection", "the coordinate system cannot be written as WKT");
  Projection projection;
  projection.geographic_wkt = std::move(wkt);
  return projection;
}

}  // namespace

base::Result<Projection> MetricProjection(const OGRSpatialReference& reference) {
  if (reference.IsGeographic() != 0) {
    return base::WrongInput("terrain.wrong_projection",
                            "the coordinate system is in degrees; a projection in metres was expected");
  }
  Projection projection;
  projection.metres_a_unit = reference.GetLinearUnits();
  if (!(projection.metres_a_unit > 1e-6 && projection.metres_a_unit < 1e6)) {
    return base::WrongInput(
        "terrain.wrong_projection",
        fmt::format("the coordinate system's unit is {} m; metres or feet were expected", projection.metres_a_unit));
  }
  const std::unique_ptr<OGRSpatialReference> metric(reference.Clone());
  if (projection.metres_a_unit != 1.0) metric->SetLinearUnitsAndUpdateParameters(SRS_UL_METER, 1.0);
  char* text = nullptr;
  const std::array<const char*, 2> options = {"FORMAT=WKT1_ESRI", nullptr};
  const OGRErr failed = metric->exportToWkt(&text, options.data());
  projection.wkt = text == nullptr ? "" : text;
  CPLFree(text);
  if (failed != OGRERR_NONE || projection.wkt.empty())
    return base::WrongInput("terrain.wrong_projection", "the coordinate system cannot be written as WKT");
  return projection;
}

std::filesystem::path ProjectionBeside(const std::filesystem::path& path, bool gzipped) {
  std::filesystem::path beside = gzipped ? std::filesystem::path(path).replace_extension() : path;
  return beside.replace_extension(".prj");
}

base::Result<Projection> ReadProjection(const std::filesystem::path& path, bool gzipped, GDALDataset& dataset) {
  const std::filesystem::path beside = ProjectionBeside(path, gzipped);
  std::error_code problem;
  if (std::filesystem::exists(beside, problem)) {
    const auto text = base::ReadText(beside, 1u << 20);
    if (!text) return text.error();
    const auto reference = FromDefinition(text.value());
    if (!reference) return reference.error().WithContext(beside.string());
    auto projection = AnyProjection(reference.value());
    if (!projection) return projection.error().WithContext(beside.string());
    return projection;
  }
  const OGRSpatialReference* reference = dataset.GetSpatialRef();
  if (reference == nullptr) return Projection();
  auto projection = AnyProjection(*reference);
  if (!projection) return projection.error().WithContext(path.string());
  return projection;
}

base::Result<std::string> ToProjectionWkt(std::string_view definition) {
  const auto reference = FromDefinition(definition);
  if (!reference) return reference.error();
  auto projection = MetricProjection(reference.value());
  if (!projection) return projection.error();
  return std::move(projection).value().wkt;
}

}  // namespace rodeira::terrain::geodata
