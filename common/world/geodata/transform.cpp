// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <proj.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "common/world/geodata/functions.hpp"

namespace rodeira::terrain::geodata {
namespace {

constexpr const char* kEarth = "EPSG:4326";  // WGS 84

bool IsMap(PJ_CONTEXT* context, const PJ* to_earth) {
  PJ* source = proj_get_source_crs(context, to_earth);
  const PJ_TYPE type = source == nullptr ? PJ_TYPE_UNKNOWN : proj_get_type(source);
  proj_destroy(source);
  return type != PJ_TYPE_UNKNOWN && type != PJ_TYPE_GEOGRAPHIC_2D_CRS && type != PJ_TYPE_GEOGRAPHIC_3D_CRS &&
         type != PJ_TYPE_GEOCENTRIC_CRS;
}

class ProjTransform final : public MapTransform {
 public:
  PJ_CONTEXT* context = proj_context_create();
  PJ* to_earth = nullptr;

  ProjTransform() {
    proj_log_level(context, PJ_LOG_NONE);
    proj_context_set_enable_network(context, 0);
  }
  ProjTransform(const ProjTransform&) = delete;
  ProjTransform& operator=(const ProjTransform&) = delete;
  ~ProjTransform() override {
    proj_destroy(to_earth);
    proj_context_destroy(context);
  }

  std::optional<Eigen::Vector2d> Move(PJ_DIRECTION direction, double first, double second) const {
    if (!std::isfinite(first) || !std::isfinite(second)) return std::nullopt;
    proj_errno_reset(to_earth);
    const PJ_COORD moved = proj_trans(to_earth, direction, proj_coord(first, second, 0.0, HUGE_VAL));
    if (proj_errno(to_earth) != 0 || !std::isfinite(moved.xy.x) || !std::isfinite(moved.xy.y)) return std::nullopt;
    return Eigen::Vector2d(moved.xy.x, moved.xy.y);
  }

  std::optional<EarthPlace> ToEarth(double x_m, double y_m) const override {
    const auto at = Move(PJ_FWD, x_m, y_m);
    return at ? std::optional(EarthPlace{at->x(), at->y()}) : std::nullopt;
  }
  std::optional<Eigen::Vector2d> ToMap(const EarthPlace& place) const override {
    return Move(PJ_INV, place.longitude_deg, place.latitude_deg);
  }
};

}  // namespace

base::Result<std::shared_ptr<const MapTransform>> MakeTransform(const std::string& definition) {
  auto parts = std::make_shared<ProjTransform>();
  PJ* raw = proj_create_crs_to_crs(parts->context, definition.c_str(), kEarth, nullptr);
  if (raw != nullptr) {
    parts->to_earth =
        proj_normalize_for_visualization(parts->context, raw);  // east before north, longitude before latitude
    proj_destroy(raw);
  }
  const bool known = parts->to_earth != nullptr;
  // A system of longitudes and latitudes is no map.
  if (!known || !IsMap(parts->context, parts->to_earth)) {
    return base::WrongInput("terrain.wrong_projection",
                            fmt::format("'{}' is no {}; a PROJ string, WKT or EPSG code of a projection was expected",
                                        definition.substr(0, std::min<std::size_t>(60, definition.find('\n'))),
                                        known ? "projection" : "coordinate system that PROJ knows"));
  }
  return std::shared_ptr<const MapTransform>(std::move(parts));
}

base::Result<std::optional<std::string>> ToProjString(const std::string& definition) {
  PJ_CONTEXT* context = proj_context_create();
  std::string said;
  proj_log_level(context, PJ_LOG_ERROR);
  proj_log_func(context, &said, [](void* all, int, const char* line) { *static_cast<std::string*>(all) += line; });
  proj_context_set_enable_network(context, 0);
  PJ* system = proj_create(context, definition.c_str());
  const char* string = system == nullptr ? nullptr : proj_as_proj_string(context, system, PJ_PROJ_4, nullptr);
  std::optional<std::string> text;
  if (string != nullptr) text = string;
  proj_destroy(system);
  proj_context_destroy(context);
  // PROJ goes on without its database, with another answer.
  for (const char* of_database : {"proj.db", "SQLite"})
    if (said.find(of_database) != std::string::npos) return base::Failed("terrain.wrong_projection", said);
  constexpr std::string_view kType = " +type=crs";
  if (text && text->ends_with(kType)) text->resize(text->size() - kType.size());
  return text;
}

}  // namespace rodeira::terrain::geodata
