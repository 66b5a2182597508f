// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "common/core/base/file_kind.hpp"
#include "common/data/record/checksum.hpp"
#include "common/data/record/mcap_contents.hpp"

namespace rodeira::record {
namespace {

using base::Status;
using base::WrongInput;

constexpr std::uint64_t kRunBytes = 1u << 20;  // a run of messages outside of chunks ends when it is that long
constexpr std::size_t kMaxSkippedChunks = 20;  // damaged chunks that are named one by one

class Scanner {
 public:
  explicit Scanner(const Source& source) : source_(source) {}

  base::Result<Scan> Run();

 private:
  Rules rules() const { return scan_.contents.rules; }
  Status Take(const FileRecord& record);
  Status TakeRecord(const FileRecord& record);
  Status TakeChunk(const FileRecord& record);
  void SkipChunk(const FileRecord& record, const std::string& why);
  bool SkipLargeRecord();
  Status TakeMessage(const FileRecord& record);
  void Continue(const FileRecord& record);
  Status TakeIndex(const FileRecord& record);
  Status TakeDataEnd(const FileRecord& record);
  Status TakeFooter(const FileRecord& record);
  void CheckPlaceOfDataEnd(std::uint64_t end);
  void CheckIndexesOfLastChunk();
  void Count(ChannelId channel, std::uint64_t log_time_ns);
  void Count();
  void Find(std::string finding) { scan_.findings.push_back(std::move(finding)); }
  void AddLoss(std::string finding) {
    scan_.lost = true;
    Find(std::move(finding));
  }

  const Source& source_;
  Scan scan_;
  std::uint64_t at_ = 0;              // offset of the record that is looked at
  std::uint32_t crc_ = 0;             // of all bytes before it
  bool crc_known_ = true;             // false once a record was too large to be read
  bool after_chunk_ = false;          // only a chunk and its indexes may be followed by an index
  bool after_skipped_chunk_ = false;  // its indexes are skipped, too
  std::size_t skipped_chunks_ = 0;
  bool in_run_ = false;                         // the last entry of contents.chunks is a run that may go on
  std::map<ChannelId, IndexEntries> expected_;  // the last chunk's message indexes, as they should be
};

Status Scanner::TakeChunk(const FileRecord& record) {
  auto decoded = DecodeChunk(record.content(), scan_.contents.definitions, rules());
  if (!decoded) return decoded.error();
  const Chunk& chunk = decoded.value();
  ChunkInfo info;
  info.offset = at_;
  info.record_bytes = record.bytes.size();
  info.first_log_time_ns = chunk.head.first_log_time_ns;
  info.last_log_time_ns = chunk.head.last_log_time_ns;
  info.compression = chunk.head.compression;
  info.uncompressed_bytes = chunk.head.uncompressed_bytes;
  info.compressed_bytes = ParseChunk(record.content(), rules())->records.size();
  info.channels.emplace();

  expected_.clear();
  for (const Chunk::Entry& entry : chunk.entries) {
    expected_[entry.channel].emplace_back(entry.log_time_ns, entry.offset);
    info.channels->insert(entry.channel);
    Count(entry.channel, entry.log_time_ns);
  }
  scan_.contents.chunks.push_back(std::move(info));
  ++scan_.contents.statistics.chunks;
  scan_.skipped += chunk.skipped;
  after_chunk_ = true;
  return {};
}

// Its length is known, so what follows it can be read.
void Scanner::SkipChunk(const FileRecord& record, const std::string& why) {
  after_skipped_chunk_ = true;
  scan_.lost = true;
  if (++skipped_chunks_ > kMaxSkippedChunks) return;
  const auto head = ParseChunk(record.content(), rules());
  const std::string times = head ? fmt::format(" with the messages from {} to {}", Seconds(head->first_log_time_ns),
                                               Seconds(head->last_log_time_ns))
                                 : "";
  Find(fmt::format("byte {}: the chunk{} is lost: {}", at_, times, why));
}

// True where a record that is too large to be read ends within the file.
bool Scanner::SkipLargeRecord() {
  const std::uint64_t room = source_.size() - at_;
  if (rules() != Rules::kSpecification || room < kHeadBytes) return false;
  const auto head = source_.Read(at_ + 1, sizeof(std::uint64_t));
  if (!head) return false;
  const auto length = base::ByteReader(head.value()).Get<std::uint64_t>();
  if (length <= kMaxRecordBytes || length > room - kHeadBytes) return false;
  CheckIndexesOfLastChunk();
  in_run_ = false;
  after_skipped_chunk_ = true;
  crc_known_ = false;
  AddLoss(fmt::format("byte {}: a record of {} bytes is lost; at most {} can be read", at_, length, kMaxRecordBytes));
  at_ += kHeadBytes + length;
  return true;
}

Status Scanner::TakeMessage(const FileRecord& record) {
  if (rules() == Rules::kOwn) {
    return WrongInput("recording.damaged",
                      "a message outside of a chunk lies there, which this program does not write");
  }
  const auto message = ParseMessage(record.content());
  if (!message) return WrongInput("recording.damaged", "a damaged message lies there");
  if (!scan_.contents.definitions.channels.contains(message->channel)) {
    return WrongInput("recording.damaged",
                      fmt::format("a message of channel {} lies there, which is not defined", message->channel));
  }
  if (!in_run_) {
    ChunkInfo run;
    run.unchunked = true;
    run.offset = at_;
    run.first_log_time_ns = run.last_log_time_ns = message->log_time_ns;
    run.channels.emplace();
    scan_.contents.chunks.push_back(std::move(run));
    in_run_ = true;
  }
  ChunkInfo& run = scan_.contents.chunks.back();
  run.first_log_time_ns = std::min(run.first_log_time_ns, message->log_time_ns);
  run.last_log_time_ns = std::max(run.last_log_time_ns, message->log_time_ns);
  run.channels->insert(message->channel);
  Count(message->channel, message->log_time_ns);
  return {};
}

// A record that was taken belongs to the run that goes on, if any.
void Scanner::Continue(const FileRecord& record) {
  if (!in_run_) return;
  ChunkInfo& run = scan_.contents.chunks.back();
  run.record_bytes += record.bytes.size();
  run.compressed_bytes = run.uncompressed_bytes = run.record_bytes;
}

void Scanner::Count(ChannelId channel, std::uint64_t log_time_ns) {
  Statistics& s = scan_.contents.statistics;
  s.first_log_time_ns = s.messages == 0 ? log_time_ns : std::min(s.first_log_time_ns, log_time_ns);
  s.last_log_time_ns = s.messages == 0 ? log_time_ns : std::max(s.last_log_time_ns, log_time_ns);
  ++s.messages;
  ++s.messages_by_channel[channel];
}

// An index holds nothing that the chunk does not: a wrong one is a finding, not a loss.
Status Scanner::TakeIndex(const FileRecord& record) {
  if (after_skipped_chunk_) return {};
  if (!after_chunk_) return WrongInput("recording.damaged", "a message index without its chunk lies there");
  ChunkInfo& chunk = scan_.contents.chunks.back();
  auto index = ParseMessageIndex(record.content(), rules());
  chunk.index_bytes += record.bytes.size();
  if (rules() == Rules::kSpecification && index && index->entries.empty() &&
      !chunk.channels->contains(index->channel)) {
    chunk.index_offsets.emplace(index->channel, at_);
    return {};
  }
  if (!index || !chunk.channels->contains(index->channel) || !chunk.index_offsets.emplace(index->channel, at_).second) {
    Find(fmt::format("byte {}: the message index there is damaged (its messages are not)", at_));
    return {};
  }
  std::ranges::sort(index->entries, {}, &IndexEntries::value_type::second);
  if (index->entries != expected_[index->channel]) {
    Find(fmt::format("byte {}: the message index there does not fit its chunk", at_));
  }
  return {};
}

void Scanner::CheckIndexesOfLastChunk() {
  if (!after_chunk_) return;
  const ChunkInfo& chunk = scan_.contents.chunks.back();
  // A foreign file may do without indexes; with some, none may be missing.
  const auto missing =
      std::ranges::count_if(*chunk.channels, [&](ChannelId channel) { return !chunk.index_offsets.contains(channel); });
  if (!chunk.index_offsets.empty() && missing > 0) {
    Find(fmt::format("byte {}: of the chunk there, {} of {} message indexes are missing", chunk.offset, missing,
                     chunk.channels->size()));
  }
  after_chunk_ = false;
}

Status Scanner::TakeDataEnd(const FileRecord& record) {
  const auto crc = ParseDataEnd(record.content(), rules());
  if (!crc) return WrongInput("recording.damaged", "the mark of the data's end is damaged");
  if (*crc != 0 && *crc != crc_ && crc_known_) {
    AddLoss(
        fmt::format("the checksum of all data is {:08x}, {:08x} was expected: something outside of the chunks "
                    "(header, metadata, an index) has changed",
                    crc_, *crc));
  }
  scan_.ended = true;
  if (rules() == Rules::kSpecification) CheckPlaceOfDataEnd(at_ + record.bytes.size());
  return {};
}

// A file without a summary may do without DataEnd, too.
Status Scanner::TakeFooter(const FileRecord& record) {
  const auto footer = ParseFooter(record.content());
  const bool is_end = source_.size() - at_ == kFooterBytes + kMagic.size();
  if (rules() == Rules::kOwn || !footer || !is_end || footer->summary_start != 0) {
    return WrongInput("recording.damaged", "a footer lies there, before which the end of the data is not marked");
  }
  scan_.ended = true;
  return {};
}

// What lies between the end of the data and the place that the footer names is read by no reader.
void Scanner::CheckPlaceOfDataEnd(std::uint64_t end) {
  const std::uint64_t tail = kFooterBytes + kMagic.size();
  if (source_.size() < tail) return;
  const std::uint64_t footer_at = source_.size() - tail;
  const auto bytes = source_.Read(footer_at, kFooterBytes);
  const auto record = bytes ? RecordAt(bytes.value(), 0) : std::nullopt;
  const auto footer = record && record->opcode == Opcode::kFooter ? ParseFooter(record->content) : std::nullopt;
  if (!footer) return;  // ReadSummary says so
  const std::uint64_t expected = footer->summary_start == 0 ? footer_at : footer->summary_start;
  if (end == expected) return;
  AddLoss(fmt::format("byte {}: the data end there; the footer says that they end at byte {}", end, expected));
}

Status Scanner::Take(const FileRecord& record) {
  const bool goes_on = record.opcode == Opcode::kMessage || record.opcode == Opcode::kSchema ||
                       record.opcode == Opcode::kChannel || IsSkipped(record.opcode, rules());
  if (in_run_ && (!goes_on || scan_.contents.chunks.back().record_bytes + record.bytes.size() > kRunBytes)) {
    in_run_ = false;
  }
  const Status status = TakeRecord(record);
  if (status) {
    Continue(record);
  } else if (record.opcode == Opcode::kChunk && rules() == Rules::kSpecification) {
    SkipChunk(record, status.error().message);
    return {};
  }
  return status;
}

Status Scanner::TakeRecord(const FileRecord& record) {
  if (record.opcode == Opcode::kMessageIndex) return TakeIndex(record);
  CheckIndexesOfLastChunk();
  after_skipped_chunk_ = false;
  switch (record.opcode) {
    case Opcode::kChunk:
      return TakeChunk(record);
    case Opcode::kSchema: {
      const auto schema = ParseSchema(record.content(), rules());
      return schema ? scan_.contents.definitions.Add(*schema)
                    : WrongInput("recording.damaged", "a damaged schema lies there");
    }
    case Opcode::kChannel: {
      const auto channel = ParseChannel(record.content(), rules());
      return channel ? scan_.contents.definitions.Add(*channel)
                     : WrongInput("recording.damaged", "a damaged channel lies there");
    }
    case Opcode::kAttachment: {
      const auto attachment = ParseAttachment(record.content(), rules());
      if (!attachment) return WrongInput("recording.damaged", "a damaged attachment lies there");
      scan_.contents.attachments.push_back({attachment->name, attachment->media_type, attachment->log_time_ns,
                                            attachment->create_time_ns, attachment->data.size(), at_,
                                            record.bytes.size()});
      return {};
    }
    case Opcode::kMetadata: {
      const auto metadata = ParseMetadata(record.content(), rules());
      if (!metadata) return WrongInput("recording.damaged", "damaged metadata lie there");
      scan_.contents.metadata.push_back({metadata->name, at_, record.bytes.size()});
      return {};
    }
    case Opcode::kDataEnd:
      return TakeDataEnd(record);
    case Opcode::kMessage:
      return TakeMessage(record);
    case Opcode::kFooter:
      return TakeFooter(record);
    default:
      if (IsSkipped(record.opcode, rules())) {
        ++scan_.skipped;
        return {};
      }
      return WrongInput("recording.damaged", fmt::format("a record of kind {} lies there, which does not belong there",
                                                         static_cast<int>(record.opcode)));
  }
}

void Scanner::Count() {
  Statistics& s = scan_.contents.statistics;
  s.schemas = static_cast<std::uint16_t>(scan_.contents.definitions.schemas.size());
  s.channels = static_cast<std::uint32_t>(scan_.contents.definitions.channels.size());
  s.attachments = static_cast<std::uint32_t>(scan_.contents.attachments.size());
  s.metadata = static_cast<std::uint32_t>(scan_.contents.metadata.size());
}

base::Result<Scan> Scanner::Run() {
  if (auto status = CheckMark(source_); !status) return status.error();
  auto first = ReadRecord(source_, kMagic.size(), source_.size());
  auto header = first ? ParseHeader(first.value().content()) : std::nullopt;
  if (!header || first.value().opcode != Opcode::kHeader) {
    return WrongInput("recording.damaged", "nothing of this recording can be read: its header is cut short or damaged",
                      source_.name());
  }
  scan_.contents.rules = RulesOf(*header);
  scan_.contents.header = std::move(*header);
  at_ = kMagic.size() + first.value().bytes.size();
  crc_ = Crc32(first.value().bytes, Crc32(MagicBytes()));

  while (!scan_.ended && at_ < source_.size()) {
    auto record = ReadRecord(source_, at_, source_.size());
    if (!record && SkipLargeRecord()) continue;
    const Status status = record ? Take(record.value()) : Status(record.error());
    if (!status) {
      AddLoss(fmt::format("byte {}: from there to the end ({} bytes) everything is lost: {}", at_, source_.size() - at_,
                          status.error().message));
      break;
    }
    crc_ = Crc32(record.value().bytes, crc_);
    at_ += record.value().bytes.size();
  }
  if (skipped_chunks_ > kMaxSkippedChunks) {
    Find(fmt::format("and {} chunks more are lost", skipped_chunks_ - kMaxSkippedChunks));
  }
  scan_.good_bytes = at_;
  Count();
  return std::move(scan_);
}

// "; this is …" where the file is of another kind that Rodeira reads.
std::string OtherKind(const Source& source) {
  constexpr std::uint64_t kSearched = 4096;
  const auto begin = source.Read(0, std::min(kSearched, source.size()));
  if (!begin) return "";
  const std::string_view text(reinterpret_cast<const char*>(begin.value().data()), begin.value().size());
  const std::string about = base::AboutFile(text, source.name());
  return about.empty() ? about : "; this is " + about;
}

}  // namespace

Status CheckMark(const Source& source) {
  const auto mark = source.Read(0, std::min<std::uint64_t>(kMagic.size(), source.size()));
  if (!mark) return mark.error();
  if (std::ranges::equal(mark.value(), MagicBytes())) return {};
  constexpr std::size_t kVersionAt = 5;
  if (mark.value().size() == kMagic.size() &&
      std::ranges::equal(std::span(mark.value()).first(kVersionAt), MagicBytes().first(kVersionAt))) {
    return WrongInput(
        "recording.other_version",
        fmt::format("a recording of MCAP's version {} was found, version {} was expected",
                    std::string(1, static_cast<char>(mark.value()[kVersionAt])), static_cast<char>(kMagic[kVersionAt])),
        source.name());
  }
  return WrongInput("recording.not_mcap",
                    "this is no MCAP recording: it does not begin with MCAP's mark" + OtherKind(source), source.name());
}

void AddNamed(const Contents& summary, Contents& scanned) {
  if (scanned.rules == Rules::kOwn) return;
  Definitions& found = scanned.definitions;  // what they define otherwise stays, which Compare says
  for (const auto& [id, schema] : summary.definitions.schemas) static_cast<void>(found.Add(schema).ok());
  for (const auto& [id, channel] : summary.definitions.channels) static_cast<void>(found.Add(channel).ok());
}

base::Result<Scan> ScanFile(const Source& source) { return Scanner(source).Run(); }

}  // namespace rodeira::record
