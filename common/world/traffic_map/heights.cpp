// SPDX-License-Identifier: Apache-2.0
#include "common/world/traffic_map/heights.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>

#include "common/core/config/declared.hpp"
#include "common/world/traffic_map/companion_schema.hpp"

namespace rodeira::traffic_map {
namespace {

bool HasLowerIndex(const CurveHeights& heights, std::int32_t curve) { return heights.curve < curve; }

// A key that is an element's number; nothing, after a problem, where it is none.
std::optional<std::int32_t> NumberOf(const config::Map& map, const std::string& key, std::string_view what) {
  std::int32_t number = 0;
  const auto [end, problem] = std::from_chars(key.data(), key.data() + key.size(), number);
  if (problem == std::errc() && end == key.data() + key.size()) return number;
  map.Problem(key, fmt::format("'{}' is not a {}'s number", key, what));
  return std::nullopt;
}

// The mapping of a key with named values, and the declaration of each value.
std::pair<config::Map, const config::Key&> NamedOf(const config::DeclaredMap& root, std::string_view key) {
  return {root.MapWith(key).OptionalChild(key), config::FindKey(CompanionSchema().keys, key)->of.front()};
}

void ReadCurves(const config::DeclaredMap& root, Heights& heights) {
  const auto [all, declared] = NamedOf(root, "heights_m");
  for (const std::string& key : all.Keys()) {
    CurveHeights one;
    if (const auto number = NumberOf(all, key, "curve")) one.curve = *number;
    const std::vector<double> z = all.Numbers(key, declared.of.front().range);
    if (z.size() == one.z_m.size()) {
      std::copy(z.begin(), z.end(), one.z_m.begin());
    } else {
      all.Problem(key, "config.wrong_length",
                  fmt::format("curve {} has {} heights; 4 were expected, one a control point", key, z.size()));
    }
    one.line = LineOf(all.Place(key));
    const auto at = std::lower_bound(heights.curves.begin(), heights.curves.end(), one.curve, HasLowerIndex);
    if (at != heights.curves.end() && at->curve == one.curve)
      all.Problem(key, "config.duplicate_name", fmt::format("curve {} has heights already", one.curve));
    heights.curves.insert(at, one);
  }
}

LaneSign ReadSign(const config::DeclaredMap& item) {
  std::vector<std::string> kinds;
  for (int i = 0; i < kSignKinds; ++i) kinds.emplace_back(NameOf(static_cast<SignKind>(i)));
  LaneSign sign;
  sign.line = LineOf(item.map().Place());
  sign.lane = static_cast<std::int32_t>(item.Integer("lane"));
  const auto kind = std::find(kinds.begin(), kinds.end(), item.Word("kind"));
  if (kind != kinds.end()) sign.kind = static_cast<SignKind>(kind - kinds.begin());
  sign.before_end_m = item.Number("before_end_m");
  if (sign.kind == SignKind::kSpeedLimit) sign.limit_kmh = item.RequiredNumber("limit_kmh");
  return sign;
}

void ReadFlows(const config::DeclaredMap& root, Heights& heights) {
  const auto [all, declared] = NamedOf(root, "flows_vehph");
  for (const std::string& key : all.Keys()) {
    LaneFlow flow;
    if (const auto number = NumberOf(all, key, "lane")) flow.lane = *number;
    flow.vehph = all.Number(key, declared.range);
    flow.line = LineOf(all.Place(key));
    const auto at = std::lower_bound(heights.flows.begin(), heights.flows.end(), flow.lane,
                                     [](const LaneFlow& f, std::int32_t lane) { return f.lane < lane; });
    if (at != heights.flows.end() && at->lane == flow.lane)
      all.Problem(key, "config.duplicate_name", fmt::format("lane {} has a flow already", flow.lane));
    heights.flows.insert(at, flow);
  }
}

base::Result<Heights> Read(config::File& file) {
  const config::DeclaredMap root(file.root(), CompanionSchema().keys);
  (void)root.Word("rodeira");
  Heights heights;
  const config::DeclaredList lights = root.Items("lights"), signs = root.Items("signs");
  for (std::size_t i = 0; i < lights.size(); ++i) heights.lights.push_back(lights::ReadLightPlan(lights.At(i).map()));
  for (std::size_t i = 0; i < signs.size(); ++i) heights.signs.push_back(ReadSign(signs.At(i)));
  heights.left_hand = root.Word("rule") == "left";
  ReadCurves(root, heights);
  ReadFlows(root, heights);
  if (const base::Status status = file.Finish(); !status) return status.error();
  return heights;
}

}  // namespace

std::string_view NameOf(SignKind kind) {
  constexpr std::array<std::string_view, kSignKinds> kNames = {"stop", "give_way", "priority", "speed_limit"};
  return kNames[static_cast<std::size_t>(kind)];
}

std::size_t LineOf(const std::string& place) {
  std::size_t line = 0;
  const std::size_t colon = place.rfind(':');
  if (colon != std::string::npos) std::from_chars(place.data() + colon + 1, place.data() + place.size(), line);
  return line;
}

std::array<double, 4> Heights::Of(std::int32_t curve) const {
  const auto at = std::lower_bound(curves.begin(), curves.end(), curve, HasLowerIndex);
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

}  // namespace rodeira::traffic_map
