// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/traffic/traffic_model.hpp"

namespace rodeira::traffic {

template <class Tell>
void TrafficModel::EachDriving(const Tell& tell) {
  const auto some = [&](std::size_t begin, std::size_t end) {
    for (std::size_t id = begin; id < end; ++id) {
      if (agents_[id].on_road) tell(static_cast<std::uint32_t>(id));
    }
  };
  base::ParallelFor(pool_.get(), agents_.size(), some);
}

}  // namespace rodeira::traffic
