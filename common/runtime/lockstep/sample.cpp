// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/lockstep/sample.hpp"

#include <cstring>

#include "common/core/base/assert.hpp"
#include "common/runtime/lockstep/snapshot.hpp"

namespace rodeira::lockstep {

static_assert(sizeof(SampleHeader) == SampleHeader::kSize, "the header has no padding");

bool SampleHeader::HasHeader(std::span<const std::byte> payload) { return payload.size() >= kEncapsulation + kSize; }

SampleHeader SampleHeader::Read(std::span<const std::byte> payload) {
  RODEIRA_ASSERT(HasHeader(payload));
  SampleHeader header;
  std::memcpy(&header, payload.data() + kEncapsulation, kSize);
  return header;
}

void SampleHeader::Write(std::span<std::byte> payload) const {
  RODEIRA_ASSERT(HasHeader(payload));
  std::memcpy(payload.data() + kEncapsulation, this, kSize);
}

base::Digest PayloadDigest(std::span<const std::byte> payload) {
  if (!SampleHeader::HasHeader(payload)) return base::Hash(payload);
  const base::Digest head = base::Hash(payload.first(SampleHeader::kIncarnationAt));
  return base::Combine(head, base::Hash(payload.subspan(SampleHeader::kIncarnationAt + 4)));
}

bool SameContent(const Sample& a, const Sample& b) {
  const auto same = [&](std::size_t from, std::size_t to) {
    return std::memcmp(a.payload->data() + from, b.payload->data() + from, to - from) == 0;
  };
  const bool same_bytes = a.payload->size() == b.payload->size() && same(0, SampleHeader::kIncarnationAt) &&
                          same(SampleHeader::kIncarnationAt + 4, a.payload->size());
  return same_bytes || SameSnapshots(a, b);
}

}  // namespace rodeira::lockstep
