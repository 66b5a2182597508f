// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/demand/vehicle_mix.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>

#include "common/core/base/suggest.hpp"

namespace rodeira::traffic {
namespace {

constexpr std::array<std::string_view, 4> kKindNames{"car", "van", "lorry", "bus"};

}  // namespace

std::vector<VehicleKind> ReadKinds(const config::List& list) {
  std::vector<VehicleKind> kinds;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const std::string name = list.Text(i);
    const auto* const found = std::find(kKindNames.begin(), kKindNames.end(), name);
    if (found == kKindNames.end()) {
      list.Problem(i, fmt::format("'{}' was found; car, van, lorry or bus was expected{}", name,
                                  base::DidYouMean(name, {kKindNames.begin(), kKindNames.end()})));
      continue;
    }
    kinds.push_back(static_cast<VehicleKind>(found - kKindNames.begin()));
  }
  return kinds;
}

VehicleMix ReadMix(const config::Map& map) {
  VehicleMix mix;
  double sum = 0.0;
  for (std::size_t k = 0; k < mix.shares.size(); ++k) sum += mix.shares[k] = map.Number(kKindNames[k], {0.0, 1e6}, 0.0);
  if (sum <= 0.0) {
    map.Problem("", "config.too_few",
                fmt::format("no kind of vehicle has a share; at least one above 0 was expected, of {}",
                            fmt::join(kKindNames, ", ")));
    return {};
  }
  for (double& share : mix.shares) share /= sum;
  return mix;
}

}  // namespace rodeira::traffic
