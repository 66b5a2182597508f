// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/lockstep/snapshot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>

#include "common/core/base/assert.hpp"
#include "common/core/base/carried_state.hpp"

namespace rodeira::lockstep {
namespace {

constexpr std::size_t kContentAt = SampleHeader::kEncapsulation + SampleHeader::kSize;
// The first words of a snapshot, by which it says whether it holds a state.
constexpr std::string_view kWithState = "rodeira-snapshot/1";
constexpr std::string_view kWithoutState = "rodeira-snapshot/1 none";

bool BeginsAsSnapshot(std::span<const std::byte> payload) {
  constexpr std::size_t kWordsAt = kContentAt + 2 * sizeof(std::uint32_t);  // behind the lengths of content and text
  if (payload.size() < kWordsAt + kWithState.size()) return false;
  return std::memcmp(payload.data() + kWordsAt, kWithState.data(), kWithState.size()) == 0;
}

}  // namespace

base::Bytes Snapshot::Encode() const {
  base::ByteWriter out;
  out.PutString(std::string(has_state ? kWithState : kWithoutState));
  out.Put(node);
  out.Put(at);
  out.Put(steps);
  out.Put(digest);
  out.Put(static_cast<std::uint64_t>(state.size()));
  out.PutRaw(state);
  out.Put(static_cast<std::uint32_t>(samples.size()));
  for (const Sample& sample : samples) {
    out.Put(static_cast<std::uint64_t>(sample.payload->size()));
    out.PutRaw(*sample.payload);
  }
  return std::move(out.bytes());
}

base::Result<Snapshot> Snapshot::Decode(std::span<const std::byte> bytes) {
  base::ByteReader in(bytes);
  const std::string magic = in.GetString();
  if (magic != kWithState && magic != kWithoutState) {
    return base::WrongInput(
        "snapshot.other_version",
        fmt::format("this is no snapshot of this version: '{}' was expected at its start", kWithState));
  }
  Snapshot snapshot;
  snapshot.has_state = magic == kWithState;
  snapshot.node = in.Get<NodeIndex>();
  snapshot.at = in.Get<Step>();
  snapshot.steps = in.Get<std::uint64_t>();
  snapshot.digest = in.Get<base::Digest>();
  const auto state = in.GetRaw(in.Get<std::uint64_t>());
  snapshot.state.assign(state.begin(), state.end());
  const auto count = in.Get<std::uint32_t>();
  for (std::uint32_t i = 0; i < count && in.ok(); ++i) {
    const auto payload = in.GetRaw(in.Get<std::uint64_t>());
    if (!in.ok() || !SampleHeader::HasHeader(payload))
      return base::WrongInput("snapshot.damaged", "the snapshot holds a sample without a header");
    snapshot.samples.push_back(
        {SampleHeader::Read(payload), std::make_shared<const base::Bytes>(payload.begin(), payload.end())});
  }
  if (!in.ok()) return base::WrongInput("snapshot.damaged", "the snapshot is cut short");
  if (!snapshot.has_state && !snapshot.state.empty())
    return base::WrongInput("snapshot.damaged", "the snapshot says that it has no state, and holds one");
  if (in.remaining() != 0) return base::WrongInput("snapshot.damaged", "bytes are left over behind the snapshot");
  return snapshot;
}

Sample Snapshot::ToSample(const Roster& roster, std::uint32_t incarnation) const {
  const RosterNode& spec = roster.node(node);
  RODEIRA_ASSERT(spec.snapshots.has_value());
  const base::Bytes content = Encode();
  base::ByteWriter out;
  for (const unsigned char byte : std::array<unsigned char, 4>{0, 1, 0, 0}) out.Put(byte);  // little-endian CDR
  out.PutRaw(base::Bytes(SampleHeader::kSize));
  out.Put(static_cast<std::uint32_t>(content.size()));
  out.PutRaw(content);
  while (out.bytes().size() % 4 != 0) out.Put(static_cast<unsigned char>(0));
  out.Put(static_cast<std::uint32_t>(0));
  base::Bytes payload = std::move(out.bytes());
  const SampleHeader header{at, at * roster.base_step_ns(), *spec.snapshots, incarnation, 0};
  header.Write(payload);
  return {header, std::make_shared<const base::Bytes>(std::move(payload))};
}

base::Result<Snapshot> Snapshot::FromSample(std::span<const std::byte> payload) {
  if (payload.size() < kContentAt + sizeof(std::uint32_t))
    return base::WrongInput("snapshot.damaged", fmt::format("a snapshot of {} bytes was found", payload.size()));
  base::ByteReader in(payload.subspan(kContentAt));
  const auto size = in.Get<std::uint32_t>();
  if (size > in.remaining()) return base::WrongInput("snapshot.damaged", "the snapshot is cut short");
  return Decode(in.GetRaw(size));
}

bool SameSnapshots(const Sample& a, const Sample& b) {
  if (!BeginsAsSnapshot(*a.payload) || !BeginsAsSnapshot(*b.payload)) return false;
  if (a.valid() != b.valid() || a.source() != b.source() || a.header.state_digest != b.header.state_digest)
    return false;
  const auto first = Snapshot::FromSample(*a.payload), second = Snapshot::FromSample(*b.payload);
  if (!first || !second) return false;
  const Snapshot &s = first.value(), &t = second.value();
  return s.node == t.node && s.at == t.at && s.steps == t.steps && s.digest == t.digest && s.has_state == t.has_state &&
         std::ranges::equal(s.samples, t.samples, SameContent) && base::SameButCarried(s.state, t.state);
}

}  // namespace rodeira::lockstep
