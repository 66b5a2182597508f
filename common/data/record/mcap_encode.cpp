// SPDX-License-Identifier: Apache-2.0
#include "common/data/record/mcap_format.hpp"

#include <cstring>

#include "common/data/record/checksum.hpp"

namespace rodeira::record {
namespace {

using base::ByteWriter;

void PutTexts(ByteWriter& out, const TextMap& texts) {
  const std::size_t at = out.bytes().size();
  out.Put(std::uint32_t{0});
  for (const auto& [key, value] : texts) {
    out.PutString(key);
    out.PutString(value);
  }
  const auto size = static_cast<std::uint32_t>(out.bytes().size() - at - sizeof(std::uint32_t));
  std::memcpy(out.bytes().data() + at, &size, sizeof size);
}

void PutCounts(ByteWriter& out, const std::map<ChannelId, std::uint64_t>& counts) {
  out.Put(static_cast<std::uint32_t>(counts.size() * (sizeof(ChannelId) + sizeof(std::uint64_t))));
  for (const auto& [channel, count] : counts) {
    out.Put(channel);
    out.Put(count);
  }
}

}  // namespace

std::size_t BeginRecord(ByteWriter& out, Opcode opcode) {
  const std::size_t begin = out.bytes().size();
  out.Put(opcode);
  out.Put(std::uint64_t{0});
  return begin;
}

void EndRecord(ByteWriter& out, std::size_t begin) {
  const std::uint64_t length = out.bytes().size() - begin - kHeadBytes;
  std::memcpy(out.bytes().data() + begin + 1, &length, sizeof length);
}

void PutHeader(ByteWriter& out, const Header& header) {
  const std::size_t begin = BeginRecord(out, Opcode::kHeader);
  out.PutString(header.profile);
  out.PutString(header.library);
  EndRecord(out, begin);
}

void PutSchema(ByteWriter& out, const Schema& schema) {
  const std::size_t begin = BeginRecord(out, Opcode::kSchema);
  out.Put(schema.id);
  out.PutString(schema.name);
  out.PutString(schema.encoding);
  out.PutString(schema.text);
  EndRecord(out, begin);
}

void PutChannel(ByteWriter& out, const Channel& channel) {
  const std::size_t begin = BeginRecord(out, Opcode::kChannel);
  out.Put(channel.id);
  out.Put(channel.schema);
  out.PutString(channel.topic);
  out.PutString(channel.message_encoding);
  PutTexts(out, channel.metadata);
  EndRecord(out, begin);
}

void PutMessage(ByteWriter& out, const Message& message) {
  out.Put(Opcode::kMessage);
  out.Put(std::uint64_t{kMessageHeadBytes + message.data.size()});
  out.Put(message.channel);
  out.Put(message.sequence);
  out.Put(message.log_time_ns);
  out.Put(message.publish_time_ns);
  out.PutRaw(message.data);
}

void PutMessageIndex(ByteWriter& out, ChannelId channel, const IndexEntries& entries) {
  const std::size_t begin = BeginRecord(out, Opcode::kMessageIndex);
  out.Put(channel);
  out.Put(static_cast<std::uint32_t>(entries.size() * 2 * sizeof(std::uint64_t)));
  for (const auto& [log_time_ns, offset] : entries) {
    out.Put(log_time_ns);
    out.Put(offset);
  }
  EndRecord(out, begin);
}

void PutChunkIndex(ByteWriter& out, const ChunkInfo& chunk) {
  const std::size_t begin = BeginRecord(out, Opcode::kChunkIndex);
  out.Put(chunk.first_log_time_ns);
  out.Put(chunk.last_log_time_ns);
  out.Put(chunk.offset);
  out.Put(chunk.record_bytes);
  PutCounts(out, chunk.index_offsets);
  out.Put(chunk.index_bytes);
  out.PutString(chunk.compression);
  out.Put(chunk.compressed_bytes);
  out.Put(chunk.uncompressed_bytes);
  EndRecord(out, begin);
}

void PutAttachment(ByteWriter& out, const AttachmentInfo& info, std::span<const std::byte> data) {
  const std::size_t begin = BeginRecord(out, Opcode::kAttachment);
  out.Put(info.log_time_ns);
  out.Put(info.create_time_ns);
  out.PutString(info.name);
  out.PutString(info.media_type);
  out.Put(std::uint64_t{data.size()});
  out.PutRaw(data);
  out.Put(Crc32(std::span(out.bytes()).subspan(begin + kHeadBytes)));
  EndRecord(out, begin);
}

void PutAttachmentIndex(ByteWriter& out, const AttachmentInfo& info) {
  const std::size_t begin = BeginRecord(out, Opcode::kAttachmentIndex);
  out.Put(info.offset);
  out.Put(info.record_bytes);
  out.Put(info.log_time_ns);
  out.Put(info.create_time_ns);
  out.Put(info.data_bytes);
  out.PutString(info.name);
  out.PutString(info.media_type);
  EndRecord(out, begin);
}

void PutMetadata(ByteWriter& out, std::string_view name, const TextMap& entries) {
  const std::size_t begin = BeginRecord(out, Opcode::kMetadata);
  out.PutString(name);
  PutTexts(out, entries);
  EndRecord(out, begin);
}

void PutMetadataIndex(ByteWriter& out, const MetadataInfo& info) {
  const std::size_t begin = BeginRecord(out, Opcode::kMetadataIndex);
  out.Put(info.offset);
  out.Put(info.record_bytes);
  out.PutString(info.name);
  EndRecord(out, begin);
}

void PutStatistics(ByteWriter& out, const Statistics& statistics) {
  const std::size_t begin = BeginRecord(out, Opcode::kStatistics);
  out.Put(statistics.messages);
  out.Put(statistics.schemas);
  out.Put(statistics.channels);
  out.Put(statistics.attachments);
  out.Put(statistics.metadata);
  out.Put(statistics.chunks);
  out.Put(statistics.first_log_time_ns);
  out.Put(statistics.last_log_time_ns);
  PutCounts(out, statistics.messages_by_channel);
  EndRecord(out, begin);
}

void PutSummaryOffset(ByteWriter& out, const SummaryOffset& group) {
  const std::size_t begin = BeginRecord(out, Opcode::kSummaryOffset);
  out.Put(group.group);
  out.Put(group.start);
  out.Put(group.length);
  EndRecord(out, begin);
}

void PutDataEnd(ByteWriter& out, std::uint32_t crc) {
  const std::size_t begin = BeginRecord(out, Opcode::kDataEnd);
  out.Put(crc);
  EndRecord(out, begin);
}

void PutFooterStart(ByteWriter& out, std::uint64_t summary_start, std::uint64_t summary_offset_start) {
  out.Put(Opcode::kFooter);
  out.Put(std::uint64_t{kFooterBytes - kHeadBytes});
  out.Put(summary_start);
  out.Put(summary_offset_start);
}

}  // namespace rodeira::record
