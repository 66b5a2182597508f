// SPDX-License-Identifier: Apache-2.0
#include "common/data/record/repair.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

#include "common/core/base/put_in_place.hpp"
#include "common/data/record/mcap_contents.hpp"
#include "common/data/record/mcap_reader.hpp"
#include "common/data/record/mcap_writer.hpp"

namespace rodeira::record {
namespace {

using base::Status;

// Copies what can be read of one recording into a new one, in file order and chunk by chunk.
class Copier {
 public:
  Copier(const Source& source, const Contents& contents, McapWriter& writer, RepairReport& report, RepairEnd* end)
      : source_(source), contents_(contents), writer_(writer), report_(report), end_(end) {}

  Status Run();
  // Of the record that is written anew.
  const TextMap& found_end() const { return found_end_; }

 private:
  // Ids of the new recording for those of the old one.
  base::Result<SchemaId> IdOf(const Schema& schema);
  base::Result<ChannelId> IdOf(const Channel& channel);
  Status CopyChunk(const ChunkInfo& info);
  Status CopyRecord(const RecordView& record);
  Status CopyMetadata(const MetadataInfo& info);
  Status CopyAttachment(const AttachmentInfo& info);
  base::Result<FileRecord> Read(std::uint64_t offset, std::uint64_t record_bytes) const {
    return ReadRecord(source_, offset, offset + record_bytes);
  }

  const Source& source_;
  const Contents& contents_;
  McapWriter& writer_;
  RepairReport& report_;
  RepairEnd* end_;
  TextMap found_end_;
  std::map<ChannelId, ChannelId> channel_ids_;
};

base::Result<SchemaId> Copier::IdOf(const Schema& schema) {
  return writer_.AddSchema(schema.name, schema.encoding, schema.text);
}

base::Result<ChannelId> Copier::IdOf(const Channel& channel) {
  SchemaId schema = 0;
  if (channel.schema != 0) {
    auto id = IdOf(contents_.definitions.schemas.at(channel.schema));
    if (!id) return id;
    schema = id.value();
  }
  auto id = writer_.AddChannel(channel.topic, schema, channel.message_encoding, channel.metadata);
  if (id) channel_ids_[channel.id] = id.value();
  return id;
}

Status Copier::CopyRecord(const RecordView& record) {
  if (record.opcode == Opcode::kSchema) {
    const auto id = IdOf(*ParseSchema(record.content));
    return id ? Status() : Status(id.error());
  }
  if (record.opcode == Opcode::kChannel) {
    const auto id = IdOf(*ParseChannel(record.content));
    return id ? Status() : Status(id.error());
  }
  if (record.opcode != Opcode::kMessage) return {};
  const Message message = *ParseMessage(record.content);
  if (!channel_ids_.contains(message.channel)) {  // its definition lay in a chunk that is lost
    const auto id = IdOf(contents_.definitions.channels.at(message.channel));
    if (!id) return id.error();
  }
  if (end_ != nullptr) end_->Keep(contents_.definitions.channels.at(message.channel), message);
  return writer_.Write(channel_ids_.at(message.channel), message.sequence, message.log_time_ns, message.publish_time_ns,
                       message.data);
}

Status Copier::CopyChunk(const ChunkInfo& info) {
  const auto chunk = LoadChunk(source_, info, contents_.definitions);
  if (!chunk) {
    report_.losses.push_back(fmt::format("byte {}: {}", info.offset, chunk.error().message));
    return {};
  }
  for (std::uint64_t offset = 0; offset < chunk.value().records.size();) {
    const RecordView record = *RecordAt(chunk.value().records, offset);  // DecodeChunk found all of them whole
    if (auto status = CopyRecord(record); !status) return status;
    offset += kHeadBytes + record.content.size();
  }
  return writer_.Flush();
}

Status Copier::CopyMetadata(const MetadataInfo& info) {
  const auto record = Read(info.offset, info.record_bytes);
  const auto metadata = record ? ParseMetadata(record.value().content()) : std::nullopt;
  if (!metadata || record.value().opcode != Opcode::kMetadata) {
    report_.losses.push_back(fmt::format("byte {}: the metadata '{:.64}' are damaged", info.offset, info.name));
    return {};
  }
  if (end_ != nullptr && metadata->name == end_->name()) {
    found_end_ = metadata->entries;
    return {};
  }
  return writer_.AddMetadata(metadata->name, metadata->entries);
}

Status Copier::CopyAttachment(const AttachmentInfo& info) {
  const auto record = Read(info.offset, info.record_bytes);
  const auto attachment = record ? ParseAttachment(record.value().content()) : std::nullopt;
  if (!attachment || record.value().opcode != Opcode::kAttachment) {
    report_.losses.push_back(fmt::format("byte {}: the attachment '{:.64}' is damaged", info.offset, info.name));
    return {};
  }
  return writer_.AddAttachment(attachment->name, attachment->media_type, attachment->data, attachment->log_time_ns,
                               attachment->create_time_ns);
}

Status Copier::Run() {
  auto chunk = contents_.chunks.begin();
  auto metadata = contents_.metadata.begin();
  auto attachment = contents_.attachments.begin();
  const auto next = [](const auto& at, const auto& list) { return at == list.end() ? ~std::uint64_t{0} : at->offset; };
  while (true) {
    const std::uint64_t c = next(chunk, contents_.chunks);
    const std::uint64_t m = next(metadata, contents_.metadata);
    const std::uint64_t a = next(attachment, contents_.attachments);
    if (std::min({c, m, a}) == ~std::uint64_t{0}) return {};
    Status status;
    if (c < m && c < a) {
      status = CopyChunk(*chunk++);
    } else if (m < a) {
      status = CopyMetadata(*metadata++);
    } else {
      status = CopyAttachment(*attachment++);
    }
    if (!status) return status;
  }
}

TextMap Statement(const RepairReport& report) {
  TextMap entries{{"source_bytes", fmt::format("{}", report.source_bytes)},
                  {"messages_kept", fmt::format("{}", report.kept.messages)},
                  {"last_log_time_ns", fmt::format("{}", report.kept.last_log_time_ns)}};
  for (std::size_t i = 0; i < report.losses.size(); ++i) {
    entries.emplace(fmt::format("loss_{:03}", i + 1), report.losses[i]);
  }
  return entries;
}

base::Result<RepairReport> RepairInto(const Source& source, std::unique_ptr<Sink> sink, RepairEnd* end) {
  RepairReport report;
  report.source_bytes = source.size();
  const auto scan = ScanFile(source);
  if (!scan) return scan.error();
  const auto summary = ReadSummary(source);
  report.was_whole = summary.ok() && scan.value().ended && scan.value().findings.empty();
  // With a whole summary the chunks behind a damaged one can be found; otherwise the scan's end is the end.
  const bool by_summary = summary.ok() && !scan.value().ended;
  const Contents& contents = by_summary ? summary.value() : scan.value().contents;
  if (!by_summary) {
    if (!summary) report.losses.push_back(summary.error().message);
    report.losses.insert(report.losses.end(), scan.value().findings.begin(), scan.value().findings.end());
  }

  WriterSettings settings;
  settings.chunk_bytes = 64u << 20;  // the source's chunks stay as they are
  settings.profile = contents.header.profile;
  settings.library = contents.header.library;
  const bool compressed =
      std::ranges::any_of(contents.chunks, [](const ChunkInfo& c) { return !c.compression.empty(); });
  settings.compression = compressed ? Compression::kZstd : Compression::kNone;
  auto writer = McapWriter::Open(std::move(sink), settings);
  if (!writer) return writer.error();
  if (report.was_whole) end = nullptr;
  if (end != nullptr) end->Begin(contents.definitions.channels);
  Copier copier(source, contents, writer.value(), report, end);
  if (auto status = copier.Run(); !status) return status.error();
  if (const TextMap entries = end != nullptr ? end->Entries(copier.found_end()) : TextMap(); !entries.empty()) {
    if (auto status = writer.value().AddMetadata(end->name(), entries); !status) return status.error();
  }
  report.kept = writer.value().statistics();
  if (!report.was_whole) {
    if (auto status = writer.value().AddMetadata(kRepairMetadata, Statement(report)); !status) return status.error();
  }
  if (auto status = writer.value().Sync(); !status) return status.error();
  if (auto status = writer.value().Close(); !status) return status.error();
  report.target_bytes = writer.value().written_bytes();
  return report;
}

}  // namespace

std::string RepairReport::Text() const {
  std::string text = was_whole ? "the recording was whole\n" : "";
  for (const std::string& loss : losses) text += loss + "\n";
  text += fmt::format("kept: {} messages of {} channels in {} chunks, {} attachments, {} metadata records",
                      kept.messages, kept.channels, kept.chunks, kept.attachments, kept.metadata);
  if (kept.messages > 0) text += fmt::format("; up to {}", Seconds(kept.last_log_time_ns));
  return text + "\n";
}

base::Result<RepairReport> Repair(const std::filesystem::path& source, const std::filesystem::path& target,
                                  RepairEnd* end) {
  auto opened = OpenFileSource(source);
  if (!opened) return opened.error();
  std::error_code problem;
  if (std::filesystem::exists(target, problem)) {
    return base::WrongInput("the repaired recording cannot be created: a file of that name is there already",
                            target.string());
  }
  const std::filesystem::path beside = target.string() + fmt::format(".{}.part", ::getpid());
  auto sink = OpenFileSink(beside, false);
  if (!sink) return sink.error();
  auto report = RepairInto(*opened.value(), std::move(sink).value(), end);
  if (report) {
    if (auto status = base::PutInPlace(beside, target); !status) report = status.error();
  }
  if (!report) std::filesystem::remove(beside, problem);
  return report;
}

base::Result<RepairReport> RepairBytes(base::Bytes source, base::Bytes* target, RepairEnd* end) {
  base::Bytes written;
  auto report = RepairInto(*MemorySource(std::move(source)), std::make_unique<MemorySink>(&written), end);
  if (report) *target = std::move(written);
  return report;
}

}  // namespace rodeira::record
