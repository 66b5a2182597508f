// SPDX-License-Identifier: Apache-2.0
#include "common/world/terrain/plain_projection.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>

namespace rodeira::terrain {
namespace {

using Parameters = std::map<std::string, std::string, std::less<>>;

// Words of the form +KEY=VALUE, each key once; nothing where one is not.
std::optional<Parameters> Split(std::string_view definition) {
  Parameters parameters;
  while (!definition.empty()) {
    const std::size_t end = std::min(definition.find(' '), definition.size());
    const std::string_view word = definition.substr(0, end);
    definition.remove_prefix(std::min(end + 1, definition.size()));
    const std::size_t equals = word.find('=');
    if (word.empty() || word[0] != '+' || equals == std::string_view::npos) return std::nullopt;
    if (!parameters.emplace(word.substr(1, equals - 1), word.substr(equals + 1)).second) return std::nullopt;
  }
  return parameters;
}

// A number of at most twelve digits with less than `limit` as its magnitude.
std::optional<double> NumberOf(const Parameters& parameters, std::string_view key, double limit) {
  const auto found = parameters.find(key);
  if (found == parameters.end()) return std::nullopt;
  const std::string& text = found->second;
  constexpr std::size_t kMaxLetters = 12;
  if (text.size() > kMaxLetters || text.find_first_not_of("-.0123456789") != std::string::npos) return std::nullopt;
  double value = 0.0;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
  if (read.ec != std::errc() || read.ptr != text.data() + text.size()) return std::nullopt;
  if (!(std::fabs(value) < limit) || (value == 0.0 && std::signbit(value))) return std::nullopt;
  return value;
}

struct Mercator {
  double latitude_deg = 0.0, longitude_deg = 0.0, scale = 1.0, easting_m = 0.0, northing_m = 0.0;
};

std::optional<Mercator> MercatorOf(const Parameters& parameters) {
  constexpr double kMax_m = 1e8, kMaxScale = 10.0, kMinScale = 1e-3;
  const std::string& kind = parameters.find("proj")->second;
  if (kind == "utm" && parameters.size() == 4) {
    const auto zone = NumberOf(parameters, "zone", 60.5);
    if (!zone || *zone < 1.0 || *zone != std::floor(*zone)) return std::nullopt;
    return Mercator{0.0, 6.0 * *zone - 183.0, 0.9996, 500'000.0, 0.0};
  }
  if (kind != "tmerc" || parameters.size() != 8) return std::nullopt;
  const auto latitude = NumberOf(parameters, "lat_0", 90.0), longitude = NumberOf(parameters, "lon_0", 180.0),
             scale = NumberOf(parameters, "k", kMaxScale), easting = NumberOf(parameters, "x_0", kMax_m),
             northing = NumberOf(parameters, "y_0", kMax_m);
  if (!latitude || !longitude || !scale || *scale < kMinScale || !easting || !northing) return std::nullopt;
  return Mercator{*latitude, *longitude, *scale, *easting, *northing};
}

// With a point, as Esri's form has it; empty where it would have an exponent.
std::string Decimal(double value) {
  std::string text = fmt::format("{:.15g}", value);
  if (text.find('e') != std::string::npos) return "";
  return text.find('.') == std::string::npos ? text + ".0" : text;
}

}  // namespace

std::optional<std::string> PlainProjectionWkt(std::string_view definition) {
  const auto parameters = Split(definition);
  if (!parameters) return std::nullopt;
  for (const char* key : {"proj", "ellps", "units"})
    if (!parameters->contains(key)) return std::nullopt;
  const std::string& ellipsoid = parameters->find("ellps")->second;
  if ((ellipsoid != "GRS80" && ellipsoid != "WGS84") || parameters->find("units")->second != "m") return std::nullopt;
  const auto mercator = MercatorOf(*parameters);
  if (!mercator) return std::nullopt;
  const std::string spheroid =
      ellipsoid == "GRS80" ? R"("GRS_1980",6378137.0,298.257222101)" : R"("WGS_1984",6378137.0,298.257223563)";
  std::string wkt =
      fmt::format(R"(PROJCS["unknown",GEOGCS["GCS_unknown",DATUM["D_Unknown_based_on_{}_ellipsoid",SPHEROID[{}]],)"
                  R"(PRIMEM["Greenwich",0.0],UNIT["Degree",0.0174532925199433]],PROJECTION["Transverse_Mercator"])",
                  ellipsoid, spheroid);
  const std::pair<const char*, double> values[] = {{"False_Easting", mercator->easting_m},
                                                   {"False_Northing", mercator->northing_m},
                                                   {"Central_Meridian", mercator->longitude_deg},
                                                   {"Scale_Factor", mercator->scale},
                                                   {"Latitude_Of_Origin", mercator->latitude_deg}};
  for (const auto& [name, value] : values) {
    const std::string text = Decimal(value);
    if (text.empty()) return std::nullopt;
    wkt += fmt::format(R"(,PARAMETER["{}",{}])", name, text);
  }
  return wkt + R"(,UNIT["Meter",1.0]])";
}

}  // namespace rodeira::terrain
