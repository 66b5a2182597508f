// SPDX-License-Identifier: Apache-2.0
// Bodies and drivers of the agents, drawn at random.
#include <algorithm>
#include <array>
#include <span>

#include "common/core/base/assert.hpp"
#include "common/core/base/random.hpp"
#include "common/traffic/state/traffic_settings.hpp"

namespace rodeira::traffic {
namespace {

// Purposes of draws, keys beside seed and agent; never renumber.
enum Draw : std::uint64_t {
  kSize = 1,
  kColour = 2,
  kSpeed = 3,
  kTimeGap = 4,
  kAcceleration = 5,
  kBraking = 6,
  kShade = 7
};

struct Body {
  double length_m, width_m, height_m, wheelbase_m, wheel_radius_m, mass_kg;
};
constexpr std::array<Body, 4> kCars{{
    {3.6, 1.62, 1.48, 2.35, 0.28, 1000.0},  // small
    {4.1, 1.72, 1.46, 2.55, 0.30, 1250.0},  // compact
    {4.5, 1.78, 1.45, 2.68, 0.31, 1500.0},  // saloon
    {4.6, 1.82, 1.66, 2.70, 0.33, 1750.0},  // off-roader
}};
constexpr std::array<Body, 1> kVans{{{5.2, 1.92, 2.10, 3.20, 0.34, 2100.0}}};
constexpr std::array<Body, 2> kLorries{{
    {7.2, 2.30, 3.00, 3.90, 0.40, 6500.0},   // of 7.5 t
    {8.4, 2.45, 3.40, 4.60, 0.48, 11000.0},  // of 16 t
}};
constexpr std::array<Body, 1> kBuses{{{10.5, 2.50, 3.10, 5.30, 0.48, 13000.0}}};

// A kind's bodies, how it accelerates beside a car, and the speed that it is allowed outside of towns (Germany: lorries
// 80 km/h, buses 100 km/h).
struct Kind {
  std::span<const Body> bodies;
  double liveliness, top_mps;
};
// A vehicle with full physics leaves its line by this, to both sides together.
constexpr double kFullPhysicsWidth_m = 0.4;
constexpr double kNoTop_mps = 1e3;
constexpr std::array<Kind, 4> kKinds{
    {{kCars, 1.0, kNoTop_mps}, {kVans, 1.0, kNoTop_mps}, {kLorries, 0.6, 80.0 / 3.6}, {kBuses, 0.7, 100.0 / 3.6}}};

constexpr std::array<std::uint32_t, 8> kPaints{0xE8E8E6, 0x1B1C1E, 0x8A8D8F, 0x3A4A63,
                                               0x9C2A2A, 0xC9CBCD, 0x4B5A45, 0xB59A5A};

void SetMeasures(const Body& body, AgentTraits& traits) {
  traits.length_m = body.length_m;
  traits.width_m = body.width_m;
  traits.height_m = body.height_m;
  traits.wheelbase_m = body.wheelbase_m;
  traits.wheel_radius_m = body.wheel_radius_m;
  traits.mass_kg = body.mass_kg;
}

}  // namespace

AgentTraits TraitsOfBody(std::uint32_t body) {
  AgentTraits traits;
  traits.body = body;
  for (std::size_t k = 0; k < kKinds.size(); ++k) {
    if (body < kKinds[k].bodies.size()) {
      traits.kind = static_cast<VehicleKind>(k);
      SetMeasures(kKinds[k].bodies[body], traits);
      return traits;
    }
    body -= static_cast<std::uint32_t>(kKinds[k].bodies.size());
  }
  RODEIRA_ASSERT(false);
  return traits;
}

AgentTraits TraitsOf(const TrafficSettings& settings, const VehicleMix& mix, std::uint64_t key) {
  const auto uniform = [&](Draw what, double low, double high) {
    return base::RandomUniform({settings.seed, key, what}, low, high);
  };
  AgentTraits traits;
  double draw = uniform(kSize, 0.0, 1.0);  // the kind, and among its bodies each as often
  std::size_t k = 0;
  for (std::size_t i = 0; i < kKinds.size(); ++i) {
    if (mix.shares[i] <= 0.0) continue;
    k = i;
    if (draw < mix.shares[i]) break;
    draw -= mix.shares[i];
  }
  const Kind& kind = kKinds[k];
  const auto among = static_cast<std::size_t>(draw / mix.shares[k] * static_cast<double>(kind.bodies.size()));
  const Body& body = kind.bodies[std::min(among, kind.bodies.size() - 1)];
  traits.body = static_cast<std::uint32_t>(&body - kKinds[k].bodies.data());
  for (std::size_t i = 0; i < k; ++i) traits.body += static_cast<std::uint32_t>(kKinds[i].bodies.size());
  traits.kind = static_cast<VehicleKind>(k);
  SetMeasures(body, traits);
  traits.top_mps = kind.top_mps;
  if (kind.liveliness < 1.0) traits.start_mps2 *= (1.0 - settings.variety) * kind.liveliness;
  traits.colour_rgb = kPaints[static_cast<std::size_t>(uniform(kColour, 0.0, static_cast<double>(kPaints.size())))];
  traits.speed_factor = uniform(kSpeed, settings.speed_factor_low, settings.speed_factor_high);
  const auto varied = [&](Draw what, double middle) {
    return middle * uniform(what, 1.0 - settings.variety, 1.0 + settings.variety);
  };
  traits.idm = settings.idm;
  traits.idm.time_gap_s = varied(kTimeGap, settings.idm.time_gap_s);
  traits.idm.acceleration_mps2 = kind.liveliness * varied(kAcceleration, settings.idm.acceleration_mps2);
  traits.idm.braking_mps2 = varied(kBraking, settings.idm.braking_mps2);
  return traits;
}

AgentTraits TraitsOf(const TrafficSettings& settings, std::uint32_t id) {
  if (id < settings.vehicles || id - settings.vehicles >= settings.scripted.size())
    return TraitsOf(settings, settings.mix, id);
  VehicleMix one{{0.0, 0.0, 0.0, 0.0}};
  one.shares[static_cast<std::size_t>(settings.scripted[id - settings.vehicles])] = 1.0;
  return TraitsOf(settings, one, id);
}

namespace {

// Whether a vehicle of this kind may be on the road.
bool MayBe(const TrafficSettings& settings, std::size_t k) {
  return settings.mix.shares[k] > 0.0 ||
         std::count(settings.scripted.begin(), settings.scripted.end(), static_cast<VehicleKind>(k)) > 0 ||
         std::any_of(settings.demand.flows.begin(), settings.demand.flows.end(),
                     [&](const FlowSettings& flow) { return flow.mix && flow.mix->shares[k] > 0.0; });
}

}  // namespace

std::vector<std::uint32_t> BodiesOf(const TrafficSettings& settings) {
  std::vector<std::uint32_t> bodies;
  std::uint32_t body = 0;
  for (std::size_t k = 0; k < kKinds.size(); ++k) {
    for (std::size_t i = 0; i < kKinds[k].bodies.size(); ++i, ++body) {
      if (MayBe(settings, k)) bodies.push_back(body);
    }
  }
  return bodies;
}

lanes::LargestCar LargestOf(const TrafficSettings& settings) {
  lanes::LargestCar largest;
  for (const std::uint32_t body : BodiesOf(settings)) {
    const AgentTraits traits = TraitsOfBody(body);
    largest.length_m = std::max(largest.length_m, traits.length_m);
    largest.width_m = std::max(largest.width_m, traits.width_m);
    largest.wheelbase_m = std::max(largest.wheelbase_m, traits.wheelbase_m);
  }
  if (settings.physics == Physics::kFull) largest.width_m += kFullPhysicsWidth_m;
  return largest;
}

}  // namespace rodeira::traffic
