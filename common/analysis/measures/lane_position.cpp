// SPDX-License-Identifier: Apache-2.0
#include "common/analysis/measures/lane_position.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "common/core/base/assert.hpp"

namespace rodeira::measures {

std::vector<SampleRun> LaneRuns(const LanePosition& position) {
  RODEIRA_ASSERT(position.y_m.size() == position.episode.size());
  std::vector<SampleRun> runs;
  for (const SampleRun& valid : ValidRuns(position.y_m)) {
    for (std::size_t i = valid.from; i < valid.to; ++i) {
      if (i == valid.from || position.episode[i] != position.episode[i - 1]) runs.push_back({i, i});
      runs.back().to = i + 1;
    }
  }
  return runs;
}

Measure Sdlp(const LanePosition& position, const SdlpOptions& options) {
  const UsedOptions used = Used({{"denominator", NameOf(options.denominator)},
                                 {"min_valid_share", options.min_valid_share},
                                 {"pooled", "over lanes, about the mean of each"}});
  const std::size_t n = CountValid(position.y_m), all = position.y_m.size();
  if (static_cast<double>(n) < options.min_valid_share * static_cast<double>(all) || n == 0) {
    return NotFound(fmt::format("{} of {} samples have a lane position", n, all), "m", n, all, used);
  }
  const auto runs = LaneRuns(position);
  return FoundOr(PooledDeviation(position.y_m, runs, options.denominator), "too few valid samples", "m", n, all, used);
}

Measure ModifiedSdlp(const LanePosition& position, double rate_hz, const ModifiedSdlpOptions& options) {
  const UsedOptions used = Used({{"denominator", NameOf(options.denominator)},
                                 {"cutoff_hz", options.cutoff_hz},
                                 {"passes", options.both_ways ? "forward and backward" : "forward"},
                                 {"padding_s", options.both_ways ? kPadding_s : 0.0},
                                 {"min_duration_s", options.min_duration_s}});
  const std::size_t all = position.y_m.size();
  if (!IsCutoff(options.cutoff_hz, rate_hz))
    return NotFound("the cut-off is not between 0 and half the sample rate", "m", 0, all, used);
  const auto section = ButterworthHighPass(options.cutoff_hz, rate_hz);
  std::vector<double> high(all, kMissing);
  std::vector<SampleRun> kept;
  std::size_t n = 0;
  for (const SampleRun& run : LaneRuns(position)) {
    if (static_cast<double>(run.size()) < options.min_duration_s * rate_hz) continue;
    const Series part = position.y_m.subspan(run.from, run.size());
    const auto filtered = options.both_ways ? FilterBothWays(section, part, PaddingSamples(kPadding_s, rate_hz))
                                            : FilterForward(section, part);
    if (filtered.empty()) continue;
    std::copy(filtered.begin(), filtered.end(), high.begin() + static_cast<std::ptrdiff_t>(run.from));
    kept.push_back(run);
    n += run.size();
  }
  if (kept.empty())
    return NotFound(fmt::format("no time of {:g} s in one lane", options.min_duration_s), "m", 0, all, used);
  return FoundOr(PooledDeviation(high, kept, options.denominator), "too few valid samples", "m", n, all, used);
}

}  // namespace rodeira::measures
