// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/dynamics/usual_tyre.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>

namespace rodeira::dynamics {
namespace {

struct TyreRange {
  double low, high;
};

// A quantity with the range of the tyres of road vehicles, and the range of all tyres with room on both sides.
struct TyreQuantity {
  std::string_view key, what, unit;
  double value;
  TyreRange usual, possible;
};

constexpr double kUsualForce = 5.0, kPossibleForce = 100.0;  // over the load

bool IsWithin(const TyreRange& range, double value) { return value >= range.low && value <= range.high; }

std::vector<TyreQuantity> QuantitiesOf(const MagicFormulaSettings& tyre, const AligningSettings* aligning) {
  const double load_N = tyre.fnomin * tyre.lfzo;
  const auto loads = [load_N](double low, double high) { return TyreRange{low * load_N, high * load_N}; };
  std::vector<TyreQuantity> quantities{
      {"FNOMIN", "the nominal load, FNOMIN times LFZO,", " N", load_N, {200.0, 1e5}, {1.0, 1e7}},
      {"FZMAX", "the largest load, FZMAX,", " N", tyre.fzmax, {200.0, 1e6}, {1.0, 1e7}},
      {"NOMPRES", "the nominal pressure, NOMPRES,", " Pa", tyre.nompres, {3e4, 2e6}, {1.0, 1e9}},
      {"INFLPRES", "the inflation pressure, INFLPRES,", " Pa", tyre.inflpres, {3e4, 2e6}, {1.0, 1e9}},
      {"PKX1", "the slip stiffness at FNOMIN, by PKX1 and its partners,", " N", LongitudinalStiffness(tyre, load_N),
       loads(2.0, 200.0), loads(0.01, 1e4)},
      {"PKY1", "the cornering stiffness at FNOMIN, by PKY1, PKY2 and PKY4,", " N", -CorneringStiffness(tyre, load_N),
       loads(-100.0, -2.0), loads(-1e4, -0.01)},
      {"PDX1",
       "the longitudinal friction at FNOMIN, PDX1 times LMUX,",
       "",
       LongitudinalPeak(tyre, load_N, 1.0) / load_N,
       {0.1, 4.0},
       {1e-3, kPossibleForce}},
      {"PDY1",
       "the lateral friction at FNOMIN, PDY1 times LMUY,",
       "",
       LateralPeak(tyre, load_N, 1.0) / load_N,
       {0.1, 4.0},
       {1e-3, kPossibleForce}}};
  if (aligning == nullptr || !(aligning->unloaded_radius > 0.0)) return quantities;
  const double radius_m = aligning->unloaded_radius;
  quantities.push_back({"UNLOADED_RADIUS", "the radius, UNLOADED_RADIUS,", " m", radius_m, {0.1, 1.5}, {0.01, 10.0}});
  quantities.push_back({"QDZ1",
                        "the pneumatic trail at FNOMIN, QDZ1 times UNLOADED_RADIUS,",
                        " m",
                        std::fabs(aligning->qdz1 * radius_m),
                        {0.0, 0.3},
                        {0.0, 10.0}});
  return quantities;
}

double ForceOverLoad(const MagicFormulaSettings& tyre, const TyreSlip& slip, double load_N) {
  const TyreForces forces = SteadyForces(tyre, slip, load_N, 1.0);
  const double over = std::hypot(forces.longitudinal_N, forces.lateral_N) / load_N;
  return std::isfinite(over) ? over : std::numeric_limits<double>::infinity();
}

struct LargestForce {
  TyreSlip slip;
  double load_N = 0.0, over_load = 0.0;
};

LargestForce FindLargestForce(const MagicFormulaSettings& tyre) {
  LargestForce largest;
  for (const double share : {0.25, 1.0, 2.0}) {
    const double load_N = share * tyre.fnomin * tyre.lfzo;
    for (double kappa = -1.0; kappa <= 1.0; kappa += 0.25) {
      for (double alpha = -1.0; alpha <= 1.0; alpha += 0.25) {
        for (const double camber : {-0.1, 0.0, 0.1}) {
          const TyreSlip slip{kappa, alpha, camber};
          const double over = ForceOverLoad(tyre, slip, load_N);
          if (over > largest.over_load) largest = {slip, load_N, over};
        }
      }
    }
  }
  return largest;
}

// The coefficient without which that force is smallest.
std::string_view CauseOf(const LargestForce& largest, const MagicFormulaSettings& tyre) {
  const MagicFormulaSettings usual;
  std::string_view cause = "FNOMIN";
  double least = largest.over_load;
  for (const MagicFormulaCoefficient& each : MagicFormulaCoefficients()) {
    MagicFormulaSettings other = tyre;
    other.*each.member = usual.*each.member;
    const double over = ForceOverLoad(other, largest.slip, largest.load_N);
    if (over < least) least = over, cause = each.name;
  }
  return cause;
}

}  // namespace

std::vector<UnusualTyreValue> UnusualTyreValues(const MagicFormulaSettings& tyre, const AligningSettings* aligning) {
  std::vector<UnusualTyreValue> found;
  for (const TyreQuantity& each : QuantitiesOf(tyre, aligning)) {
    if (IsWithin(each.usual, each.value)) continue;
    const bool is_possible = IsWithin(each.possible, each.value);
    const TyreRange& range = is_possible ? each.usual : each.possible;
    const bool pushes_outward = each.key == "PKY1" && each.value > 0.0;
    found.push_back({each.key,
                     fmt::format("{} is {:.6g}{}; {:g} to {:g}{} {}{}", each.what, each.value, each.unit, range.low,
                                 range.high, each.unit, is_possible ? "is usual of a road vehicle" : "was expected",
                                 pushes_outward ? ": this tyre pushes the car outward" : ""),
                     !is_possible});
  }
  if (!found.empty()) return found;
  const LargestForce largest = FindLargestForce(tyre);
  if (largest.over_load <= kUsualForce) return {};
  const bool is_impossible = largest.over_load > kPossibleForce;
  return {
      {CauseOf(largest, tyre),
       fmt::format("the force is {:.6g} times the load of {:.0f} N at slip {:g}, tangent of the slip angle {:g} and "
                   "camber {:g} rad; at most {:g} times {}",
                   largest.over_load, largest.load_N, largest.slip.kappa, largest.slip.tan_alpha,
                   largest.slip.camber_rad, is_impossible ? kPossibleForce : kUsualForce,
                   is_impossible ? "was expected" : "is usual of a road vehicle"),
       is_impossible}};
}

}  // namespace rodeira::dynamics
