// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "common/core/base/result.hpp"
#include "launch/rodeira/run/abstract_socket.hpp"
#include "launch/rodeira/run/domains.hpp"

namespace rodeira::cli {

// What one PC starts of a run, held against a second start on that PC by any user: a second process of a node would end
// the run. `host` is empty in a run without a laboratory file. Wrong input, which names the process and the user, if
// another process holds it.
base::Result<AbstractSocket> HoldHost(std::uint32_t domain, const std::string& run, const std::string& host,
                                      const DomainPlace& place = {});

}  // namespace rodeira::cli
