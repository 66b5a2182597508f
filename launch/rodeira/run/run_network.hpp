// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "common/core/base/result.hpp"
#include "common/runtime/launch/launch.hpp"
#include "launch/rodeira/run/abstract_socket.hpp"
#include "launch/rodeira/run/domains.hpp"
#include "launch/rodeira/run/placement.hpp"
#include "launch/rodeira/run/run_command.hpp"

namespace rodeira::cli {

// The largest segment, KiB, so that processes which want segments of `segments_kib` (at least one), none of them larger
// than it, have room in so many bytes of shared memory; 0: there is no room.
std::uint32_t SegmentThatFits(std::uint64_t free_bytes, std::span<const std::uint32_t> segments_kib);
// The same for so many processes with segments of the default size.
std::uint32_t SegmentThatFits(std::uint64_t free_bytes, int processes);

// How the processes of a run on this PC reach each other: the domain that it holds, and what stands above the launch
// file so that the run can work here.
struct RunNetwork {
  std::uint32_t domain = 0;
  std::optional<DomainHold> hold;      // none where the domain was given and another run has it, too
  std::optional<AbstractSocket> host;  // held against a second start of the same host
  launch::Overrides overrides;
  std::string note;  // a sentence that says why there are overrides; empty: there are none

  // Wrong input where the run cannot work here: the network that it needs is not there; all domains are in use; this
  // host of the run is started already.
  static base::Result<RunNetwork> Prepare(const RunOptions& options, const Placement& placement,
                                          const launch::Launch& launch, const DomainPlace& place = {});
};

}  // namespace rodeira::cli
