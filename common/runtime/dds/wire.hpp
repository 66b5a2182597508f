// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/core/base/bytes.hpp"
#include "common/core/base/result.hpp"
#include "common/runtime/launch/launch.hpp"
#include "common/runtime/lockstep/pending_nacks.hpp"
#include "common/runtime/lockstep/report.hpp"
#include "common/runtime/lockstep/roster.hpp"
#include "idl/topic_types.hpp"

namespace rodeira::dds {

// What two processes must share to take part in one run (law L7).
struct Hello {
  base::Digest report = 0;    // of the type of rodeira/report
  base::Digest protocol = 0;  // of the types of all topics that the node uses
  base::Digest roster = 0;
  base::Digest world = 0;  // 0: knows none
  base::Digest mathematics = 0;
  std::string host;
  std::uint32_t pid = 0;  // 0: of a report that another process makes about the node
  std::shared_ptr<const std::vector<idl::TopicText>> topics;  // behind `protocol`; null: the report does not say
};

// This process, of this build, as this node of the launch.
Hello OwnHello(const launch::Launch& launch, lockstep::NodeIndex node);
// Wrong input that names what differs, with both values. Worlds are compared if both have one.
base::Status CheckHello(const Hello& own, const Hello& other);

// A node's report, with the id of the clock that the node has heard; 0: none yet.
struct NamedReport {
  std::string node;
  std::uint64_t clock_id = 0;
  Hello hello;              // its topics are sent along if they are there
  lockstep::Report report;  // report.node is not set: the name decides
};

// CDR of idl's types, as the functions below.
base::Bytes EncodeReport(const NamedReport& report);
// Wrong input if it cannot be read, and if the sender's type of the report is another one; this names the node.
base::Result<NamedReport> DecodeReport(const base::Bytes& payload);

// A grant of the clock of this id; `serial` ascends with each that it sends.
struct NumberedGrant {
  std::uint64_t clock_id = 0;
  std::uint32_t serial = 0;
  lockstep::Grant grant;
};

base::Bytes EncodeGrant(const NumberedGrant& grant);
// Wrong input where it cannot be read: it is of another version.
base::Result<NumberedGrant> DecodeGrant(const base::Bytes& payload);

base::Bytes EncodeNack(base::Digest roster_hash, const lockstep::Nack& nack);
// Nothing where it is of another roster or cannot be read: the requester will ask again.
std::optional<lockstep::Nack> DecodeNack(base::Digest roster_hash, const base::Bytes& payload);

base::Bytes EncodeSampleBatch(lockstep::NodeIndex to, std::span<const lockstep::Sample> samples);

// Contents of a batch of samples that was sent again to one node.
struct Opened {
  lockstep::NodeIndex to = 0;
  std::vector<base::Bytes> samples;  // payloads
};
// Wrong input where it cannot be read.
base::Result<Opened> DecodeSampleBatch(const base::Bytes& payload);

}  // namespace rodeira::dds
