// SPDX-License-Identifier: Apache-2.0
#pragma once

// Limits of the search for the equilibrium in which a car begins (INI), for the models with struts.
namespace rodeira::dynamics {

// The wheels move a little as the body leans, and the ground under them with that: how often the ground is asked.
inline constexpr int kMaxGroundIterations = 30;
// A step of Newton's iteration below this ends it, m and rad.
inline constexpr double kSettled_m = 1e-13;
// How often aligning moments and the side forces that make up for them are found in turn, and the change that ends it.
inline constexpr int kMomentTurns = 12;
inline constexpr double kSameMoment_Nm = 1e-12;

}  // namespace rodeira::dynamics
