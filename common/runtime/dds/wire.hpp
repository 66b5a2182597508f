// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>

#include "common/core/base/bytes.hpp"
#include "common/core/base/result.hpp"
#include "common/runtime/lockstep/questions.hpp"
#include "common/runtime/lockstep/report.hpp"
#include "common/runtime/lockstep/roster.hpp"

namespace rodeira::dds {

// What two processes must share to drive together (the hello of law L7 and of the protocol).
struct Hello {
  base::Digest protocol = 0;  // of all IDL texts
  base::Digest roster = 0;
  base::Digest world = 0;  // 0: knows none
  base::Digest mathematics = 0;
  std::string host;
  std::uint32_t pid = 0;
};

// This process, of this build, in a run with this roster.
Hello OwnHello(base::Digest roster_hash);
// Wrong input that names what differs, with both values; worlds are compared where both know one.
base::Status CheckHello(const Hello& own, const Hello& other);

struct NamedReport {
  std::string node;
  std::uint64_t clock_id = 0;
  Hello hello;
  lockstep::Report report;  // report.node is not set: the name decides
};

base::Bytes EncodeReport(const NamedReport& report);
base::Result<NamedReport> DecodeReport(const base::Bytes& payload);

struct NumberedGrant {
  std::uint64_t clock_id = 0;
  std::uint32_t serial = 0;
  lockstep::Grant grant;
};

base::Bytes EncodeGrant(const NumberedGrant& grant);
base::Result<NumberedGrant> DecodeGrant(const base::Bytes& payload);

base::Bytes EncodeAsk(base::Digest roster_hash, const lockstep::Question& question);
// Nothing where it is of another roster or cannot be read: whoever asks will ask again.
std::optional<lockstep::Question> DecodeAsk(base::Digest roster_hash, const base::Bytes& payload);

base::Bytes EncodeParcel(lockstep::NodeIndex to, std::span<const lockstep::Sample> samples);
struct Opened {
  lockstep::NodeIndex to = 0;
  std::vector<base::Bytes> samples;  // payloads
};
// Wrong input where it cannot be read.
base::Result<Opened> DecodeParcel(const base::Bytes& payload);

}  // namespace rodeira::dds
