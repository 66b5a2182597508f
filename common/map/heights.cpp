#include "common/map/heights.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "common/config/config.hpp"

namespace rodeira::map {
namespace {

constexpr double kMostHeight_m = 1e4;

bool Below(const CurveHeights& heights, std::int32_t curve) { return heights.curve < curve; }

base::Result<Heights> Read(config::File& file) {
  const config::Map root = file.root();
  (void)root.Choice("rodeira", {"motors/1"});
  const config::Map all = root.OptionalChild("heights_m");
  Heights heights;
  const config::List lights = root.OptionalItems("lights");
  for (std::size_t i = 0; i < lights.size(); ++i) heights.lights.push_back(lights::ReadLightPlan(lights.At(i)));
  for (const std::string& key : all.Keys()) {
    CurveHeights one;
    const auto [end, problem] = std::from_chars(key.data(), key.data() + key.size(), one.curve);
    if (problem != std::errc() || end != key.data() + key.size())
      all.Problem(key, fmt::format("'{}' is not a curve's number", key));
    const std::vector<double> z = all.Numbers(key, {-kMostHeight_m, kMostHeight_m});
    if (z.size() == one.z_m.size()) {
      std::copy(z.begin(), z.end(), one.z_m.begin());
    } else {
      all.Problem(key, fmt::format("curve {} has {} heights; 4 were expected, one a control point", key, z.size()));
    }
    one.line = LineOf(all.Place(key));
    const auto at = std::lower_bound(heights.curves.begin(), heights.curves.end(), one.curve, Below);
    if (at != heights.curves.end() && at->curve == one.curve)
      all.Problem(key, fmt::format("curve {} has heights already", one.curve));
    heights.curves.insert(at, one);
  }
  if (const base::Status status = file.Finish(); !status) return status.error();
  return heights;
}

}  // namespace

std::size_t LineOf(const std::string& place) {
  std::size_t line = 0;
  const std::size_t colon = place.rfind(':');
  if (colon != std::string::npos) std::from_chars(place.data() + colon + 1, place.data() + place.size(), line);
  return line;
}

std::array<double, 4> Heights::Of(std::int32_t curve) const {
  const auto at = std::lower_bound(curves.begin(), curves.end(), curve, Below);
  return at != curves.end() && at->curve == curve ? at->z_m : std::array<double, 4>{};
}

base::Result<Heights> ParseHeights(std::string_view text, const std::filesystem::path& name) {
  auto file = config::File::Parse(text, name);
  if (!file) return file.error();
  return Read(file.value());
}

base::Result<Heights> LoadHeightsOf(const std::filesystem::path& map_file) {
  const std::filesystem::path path = map_file.string() + ".yaml";
  std::error_code problem;
  if (!std::filesystem::exists(path, problem)) return Heights{};
  auto file = config::File::Load(path);
  if (!file) return file.error();
  return Read(file.value());
}

}  // namespace rodeira::map
