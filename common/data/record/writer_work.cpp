// SPDX-License-Identifier: Apache-2.0
#include "common/data/record/writer_work.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "common/data/record/checksum.hpp"

namespace rodeira::record {
namespace {

using base::Status;

constexpr std::uint64_t kMaxTextsBytes = 16u << 20;  // of a schema, a channel, a metadata record
constexpr std::size_t kMaxIds = std::numeric_limits<std::uint16_t>::max();

std::uint64_t SizeOf(const TextMap& texts) {
  std::uint64_t size = 0;
  for (const auto& [key, value] : texts) size += key.size() + value.size() + 2 * sizeof(std::uint32_t);
  return size;
}

}  // namespace

Status McapWriter::Work::Begin() {
  out_.PutRaw(MagicBytes());
  PutHeader(out_, Header{settings_.profile, settings_.library});
  return Emit();
}

void McapWriter::Work::Resume(Contents contents, std::uint64_t bytes, std::uint32_t crc) {
  offset_ = bytes;
  crc_ = crc;
  statistics_ = std::move(contents.statistics);
  for (auto& [id, schema] : contents.definitions.schemas) schemas_.push_back(std::move(schema));
  for (auto& [id, channel] : contents.definitions.channels) channels_.push_back(std::move(channel));
  chunks_ = std::move(contents.chunks);
  attachments_ = std::move(contents.attachments);
  metadata_ = std::move(contents.metadata);
}

// Hands out_ to the sink: all of it, or the file ends where it ended before.
Status McapWriter::Work::Emit() {
  if (failure_) return *failure_;
  if (auto status = sink_->Append(out_.bytes()); !status) {
    sink_->CutTo(offset_);
    failure_ = status.error();
    return status;
  }
  offset_ += out_.bytes().size();
  crc_ = Crc32(out_.bytes(), crc_);
  out_.Clear();
  return {};
}

base::Result<SchemaId> McapWriter::Work::AddSchema(std::string_view name, std::string_view encoding,
                                                   std::string_view text) {
  if (failure_) return *failure_;
  for (const Schema& known : schemas_) {
    if (known.name == name && known.encoding == encoding && known.text == text) return known.id;
  }
  if (name.size() + encoding.size() + text.size() > kMaxTextsBytes) {
    return Refuse(fmt::format("the schema '{:.64}' has more than {} bytes", name, kMaxTextsBytes));
  }
  if (schemas_.size() == kMaxIds) return Refuse(fmt::format("there are more than {} schemas", kMaxIds));
  if (auto status = MakeRoom(name.size() + encoding.size() + text.size()); !status) return status.error();
  schemas_.push_back(
      {static_cast<SchemaId>(schemas_.size() + 1), std::string(name), std::string(encoding), std::string(text)});
  chunk_.Add(schemas_.back());
  ++statistics_.schemas;
  return schemas_.back().id;
}

base::Result<ChannelId> McapWriter::Work::AddChannel(std::string_view topic, SchemaId schema,
                                                     std::string_view message_encoding, const TextMap& metadata) {
  if (failure_) return *failure_;
  if (schema > schemas_.size()) return Refuse(fmt::format("topic '{:.64}': there is no schema {}", topic, schema));
  for (const Channel& known : channels_) {
    if (known.topic == topic && known.schema == schema && known.message_encoding == message_encoding &&
        known.metadata == metadata) {
      return known.id;
    }
  }
  if (topic.size() + message_encoding.size() + SizeOf(metadata) > kMaxTextsBytes) {
    return Refuse(fmt::format("the channel of topic '{:.64}' has more than {} bytes", topic, kMaxTextsBytes));
  }
  if (channels_.size() == kMaxIds) return Refuse(fmt::format("there are more than {} channels", kMaxIds));
  if (auto status = MakeRoom(topic.size() + message_encoding.size() + SizeOf(metadata)); !status) return status.error();
  channels_.push_back({static_cast<ChannelId>(channels_.size() + 1), schema, std::string(topic),
                       std::string(message_encoding), metadata});
  chunk_.Add(channels_.back());
  ++statistics_.channels;
  return channels_.back().id;
}

Status McapWriter::Work::Write(const Message& message) {
  if (failure_) return *failure_;
  if (message.channel == 0 || message.channel > channels_.size()) {
    return Refuse(fmt::format("there is no channel {}", message.channel));
  }
  if (message.data.size() > kMaxMessageBytes) {
    return Refuse(fmt::format("topic '{}': a message has {} bytes, at most {} were expected",
                              channels_[message.channel - 1u].topic, message.data.size(), kMaxMessageBytes));
  }
  if (chunk_.SpanWith(message.log_time_ns) >= settings_.chunk_span_ns) {
    if (auto status = CloseChunk(); !status) return status;
  }
  if (auto status = MakeRoom(kHeadBytes + kMessageHeadBytes + message.data.size()); !status) return status;
  chunk_.Add(message);
  Statistics& s = statistics_;
  s.first_log_time_ns = s.messages == 0 ? message.log_time_ns : std::min(s.first_log_time_ns, message.log_time_ns);
  s.last_log_time_ns = s.messages == 0 ? message.log_time_ns : std::max(s.last_log_time_ns, message.log_time_ns);
  ++s.messages;
  ++s.messages_by_channel[message.channel];
  return {};
}

Status McapWriter::Work::MakeRoom(std::uint64_t record_bytes) {
  if (chunk_.empty() || chunk_.bytes() + record_bytes <= settings_.chunk_bytes) return {};
  return CloseChunk();
}

Status McapWriter::Work::CloseChunk() {
  if (failure_) return *failure_;
  if (chunk_.empty()) return {};
  chunks_.push_back(chunk_.Finish(offset_, out_));
  ++statistics_.chunks;
  if (auto status = Emit(); !status) return status;
  sink_->SyncSoon();
  return {};
}

Status McapWriter::Work::AddMetadata(std::string_view name, const TextMap& entries) {
  if (failure_) return *failure_;
  if (name.size() + SizeOf(entries) > kMaxTextsBytes) {
    return Refuse(fmt::format("the metadata '{:.64}' has more than {} bytes", name, kMaxTextsBytes));
  }
  if (auto status = CloseChunk(); !status) return status;
  PutMetadata(out_, name, entries);
  metadata_.push_back({std::string(name), offset_, out_.bytes().size()});
  ++statistics_.metadata;
  return Emit();
}

Status McapWriter::Work::AddAttachment(AttachmentInfo info, std::span<const std::byte> data) {
  if (failure_) return *failure_;
  if (data.size() > kMaxRecordBytes - kMaxTextsBytes ||
      info.name.size() + info.media_type.size() > kMaxTextsBytes / 2) {
    return Refuse(fmt::format("the attachment '{:.64}' has {} bytes, at most {} were expected", info.name, data.size(),
                              kMaxRecordBytes - kMaxTextsBytes));
  }
  if (auto status = CloseChunk(); !status) return status;
  PutAttachment(out_, info, data);
  info.offset = offset_;
  info.record_bytes = out_.bytes().size();
  info.data_bytes = data.size();
  attachments_.push_back(std::move(info));
  ++statistics_.attachments;
  return Emit();
}

Status McapWriter::Work::Sync() {
  if (auto status = CloseChunk(); !status) return status;
  if (auto status = sink_->Sync(); !status) {
    failure_ = status.error();
    return status;
  }
  return {};
}

void McapWriter::Work::PutSummary(std::vector<SummaryOffset>& groups) {
  const auto group = [&](Opcode opcode, const auto& records, auto put) {
    const std::size_t begin = out_.bytes().size();
    for (const auto& record : records) put(out_, record);
    if (!records.empty()) groups.push_back({opcode, offset_ + begin, out_.bytes().size() - begin});
  };
  group(Opcode::kSchema, schemas_, PutSchema);
  group(Opcode::kChannel, channels_, PutChannel);
  group(Opcode::kStatistics, std::vector<Statistics>{statistics_}, PutStatistics);
  group(Opcode::kChunkIndex, chunks_, PutChunkIndex);
  group(Opcode::kAttachmentIndex, attachments_, PutAttachmentIndex);
  group(Opcode::kMetadataIndex, metadata_, PutMetadataIndex);
}

// DataEnd, summary, summary offsets, footer and magic, all at once.
Status McapWriter::Work::Finish() {
  closed_ = true;
  if (auto status = CloseChunk(); !status) return status;
  PutDataEnd(out_, crc_);
  const std::size_t summary = out_.bytes().size();
  std::vector<SummaryOffset> groups;
  PutSummary(groups);
  const std::size_t offsets = out_.bytes().size();
  for (const SummaryOffset& group : groups) PutSummaryOffset(out_, group);
  PutFooterStart(out_, offset_ + summary, offset_ + offsets);
  out_.Put(Crc32(std::span(out_.bytes()).subspan(summary)));
  out_.PutRaw(MagicBytes());
  if (auto status = Emit(); !status) return status;
  if (auto status = sink_->Close(); !status) {
    failure_ = status.error();
    return status;
  }
  return {};
}

}  // namespace rodeira::record
