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
  Status AddDefinitions();
  void AddLoss(std::string sentence) {
    report_.lost = true;
    report_.losses.push_back(std::move(sentence));
  }
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
    const auto id = IdOf(*ParseSchema(record.content, contents_.rules));
    return id ? Status() : Status(id.error());
  }
  if (record.opcode == Opcode::kChannel) {
    const auto id = IdOf(*ParseChannel(record.content, contents_.rules));
    return id ? Status() : Status(id.error());
  }
  if (record.opcode != Opcode::kMessage) return {};
  const Message message = *ParseMessage(record.content);
  if (!channel_ids_.contains(message.channel)) {  // its definition lay in a chunk that is lost
    const auto id = IdOf(contents_.definitions.channels.at(message.channel));
    if (!id) return id.error();
  }
  if (message.data.size() > kMaxMessageBytes) {
    AddLoss(fmt::format("a message at {} is lost: it has {} bytes, at most {} can be written",
                        Seconds(message.log_time_ns), message.data.size(), kMaxMessageBytes));
    return {};
  }
  if (end_ != nullptr) end_->Keep(contents_.definitions.channels.at(message.channel), message);
  return writer_.Write(channel_ids_.at(message.channel), message.sequence, message.log_time_ns, message.publish_time_ns,
                       message.data);
}

Status Copier::CopyChunk(const ChunkInfo& info) {
  const auto chunk = LoadChunk(source_, info, contents_);
  if (!chunk) {
    AddLoss(fmt::format("byte {}: {}", info.offset, chunk.error().message));
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
  const auto metadata = record ? ParseMetadata(record.value().content(), contents_.rules) : std::nullopt;
  if (!metadata || record.value().opcode != Opcode::kMetadata) {
    AddLoss(fmt::format("byte {}: the metadata '{:.64}' are damaged", info.offset, info.name));
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
  const auto attachment = record ? ParseAttachment(record.value().content(), contents_.rules) : std::nullopt;
  if (!attachment || record.value().opcode != Opcode::kAttachment) {
    AddLoss(fmt::format("byte {}: the attachment '{:.64}' is damaged", info.offset, info.name));
    return {};
  }
  return writer_.AddAttachment(attachment->name, attachment->media_type, attachment->data, attachment->log_time_ns,
                               attachment->create_time_ns);
}

// Other programs define schemas and channels outside of chunks, and some without a message. In a recording of Rodeira a
// channel without a message has lost its messages: it is not kept.
Status Copier::AddDefinitions() {
  if (contents_.rules == Rules::kOwn) return {};
  for (const auto& [id, schema] : contents_.definitions.schemas) {
    if (const auto added = IdOf(schema); !added) return added.error();
  }
  for (const auto& [id, channel] : contents_.definitions.channels) {
    if (const auto added = IdOf(channel); !added) return added.error();
  }
  return {};
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
    if (std::min({c, m, a}) == ~std::uint64_t{0}) return AddDefinitions();
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

bool FollowsSummary(const Scan& scan, const base::Result<Summary>& summary) {
  return summary.ok() && summary.value().shortage.empty() && !scan.ended;
}

// A wrong index loses nothing; a wrong count says that something was there.
bool CountsDiffer(const Summary& summary, const Contents& found) {
  const Statistics& said = summary.contents.statistics;
  const Statistics& is = found.statistics;
  return summary.has_statistics &&
         (said.messages != is.messages || said.attachments != is.attachments || said.metadata != is.metadata);
}

// What is said of the source before anything is copied.
void DescribeSource(const Scan& scan, const base::Result<Summary>& summary, RepairReport& report) {
  std::vector<std::string> findings;
  if (!summary) findings.push_back(summary.error().message);
  findings.insert(findings.end(), scan.findings.begin(), scan.findings.end());
  if (summary && scan.ended && scan.contents.rules == Rules::kSpecification) {
    const auto differences = Compare(summary.value(), scan.contents);
    report.lost = CountsDiffer(summary.value(), scan.contents);
    findings.insert(findings.end(), differences.begin(), differences.end());
  }
  report.was_whole = scan.ended && findings.empty();
  if (FollowsSummary(scan, summary)) return;  // the copy says what is damaged
  report.lost = report.lost || scan.lost;
  report.losses = std::move(findings);
  if (scan.skipped == 0) return;
  report.lost = true;
  report.losses.push_back(
      fmt::format("{} records that MCAP's specification leaves to applications are not copied", scan.skipped));
}

base::Result<RepairReport> RepairInto(const Source& source, std::unique_ptr<Sink> sink, RepairEnd* end) {
  RepairReport report;
  report.source_bytes = source.size();
  auto scan = ScanFile(source);
  if (!scan) return scan.error();
  const auto summary = ReadSummary(source);
  DescribeSource(scan.value(), summary, report);
  // With a whole summary the chunks behind a damaged one can be found; otherwise the scan's end is the end.
  const bool by_summary = FollowsSummary(scan.value(), summary);
  if (!by_summary && summary) AddNamed(summary.value().contents, scan.value().contents);
  const Contents& contents = by_summary ? summary.value().contents : scan.value().contents;

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
    return base::WrongInput("file.exists",
                            "the repaired recording cannot be created: a file of that name is there already",
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
