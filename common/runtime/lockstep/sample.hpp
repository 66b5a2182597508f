// SPDX-License-Identifier: Apache-2.0
#pragma once

/// @file
/// Samples: the messages of the lockstep.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "common/core/base/bytes.hpp"
#include "common/core/base/hash.hpp"
#include "common/runtime/lockstep/roster.hpp"
#include "common/runtime/lockstep/step.hpp"

namespace rodeira::lockstep {

/// The first member of the type of every lockstep topic (idl/sample_header.idl), as it lies in a serialised payload:
/// little-endian CDR, four encapsulation bytes, then these fields without padding. The runner fills it in.
struct SampleHeader {
  Step step = 0;                  ///< the sample is valid at this step
  std::int64_t time_ns = 0;       ///< step * base step
  SourceIndex source = 0;         ///< index of the source in the roster
  std::uint32_t incarnation = 0;  ///< number of the node's restarts; 0 in digests and recordings
  base::Digest state_digest = 0;  ///< digest of the node's state after the activation that made the sample

  static constexpr std::size_t kEncapsulation = 4;                    ///< bytes before the header in a payload
  static constexpr std::size_t kSize = 32;                            ///< bytes of the header
  static constexpr std::size_t kIncarnationAt = kEncapsulation + 20;  ///< position of `incarnation` in a payload

  /// Says whether a payload is long enough for a header.
  /// @param payload the payload with its encapsulation bytes
  /// @return true if it has at least kEncapsulation + kSize bytes
  static bool HasHeader(std::span<const std::byte> payload);
  /// Reads the header of a payload. Precondition: HasHeader(payload).
  /// @param payload the payload with its encapsulation bytes
  /// @return the header
  static SampleHeader Read(std::span<const std::byte> payload);
  /// Writes this header into a payload. Precondition: HasHeader(payload).
  /// @param payload the payload with its encapsulation bytes
  void Write(std::span<std::byte> payload) const;
};

/// One message: a header and the whole payload, which also begins with the header. Payloads are shared and never
/// change.
struct Sample {
  SampleHeader header;                         ///< header of the payload
  std::shared_ptr<const base::Bytes> payload;  ///< bytes for idl::Decode; not null in an Inbox

  /// Gives the time of the sample.
  /// @return the step at which the sample is valid
  Step valid() const { return header.step; }
  /// Gives the source of the sample.
  /// @return index of the source in the roster
  SourceIndex source() const { return header.source; }
};

/// Computes the digest of a payload as it is recorded: the incarnation counts as 0, so the samples of a restarted node
/// have the same digest.
/// @param payload the payload with its encapsulation bytes
/// @return the digest
base::Digest PayloadDigest(std::span<const std::byte> payload);
/// Compares the payloads of two samples without their incarnations.
/// @param a first sample
/// @param b second sample
/// @return true if all other bytes are equal
bool SameContent(const Sample& a, const Sample& b);

}  // namespace rodeira::lockstep
