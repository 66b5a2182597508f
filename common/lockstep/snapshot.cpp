#include "common/lockstep/snapshot.hpp"

namespace rodeira::lockstep {

base::Bytes Snapshot::Encode() const {
  base::ByteWriter out;
  out.PutString("rodeira-snapshot/1");
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
  if (magic != "rodeira-snapshot/1") return base::WrongInput("this is no snapshot of this version: 'rodeira-snapshot/1' was expected at its start");
  Snapshot snapshot;
  snapshot.node = in.Get<NodeIndex>();
  snapshot.at = in.Get<Step>();
  snapshot.steps = in.Get<std::uint64_t>();
  snapshot.digest = in.Get<base::Digest>();
  const auto state = in.GetRaw(in.Get<std::uint64_t>());
  snapshot.state.assign(state.begin(), state.end());
  const auto count = in.Get<std::uint32_t>();
  for (std::uint32_t i = 0; i < count && in.ok(); ++i) {
    const auto payload = in.GetRaw(in.Get<std::uint64_t>());
    if (!in.ok() || !SampleHeader::HasHeader(payload)) return base::WrongInput("the snapshot holds a sample without a header");
    snapshot.samples.push_back({SampleHeader::Read(payload), std::make_shared<const base::Bytes>(payload.begin(), payload.end())});
  }
  if (!in.ok()) return base::WrongInput("the snapshot is cut short");
  if (in.remaining() != 0) return base::WrongInput("bytes are left over behind the snapshot");
  return snapshot;
}

}  // namespace rodeira::lockstep
