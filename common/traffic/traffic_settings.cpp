#include "common/traffic/traffic_settings.hpp"

#include <array>

#include "common/base/random.hpp"

namespace rodeira::traffic {
namespace {

// Purposes of draws, keys beside seed and agent; never renumber.
enum Draw : std::uint64_t { kSize = 1, kColour = 2, kSpeed = 3, kTimeGap = 4, kAcceleration = 5, kBraking = 6, kShade = 7 };

struct Body {
  double length_m, width_m, height_m, wheelbase_m, wheel_radius_m, mass_kg;
};
constexpr std::array<Body, 5> kBodies{{
    {3.6, 1.62, 1.48, 2.35, 0.28, 1000.0},  // small
    {4.1, 1.72, 1.46, 2.55, 0.30, 1250.0},  // compact
    {4.5, 1.78, 1.45, 2.68, 0.31, 1500.0},  // saloon
    {4.6, 1.82, 1.66, 2.70, 0.33, 1750.0},  // off-roader
    {5.2, 1.92, 2.10, 3.20, 0.34, 2100.0},  // van
}};
constexpr std::array<std::uint32_t, 8> kPaints{0xE8E8E6, 0x1B1C1E, 0x8A8D8F, 0x3A4A63, 0x9C2A2A, 0xC9CBCD, 0x4B5A45, 0xB59A5A};

}  // namespace

AgentTraits TraitsOf(const TrafficSettings& settings, std::uint32_t id) {
  const auto uniform = [&](Draw what, double low, double high) { return base::RandomUniform({settings.seed, id, what}, low, high); };
  AgentTraits traits;
  const Body& body = kBodies[static_cast<std::size_t>(uniform(kSize, 0.0, static_cast<double>(kBodies.size())))];
  traits.length_m = body.length_m;
  traits.width_m = body.width_m;
  traits.height_m = body.height_m;
  traits.wheelbase_m = body.wheelbase_m;
  traits.wheel_radius_m = body.wheel_radius_m;
  traits.mass_kg = body.mass_kg;
  traits.colour_rgb = kPaints[static_cast<std::size_t>(uniform(kColour, 0.0, static_cast<double>(kPaints.size())))];
  traits.speed_factor = uniform(kSpeed, settings.speed_factor_low, settings.speed_factor_high);
  const auto varied = [&](Draw what, double middle) { return middle * uniform(what, 1.0 - settings.variety, 1.0 + settings.variety); };
  traits.idm = settings.idm;
  traits.idm.time_gap_s = varied(kTimeGap, settings.idm.time_gap_s);
  traits.idm.acceleration_mps2 = varied(kAcceleration, settings.idm.acceleration_mps2);
  traits.idm.braking_mps2 = varied(kBraking, settings.idm.braking_mps2);
  return traits;
}

TrafficSettings ReadTraffic(const config::Map& map, std::uint64_t seed) {
  TrafficSettings t;
  t.seed = seed;
  t.vehicles = static_cast<std::uint32_t>(map.Integer("vehicles", 0, 100000, t.vehicles));
  t.variety = map.Number("variety", {0.0, 0.5}, t.variety);
  t.speed_factor_low = map.Number("speed_factor_low", {0.2, 2.0}, t.speed_factor_low);
  t.speed_factor_high = map.Number("speed_factor_high", {0.2, 2.0}, t.speed_factor_high);
  if (t.speed_factor_high < t.speed_factor_low) map.Problem("speed_factor_high", "'speed_factor_high' is below 'speed_factor_low'");
  t.side_margin_m = map.Number("side_margin_m", {0.0, 2.0}, t.side_margin_m);
  t.sight_m = map.Number("sight_m", {20.0, 2000.0}, t.sight_m);
  const config::Map follow = map.OptionalChild("following");
  t.idm.time_gap_s = follow.Number("time_gap_s", {0.2, 10.0}, t.idm.time_gap_s);
  t.idm.standing_gap_m = follow.Number("standing_gap_m", {0.5, 20.0}, t.idm.standing_gap_m);
  t.idm.acceleration_mps2 = follow.Number("acceleration_mps2", {0.2, 5.0}, t.idm.acceleration_mps2);
  t.idm.braking_mps2 = follow.Number("braking_mps2", {0.5, 8.0}, t.idm.braking_mps2);
  t.idm.hardest_mps2 = follow.Number("hardest_mps2", {1.0, 12.0}, t.idm.hardest_mps2);
  const config::Map comfort = map.OptionalChild("comfort");
  t.speed.lateral_mps2 = comfort.Number("lateral_mps2", {0.3, 8.0}, t.speed.lateral_mps2);
  t.speed.vertical_mps2 = comfort.Number("vertical_mps2", {0.3, 8.0}, t.speed.vertical_mps2);
  t.speed.braking_mps2 = comfort.Number("braking_mps2", {0.3, 6.0}, t.speed.braking_mps2);
  t.speed.steep_grade = comfort.Number("steep_grade", {0.0, 1.0}, t.speed.steep_grade);
  t.speed.steep_factor = comfort.Number("steep_factor", {0.2, 1.0}, t.speed.steep_factor);
  const config::Map change = map.OptionalChild("lane_changes");
  t.changes_lanes = change.Flag("allowed", t.changes_lanes);
  t.lane_changes.politeness = change.Number("politeness", {0.0, 1.0}, t.lane_changes.politeness);
  t.lane_changes.threshold_mps2 = change.Number("threshold_mps2", {0.0, 2.0}, t.lane_changes.threshold_mps2);
  t.lane_changes.bias_mps2 = change.Number("bias_mps2", {0.0, 2.0}, t.lane_changes.bias_mps2);
  t.lane_changes.safe_mps2 = change.Number("safe_mps2", {0.5, 8.0}, t.lane_changes.safe_mps2);
  return t;
}

base::Result<TrafficSettings> LoadTraffic(const std::filesystem::path& path, std::uint64_t seed) {
  auto file = config::File::Load(path);
  if (!file) return file.error();
  (void)file.value().root().Choice("rodeira", {"traffic/1"});
  const TrafficSettings settings = ReadTraffic(file.value().root(), seed);
  if (auto status = file.value().Finish(); !status) return status.error();
  return settings;
}

}  // namespace rodeira::traffic
