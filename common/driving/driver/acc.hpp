// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/driving/driver/idm.hpp"

namespace rodeira::driver {

// Behind a vehicle that has come in before: the IDM, eased where it brakes harder than that leader's motion asks for
// (ACC; Kesting, Treiber, Helbing, Phil. Trans. R. Soc. A 368, 4585, 2010). As soon as the leader may keep to its own
// acceleration (CAH) with
//   CAH = v² a_l/(v_l² - 2 s a_l)  if v_l (v - v_l) <= -2 s a_l and that can be said,  else  a_l - max(0, v - v_l)²/(2
//   s),   a_l no more than the own a,
// asks for less braking than the IDM, it is 0.01 IDM + 0.99 (CAH + b tanh((IDM - CAH)/b)). Clamped to
// [-max_deceleration_mps2, a]; with a gap of 0 or less it is -max_deceleration_mps2.
double AccAcceleration(const IdmSettings& idm, double speed_mps, double desired_mps, double gap_m, double leader_mps,
                       double leader_mps2);
// Whether the IDM asks for no more braking than CAH does: the gap is what it wants.
bool AccIsIdm(const IdmSettings& idm, double speed_mps, double desired_mps, double gap_m, double leader_mps,
              double leader_mps2);

}  // namespace rodeira::driver
