// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "common/core/config/config.hpp"

namespace rodeira::launch {

enum class Transport { kSharedMemory, kUdp };

// How the processes of a run exchange samples.
struct TransportSettings {
  static constexpr std::uint32_t kSegmentKib = 8192, kMinSegmentKib = 512;

  Transport kind = Transport::kSharedMemory;
  bool has_observers = false;               // samples also go over UDP, for programs that are not Rodeira's
  std::uint32_t segment_kib = kSegmentKib;  // of shared memory, at most, for a process (SegmentKibOf)
};

// `transport: KIND`, or `transport: {kind, observers, segment_kib}`, of a launch file.
TransportSettings ReadTransport(const config::Map& root);
// As a launch file writes it.
std::string TransportText(const TransportSettings& settings);

}  // namespace rodeira::launch
