// SPDX-License-Identifier: Apache-2.0
#include "common/analysis/measures/steering_entropy.hpp"

#include <algorithm>
#include <cmath>

#include "common/analysis/measures/statistics.hpp"

namespace rodeira::measures {
namespace {

// The index of the bin of x between the ascending cuts.
template <std::size_t N>
std::size_t BinOf(double x, const std::array<double, N>& cuts) {
  return static_cast<std::size_t>(std::upper_bound(cuts.begin(), cuts.end(), x) - cuts.begin());
}

UsedOptions Used1999(double alpha_deg) {
  return Used({{"method", "1999"}, {"period_s", 0.15}, {"alpha_deg", alpha_deg}, {"percentile_type", 7}});
}

}  // namespace

std::vector<double> At150ms(Series wheel_deg, double rate_hz) {
  constexpr double kPeriod_s = 0.15;
  std::vector<double> angle;
  for (std::size_t k = 0;; ++k) {
    const auto from = static_cast<std::size_t>(std::llround(static_cast<double>(k) * kPeriod_s * rate_hz));
    const auto to =
        std::max(static_cast<std::size_t>(std::llround(static_cast<double>(k + 1) * kPeriod_s * rate_hz)), from + 1);
    if (to > wheel_deg.size()) break;
    double sum = 0.0;  // a missing sample makes it missing
    for (std::size_t i = from; i < to; ++i) sum += wheel_deg[i];
    angle.push_back(sum / static_cast<double>(to - from));
  }
  return angle;
}

std::vector<double> TaylorErrors(Series angle_deg) {
  std::vector<double> errors;
  for (std::size_t n = 3; n < angle_deg.size(); ++n) {
    errors.push_back(angle_deg[n] - (2.5 * angle_deg[n - 1] - 2.0 * angle_deg[n - 2] + 0.5 * angle_deg[n - 3]));
  }
  return errors;
}

std::optional<double> EntropyAlpha(Series baseline_errors_deg) {
  std::vector<double> size;
  size.reserve(baseline_errors_deg.size());
  for (const double e : baseline_errors_deg) size.push_back(std::abs(e));
  return Quantile(size, 0.9);
}

Measure Entropy1999(Series errors_deg, double alpha_deg) {
  const std::size_t n = CountValid(errors_deg);
  if (n == 0) return NotFound("no prediction error", "1", 0, errors_deg.size(), Used1999(alpha_deg));
  if (!(alpha_deg > 0.0))
    return NotFound("the baseline has no prediction errors", "1", n, errors_deg.size(), Used1999(alpha_deg));
  std::array<double, 8> cuts{-5.0, -2.5, -1.0, -0.5, 0.5, 1.0, 2.5, 5.0};
  for (double& cut : cuts) cut *= alpha_deg;
  std::array<double, 9> counts{};
  for (const double e : errors_deg) {
    if (!std::isnan(e)) counts[BinOf(e, cuts)] += 1.0;
  }
  double entropy = 0.0;
  for (const double count : counts) {
    const double p = count / static_cast<double>(n);
    if (p > 0.0) entropy -= p * std::log(p) / std::log(9.0);
  }
  return Found(entropy, "1", n, errors_deg.size(), Used1999(alpha_deg));
}

Measure SteeringEntropy1999(Series wheel_deg, Series baseline_deg, double rate_hz) {
  const auto alpha = EntropyAlpha(TaylorErrors(At150ms(baseline_deg, rate_hz)));
  return Entropy1999(TaylorErrors(At150ms(wheel_deg, rate_hz)), alpha.value_or(0.0));
}

std::vector<double> At4Hz(Series wheel_deg, double rate_hz) {
  const double cutoff_hz = 3.0 / 7.0 * kEntropyRate_hz;
  if (!IsCutoff(cutoff_hz, rate_hz)) return {};
  const auto smooth = FilterRunsBothWays(ButterworthLowPass(cutoff_hz, rate_hz), wheel_deg,
                                         PaddingSamples(kPaddingOfAuthors_s, rate_hz));
  return Resample(smooth, rate_hz, kEntropyRate_hz);
}

std::optional<std::array<double, 3>> BurgAr3(Series x) {
  constexpr std::size_t kFewest = 8;
  if (x.size() < kFewest || CountValid(x) < x.size()) return std::nullopt;
  std::vector<double> forward(x.begin(), x.end()), backward(x.begin(), x.end());
  std::array<double, 4> a{1.0, 0.0, 0.0, 0.0};  // of the prediction error filter
  for (std::size_t order = 1; order <= 3; ++order) {
    double numerator = 0.0, denominator = 0.0;
    for (std::size_t n = order; n < x.size(); ++n) {
      numerator -= 2.0 * forward[n] * backward[n - 1];
      denominator += forward[n] * forward[n] + backward[n - 1] * backward[n - 1];
    }
    const double k = denominator > 0.0 ? numerator / denominator : 0.0;
    std::array<double, 4> next = a;
    for (std::size_t i = 1; i <= order; ++i) next[i] = a[i] + k * a[order - i];
    a = next;
    for (std::size_t n = x.size() - 1; n >= order; --n) {
      const double f = forward[n];
      forward[n] = f + k * backward[n - 1];
      backward[n] = backward[n - 1] + k * f;
    }
  }
  return std::array<double, 3>{-a[1], -a[2], -a[3]};
}

std::vector<double> ArErrors(Series x, const std::array<double, 3>& a) {
  std::vector<double> errors;
  for (std::size_t n = 3; n < x.size(); ++n)
    errors.push_back(x[n] - (a[0] * x[n - 1] + a[1] * x[n - 2] + a[2] * x[n - 3]));
  return errors;
}

EntropyShares SharesOf(Series errors_deg, double pe_deg) {
  std::array<double, 13> cuts{};
  for (std::size_t i = 0; i < cuts.size(); ++i) cuts[i] = (static_cast<double>(i) - 6.0) * pe_deg;
  EntropyShares shares{};
  for (const double e : errors_deg) {
    if (!std::isnan(e)) shares[BinOf(e, cuts)] += 1.0;
  }
  constexpr double kMinShare = 1e-3;
  const auto n = static_cast<double>(CountValid(errors_deg));
  for (double& share : shares) share = std::max(n > 0.0 ? share / n : 0.0, kMinShare);
  return shares;
}

std::optional<double> EntropyPe(Series errors_deg) {
  const auto low = Quantile(errors_deg, 0.2), high = Quantile(errors_deg, 0.8);
  if (!low || !high) return std::nullopt;
  return 0.5 * (std::abs(*low) + std::abs(*high));
}

double CrossEntropy_bit(const EntropyShares& p, const EntropyShares& q) {
  double entropy = 0.0;
  for (std::size_t i = 0; i < p.size(); ++i) entropy -= p[i] * std::log2(q[i]);
  return entropy;
}

Measure SteeringEntropy2005(Series wheel_deg, Series baseline_deg, double rate_hz) {
  constexpr double kShortest_s = 90.0;
  constexpr std::size_t kMinute = 60 * static_cast<std::size_t>(kEntropyRate_hz);
  UsedOptions used = Used({{"method", "2005"},
                           {"rate_hz", kEntropyRate_hz},
                           {"cutoff_hz", 3.0 / 7.0 * kEntropyRate_hz},
                           {"padding_s", kPaddingOfAuthors_s},
                           {"percentile_type", 7}});
  const auto missing = [&](const char* reason) { return NotFound(reason, "bit", 0, wheel_deg.size(), used); };
  if (static_cast<double>(baseline_deg.size()) < kShortest_s * rate_hz)
    return missing("the baseline is shorter than 90 s");
  const std::vector<double> baseline = At4Hz(baseline_deg, rate_hz);
  if (baseline.size() <= kMinute) return missing("the baseline is too short");
  const auto predictor = BurgAr3(Series(baseline).first(kMinute));
  if (!predictor) return missing("a sample of the baseline's first minute is missing");
  const std::size_t second = std::min(baseline.size() - kMinute, kMinute);
  const auto baseline_errors = ArErrors(Series(baseline).subspan(kMinute, second), *predictor);
  const auto pe = EntropyPe(baseline_errors);
  if (!pe || !(*pe > 0.0)) return missing("the baseline has no prediction errors");
  const auto errors = ArErrors(At4Hz(wheel_deg, rate_hz), *predictor);
  const std::size_t n = CountValid(errors);
  if (n == 0) return missing("no prediction error");
  used.push_back({"pe_deg", Used({{"", *pe}}).front().value});
  return Found(CrossEntropy_bit(SharesOf(errors, *pe), SharesOf(baseline_errors, *pe)), "bit", n, errors.size(), used);
}

}  // namespace rodeira::measures
