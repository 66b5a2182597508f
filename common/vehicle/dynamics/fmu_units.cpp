// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/dynamics/fmu_units.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "common/core/geometry/angle.hpp"

namespace rodeira::dynamics {
namespace {

// In the order of fmi::UnitDefinition.
using Exponents = std::array<int, 8>;
constexpr std::size_t kRadian = 7;
constexpr Exponents kOne{}, kLength{0, 1}, kAngle{0, 0, 0, 0, 0, 0, 0, 1}, kSpeed{0, 1, -1},
    kAngularRate{0, 0, -1, 0, 0, 0, 0, 1}, kForce{1, 1, -2}, kMoment{1, 2, -2}, kMassRate{1, 0, -1},
    kPressure{1, -1, -2};

struct UsualUnit {
  std::string_view name;
  Exponents exponents;
  double factor;
};
constexpr double kDegree_rad = geometry::kPi / 180.0;
constexpr auto kUsualUnits = std::to_array<UsualUnit>({{"1", kOne, 1.0},
                                                       {"-", kOne, 1.0},
                                                       {"%", kOne, 0.01},
                                                       {"m", kLength, 1.0},
                                                       {"metre", kLength, 1.0},
                                                       {"meter", kLength, 1.0},
                                                       {"mm", kLength, 1e-3},
                                                       {"cm", kLength, 1e-2},
                                                       {"km", kLength, 1e3},
                                                       {"rad", kAngle, 1.0},
                                                       {"radian", kAngle, 1.0},
                                                       {"deg", kAngle, kDegree_rad},
                                                       {"degree", kAngle, kDegree_rad},
                                                       {"m/s", kSpeed, 1.0},
                                                       {"m.s-1", kSpeed, 1.0},
                                                       {"mm/s", kSpeed, 1e-3},
                                                       {"km/h", kSpeed, 1.0 / 3.6},
                                                       {"rad/s", kAngularRate, 1.0},
                                                       {"rad.s-1", kAngularRate, 1.0},
                                                       {"deg/s", kAngularRate, kDegree_rad},
                                                       {"rev/min", kAngularRate, geometry::kPi / 30.0},
                                                       {"rpm", kAngularRate, geometry::kPi / 30.0},
                                                       {"N", kForce, 1.0},
                                                       {"kN", kForce, 1e3},
                                                       {"N.m", kMoment, 1.0},
                                                       {"N*m", kMoment, 1.0},
                                                       {"Nm", kMoment, 1.0},
                                                       {"kN.m", kMoment, 1e3},
                                                       {"kg/s", kMassRate, 1.0},
                                                       {"kg.s-1", kMassRate, 1.0},
                                                       {"g/s", kMassRate, 1e-3},
                                                       {"kg/h", kMassRate, 1.0 / 3600.0},
                                                       {"Pa", kPressure, 1.0},
                                                       {"bar", kPressure, 1e5}});

const UsualUnit* Usual(std::string_view name) {
  const auto found = std::ranges::find(kUsualUnits, name, &UsualUnit::name);
  return found == kUsualUnits.end() ? nullptr : &*found;
}

}  // namespace

std::optional<UnitConversion> ConversionOf(const fmi::Description& description, std::string_view declared,
                                           std::string_view ours) {
  const UsualUnit* const wanted = Usual(ours);
  if (wanted == nullptr) return std::nullopt;
  if (declared.empty() || declared == ours) return UnitConversion{};
  const UsualUnit* const usual = Usual(declared);
  const auto defined = description.units.find(declared);
  if (defined == description.units.end()) {
    if (usual == nullptr || usual->exponents != wanted->exponents) return std::nullopt;
    return UnitConversion{usual->factor, 0.0};
  }
  const fmi::UnitDefinition& unit = defined->second;
  if (!std::isfinite(unit.factor) || unit.factor == 0.0 || !std::isfinite(unit.offset)) return std::nullopt;
  Exponents exponents = unit.exponents;
  const bool is_named_as_angle = usual != nullptr && usual->exponents[kRadian] != 0;
  if (exponents[kRadian] == 0 && wanted->exponents[kRadian] != 0 && is_named_as_angle)
    exponents[kRadian] = wanted->exponents[kRadian];
  if (exponents != wanted->exponents) return std::nullopt;
  // "deg" and "rpm" without radian and without a factor name their factor by themselves.
  const bool is_bare = is_named_as_angle && unit.exponents[kRadian] == 0;
  return UnitConversion{is_bare ? usual->factor : unit.factor, is_bare ? 0.0 : unit.offset};
}

}  // namespace rodeira::dynamics
