// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/launch/transport.hpp"

#include <fmt/format.h>

#include "common/core/config/declared.hpp"
#include "common/runtime/launch/launch_schema.hpp"

namespace rodeira::launch {
TransportSettings ReadTransport(const config::Map& root) {
  TransportSettings settings;
  if (!root.Has("transport") || root.Peek({"transport"})) {
    const std::string word = root.Choice("transport", {"shared_memory", "udp"}, "shared_memory");
    settings.kind = word == "udp" ? Transport::kUdp : Transport::kSharedMemory;
    return settings;
  }
  const config::Map map = root.Child("transport");
  const config::DeclaredMap declared(map, TransportKeys());
  settings.kind = declared.Word("kind") == "udp" ? Transport::kUdp : Transport::kSharedMemory;
  // Over UDP every program reads the samples.
  settings.has_observers = declared.Word("observers") == "udp";
  if (settings.kind == Transport::kSharedMemory) {
    settings.segment_kib = static_cast<std::uint32_t>(declared.Integer("segment_kib"));
  }
  return settings;
}

std::string TransportText(const TransportSettings& settings) {
  const char* observers = settings.has_observers ? ", observers: udp" : "";
  if (settings.kind == Transport::kUdp) return fmt::format("{{kind: udp{}}}", observers);
  return fmt::format("{{kind: shared_memory{}, segment_kib: {}}}", observers, settings.segment_kib);
}

}  // namespace rodeira::launch
