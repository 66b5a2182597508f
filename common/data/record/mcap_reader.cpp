// SPDX-License-Identifier: Apache-2.0
#include "common/data/record/mcap_reader.hpp"

#include <fmt/format.h>

#include <utility>

#include "common/data/record/mcap_contents.hpp"

namespace rodeira::record {
namespace {

base::Result<std::shared_ptr<McapReader::Shared>> OpenSource(std::unique_ptr<Source> source,
                                                             const ReaderSettings& settings) {
  auto shared = std::make_shared<McapReader::Shared>();
  shared->source = std::move(source);
  shared->settings = settings;
  if (auto status = CheckMark(*shared->source); !status) return status.error();
  Condition& condition = shared->condition;
  condition.file_bytes = shared->source->size();
  auto summary = ReadSummary(*shared->source);
  if (summary && summary.value().shortage.empty() && !settings.scan) {
    condition.by_summary = condition.whole = true;
    condition.good_bytes = condition.file_bytes;
    shared->contents = std::move(summary).value().contents;
    return shared;
  }
  auto scan = ScanFile(*shared->source);
  if (!scan) return scan.error();
  if (!summary) condition.findings.push_back(summary.error().message);
  for (auto& finding : scan.value().findings) condition.findings.push_back(std::move(finding));
  condition.whole = condition.findings.empty() && scan.value().ended;
  condition.good_bytes = condition.whole ? condition.file_bytes : scan.value().good_bytes;
  shared->contents = std::move(scan.value().contents);
  if (summary) AddNamed(summary.value().contents, shared->contents);
  return shared;
}

// The record that lies where the contents say one lies.
base::Result<FileRecord> ReadListed(const Source& source, std::uint64_t offset, std::uint64_t record_bytes,
                                    Opcode opcode) {
  const std::string where = fmt::format("{}: byte {}", source.name(), offset);
  if (offset > source.size() || record_bytes > source.size() - offset) {
    return base::WrongInput("recording.damaged", "nothing lies there, the file is shorter", where);
  }
  auto record = ReadRecord(source, offset, offset + record_bytes);
  if (!record) return record.error().WithContext(where);
  if (record.value().opcode != opcode || record.value().bytes.size() != record_bytes) {
    return base::WrongInput("recording.damaged", "what lies there is not what the summary says", where);
  }
  return record;
}

}  // namespace

McapReader::McapReader(std::shared_ptr<const Shared> shared) : shared_(std::move(shared)) {}
McapReader::McapReader(McapReader&&) noexcept = default;
McapReader& McapReader::operator=(McapReader&&) noexcept = default;
McapReader::~McapReader() = default;

base::Result<McapReader> McapReader::Open(const std::filesystem::path& path, const ReaderSettings& settings) {
  auto source = OpenFileSource(path);
  if (!source) return source.error();
  auto shared = OpenSource(std::move(source).value(), settings);
  if (!shared) return shared.error();
  return McapReader(std::move(shared).value());
}

base::Result<McapReader> McapReader::OpenBytes(base::Bytes bytes, const ReaderSettings& settings) {
  auto shared = OpenSource(MemorySource(std::move(bytes)), settings);
  if (!shared) return shared.error();
  return McapReader(std::move(shared).value());
}

const Condition& McapReader::condition() const { return shared_->condition; }
const Header& McapReader::header() const { return shared_->contents.header; }
const std::map<SchemaId, Schema>& McapReader::schemas() const { return shared_->contents.definitions.schemas; }
const std::map<ChannelId, Channel>& McapReader::channels() const { return shared_->contents.definitions.channels; }
const Statistics& McapReader::statistics() const { return shared_->contents.statistics; }
const std::vector<ChunkInfo>& McapReader::chunks() const { return shared_->contents.chunks; }
const std::vector<MetadataInfo>& McapReader::metadata() const { return shared_->contents.metadata; }
const std::vector<AttachmentInfo>& McapReader::attachments() const { return shared_->contents.attachments; }

std::vector<ChannelId> McapReader::ChannelsOf(std::string_view topic) const {
  std::vector<ChannelId> ids;
  for (const auto& [id, channel] : channels()) {
    if (channel.topic == topic) ids.push_back(id);
  }
  return ids;
}

base::Result<ChunkMessages> McapReader::ReadChunk(const ChunkInfo& info) const {
  auto chunk = LoadChunk(*shared_->source, info, shared_->contents);
  if (!chunk) return chunk.error();
  ChunkMessages out;
  out.records = std::move(chunk.value().records);
  out.messages.reserve(chunk.value().entries.size());
  for (const Chunk::Entry& entry : chunk.value().entries) {
    out.messages.push_back(*ParseMessage(RecordAt(out.records, entry.offset)->content));
  }
  return out;
}

base::Result<Metadata> McapReader::ReadMetadata(const MetadataInfo& info) const {
  auto record = ReadListed(*shared_->source, info.offset, info.record_bytes, Opcode::kMetadata);
  if (!record) return record.error();
  auto metadata = ParseMetadata(record.value().content(), shared_->contents.rules);
  if (!metadata || metadata->name != info.name) {
    return base::WrongInput("recording.damaged", fmt::format("the metadata '{:.64}' are damaged", info.name),
                            fmt::format("{}: byte {}", shared_->source->name(), info.offset));
  }
  return std::move(*metadata);
}

base::Result<std::optional<Metadata>> McapReader::FindMetadata(std::string_view name) const {
  std::optional<Metadata> found;
  for (const MetadataInfo& info : metadata()) {
    if (info.name != name) continue;
    auto one = ReadMetadata(info);
    if (!one) return one.error();
    if (!found) found.emplace(Metadata{info.name, {}});
    for (auto& [key, value] : one.value().entries) found->entries.insert_or_assign(key, std::move(value));
  }
  return found;
}

base::Result<Attachment> McapReader::ReadAttachment(const AttachmentInfo& info) const {
  auto record = ReadListed(*shared_->source, info.offset, info.record_bytes, Opcode::kAttachment);
  if (!record) return record.error();
  auto attachment = ParseAttachment(record.value().content(), shared_->contents.rules);
  if (!attachment || attachment->name != info.name || attachment->media_type != info.media_type ||
      attachment->log_time_ns != info.log_time_ns || attachment->create_time_ns != info.create_time_ns ||
      attachment->data.size() != info.data_bytes) {
    return base::WrongInput("recording.damaged", fmt::format("the attachment '{:.64}' is damaged", info.name),
                            fmt::format("{}: byte {}", shared_->source->name(), info.offset));
  }
  return std::move(*attachment);
}

base::Result<std::optional<Attachment>> McapReader::FindAttachment(std::string_view name) const {
  const AttachmentInfo* last = nullptr;
  for (const AttachmentInfo& info : attachments()) {
    if (info.name == name) last = &info;
  }
  if (last == nullptr) return std::optional<Attachment>();
  auto attachment = ReadAttachment(*last);
  if (!attachment) return attachment.error();
  return std::optional<Attachment>(std::move(attachment).value());
}

}  // namespace rodeira::record
