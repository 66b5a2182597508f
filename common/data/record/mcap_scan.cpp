// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "common/data/record/checksum.hpp"
#include "common/data/record/mcap_contents.hpp"

namespace rodeira::record {
namespace {

using base::Status;
using base::WrongInput;

class Scanner {
 public:
  explicit Scanner(const Source& source) : source_(source) {}

  base::Result<Scan> Run();

 private:
  Status Take(const FileRecord& record);
  Status TakeChunk(const FileRecord& record);
  Status TakeIndex(const FileRecord& record);
  Status TakeDataEnd(const FileRecord& record);
  void CheckIndexesOfLastChunk();
  void Count();
  void Find(std::string finding) { scan_.findings.push_back(std::move(finding)); }

  const Source& source_;
  Scan scan_;
  std::uint64_t at_ = 0;                        // offset of the record that is looked at
  std::uint32_t crc_ = 0;                       // of all bytes before it
  bool after_chunk_ = false;                    // only a chunk and its indexes may be followed by an index
  std::map<ChannelId, IndexEntries> expected_;  // the last chunk's message indexes, as they should be
};

Status Scanner::TakeChunk(const FileRecord& record) {
  auto decoded = DecodeChunk(record.content(), scan_.contents.definitions);
  if (!decoded) return decoded.error();
  const Chunk& chunk = decoded.value();
  ChunkInfo info;
  info.offset = at_;
  info.record_bytes = record.bytes.size();
  info.first_log_time_ns = chunk.head.first_log_time_ns;
  info.last_log_time_ns = chunk.head.last_log_time_ns;
  info.compression = chunk.head.compression;
  info.uncompressed_bytes = chunk.head.uncompressed_bytes;
  info.compressed_bytes = ParseChunk(record.content())->records.size();
  info.channels.emplace();

  expected_.clear();
  Statistics& s = scan_.contents.statistics;
  for (const Chunk::Entry& entry : chunk.entries) {
    expected_[entry.channel].emplace_back(entry.log_time_ns, entry.offset);
    info.channels->insert(entry.channel);
    s.first_log_time_ns = s.messages == 0 ? entry.log_time_ns : std::min(s.first_log_time_ns, entry.log_time_ns);
    s.last_log_time_ns = s.messages == 0 ? entry.log_time_ns : std::max(s.last_log_time_ns, entry.log_time_ns);
    ++s.messages;
    ++s.messages_by_channel[entry.channel];
  }
  scan_.contents.chunks.push_back(std::move(info));
  after_chunk_ = true;
  return {};
}

// An index holds nothing that the chunk does not: a wrong one is a finding, not a loss.
Status Scanner::TakeIndex(const FileRecord& record) {
  if (!after_chunk_) return WrongInput("a message index without its chunk lies there");
  ChunkInfo& chunk = scan_.contents.chunks.back();
  auto index = ParseMessageIndex(record.content());
  chunk.index_bytes += record.bytes.size();
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
  if (!chunk.index_offsets.empty() && chunk.index_offsets.size() != chunk.channels->size()) {
    Find(fmt::format("byte {}: of the chunk there, {} of {} message indexes are missing", chunk.offset,
                     chunk.channels->size() - chunk.index_offsets.size(), chunk.channels->size()));
  }
  after_chunk_ = false;
}

Status Scanner::TakeDataEnd(const FileRecord& record) {
  const auto crc = ParseDataEnd(record.content());
  if (!crc) return WrongInput("the mark of the data's end is damaged");
  if (*crc != 0 && *crc != crc_) {
    Find(
        fmt::format("the checksum of all data is {:08x}, {:08x} was expected: something outside of the chunks "
                    "(header, metadata, an index) has changed",
                    crc_, *crc));
  }
  scan_.ended = true;
  return {};
}

Status Scanner::Take(const FileRecord& record) {
  if (record.opcode == Opcode::kMessageIndex) return TakeIndex(record);
  CheckIndexesOfLastChunk();
  switch (record.opcode) {
    case Opcode::kChunk:
      return TakeChunk(record);
    case Opcode::kSchema: {
      const auto schema = ParseSchema(record.content());
      return schema ? scan_.contents.definitions.Add(*schema) : WrongInput("a damaged schema lies there");
    }
    case Opcode::kChannel: {
      const auto channel = ParseChannel(record.content());
      return channel ? scan_.contents.definitions.Add(*channel) : WrongInput("a damaged channel lies there");
    }
    case Opcode::kAttachment: {
      const auto attachment = ParseAttachment(record.content());
      if (!attachment) return WrongInput("a damaged attachment lies there");
      scan_.contents.attachments.push_back({attachment->name, attachment->media_type, attachment->log_time_ns,
                                            attachment->create_time_ns, attachment->data.size(), at_,
                                            record.bytes.size()});
      return {};
    }
    case Opcode::kMetadata: {
      const auto metadata = ParseMetadata(record.content());
      if (!metadata) return WrongInput("damaged metadata lie there");
      scan_.contents.metadata.push_back({metadata->name, at_, record.bytes.size()});
      return {};
    }
    case Opcode::kDataEnd:
      return TakeDataEnd(record);
    case Opcode::kMessage:
      return WrongInput("a message outside of a chunk lies there, which is not supported");
    default:
      if (static_cast<std::uint8_t>(record.opcode) >= 0x80) return {};  // somebody's private record
      return WrongInput(
          fmt::format("a record of kind {} lies there, which does not belong there", static_cast<int>(record.opcode)));
  }
}

void Scanner::Count() {
  Statistics& s = scan_.contents.statistics;
  s.schemas = static_cast<std::uint16_t>(scan_.contents.definitions.schemas.size());
  s.channels = static_cast<std::uint32_t>(scan_.contents.definitions.channels.size());
  s.chunks = static_cast<std::uint32_t>(scan_.contents.chunks.size());
  s.attachments = static_cast<std::uint32_t>(scan_.contents.attachments.size());
  s.metadata = static_cast<std::uint32_t>(scan_.contents.metadata.size());
}

base::Result<Scan> Scanner::Run() {
  if (auto status = CheckMark(source_); !status) return status.error();
  auto first = ReadRecord(source_, kMagic.size(), source_.size());
  auto header = first ? ParseHeader(first.value().content()) : std::nullopt;
  if (!header || first.value().opcode != Opcode::kHeader) {
    return WrongInput("nothing of this recording can be read: its header is cut short or damaged", source_.name());
  }
  scan_.contents.header = std::move(*header);
  at_ = kMagic.size() + first.value().bytes.size();
  crc_ = Crc32(first.value().bytes, Crc32(MagicBytes()));

  while (!scan_.ended && at_ < source_.size()) {
    auto record = ReadRecord(source_, at_, source_.size());
    const Status status = record ? Take(record.value()) : Status(record.error());
    if (!status) {
      Find(fmt::format("byte {}: from there to the end ({} bytes) everything is lost: {}", at_, source_.size() - at_,
                       status.error().message));
      break;
    }
    crc_ = Crc32(record.value().bytes, crc_);
    at_ += record.value().bytes.size();
  }
  scan_.good_bytes = at_;
  Count();
  return std::move(scan_);
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
        fmt::format("a recording of MCAP's version {} was found, version {} was expected",
                    std::string(1, static_cast<char>(mark.value()[kVersionAt])), static_cast<char>(kMagic[kVersionAt])),
        source.name());
  }
  return WrongInput("this is no MCAP recording: it does not begin with MCAP's mark", source.name());
}

base::Result<Scan> ScanFile(const Source& source) { return Scanner(source).Run(); }

}  // namespace rodeira::record
