// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "common/core/base/bytes.hpp"
#include "common/core/base/hash.hpp"
#include "common/runtime/lockstep/roster.hpp"
#include "common/runtime/lockstep/step.hpp"

namespace rodeira::lockstep {

// The first member of every topic's type (idl/sample_header.idl), as it lies in a serialised payload: little-endian
// CDR, four encapsulation bytes, then these fields without padding.
struct SampleHeader {
  Step step = 0;                  // valid at
  std::int64_t time_ns = 0;       // step * base step
  SourceIndex source = 0;         // index in the roster
  std::uint32_t incarnation = 0;  // which life of the node; 0 in digests and recordings
  base::Digest state_digest = 0;  // of the node's state after the activation that made the sample

  static constexpr std::size_t kEncapsulation = 4;
  static constexpr std::size_t kSize = 32;
  static constexpr std::size_t kIncarnationAt = kEncapsulation + 20;

  // The payload must hold kEncapsulation + kSize bytes at least; HasHeader says whether it does.
  static bool HasHeader(std::span<const std::byte> payload);
  static SampleHeader Read(std::span<const std::byte> payload);
  void Write(std::span<std::byte> payload) const;
};

// What travels: a header and the whole payload (the header lies in it too). Payloads are shared and never change.
struct Sample {
  SampleHeader header;
  std::shared_ptr<const base::Bytes> payload;

  Step valid() const { return header.step; }
  SourceIndex source() const { return header.source; }
};

// Of the payload as it would be recorded: the incarnation counts as 0, so that a restarted node's samples agree.
base::Digest PayloadDigest(std::span<const std::byte> payload);
// The same content, whatever the incarnation.
bool SameContent(const Sample& a, const Sample& b);

}  // namespace rodeira::lockstep
