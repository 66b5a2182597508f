// SPDX-License-Identifier: Apache-2.0
#include "common/driving/driver/mobil.hpp"

namespace rodeira::driver {

bool MobilIsSafe(const MobilSettings& settings, const MobilCase& at) {
  return at.new_follower_then_mps2 >= -settings.safe_mps2 && at.own_then_mps2 >= -settings.safe_mps2;
}

double MobilSurplus(const MobilSettings& settings, const MobilCase& at, bool to_keep) {
  const double others =
      at.new_follower_then_mps2 - at.new_follower_mps2 + at.old_follower_then_mps2 - at.old_follower_mps2;
  return at.own_then_mps2 - at.own_mps2 + settings.politeness * others - settings.threshold_mps2 +
         (to_keep ? settings.bias_mps2 : -settings.bias_mps2);
}

}  // namespace rodeira::driver
