// SPDX-License-Identifier: Apache-2.0
#include "common/data/record/mcap_format.hpp"

#include "common/data/record/checksum.hpp"

namespace rodeira::record {
namespace {

using base::ByteReader;

// The bytes behind a u32 length.
ByteReader GetBlock(ByteReader& in) {
  const auto size = in.Get<std::uint32_t>();
  return ByteReader(in.GetRaw(size));
}

bool GetTexts(ByteReader& in, TextMap& texts) {
  ByteReader block = GetBlock(in);
  while (block.ok() && block.remaining() > 0) {
    std::string key = block.GetString();
    std::string value = block.GetString();
    if (!block.ok() || !texts.emplace(std::move(key), std::move(value)).second) return false;
  }
  return in.ok();
}

bool GetCounts(ByteReader& in, std::map<ChannelId, std::uint64_t>& counts) {
  ByteReader block = GetBlock(in);
  while (block.ok() && block.remaining() > 0) {
    const auto channel = block.Get<ChannelId>();
    const auto count = block.Get<std::uint64_t>();
    if (!block.ok() || !counts.emplace(channel, count).second) return false;
  }
  return in.ok();
}

// True where the fields fit into the record.
bool AtEnd(const ByteReader& in, Rules rules = Rules::kOwn) {
  return in.ok() && (rules == Rules::kSpecification || in.remaining() == 0);
}

}  // namespace

std::optional<RecordView> RecordAt(std::span<const std::byte> bytes, std::uint64_t offset) {
  if (offset > bytes.size()) return std::nullopt;
  ByteReader in(bytes.subspan(static_cast<std::size_t>(offset)));
  RecordView record;
  record.opcode = in.Get<Opcode>();
  record.offset = offset;
  const auto length = in.Get<std::uint64_t>();
  if (!in.ok() || length > in.remaining()) return std::nullopt;
  record.content = in.GetRaw(static_cast<std::size_t>(length));
  return record;
}

std::optional<Header> ParseHeader(std::span<const std::byte> content) {
  ByteReader in(content);
  Header header;
  header.profile = in.GetString();
  header.library = in.GetString();
  return AtEnd(in, RulesOf(header)) ? std::optional(std::move(header)) : std::nullopt;
}

std::optional<Footer> ParseFooter(std::span<const std::byte> content) {
  ByteReader in(content);
  Footer footer;
  footer.summary_start = in.Get<std::uint64_t>();
  footer.summary_offset_start = in.Get<std::uint64_t>();
  footer.summary_crc = in.Get<std::uint32_t>();
  return AtEnd(in) ? std::optional(footer) : std::nullopt;
}

std::optional<Schema> ParseSchema(std::span<const std::byte> content, Rules rules) {
  ByteReader in(content);
  Schema schema;
  schema.id = in.Get<SchemaId>();
  schema.name = in.GetString();
  schema.encoding = in.GetString();
  schema.text = in.GetString();
  return AtEnd(in, rules) && (schema.id != 0 || rules == Rules::kSpecification) ? std::optional(std::move(schema))
                                                                                : std::nullopt;
}

std::optional<Channel> ParseChannel(std::span<const std::byte> content, Rules rules) {
  ByteReader in(content);
  Channel channel;
  channel.id = in.Get<ChannelId>();
  channel.schema = in.Get<SchemaId>();
  channel.topic = in.GetString();
  channel.message_encoding = in.GetString();
  if (!GetTexts(in, channel.metadata) || !AtEnd(in, rules)) return std::nullopt;
  return channel;
}

std::optional<Message> ParseMessage(std::span<const std::byte> content) {
  ByteReader in(content);
  Message message;
  message.channel = in.Get<ChannelId>();
  message.sequence = in.Get<std::uint32_t>();
  message.log_time_ns = in.Get<std::uint64_t>();
  message.publish_time_ns = in.Get<std::uint64_t>();
  message.data = in.GetRaw(in.remaining());
  return AtEnd(in) ? std::optional(message) : std::nullopt;
}

std::optional<ChunkHead> ParseChunk(std::span<const std::byte> content, Rules rules) {
  ByteReader in(content);
  ChunkHead chunk;
  chunk.first_log_time_ns = in.Get<std::uint64_t>();
  chunk.last_log_time_ns = in.Get<std::uint64_t>();
  chunk.uncompressed_bytes = in.Get<std::uint64_t>();
  chunk.crc = in.Get<std::uint32_t>();
  chunk.compression = in.GetString();
  const auto size = in.Get<std::uint64_t>();
  chunk.records = in.GetRaw(size);
  return AtEnd(in, rules) ? std::optional(std::move(chunk)) : std::nullopt;
}

std::optional<MessageIndex> ParseMessageIndex(std::span<const std::byte> content, Rules rules) {
  ByteReader in(content);
  MessageIndex index;
  index.channel = in.Get<ChannelId>();
  ByteReader block = GetBlock(in);
  if (!AtEnd(in, rules) || block.remaining() % (2 * sizeof(std::uint64_t)) != 0) return std::nullopt;
  index.entries.reserve(block.remaining() / (2 * sizeof(std::uint64_t)));
  while (block.remaining() > 0) {
    const auto log_time_ns = block.Get<std::uint64_t>();
    index.entries.emplace_back(log_time_ns, block.Get<std::uint64_t>());
  }
  return index;
}

std::optional<ChunkInfo> ParseChunkIndex(std::span<const std::byte> content, Rules rules) {
  ByteReader in(content);
  ChunkInfo chunk;
  chunk.first_log_time_ns = in.Get<std::uint64_t>();
  chunk.last_log_time_ns = in.Get<std::uint64_t>();
  chunk.offset = in.Get<std::uint64_t>();
  chunk.record_bytes = in.Get<std::uint64_t>();
  if (!GetCounts(in, chunk.index_offsets)) return std::nullopt;
  chunk.index_bytes = in.Get<std::uint64_t>();
  chunk.compression = in.GetString();
  chunk.compressed_bytes = in.Get<std::uint64_t>();
  chunk.uncompressed_bytes = in.Get<std::uint64_t>();
  return AtEnd(in, rules) ? std::optional(std::move(chunk)) : std::nullopt;
}

std::optional<Attachment> ParseAttachment(std::span<const std::byte> content, Rules rules) {
  ByteReader in(content);
  Attachment attachment;
  attachment.log_time_ns = in.Get<std::uint64_t>();
  attachment.create_time_ns = in.Get<std::uint64_t>();
  attachment.name = in.GetString();
  attachment.media_type = in.GetString();
  const auto data = in.GetRaw(in.Get<std::uint64_t>());
  const std::size_t covered = in.position();
  const auto crc = in.Get<std::uint32_t>();
  if (!AtEnd(in, rules) || (crc != 0 && crc != Crc32(content.first(covered)))) return std::nullopt;
  attachment.data.assign(data.begin(), data.end());
  return attachment;
}

std::optional<AttachmentInfo> ParseAttachmentIndex(std::span<const std::byte> content, Rules rules) {
  ByteReader in(content);
  AttachmentInfo info;
  info.offset = in.Get<std::uint64_t>();
  info.record_bytes = in.Get<std::uint64_t>();
  info.log_time_ns = in.Get<std::uint64_t>();
  info.create_time_ns = in.Get<std::uint64_t>();
  info.data_bytes = in.Get<std::uint64_t>();
  info.name = in.GetString();
  info.media_type = in.GetString();
  return AtEnd(in, rules) ? std::optional(std::move(info)) : std::nullopt;
}

std::optional<Metadata> ParseMetadata(std::span<const std::byte> content, Rules rules) {
  ByteReader in(content);
  Metadata metadata;
  metadata.name = in.GetString();
  if (!GetTexts(in, metadata.entries) || !AtEnd(in, rules)) return std::nullopt;
  return metadata;
}

std::optional<MetadataInfo> ParseMetadataIndex(std::span<const std::byte> content, Rules rules) {
  ByteReader in(content);
  MetadataInfo info;
  info.offset = in.Get<std::uint64_t>();
  info.record_bytes = in.Get<std::uint64_t>();
  info.name = in.GetString();
  return AtEnd(in, rules) ? std::optional(std::move(info)) : std::nullopt;
}

std::optional<Statistics> ParseStatistics(std::span<const std::byte> content, Rules rules) {
  ByteReader in(content);
  Statistics statistics;
  statistics.messages = in.Get<std::uint64_t>();
  statistics.schemas = in.Get<std::uint16_t>();
  statistics.channels = in.Get<std::uint32_t>();
  statistics.attachments = in.Get<std::uint32_t>();
  statistics.metadata = in.Get<std::uint32_t>();
  statistics.chunks = in.Get<std::uint32_t>();
  statistics.first_log_time_ns = in.Get<std::uint64_t>();
  statistics.last_log_time_ns = in.Get<std::uint64_t>();
  if (!GetCounts(in, statistics.messages_by_channel) || !AtEnd(in, rules)) return std::nullopt;
  return statistics;
}

std::optional<SummaryOffset> ParseSummaryOffset(std::span<const std::byte> content) {
  ByteReader in(content);
  SummaryOffset group;
  group.group = in.Get<Opcode>();
  group.start = in.Get<std::uint64_t>();
  group.length = in.Get<std::uint64_t>();
  return AtEnd(in) ? std::optional(group) : std::nullopt;
}

std::optional<std::uint32_t> ParseDataEnd(std::span<const std::byte> content, Rules rules) {
  ByteReader in(content);
  const auto crc = in.Get<std::uint32_t>();
  return AtEnd(in, rules) ? std::optional(crc) : std::nullopt;
}

}  // namespace rodeira::record
