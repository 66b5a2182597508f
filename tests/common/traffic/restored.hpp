// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <span>

#include "common/traffic/traffic_model.hpp"

namespace rodeira::traffic {

// A model at its beginning with just these agents, by number: on the road where they say so, no vehicle waits to enter.
// Their grants have numbers below `next_grant`.
inline void RestoreWith(TrafficModel& model, std::span<const Agent> agents, std::uint64_t next_grant = 1) {
  base::StateWriter writer;
  for (const Agent& agent : agents) writer.Put("agent", agent);
  writer.Put("waiting", std::vector<std::uint32_t>{});
  writer.Put("next_grant", next_grant);
  writer.Put("time_ns", std::int64_t{0});
  writer.Put("ended", std::uint64_t{0});
  writer.Put("missed", std::uint64_t{0});
  base::StateReader reader(writer.bytes());
  model.Restore(reader);
  EXPECT_TRUE(reader.Finish().ok());
}

}  // namespace rodeira::traffic
