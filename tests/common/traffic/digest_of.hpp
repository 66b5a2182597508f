// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/core/base/state.hpp"
#include "common/traffic/traffic_model.hpp"

namespace rodeira::traffic {

// Of all that a model saves.
inline base::Digest DigestOf(const TrafficModel& model) {
  base::StateWriter writer;
  model.Save(writer);
  return writer.digest();
}

}  // namespace rodeira::traffic
