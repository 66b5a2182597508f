// SPDX-License-Identifier: Apache-2.0
#pragma once

// Limits of the search for the equilibrium in which a car begins (INI), for the models with struts.
namespace rodeira::dynamics {

// The wheels move a little as the body leans, and the ground under them with that: how often the ground is asked.
inline constexpr int kMaxGroundIterations = 30;
// A step of Newton's iteration below this ends it, m and rad.
inline constexpr double kSettled_m = 1e-13;

}  // namespace rodeira::dynamics
