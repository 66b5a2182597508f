// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/launch/transport.hpp"

#include <fmt/format.h>

namespace rodeira::launch {
namespace {

Transport ReadKind(const config::Map& map, std::string_view key) {
  return map.Choice(key, {"shared_memory", "udp"}, "shared_memory") == "udp" ? Transport::kUdp
                                                                             : Transport::kSharedMemory;
}

}  // namespace

TransportSettings ReadTransport(const config::Map& root) {
  TransportSettings settings;
  if (!root.Has("transport") || root.Peek({"transport"})) {
    settings.kind = ReadKind(root, "transport");
    return settings;
  }
  const config::Map map = root.Child("transport");
  settings.kind = ReadKind(map, "kind");
  // Over UDP every program reads the samples.
  settings.has_observers = map.Choice("observers", {"none", "udp"}, "none") == "udp";
  if (settings.kind == Transport::kSharedMemory) {
    settings.segment_kib = static_cast<std::uint32_t>(map.Integer(
        "segment_kib", TransportSettings::kMinSegmentKib, std::int64_t{1} << 20, TransportSettings::kSegmentKib));
  }
  return settings;
}

std::string TransportText(const TransportSettings& settings) {
  const char* observers = settings.has_observers ? ", observers: udp" : "";
  if (settings.kind == Transport::kUdp) return fmt::format("{{kind: udp{}}}", observers);
  return fmt::format("{{kind: shared_memory{}, segment_kib: {}}}", observers, settings.segment_kib);
}

}  // namespace rodeira::launch
