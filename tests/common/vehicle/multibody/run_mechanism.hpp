// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>

#include "common/vehicle/multibody/mechanism.hpp"
#include "tests/tree.hpp"

namespace rodeira::multibody {

inline Mechanism Example(const std::string& name) {
  auto mechanism = LoadMechanism(std::filesystem::path(SourceDir()) / "configs/mechanisms" / (name + ".yaml"));
  EXPECT_TRUE(mechanism.ok()) << (mechanism.ok() ? "" : mechanism.error().Text());
  return std::move(mechanism).value();
}

inline double Value(const Mechanism& mechanism, const std::string& output) {
  for (const Output& each : mechanism.outputs) {
    if (each.name == output) return each.ValueOf(*mechanism.system);
  }
  ADD_FAILURE() << "no output " << output;
  return std::nan("");
}

struct Worst {
  int iterations = 0;
  long all_iterations = 0;
  long all_projections = 0;
  long factorisations = 0;
  double violation_m = 0.0;
  double violation_mps = 0.0;
};

// Steps to until_s in equal steps of about step_s.
inline Worst RunTo(Mechanism& mechanism, double until_s, double step_s) {
  Worst worst;
  System& system = *mechanism.system;
  const double start_s = system.time_s();
  const auto steps = static_cast<long>(std::lround((until_s - start_s) / step_s));
  for (long i = 0; i < steps; ++i) {
    const StepReport report = system.Step((until_s - start_s) / static_cast<double>(steps));
    if (!report.converged) {
      ADD_FAILURE() << "no convergence at " << system.time_s() << " s after " << report.iterations << " iterations, "
                    << report.projections << " projections";
      break;
    }
    worst.iterations = std::max(worst.iterations, report.iterations);
    worst.all_iterations += report.iterations;
    worst.all_projections += report.projections;
    worst.factorisations += report.factorisations;
    worst.violation_m = std::max(worst.violation_m, system.Violation());
    worst.violation_mps = std::max(worst.violation_mps, system.RateViolation());
  }
  return worst;
}

}  // namespace rodeira::multibody
