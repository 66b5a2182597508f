// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/check/body_size.hpp"

#include <cmath>

namespace rodeira::traffic {

BodySize BodySize::Of(double length_m, double width_m, double wheelbase_m) {
  return {length_m, width_m, wheelbase_m, 0.5 * std::sqrt(length_m * length_m + width_m * width_m)};
}

}  // namespace rodeira::traffic
