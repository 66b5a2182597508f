// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/lockstep/inbox.hpp"

#include "common/core/base/assert.hpp"

namespace rodeira::lockstep {

bool Inbox::Has(std::string_view topic) const {
  for (const PortSamples& port : ports_) {
    if (port.topic == topic) return !port.samples.empty();
  }
  return false;
}

const std::vector<Sample>& Inbox::All(std::string_view topic) const {
  static const std::vector<Sample> kNone;
  for (const PortSamples& port : ports_) {
    if (port.topic == topic) return port.samples;
  }
  return kNone;
}

const Sample& Inbox::Latest(std::string_view topic) const {
  const auto& samples = All(topic);
  RODEIRA_ASSERT(samples.size() == 1);
  return samples.front();
}

}  // namespace rodeira::lockstep
