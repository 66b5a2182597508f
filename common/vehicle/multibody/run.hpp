// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "common/core/base/result.hpp"
#include "common/core/plot/table.hpp"
#include "common/vehicle/multibody/mechanism.hpp"

namespace rodeira::multibody {

// What a run took, and how well it kept constraints (largest violations) and energy.
struct RunSummary {
  long steps = 0;
  double step_s = 0.0;  // the whole time is divided evenly, so it may be a little shorter than asked
  long iterations = 0;
  int most_iterations = 0;
  long factorisations = 0;
  double violation_m = 0.0;
  double violation_mps = 0.0;
  double energy_start_J = 0.0;
  double energy_end_J = 0.0;
};

// Runs until `until_s` in steps of `step_s`; `table` gets the outputs at the beginning and after every step;
// `progress` is called now and then with a share from 0 to 1. Wrong input for times that make no sense or a table
// beyond 100 million values; failed, with the time, where a step does not converge (the table then ends there).
base::Status RunMechanism(Mechanism& mechanism, double until_s, double step_s, plot::Table& table, RunSummary& summary,
                          const std::function<void(double)>& progress = {});

}  // namespace rodeira::multibody
