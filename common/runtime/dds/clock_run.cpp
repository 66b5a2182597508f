// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/dds/clock_run.hpp"

#include <cmath>
#include <optional>

namespace rodeira::dds {
namespace {

std::optional<lockstep::Step> LastStep(const launch::Launch& launch, const ProcessOptions& options) {
  const auto seconds = options.duration_s ? options.duration_s : launch.duration_s();
  if (!seconds) return std::nullopt;
  return static_cast<lockstep::Step>(
      std::llround(*seconds * 1e9 / static_cast<double>(launch.roster().base_step_ns())));
}

}  // namespace

ClockRun::ClockRun(const launch::Launch& its_launch, const ProcessOptions& options)
    : launch(its_launch),
      domain(options.domain),
      roster(its_launch.roster()),
      clock(roster, LastStep(its_launch, options), 0, its_launch.policies()),
      controller(clock, lockstep::Pacer(roster.base_step_ns(), options.pace), options.incarnation),
      watchdog(roster, its_launch.watchdog()),
      start(WallClock::now()) {}

lockstep::Wall ClockRun::Now() const {
  lockstep::Wall now = lockstep::ReadWall();
  now.monotonic_ns -= std::chrono::nanoseconds(start.time_since_epoch()).count();
  return now;
}

std::int64_t ClockRun::BegunNs() const {
  const lockstep::Wall now = Now();
  return std::chrono::nanoseconds(start.time_since_epoch()).count() + now.monotonic_ns - controller.RunNs(now);
}

}  // namespace rodeira::dds
