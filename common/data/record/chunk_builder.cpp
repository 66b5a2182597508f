// SPDX-License-Identifier: Apache-2.0
#include "common/data/record/chunk_builder.hpp"

#include <algorithm>
#include <cstring>

#include "common/data/record/checksum.hpp"

namespace rodeira::record {

ChunkBuilder::ChunkBuilder(Compression compression, int zstd_level) : compression_(compression) {
  if (compression == Compression::kZstd) zstd_ = std::make_unique<ZstdCompressor>(zstd_level);
}

void ChunkBuilder::Add(const Message& message) {
  index_[message.channel].emplace_back(message.log_time_ns, bytes());
  PutMessage(records_, message);
  first_log_time_ns_ = has_messages_ ? std::min(first_log_time_ns_, message.log_time_ns) : message.log_time_ns;
  last_log_time_ns_ = has_messages_ ? std::max(last_log_time_ns_, message.log_time_ns) : message.log_time_ns;
  has_messages_ = true;
}

std::uint64_t ChunkBuilder::SpanWith(std::uint64_t log_time_ns) const {
  if (!has_messages_) return 0;
  return std::max(last_log_time_ns_, log_time_ns) - std::min(first_log_time_ns_, log_time_ns);
}

ChunkInfo ChunkBuilder::Finish(std::uint64_t file_offset, base::ByteWriter& out) {
  const std::size_t start = out.bytes().size();
  const auto offset_now = [&] { return file_offset + (out.bytes().size() - start); };
  ChunkInfo info;
  info.offset = file_offset;
  info.first_log_time_ns = first_log_time_ns_;
  info.last_log_time_ns = last_log_time_ns_;
  info.uncompressed_bytes = bytes();
  info.compression = compression_ == Compression::kZstd ? "zstd" : "";

  const std::size_t begin = BeginRecord(out, Opcode::kChunk);
  out.Put(info.first_log_time_ns);
  out.Put(info.last_log_time_ns);
  out.Put(info.uncompressed_bytes);
  out.Put(Crc32(records_.bytes()));
  out.PutString(info.compression);
  const std::size_t size_at = out.bytes().size();
  out.Put(std::uint64_t{0});
  if (zstd_) {
    info.compressed_bytes = zstd_->Append(records_.bytes(), out.bytes());
  } else {
    out.PutRaw(records_.bytes());
    info.compressed_bytes = bytes();
  }
  std::memcpy(out.bytes().data() + size_at, &info.compressed_bytes, sizeof info.compressed_bytes);
  EndRecord(out, begin);
  info.record_bytes = offset_now() - file_offset;

  for (auto& [channel, entries] : index_) {
    if (entries.empty()) continue;  // kept from an earlier chunk for its memory
    info.index_offsets.emplace(channel, offset_now());
    PutMessageIndex(out, channel, entries);
    entries.clear();
  }
  info.index_bytes = offset_now() - file_offset - info.record_bytes;
  records_.Clear();
  has_messages_ = false;
  first_log_time_ns_ = last_log_time_ns_ = 0;
  return info;
}

}  // namespace rodeira::record
