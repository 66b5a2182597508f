// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/analysis/measures/catalogue.hpp"
#include "common/analysis/measures/encounter_finder.hpp"
#include "common/analysis/measures/offered_gaps.hpp"
#include "common/analysis/measures/statistics.hpp"

namespace rodeira::measures {
namespace {

constexpr const char* kEncounters = "encounters";
constexpr const char* kUnknown = "the paths of other vehicles are not known";

bool IsWithin(double time_s, const DriveCut& cut) {
  const double k = time_s * cut.drive.rate_hz;
  return k >= static_cast<double>(cut.from) - 1e-6 && k < static_cast<double>(cut.to) - 1e-6;
}

UsedOptions WithEncounters(UsedOptions used) {
  for (const UsedOption& option : Used({{"area", "intersection of the swept footprints"},
                                        {"min_angle_deg", kEncounterAngle_rad * 180.0 / std::numbers::pi},
                                        {"horizon_s", kEncounterHorizon_s},
                                        {"rate_hz", kEncounterRate_hz}}))
    used.push_back(option);
  return used;
}

// The post-encroachment times up to a limit of the encounters with their second entering within the cut.
std::vector<double> TimesIn(const DriveCut& cut, double max_s) {
  std::vector<double> times;
  for (const Encounter& e : *cut.drive.encounters) {
    const double pet_s = PostEncroachment_s(e);
    if (pet_s <= max_s && IsWithin(TimeOf(e), cut)) times.push_back(pet_s);
  }
  return times;
}

Measure LeastPet(const DriveCut& cut, const OptionValues& o) {
  const std::size_t all = cut.to - cut.from;
  const UsedOptions used = WithEncounters(Used({{"max_pet_s", o["max_pet_s"]}}));
  if (!cut.drive.encounters) return NotFound(kUnknown, "s", 0, all, used);
  const std::vector<double> times = TimesIn(cut, o["max_pet_s"]);
  Measure measure = FoundOr(Minimum(times), "no vehicle crosses or joins the path", "s", times.size(), all, used);
  measure.valid_share = 1.0;
  return measure;
}

Measure PetConflicts(const DriveCut& cut, const OptionValues& o) {
  const std::size_t all = cut.to - cut.from;
  const UsedOptions used = WithEncounters(Used({{"threshold_s", o["threshold_s"]}}));
  if (!cut.drive.encounters) return NotFound(kUnknown, "1", 0, all, used);
  const auto times = TimesIn(cut, kEncounterHorizon_s);
  const auto below = std::ranges::count_if(times, [&](double t) { return t < o["threshold_s"]; });
  Measure measure = Found(static_cast<double>(below), "1", times.size(), all, used);
  measure.valid_share = 1.0;
  return measure;
}

const std::vector<OptionInfo> kGapOptions{
    {"line_m", 5, 0, 100, "before the junction: where the front arrives"},
    {"max_gap_s", 20, 1, 600, "a longer gap is none"},
    {"with_lags", 1, 0, 1, "1: the time from the arrival to the first vehicle counts as a gap"}};

GapOptions GapOptionsOf(const OptionValues& o) { return {o["line_m"], o["max_gap_s"], o["with_lags"] >= 0.5}; }

std::vector<OfferedGaps> GapsIn(const DriveCut& cut, const OptionValues& o) {
  std::vector<OfferedGaps> gaps = FindOfferedGaps(cut.drive, GapOptionsOf(o));
  std::erase_if(gaps, [&](const OfferedGaps& g) { return !IsWithin(g.time_s, cut); });
  return gaps;
}

// compute: from the gaps that were accepted and those that were rejected.
template <class Compute>
Measure OfGaps(const DriveCut& cut, const OptionValues& o, const char* unit, const Compute& compute) {
  const GapOptions options = GapOptionsOf(o);
  const UsedOptions used = WithEncounters(
      Used({{"line_m", options.line_m}, {"max_gap_s", options.max_gap_s}, {"with_lags", options.with_lags ? 1 : 0}}));
  const std::size_t all = cut.to - cut.from;
  if (!cut.drive.encounters) return NotFound(kUnknown, unit, 0, all, used);
  if (CountValid(cut(cut.drive.junction)) == 0) return NotFound("no sample is on a road", unit, 0, all, used);
  const std::vector<OfferedGaps> gaps = GapsIn(cut, o);
  std::vector<double> accepted, rejected;
  for (const OfferedGaps& g : gaps) {
    if (g.accepted_s) accepted.push_back(*g.accepted_s);
    rejected.insert(rejected.end(), g.rejected_s.begin(), g.rejected_s.end());
  }
  Measure measure = compute(gaps, accepted, rejected);
  measure.unit = unit;
  measure.valid_share = 1.0;
  measure.options.insert(measure.options.end(), used.begin(), used.end());
  return measure;
}

Measure CountOf(const std::vector<double>& gaps) {
  return Found(static_cast<double>(gaps.size()), "1", gaps.size(), gaps.size());
}

}  // namespace

std::vector<MeasureInfo> EncounterMeasures() {
  using Gaps = std::vector<OfferedGaps>;
  using Times = std::vector<double>;
  const char* traps =
      "at lights, and with the right of way, gaps are no choice; without a next vehicle none is accepted";
  const char* kTroutbeck = "Troutbeck 1992";
  return {
      {"pet_min_s",
       kEncounters,
       "least post-encroachment time",
       "min of (second vehicle's entering - first one's leaving) of the common area of the swept footprints",
       "negative: both were in it; followers have none; one that stays in it to the end has none",
       "Allen et al. 1978",
       {{"max_pet_s", 10, 0.1, 10, "a longer time is no encounter"}},
       LeastPet},
      {"pet_conflicts_n",
       kEncounters,
       "number of post-encroachment times below a threshold",
       "encounters with PET < threshold",
       "n is the number of all encounters",
       "Allen et al. 1978",
       {{"threshold_s", 2, 0.1, 10, "of the post-encroachment time"}},
       PetConflicts},
      {"gaps_accepted_n", kEncounters, "number of gaps that were taken at junctions",
       "gaps between vehicles that cross or join the path in which the driver goes", traps, kTroutbeck, kGapOptions,
       [](const DriveCut& cut, const OptionValues& o) {
         return OfGaps(cut, o, "1", [](const Gaps&, const Times& accepted, const Times&) { return CountOf(accepted); });
       }},
      {"gaps_rejected_n", kEncounters, "number of gaps that were let pass",
       "gaps between the arrival and the vehicle behind which the driver goes", traps, kTroutbeck, kGapOptions,
       [](const DriveCut& cut, const OptionValues& o) {
         return OfGaps(cut, o, "1", [](const Gaps&, const Times&, const Times& rejected) { return CountOf(rejected); });
       }},
      {"gap_accepted_min_s", kEncounters, "shortest gap that was taken",
       "from the rear of one to the front of the next", traps, kTroutbeck, kGapOptions,
       [](const DriveCut& cut, const OptionValues& o) {
         return OfGaps(cut, o, "s", [](const Gaps&, const Times& accepted, const Times&) {
           return FoundOr(Minimum(accepted), "no gap was accepted", "s", accepted.size(), accepted.size());
         });
       }},
      {"gap_rejected_max_s", kEncounters, "longest gap that was let pass",
       "from the rear of one to the front of the next", traps, kTroutbeck, kGapOptions,
       [](const DriveCut& cut, const OptionValues& o) {
         return OfGaps(cut, o, "s", [](const Gaps&, const Times&, const Times& rejected) {
           return FoundOr(Maximum(rejected), "no gap was rejected", "s", rejected.size(), rejected.size());
         });
       }},
      {"critical_gap_raff_s", kEncounters, "critical gap by Raff",
       "where as many accepted are shorter as rejected are longer", traps, "Raff & Hart 1950", kGapOptions,
       [](const DriveCut& cut, const OptionValues& o) {
         return OfGaps(cut, o, "s", [](const Gaps&, const Times& accepted, const Times& rejected) {
           return RaffCriticalGap(accepted, rejected);
         });
       }},
      {"critical_gap_ml_s", kEncounters, "critical gap by maximum likelihood",
       "mean of a lognormal distribution between the largest rejected and the accepted gap of each junction",
       "where a smaller one was accepted than rejected, the junction is left out and counted in the options",
       kTroutbeck, kGapOptions,
       [](const DriveCut& cut, const OptionValues& o) {
         return OfGaps(cut, o, "s", [](const Gaps& gaps, const Times&, const Times&) {
           return TroutbeckCriticalGap(DecisionsOf(gaps));
         });
       }},
  };
}

}  // namespace rodeira::measures
