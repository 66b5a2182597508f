// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "common/core/base/result.hpp"

namespace rodeira::terrain {

class MapTransform;

// On WGS 84, in degrees; positive to the east and to the north.
struct EarthPlace {
  double longitude_deg = 0.0;
  double latitude_deg = 0.0;
};

// Between a map's x, y (in the units of its coordinate system, which are metres in worlds) and places on the earth, by
// PROJ, without its network. For one thread at a time.
class Geographic {
 public:
  // `definition`: a PROJ string, WKT or "EPSG:…", as an OpenDRIVE file's geoReference or an elevation file says it.
  // Wrong input where PROJ does not know it, or it is no projection.
  static base::Result<Geographic> Make(const std::string& definition);

  // Nothing where the projection has no such place.
  std::optional<EarthPlace> ToEarth(double x_m, double y_m) const;
  // Metres east and north in the map, as the coordinate system counts them.
  std::optional<Eigen::Vector2d> ToMap(const EarthPlace& place) const;

 private:
  explicit Geographic(std::shared_ptr<const MapTransform> transform) : transform_(std::move(transform)) {}

  std::shared_ptr<const MapTransform> transform_;
};

// A coordinate system (a PROJ string, WKT, "EPSG:…") as a PROJ string without "+type=crs", as OpenDRIVE's geoReference
// wants it. Nothing where PROJ does not know it or has no string for it; an error where PROJ's database cannot be read.
base::Result<std::optional<std::string>> ProjString(const std::string& definition);

}  // namespace rodeira::terrain
