// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/demand/vehicle_mix.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>

#include "common/core/base/suggest.hpp"
#include "common/core/config/declared.hpp"
#include "common/traffic/demand/demand_schema.hpp"

namespace rodeira::traffic {
namespace {

constexpr std::array<std::string_view, 4> kKindNames{"car", "van", "lorry", "bus"};

}  // namespace

config::Key KindsKey(std::string name, std::string meaning) {
  return config::ListKey(std::move(name), config::WordItem({kKindNames.begin(), kKindNames.end()}), std::move(meaning));
}

const std::vector<config::Key>& MixKeys() {
  static const std::vector<config::Key> keys = [] {
    std::vector<config::Key> all;
    for (const std::string_view name : kKindNames)
      all.push_back(config::NumberKey(std::string(name), {0.0, 1e6}, 0.0, "Weight of this kind of vehicle."));
    return all;
  }();
  return keys;
}

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
  const config::DeclaredMap declared(map, MixKeys());
  VehicleMix mix;
  double sum = 0.0;
  for (std::size_t k = 0; k < mix.shares.size(); ++k) sum += mix.shares[k] = declared.Number(kKindNames[k]);
  if (sum <= 0.0) {
    map.Problem("", "config.too_few",
                fmt::format("'mix' gives no kind of vehicle a share; at least one above 0 was expected, of {}",
                            fmt::join(kKindNames, ", ")));
    return {};
  }
  for (double& share : mix.shares) share /= sum;
  return mix;
}

}  // namespace rodeira::traffic
