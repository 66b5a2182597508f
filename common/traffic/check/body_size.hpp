// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace rodeira::traffic {

// The measures of a vehicle that the checks need.
struct BodySize {
  double length_m = 0.0;
  double width_m = 0.0;
  double wheelbase_m = 0.0;
  double reach_m = 0.0;  // from the middle to a corner

  // All over 0.
  static BodySize Of(double length_m, double width_m, double wheelbase_m);
};

}  // namespace rodeira::traffic
