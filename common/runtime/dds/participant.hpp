// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "common/core/base/bytes.hpp"
#include "common/core/base/result.hpp"
#include "common/runtime/launch/launch.hpp"
#include "idl/topic_table.hpp"

namespace rodeira::dds {

// How a topic's samples are kept and handed over (docs/explanation/architecture.md says why).
enum class Delivery {
  kBestEffortRepeated,  // best effort: what is repeated where it is missed (samples, grants, reports, nacks and
                        // answers)
  kLatched,             // reliable, transient local, the newest: world information
  kHistory,  // reliable, transient local, the newest 256: what happens seldom and must reach every node (triggers)
  kObserve,  // best effort: observers, which never slow a run (law L5)
};

// How a process takes part in a run over DDS.
struct DomainSettings {
  std::uint32_t domain = 0;  // one a rig
  std::string run;           // one a run: becomes the partition, never empty
  std::string name;          // of the participant, for people
  launch::Transport transport = launch::Transport::kSharedMemory;
  launch::Discovery discovery;
  bool serves_discovery = false;  // is the server of DiscoveryKind::kServer: the clock
  bool meets_later = false;       // processes may be restarted during the run
  bool is_restarted = false;      // a restarted process: reuses no shared-memory port of its predecessor
  bool has_observers = false;     // with shared memory: samples also go over UDP, for programs that are not Rodeira's
  std::uint32_t segment_kib = launch::TransportSettings::kSegmentKib;          // of shared memory, this process'
  std::uint32_t largest_segment_kib = launch::TransportSettings::kSegmentKib;  // that of any process of the run
  idl::TopicTable topics = {};                                                 // names and types of the topics
  // Endpoints of this process reach each other by calls within a write; false: by the transport, on a receive thread.
  bool delivers_within = true;
};

// Sends payloads on one topic.
class Writer {
 public:
  virtual ~Writer() = default;
  // Fails if the library's history is full.
  virtual base::Status Write(const base::Bytes& payload) = 0;
};

// Receives payloads on one topic until it is destroyed.
class Reader {
 public:
  virtual ~Reader() = default;
};

// Called with every payload on a receive thread of the library. Must not block.
using OnPayload = std::function<void(base::Bytes&&)>;

// A DDS participant, one a process. Its topics are those of DomainSettings::topics.
class Participant {
 public:
  // Wrong input if the discovery server's port is in use: the library would silently use another one.
  static base::Result<std::unique_ptr<Participant>> Open(const DomainSettings& settings);
  virtual ~Participant() = default;
  // Both fail where the topic is none of DomainSettings::topics, or the library makes no endpoint. The participant
  // outlives what it makes.
  virtual base::Result<std::unique_ptr<Writer>> MakeWriter(std::string_view topic, Delivery delivery) = 0;
  virtual base::Result<std::unique_ptr<Reader>> MakeReader(std::string_view topic, Delivery delivery,
                                                           OnPayload on_payload) = 0;
};

}  // namespace rodeira::dds
