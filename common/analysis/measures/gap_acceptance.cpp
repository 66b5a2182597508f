// SPDX-License-Identifier: Apache-2.0
#include "common/analysis/measures/gap_acceptance.hpp"

#include <algorithm>
#include <cmath>

#include "common/analysis/measures/statistics.hpp"

namespace rodeira::measures {
namespace {

bool IsConsistent(const GapDecision& d) { return d.accepted_s > d.largest_rejected_s; }

double LogLikelihood(const std::vector<GapDecision>& drivers, double mu, double sigma) {
  double sum = 0.0;
  for (const GapDecision& d : drivers) {
    const double high = NormalShare((std::log(d.accepted_s) - mu) / sigma);
    const double low = d.largest_rejected_s > 0.0 ? NormalShare((std::log(d.largest_rejected_s) - mu) / sigma) : 0.0;
    sum += std::log(std::max(high - low, 1e-300));
  }
  return sum;
}

// The place of the maximum of a function of one peak, by golden section.
template <class Function>
double PlaceOfMaximum(double low, double high, const Function& f) {
  constexpr double kGolden = 0.6180339887498949;
  double a = high - kGolden * (high - low), b = low + kGolden * (high - low);
  double fa = f(a), fb = f(b);
  constexpr int kSections = 60;
  for (int i = 0; i < kSections; ++i) {
    if (fa >= fb) {
      high = b;
      b = a;
      fb = fa;
      a = high - kGolden * (high - low);
      fa = f(a);
    } else {
      low = a;
      a = b;
      fa = fb;
      b = low + kGolden * (high - low);
      fb = f(b);
    }
  }
  return 0.5 * (low + high);
}

}  // namespace

std::size_t InconsistentDrivers(std::span<const GapDecision> drivers) {
  return static_cast<std::size_t>(
      std::count_if(drivers.begin(), drivers.end(), [](const GapDecision& d) { return !IsConsistent(d); }));
}

Measure RaffCriticalGap(std::span<const double> accepted_s, std::span<const double> rejected_s) {
  const std::size_t n = accepted_s.size() + rejected_s.size();
  if (accepted_s.empty() || rejected_s.empty())
    return NotFound("accepted and rejected gaps are needed", "s", n, n, Used({{"method", "Raff"}}));
  std::vector<double> accepted(accepted_s.begin(), accepted_s.end()), rejected(rejected_s.begin(), rejected_s.end());
  std::sort(accepted.begin(), accepted.end());
  std::sort(rejected.begin(), rejected.end());
  std::vector<double> lengths = accepted;
  lengths.insert(lengths.end(), rejected.begin(), rejected.end());
  std::sort(lengths.begin(), lengths.end());
  // shorter(t) grows and longer(t) falls: the excess changes its sign once. From the last length at which fewer are
  // shorter to the first one at which more are.
  const auto excess = [&](double t, bool before) {
    const auto shorter = (before ? std::lower_bound(accepted.begin(), accepted.end(), t)
                                 : std::upper_bound(accepted.begin(), accepted.end(), t)) -
                         accepted.begin();
    const auto longer = rejected.end() - (before ? std::lower_bound(rejected.begin(), rejected.end(), t)
                                                 : std::upper_bound(rejected.begin(), rejected.end(), t));
    return static_cast<double>(shorter) - static_cast<double>(longer);
  };
  double low = lengths.front(), high = lengths.back();
  for (const double t : lengths) {
    if (excess(t, true) < 0.0) low = t;
  }
  for (auto t = lengths.rbegin(); t != lengths.rend(); ++t) {
    if (excess(*t, false) > 0.0) high = *t;
  }
  return Found(0.5 * (low + high), "s", n, n, Used({{"method", "Raff"}}));
}

Measure TroutbeckCriticalGap(std::span<const GapDecision> drivers) {
  std::vector<GapDecision> used;
  std::copy_if(drivers.begin(), drivers.end(), std::back_inserter(used), IsConsistent);
  const UsedOptions options = Used({{"method", "maximum likelihood, lognormal"},
                                    {"inconsistent_drivers", static_cast<int>(drivers.size() - used.size())}});
  const bool rejects = std::any_of(used.begin(), used.end(), [](const auto& d) { return d.largest_rejected_s > 0.0; });
  if (!rejects) return NotFound("no consistent driver rejected a gap", "s", used.size(), drivers.size(), options);
  double low = 1e300, high = 0.0;
  for (const GapDecision& d : used) {
    low = std::min(low, d.largest_rejected_s > 0.0 ? d.largest_rejected_s : d.accepted_s);
    high = std::max(high, d.accepted_s);
  }
  const auto best_mu = [&](double sigma) {
    return PlaceOfMaximum(std::log(low), std::log(high), [&](double mu) { return LogLikelihood(used, mu, sigma); });
  };
  // Drivers of one and the same critical gap have a deviation of 0: the least one that is tried stands for it.
  constexpr double kMinSigma = 1e-3, kMaxSigma = 3.0;
  const double log_sigma = PlaceOfMaximum(std::log(kMinSigma), std::log(kMaxSigma), [&](double log_s) {
    const double sigma = std::exp(log_s);
    return LogLikelihood(used, best_mu(sigma), sigma);
  });
  const double sigma = std::exp(log_sigma), mu = best_mu(sigma);
  return Found(std::exp(mu + 0.5 * sigma * sigma), "s", used.size(), drivers.size(), options);
}

}  // namespace rodeira::measures
