// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/dynamics/fiala_file.hpp"

#include <fmt/format.h>

#include <array>
#include <optional>

#include "common/core/geometry/angle.hpp"

namespace rodeira::dynamics {
namespace {

constexpr double kSoftestFiala_N = 1.0, kStiffestFiala_N = 1e9;

struct FialaUnit {
  std::string_view name;
  double in_si;
};
constexpr auto kFialaForces = std::to_array<FialaUnit>({{"NEWTON", 1.0},
                                                        {"N", 1.0},
                                                        {"KNEWTON", 1000.0},
                                                        {"KILONEWTON", 1000.0},
                                                        {"KN", 1000.0},
                                                        {"POUND_FORCE", 4.4482216152605},
                                                        {"LBF", 4.4482216152605},
                                                        {"KG_FORCE", 9.80665}});
constexpr auto kFialaAngles = std::to_array<FialaUnit>({{"RADIANS", 1.0},
                                                        {"RADIAN", 1.0},
                                                        {"RAD", 1.0},
                                                        {"DEGREES", geometry::kPi / 180.0},
                                                        {"DEGREE", geometry::kPi / 180.0},
                                                        {"DEG", geometry::kPi / 180.0}});

std::string FialaPlace(std::string_view name, const TirEntry& entry) { return fmt::format("{}:{}", name, entry.line); }

base::Result<double> FialaUnitFactor(const TirText& tir, std::string_view name, std::string_view quantity,
                                     std::span<const FialaUnit> units) {
  for (const TirEntry& entry : tir.entries) {
    if (entry.section != "UNITS" || entry.key != quantity) continue;
    for (const FialaUnit& unit : units) {
      if (UpperCase(entry.value) == unit.name) return unit.in_si;
    }
    return base::WrongInput("tyre.wrong_value",
                            fmt::format("{} is given in '{}'; '{}' was expected", quantity, entry.value, units[0].name),
                            FialaPlace(name, entry));
  }
  return 1.0;
}

base::Result<double> FialaNumber(const TirText& tir, std::string_view name, std::string_view key) {
  const TirEntry* found = nullptr;
  for (const TirEntry& entry : tir.entries) {
    if (entry.key != key) continue;
    if (found != nullptr)
      return base::WrongInput("tyre.duplicate_key", fmt::format("'{}' is given in line {} already", key, found->line),
                              FialaPlace(name, entry));
    found = &entry;
  }
  if (found == nullptr || found->value.empty())
    return base::WrongInput("tyre.missing_key",
                            fmt::format("a Fiala tyre with '{}' was expected, and there is none", key),
                            std::string(name));
  const auto number = TirNumber(found->value);
  if (!number)
    return base::WrongInput("tyre.wrong_value", fmt::format("'{}' is '{}'; a number was expected", key, found->value),
                            FialaPlace(name, *found));
  return *number;
}

}  // namespace

std::string FialaProblem(const FialaSettings& fiala) {
  for (const auto& [key, value] : {std::pair("CSLIP", fiala.cslip_N), std::pair("CALPHA", fiala.calpha_N),
                                   std::pair("UMIN", fiala.umin), std::pair("UMAX", fiala.umax)}) {
    if (!(value > 0.0)) return fmt::format("'{}' is {:g}; more than 0 was expected", key, value);
  }
  for (const auto& [key, value] : {std::pair("CSLIP", fiala.cslip_N), std::pair("CALPHA", fiala.calpha_N)}) {
    if (value < kSoftestFiala_N || value > kStiffestFiala_N)
      return fmt::format("'{}' is {:g} N; {:g} to {:g} N was expected", key, value, kSoftestFiala_N, kStiffestFiala_N);
  }
  if (fiala.umin > fiala.umax || fiala.umax > 5.0)
    return fmt::format("'UMIN' is {:g} and 'UMAX' {:g}; 0 < UMIN <= UMAX <= 5 was expected", fiala.umin, fiala.umax);
  return {};
}

base::Result<FialaSettings> ReadFialaTir(const TirText& tir, std::string_view name) {
  const auto force = FialaUnitFactor(tir, name, "FORCE", kFialaForces);
  if (!force) return force.error();
  const auto angle = FialaUnitFactor(tir, name, "ANGLE", kFialaAngles);
  if (!angle) return angle.error();
  FialaSettings fiala;
  for (const auto& [key, member, factor] :
       {std::tuple("CSLIP", &FialaSettings::cslip_N, force.value()),
        std::tuple("CALPHA", &FialaSettings::calpha_N, force.value() / angle.value()),
        std::tuple("UMIN", &FialaSettings::umin, 1.0), std::tuple("UMAX", &FialaSettings::umax, 1.0)}) {
    const auto number = FialaNumber(tir, name, key);
    if (!number) return number.error();
    fiala.*member = number.value() * factor;
  }
  const std::string problem = FialaProblem(fiala);
  if (problem.empty()) return fiala;
  const TirEntry* entry = tir.Find(problem.substr(1, problem.find('\'', 1) - 1));
  return base::WrongInput("tyre.wrong_line", problem, entry == nullptr ? std::string(name) : FialaPlace(name, *entry));
}

}  // namespace rodeira::dynamics
