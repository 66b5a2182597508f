// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

namespace rodeira::dynamics {

// Ratios are turns of the input for one of the output.
struct GearboxSettings {
  std::vector<double> forward{3.46, 1.96, 1.39, 1.03, 0.85};
  double reverse = 3.40;  // positive here; the total ratio of gear -1 is negative
  double final_drive = 4.19;
  double efficiency = 0.93;  // of gears and final drive together, lost as friction at the wheels
};

// The nearest gear that there is: -1, 0, 1 … n.
int CutGear(const GearboxSettings& gearbox, int gear);
// Turns of the clutch's output for one turn of the wheels: ratio × final drive; 0 in neutral, negative in reverse.
double TotalRatio(const GearboxSettings& gearbox, int gear);

// A lever worked by hand: neutral goes in always, a gear only with the clutch pressed, and reverse against the motion
// (or forward out of reverse) not above walking speed.
int ShiftByHand(const GearboxSettings& gearbox, int engaged, int lever, double clutch_pedal, double speed_mps);

}  // namespace rodeira::dynamics
