#include "common/traffic/motors_looks.hpp"

#include <algorithm>
#include <cmath>

#include "common/network/network.hpp"
#include "common/traffic/motors_driver.hpp"

namespace rodeira::traffic {

void EachCrossing(std::vector<MotorsLook>& looks, const std::function<void(const MotorsLook&, const MotorsLook&)>& tell) {
  const auto low = [](const MotorsLook& look) { return std::min(look.from.x(), look.to.x()); };
  std::sort(looks.begin(), looks.end(), [&](const MotorsLook& a, const MotorsLook& b) { return low(a) != low(b) ? low(a) < low(b) : a.id < b.id; });
  for (std::size_t i = 0; i < looks.size(); ++i) {
    const double high = std::max(looks[i].from.x(), looks[i].to.x());
    for (std::size_t k = i + 1; k < looks.size() && low(looks[k]) <= high; ++k) {
      if (std::fabs(looks[i].z_m - looks[k].z_m) > network::Network::kLevel_m || !SegmentsCross(looks[i].from, looks[i].to, looks[k].from, looks[k].to)) continue;
      tell(looks[i], looks[k]);
    }
  }
}

}  // namespace rodeira::traffic
