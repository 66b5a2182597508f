// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "common/core/base/thread_pool.hpp"
#include "common/traffic/state/agent.hpp"

namespace rodeira::traffic {

// tell(id) for all vehicles that drive, by several threads (null: by one): it may write what is that vehicle's alone,
// and read what nothing writes meanwhile.
template <class Tell>
void EachDriving(base::ThreadPool* pool, std::span<const Agent> agents, const Tell& tell) {
  const auto some = [&](std::size_t begin, std::size_t end) {
    for (std::size_t id = begin; id < end; ++id) {
      if (agents[id].on_road) tell(static_cast<std::uint32_t>(id));
    }
  };
  base::ParallelFor(pool, agents.size(), some);
}

}  // namespace rodeira::traffic
