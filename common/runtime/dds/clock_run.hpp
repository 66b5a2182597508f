// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>

#include "common/runtime/dds/options.hpp"
#include "common/runtime/dds/wall_clock.hpp"
#include "common/runtime/launch/launch.hpp"
#include "common/runtime/lockstep/clock.hpp"
#include "common/runtime/lockstep/run_controller.hpp"
#include "common/runtime/lockstep/unavailable_nodes.hpp"
#include "common/runtime/lockstep/watchdog.hpp"

namespace rodeira::dds {

// A run as the clock's process leads it: what grants, what watches, and the wall clock that both are given.
struct ClockRun {
  ClockRun(const launch::Launch& launch, const ProcessOptions& options);

  // Since `start`, and since 1970.
  lockstep::Wall Now() const;
  // Since `start`, of a clock that never jumps.
  std::int64_t NowNs() const { return Now().monotonic_ns; }
  std::int64_t NowMs() const { return NowNs() / 1'000'000; }
  // Since the first grant; 0 before.
  double RunSeconds() const { return static_cast<double>(controller.RunNs(Now())) * 1e-9; }
  // When the first grant was given, ns of std::chrono::steady_clock.
  std::int64_t BegunNs() const;

  const launch::Launch& launch;
  const std::uint32_t domain;  // of DDS
  const lockstep::Roster& roster;
  lockstep::Clock clock;
  lockstep::RunController controller;
  lockstep::Watchdog watchdog;
  lockstep::UnavailableNodes missed;
  WallClock::time_point start;
};

}  // namespace rodeira::dds
