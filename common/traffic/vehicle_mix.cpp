#include "common/traffic/vehicle_mix.hpp"

#include <string_view>

namespace rodeira::traffic {
namespace {

constexpr std::array<std::string_view, 4> kKindNames{"car", "van", "lorry", "bus"};

}  // namespace

VehicleMix ReadMix(const config::Map& map) {
  VehicleMix mix;
  double sum = 0.0;
  for (std::size_t k = 0; k < mix.shares.size(); ++k) sum += mix.shares[k] = map.Number(kKindNames[k], {0.0, 1e6}, 0.0);
  if (sum <= 0.0) {
    map.Problem("", "no kind of vehicle has a share; at least one above 0 was expected");
    return {};
  }
  for (double& share : mix.shares) share /= sum;
  return mix;
}

}  // namespace rodeira::traffic
