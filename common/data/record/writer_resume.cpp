// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "common/data/record/checksum.hpp"
#include "common/data/record/mcap_contents.hpp"
#include "common/data/record/writer_work.hpp"

namespace rodeira::record {
namespace {

constexpr std::uint64_t kBlockBytes = 4u << 20;

base::Result<std::uint32_t> ChecksumOf(const Source& source, std::uint64_t size) {
  std::uint32_t crc = 0;
  for (std::uint64_t at = 0; at < size; at += kBlockBytes) {
    const auto block = source.Read(at, std::min(kBlockBytes, size - at));
    if (!block) return block.error();
    crc = Crc32(block.value(), crc);
  }
  return crc;
}

// The writer numbers schemas and channels from 1 without a gap; so must the file that it goes on with.
template <class Numbered>
bool CountsFromOne(const Numbered& numbered) {
  std::size_t expected = 1;
  return std::ranges::all_of(numbered, [&](const auto& entry) { return entry.first == expected++; });
}

// The last whole chunk, which counts only with all of its indexes; null where there is none.
const ChunkInfo* LastWhole(const Scan& scan) {
  const auto& chunks = scan.contents.chunks;
  for (auto chunk = chunks.rbegin(); chunk != chunks.rend(); ++chunk) {
    if (!chunk->unchunked && chunk->index_offsets.size() == chunk->channels->size()) return &*chunk;
  }
  return nullptr;
}
// The latest time of all chunks up to the last whole one. That one may hold only messages of before: the run's log is
// written when it comes.
std::uint64_t EndNs(const Scan& scan, const ChunkInfo* last_whole) {
  std::uint64_t end_ns = 0;
  for (const ChunkInfo& chunk : scan.contents.chunks) {
    if (last_whole != nullptr && chunk.offset <= last_whole->offset && !chunk.unchunked)
      end_ns = std::max(end_ns, chunk.last_log_time_ns);
  }
  return end_ns;
}
std::uint64_t EndOf(const ChunkInfo& chunk) { return chunk.offset + chunk.record_bytes + chunk.index_bytes; }

base::Status HandInTail(const Source& source, const Contents& contents, const McapWriter::Tail& tail) {
  const std::uint64_t end_ns = contents.statistics.last_log_time_ns;
  const std::uint64_t from_ns = end_ns > tail.span_ns ? end_ns - tail.span_ns : 0;
  for (const ChunkInfo& info : contents.chunks) {
    if (info.last_log_time_ns < from_ns) continue;
    const auto chunk = LoadChunk(source, info, contents);
    if (!chunk) return chunk.error();
    for (const Chunk::Entry& entry : chunk.value().entries) {
      const auto record = RecordAt(chunk.value().records, entry.offset);
      const auto message = record ? ParseMessage(record->content) : std::nullopt;
      RODEIRA_ASSERT(message.has_value());  // LoadChunk found all of them whole
      if (auto status = tail.on_message(contents.definitions.channels.at(message->channel), *message); !status)
        return status;
    }
  }
  return {};
}

}  // namespace

base::Result<std::optional<McapWriter>> McapWriter::Resume(const std::filesystem::path& path,
                                                           const WriterSettings& settings, const Tail& tail) {
  std::unique_ptr<Sink> sink;
  std::unique_ptr<Source> source;
  Scan scan;
  while (true) {  // a second time where something was cut off
    auto opened = OpenFileSource(path);
    if (!opened) return opened.error();
    source = std::move(opened).value();
    auto scanned = ScanFile(*source);
    if (!scanned) return scanned.error();
    scan = std::move(scanned).value();
    const ChunkInfo* last = LastWhole(scan);
    if (const std::uint64_t end_ns = EndNs(scan, last); end_ns < tail.least_end_ns) {
      return base::Failed("recording.damaged",
                          fmt::format("the recording can be read up to {} only, though it held more than {}: it was "
                                      "damaged meanwhile{}{}; it is left as it is",
                                      Seconds(end_ns), Seconds(tail.least_end_ns), scan.findings.empty() ? "" : ", ",
                                      scan.findings.empty() ? "" : scan.findings.front()),
                          path.string());
    }
    if (last == nullptr) return std::optional<McapWriter>();
    sink.reset();  // its lock
    auto writable = OpenFileSinkBehind(path, EndOf(*last));
    if (!writable) return writable.error();
    sink = std::move(writable).value();
    if (EndOf(*last) == scan.good_bytes) break;
  }
  Contents& contents = scan.contents;
  if (!CountsFromOne(contents.definitions.schemas) || !CountsFromOne(contents.definitions.channels)) {
    return base::WrongInput("recording.of_another_program",
                            "the recording was written by another program; nothing can be added to it", path.string());
  }
  const auto crc = ChecksumOf(*source, scan.good_bytes);
  if (!crc) return crc.error();
  if (auto status = HandInTail(*source, contents, tail); !status) return status.error();
  auto work = std::make_unique<Work>(std::move(sink), settings);
  work->Resume(std::move(contents), scan.good_bytes, crc.value());
  return std::optional<McapWriter>(McapWriter(std::move(work)));
}

}  // namespace rodeira::record
