#include "common/record/mcap_writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "common/record/checksum.hpp"
#include "common/record/chunk_builder.hpp"
#include "common/record/mcap_format.hpp"

namespace rodeira::record {
namespace {

using base::ByteWriter;
using base::Status;

constexpr std::uint64_t kMaxTextsBytes = 16u << 20;  // of a schema, a channel, a metadata record
constexpr std::uint64_t kMaxSpanNs = 1'000'000'000;
constexpr std::uint64_t kMinChunkBytes = 4u << 10;
constexpr std::uint64_t kMaxChunkBytes = 64u << 20;
constexpr std::size_t kMaxIds = std::numeric_limits<std::uint16_t>::max();

std::uint64_t SizeOf(const TextMap& texts) {
  std::uint64_t size = 0;
  for (const auto& [key, value] : texts) size += key.size() + value.size() + 2 * sizeof(std::uint32_t);
  return size;
}

Status CheckSettings(const WriterSettings& settings, const std::string& where) {
  if (settings.chunk_span_ns == 0 || settings.chunk_span_ns > kMaxSpanNs) {
    return base::WrongInput(
        fmt::format("chunk_span_ns is {}, 1 to {} (one second) was expected", settings.chunk_span_ns, kMaxSpanNs), where);
  }
  if (settings.chunk_bytes < kMinChunkBytes || settings.chunk_bytes > kMaxChunkBytes) {
    return base::WrongInput(fmt::format("chunk_bytes is {}, {} to {} was expected", settings.chunk_bytes, kMinChunkBytes,
                                        kMaxChunkBytes),
                            where);
  }
  if (settings.zstd_level < 1 || settings.zstd_level > 19) {
    return base::WrongInput(fmt::format("zstd_level is {}, 1 to 19 was expected", settings.zstd_level), where);
  }
  if (settings.profile.size() + settings.library.size() > kMaxTextsBytes) {
    return base::WrongInput("profile and library are too long", where);
  }
  return {};
}

}  // namespace

class McapWriter::Work {
 public:
  Work(std::unique_ptr<Sink> sink, const WriterSettings& settings)
      : sink_(std::move(sink)), settings_(settings), chunk_(settings.compression, settings.zstd_level) {}

  Status Begin() {
    out_.PutRaw(MagicBytes());
    PutHeader(out_, Header{settings_.profile, settings_.library});
    return Emit();
  }

  base::Result<SchemaId> AddSchema(std::string_view name, std::string_view encoding, std::string_view text);
  base::Result<ChannelId> AddChannel(std::string_view topic, SchemaId schema, std::string_view message_encoding,
                                     const TextMap& metadata);
  Status Write(const Message& message);
  Status AddMetadata(std::string_view name, const TextMap& entries);
  Status AddAttachment(AttachmentInfo info, std::span<const std::byte> data);
  Status CloseChunk();
  Status Sync();
  Status Finish();

  bool closed() const { return closed_; }
  const Statistics& statistics() const { return statistics_; }
  std::uint64_t written_bytes() const { return offset_; }
  base::Error Refuse(std::string message) const { return base::WrongInput(std::move(message), sink_->name()); }
  const std::optional<base::Error>& failure() const { return failure_; }

 private:
  Status Emit();
  // Closes the chunk where another record of that size would make it too large.
  Status MakeRoom(std::uint64_t record_bytes);
  void PutSummary(std::vector<SummaryOffset>& groups);

  std::unique_ptr<Sink> sink_;
  WriterSettings settings_;
  ChunkBuilder chunk_;
  ByteWriter out_;             // what goes to the sink next
  std::uint64_t offset_ = 0;   // bytes in the sink
  std::uint32_t crc_ = 0;      // of these
  bool closed_ = false;
  std::optional<base::Error> failure_;
  Statistics statistics_;
  std::vector<Schema> schemas_;    // id − 1
  std::vector<Channel> channels_;  // id − 1
  std::vector<ChunkInfo> chunks_;
  std::vector<AttachmentInfo> attachments_;
  std::vector<MetadataInfo> metadata_;
};

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
  schemas_.push_back({static_cast<SchemaId>(schemas_.size() + 1), std::string(name), std::string(encoding),
                      std::string(text)});
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
  return Emit();
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
  if (data.size() > kMaxRecordBytes - kMaxTextsBytes || info.name.size() + info.media_type.size() > kMaxTextsBytes / 2) {
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

McapWriter::McapWriter(std::unique_ptr<Work> work) : work_(std::move(work)) {}
McapWriter::McapWriter(McapWriter&&) noexcept = default;
McapWriter& McapWriter::operator=(McapWriter&& other) noexcept {
  if (this != &other) {
    if (work_ && !work_->closed()) static_cast<void>(work_->Finish().ok());
    work_ = std::move(other.work_);
  }
  return *this;
}
McapWriter::~McapWriter() {
  if (work_ && !work_->closed()) static_cast<void>(work_->Finish().ok());
}

base::Result<McapWriter> McapWriter::Open(const std::filesystem::path& path, const WriterSettings& settings) {
  if (auto status = CheckSettings(settings, path.string()); !status) return status.error();
  auto sink = OpenFileSink(path, settings.overwrite);
  if (!sink) return sink.error();
  return Open(std::move(sink).value(), settings);
}

base::Result<McapWriter> McapWriter::Open(std::unique_ptr<Sink> sink, const WriterSettings& settings) {
  if (auto status = CheckSettings(settings, sink->name()); !status) return status.error();
  auto work = std::make_unique<Work>(std::move(sink), settings);
  if (auto status = work->Begin(); !status) return status.error();
  return McapWriter(std::move(work));
}

base::Result<SchemaId> McapWriter::AddSchema(std::string_view name, std::string_view encoding, std::string_view text) {
  RODEIRA_ASSERT(!work_->closed());
  return work_->AddSchema(name, encoding, text);
}

base::Result<ChannelId> McapWriter::AddChannel(std::string_view topic, SchemaId schema,
                                               std::string_view message_encoding, const TextMap& metadata) {
  RODEIRA_ASSERT(!work_->closed());
  return work_->AddChannel(topic, schema, message_encoding, metadata);
}

Status McapWriter::Write(ChannelId channel, std::uint32_t sequence, std::uint64_t log_time_ns,
                         std::uint64_t publish_time_ns, std::span<const std::byte> data) {
  RODEIRA_ASSERT(!work_->closed());
  return work_->Write(Message{channel, sequence, log_time_ns, publish_time_ns, data});
}

Status McapWriter::AddMetadata(std::string_view name, const TextMap& entries) {
  RODEIRA_ASSERT(!work_->closed());
  return work_->AddMetadata(name, entries);
}

Status McapWriter::AddAttachment(std::string_view name, std::string_view media_type, std::span<const std::byte> data,
                                 std::uint64_t log_time_ns, std::uint64_t create_time_ns) {
  RODEIRA_ASSERT(!work_->closed());
  AttachmentInfo info;
  info.name = name;
  info.media_type = media_type;
  info.log_time_ns = log_time_ns;
  info.create_time_ns = create_time_ns;
  return work_->AddAttachment(std::move(info), data);
}

Status McapWriter::Flush() {
  RODEIRA_ASSERT(!work_->closed());
  return work_->CloseChunk();
}

Status McapWriter::Sync() {
  RODEIRA_ASSERT(!work_->closed());
  return work_->Sync();
}

Status McapWriter::Close() {
  if (work_->closed()) return work_->failure() ? Status(*work_->failure()) : Status();
  return work_->Finish();
}

const Statistics& McapWriter::statistics() const { return work_->statistics(); }
std::uint64_t McapWriter::written_bytes() const { return work_->written_bytes(); }

}  // namespace rodeira::record
