// SPDX-License-Identifier: Apache-2.0
#include "common/analysis/measures/conflict.hpp"

#include <algorithm>
#include <cmath>

#include "common/analysis/measures/statistics.hpp"
#include "common/core/base/assert.hpp"

namespace rodeira::measures {
namespace {

constexpr const char* kNoLeader = "no leader";

// weight(TTC) added up over the samples below the threshold, times the period.
template <class Weight>
Measure Exposed(Series ttc_s, Series gap_m, double rate_hz, double threshold_s, const char* unit,
                const Weight& weight) {
  const UsedOptions used = Used({{"threshold_s", threshold_s}});
  const std::size_t n = CountValid(gap_m);
  if (n == 0) return NotFound(kNoLeader, unit, 0, gap_m.size(), used);
  double sum = 0.0;
  for (const double ttc : ttc_s) {
    if (!std::isnan(ttc) && ttc < threshold_s) sum += weight(ttc);
  }
  return Found(sum / rate_hz, unit, n, gap_m.size(), used);
}

}  // namespace

double TimeToCollision_s(double gap_m, double own_mps, double leader_mps) {
  const double closing = own_mps - leader_mps;
  if (std::isnan(gap_m) || !(closing > 0.0)) return kMissing;
  return std::max(gap_m, 0.0) / closing;
}

double TimeToCollision_s(double gap_m, double own_mps, double leader_mps, double own_mps2, double leader_mps2) {
  const double dv = own_mps - leader_mps, da = own_mps2 - leader_mps2;
  if (std::isnan(gap_m + dv + da)) return kMissing;
  if (gap_m <= 0.0) return 0.0;
  // gap - dv t - da t^2 / 2 = 0: t = 2 gap / (dv + sqrt(dv^2 + 2 da gap)), the smaller root that is not negative.
  const double radicand = dv * dv + 2.0 * da * gap_m;
  if (radicand < 0.0) return kMissing;
  const double denominator = dv + std::sqrt(radicand);
  return denominator > 0.0 ? 2.0 * gap_m / denominator : kMissing;
}

double Drac_mps2(double gap_m, double own_mps, double leader_mps) {
  const double closing = own_mps - leader_mps;
  if (!(gap_m > 0.0) || !(closing > 0.0)) return kMissing;
  return closing * closing / (2.0 * gap_m);
}

double ModifiedDrac_mps2(double ttc_s, double closing_mps, double reaction_s) {
  if (!(ttc_s > reaction_s)) return kMissing;
  return closing_mps / (2.0 * (ttc_s - reaction_s));
}

double BrakingLeaderDrac_mps2(double gap_m, double own_mps, double leader_mps, double leader_mps2) {
  RODEIRA_ASSERT(leader_mps2 > 0.0);
  const double way = gap_m + leader_mps * leader_mps / (2.0 * leader_mps2);
  if (!(way > 0.0)) return kMissing;
  return own_mps * own_mps / (2.0 * way);
}

std::vector<double> TtcSeries(Series gap_m, Series own_mps, Series leader_mps) {
  std::vector<double> ttc(gap_m.size());
  for (std::size_t i = 0; i < ttc.size(); ++i) ttc[i] = TimeToCollision_s(gap_m[i], own_mps[i], leader_mps[i]);
  return ttc;
}

std::vector<double> DracSeries(Series gap_m, Series own_mps, Series leader_mps) {
  std::vector<double> drac(gap_m.size());
  for (std::size_t i = 0; i < drac.size(); ++i) drac[i] = Drac_mps2(gap_m[i], own_mps[i], leader_mps[i]);
  return drac;
}

Measure TimeExposedTtc(Series ttc_s, Series gap_m, double rate_hz, double threshold_s) {
  return Exposed(ttc_s, gap_m, rate_hz, threshold_s, "s", [](double) { return 1.0; });
}

Measure TimeIntegratedTtc(Series ttc_s, Series gap_m, double rate_hz, double threshold_s) {
  return Exposed(ttc_s, gap_m, rate_hz, threshold_s, "s2", [threshold_s](double ttc) { return threshold_s - ttc; });
}

Measure LeastTtc(Series ttc_s, Series gap_m) {
  const char* reason = CountValid(gap_m) == 0 ? kNoLeader : "the vehicle never closes in";
  return FoundOr(Minimum(ttc_s), reason, "s", CountValid(ttc_s), ttc_s.size());
}

Measure MeanInverseTtc(Series ttc_s, Series gap_m) {
  RODEIRA_ASSERT(ttc_s.size() == gap_m.size());
  std::vector<double> inverse(ttc_s.size(), kMissing);
  for (std::size_t i = 0; i < ttc_s.size(); ++i) {
    if (!std::isnan(gap_m[i])) inverse[i] = std::isnan(ttc_s[i]) ? 0.0 : 1.0 / ttc_s[i];
    if (ttc_s[i] == 0.0) inverse[i] = kMissing;  // they touch: no finite value
  }
  return FoundOr(Mean(inverse), kNoLeader, "1/s", CountValid(inverse), inverse.size());
}

}  // namespace rodeira::measures
