// SPDX-License-Identifier: Apache-2.0
#include "common/analysis/measures/offered_gaps.hpp"

#include <algorithm>
#include <cmath>

namespace rodeira::measures {
namespace {

// A junction that is driven through: from the arrival to the last sample in it.
struct VehiclePassage {
  double arrives_s = 0.0, leaves_s = 0.0;
};

std::vector<VehiclePassage> PassagesOf(const Drive& d, double line_m) {
  std::vector<VehiclePassage> passages;
  for (std::size_t k = 0; k < d.size(); ++k) {
    const bool inside = d.junction[k] == 1.0, before = k > 0 && d.junction[k - 1] == 1.0;
    if (inside && before) passages.back().leaves_s = static_cast<double>(k + 1) / d.rate_hz;
    if (!inside || before) continue;
    // Back along the path until the front was in front of the line.
    std::size_t from = k;
    double way_m = 0.0;
    const double wanted_m = line_m + (std::isnan(d.front_m) ? 0.0 : d.front_m);
    while (from > 0 && way_m < wanted_m && d.junction[from - 1] != 1.0) {
      const double step = std::hypot(d.x_m[from] - d.x_m[from - 1], d.y_m[from] - d.y_m[from - 1]);
      if (std::isnan(step)) break;
      way_m += step;
      --from;
    }
    passages.push_back({static_cast<double>(from) / d.rate_hz, static_cast<double>(k + 1) / d.rate_hz});
  }
  return passages;
}

OfferedGaps GapsOf(const VehiclePassage& passage, std::vector<Encounter> encounters, const GapOptions& options) {
  std::ranges::stable_sort(encounters, {}, &Encounter::other_enters_s);
  OfferedGaps gaps;
  gaps.time_s = encounters.front().own_enters_s;
  for (const Encounter& e : encounters) gaps.time_s = std::min(gaps.time_s, e.own_enters_s);
  double free_from_s = passage.arrives_s;
  bool is_lag = true;
  for (const Encounter& e : encounters) {
    const double gap_s = e.other_enters_s - free_from_s;
    const bool counts = gap_s > 0.0 && gap_s <= options.max_gap_s && (!is_lag || options.with_lags);
    if (e.own_enters_s <= e.other_enters_s) {  // the driver goes before it
      if (counts) gaps.accepted_s = gap_s;
      break;
    }
    if (e.other_leaves_s <= passage.arrives_s) continue;
    if (counts) gaps.rejected_s.push_back(gap_s);
    free_from_s = std::max(free_from_s, std::isnan(e.other_leaves_s) ? e.other_enters_s : e.other_leaves_s);
    is_lag = false;
  }
  return gaps;
}

}  // namespace

std::vector<OfferedGaps> FindOfferedGaps(const Drive& drive, const GapOptions& options) {
  std::vector<OfferedGaps> all;
  if (!drive.encounters) return all;
  for (const VehiclePassage& passage : PassagesOf(drive, options.line_m)) {
    std::vector<Encounter> here;
    for (const Encounter& e : *drive.encounters) {
      if (e.own_enters_s >= passage.arrives_s && e.own_enters_s < passage.leaves_s) here.push_back(e);
    }
    if (here.empty()) continue;
    OfferedGaps gaps = GapsOf(passage, std::move(here), options);
    if (gaps.accepted_s || !gaps.rejected_s.empty()) all.push_back(std::move(gaps));
  }
  return all;
}

std::vector<GapDecision> DecisionsOf(std::span<const OfferedGaps> offered) {
  std::vector<GapDecision> decisions;
  for (const OfferedGaps& gaps : offered) {
    if (!gaps.accepted_s) continue;
    const auto largest = std::ranges::max_element(gaps.rejected_s);
    decisions.push_back({*gaps.accepted_s, largest == gaps.rejected_s.end() ? 0.0 : *largest});
  }
  return decisions;
}

}  // namespace rodeira::measures
