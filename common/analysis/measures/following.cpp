// SPDX-License-Identifier: Apache-2.0
#include "common/analysis/measures/following.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/analysis/measures/spectrum.hpp"
#include "common/analysis/measures/statistics.hpp"

namespace rodeira::measures {
namespace {

double CoherenceOf(const SpectrumBin& bin) {
  const double power = bin.x * bin.y;
  return power > 0.0 ? std::norm(bin.cross) / power : 0.0;
}

// The bin at the given frequency, or that of greatest coherence; null where there is none.
const SpectrumBin* BinFor(const Spectrum& spectrum, const FollowingOptions& options) {
  const SpectrumBin* best = nullptr;
  const auto better = [&](const SpectrumBin& a, const SpectrumBin& b) {
    if (options.frequency_hz > 0.0)
      return std::abs(a.frequency_hz - options.frequency_hz) < std::abs(b.frequency_hz - options.frequency_hz);
    return CoherenceOf(a) > CoherenceOf(b);
  };
  for (const SpectrumBin& bin : spectrum.bins) {
    if (best == nullptr || better(bin, *best)) best = &bin;
  }
  return best;
}

}  // namespace

Following FollowLeader(Series leader_mps, Series own_mps, double rate_hz, const FollowingOptions& options) {
  const auto factor = std::max<std::size_t>(1, static_cast<std::size_t>(rate_hz / options.rate_hz));
  const std::vector<double> x = Decimate(leader_mps, factor), y = Decimate(own_mps, factor);
  const double slow_hz = rate_hz / static_cast<double>(factor);
  const auto segment = std::max<std::size_t>(4, static_cast<std::size_t>(std::llround(options.segment_s * slow_hz)));
  const double highest_hz = std::max(options.highest_hz, options.frequency_hz + slow_hz / static_cast<double>(segment));
  const Spectrum spectrum = WelchSpectrum(x, y, slow_hz, segment, highest_hz);
  const SpectrumBin* bin = BinFor(spectrum, options);
  const UsedOptions used = Used({{"segment_s", options.segment_s},
                                 {"segments", static_cast<int>(spectrum.segments)},
                                 {"window", "Hann"},
                                 {"overlap", 0.5},
                                 {"detrend", "mean"},
                                 {"frequency_hz", bin == nullptr ? 0.0 : bin->frequency_hz},
                                 {"rate_hz", slow_hz}});
  std::size_t n = 0;
  for (std::size_t i = 0; i < own_mps.size(); ++i) n += !std::isnan(leader_mps[i] + own_mps[i]) ? 1u : 0u;
  const std::size_t all = own_mps.size();
  const auto missing = [&](const char* reason) {
    return Following{NotFound(reason, "1", n, all, used), NotFound(reason, "1", n, all, used),
                     NotFound(reason, "rad", n, all, used), NotFound(reason, "s", n, all, used)};
  };
  if (spectrum.segments < options.min_segments) return missing("fewer segments with a leader than are needed");
  if (bin == nullptr || !(bin->x > 0.0)) return missing("the leader's speed does not vary");
  const double phase = std::arg(bin->cross);
  return {Found(CoherenceOf(*bin), "1", n, all, used), Found(std::abs(bin->cross) / bin->x, "1", n, all, used),
          Found(phase, "rad", n, all, used),
          Found(-phase / (2.0 * std::numbers::pi * bin->frequency_hz), "s", n, all, used)};
}

}  // namespace rodeira::measures
