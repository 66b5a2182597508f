// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "common/data/record/checksum.hpp"
#include "common/data/record/mcap_contents.hpp"

namespace rodeira::record {
namespace {

using base::Status;
using base::WrongInput;

struct Ending {
  Footer footer;
  std::uint64_t data_end = 0;   // offset of the DataEnd record
  std::uint64_t footer_at = 0;  // offset of the Footer record
};

base::Result<Ending> ReadEnding(const Source& source) {
  const std::uint64_t tail = kFooterBytes + kMagic.size();
  if (source.size() < kMagic.size() + tail) return WrongInput("the recording was not closed: it has no footer");
  Ending ending;
  ending.footer_at = source.size() - tail;
  auto bytes = source.Read(ending.footer_at, tail);
  if (!bytes) return bytes.error();
  if (!std::ranges::equal(std::span(bytes.value()).last(kMagic.size()), MagicBytes())) {
    return WrongInput("the recording was not closed: it does not end with MCAP's mark");
  }
  const auto record = RecordAt(bytes.value(), 0);
  if (!record || record->opcode != Opcode::kFooter) return WrongInput("its footer is damaged");
  const auto footer = ParseFooter(record->content);
  if (!footer) return WrongInput("its footer is damaged");
  if (footer->summary_start == 0) return WrongInput("it was written without a summary");
  if (footer->summary_start < kMagic.size() + kDataEndBytes || footer->summary_start > ending.footer_at) {
    return WrongInput(
        fmt::format("its footer says that the summary begins at byte {}, which cannot be", footer->summary_start));
  }
  if (ending.footer_at - footer->summary_start > kMaxRecordBytes) return WrongInput("its summary is too large");
  ending.footer = *footer;
  ending.data_end = footer->summary_start - kDataEndBytes;
  return ending;
}

// The summary's bytes, their checksum found right.
base::Result<base::Bytes> ReadSection(const Source& source, const Ending& ending) {
  auto data_end = source.Read(ending.data_end, kDataEndBytes);
  if (!data_end) return data_end.error();
  const auto record = RecordAt(data_end.value(), 0);
  if (!record || record->opcode != Opcode::kDataEnd || record->content.size() != kDataEndBytes - kHeadBytes) {
    return WrongInput("before its summary the end of the data is not marked");
  }
  const std::uint64_t start = ending.footer.summary_start;
  const std::uint64_t crc_at = ending.footer_at + kFooterBytes - sizeof(std::uint32_t);
  auto bytes = source.Read(start, crc_at - start);
  if (!bytes) return bytes.error();
  const std::uint32_t crc = Crc32(bytes.value());
  if (ending.footer.summary_crc != 0 && crc != ending.footer.summary_crc) {
    return WrongInput(
        fmt::format("its summary's checksum is {:08x}, {:08x} was expected", crc, ending.footer.summary_crc));
  }
  bytes.value().resize(static_cast<std::size_t>(ending.footer_at - start));
  return bytes;
}

template <class Record, class List>
Status Append(std::optional<Record> record, List& list, const char* what) {
  if (!record) return WrongInput(fmt::format("its summary holds a damaged {}", what));
  list.push_back(std::move(*record));
  return {};
}

template <class Record>
Status Define(const std::optional<Record>& record, Definitions& definitions, const char* what) {
  if (!record) return WrongInput(fmt::format("its summary holds a damaged {}", what));
  return definitions.Add(*record);
}

Status Take(const RecordView& record, Contents& contents, bool& has_statistics) {
  switch (record.opcode) {
    case Opcode::kSchema:
      return Define(ParseSchema(record.content), contents.definitions, "schema");
    case Opcode::kChannel:
      return Define(ParseChannel(record.content), contents.definitions, "channel");
    case Opcode::kChunkIndex:
      return Append(ParseChunkIndex(record.content), contents.chunks, "chunk index");
    case Opcode::kAttachmentIndex:
      return Append(ParseAttachmentIndex(record.content), contents.attachments, "attachment index");
    case Opcode::kMetadataIndex:
      return Append(ParseMetadataIndex(record.content), contents.metadata, "metadata index");
    case Opcode::kStatistics: {
      auto statistics = ParseStatistics(record.content);
      if (!statistics || has_statistics) return WrongInput("its summary's statistics are damaged or there twice");
      contents.statistics = std::move(*statistics);
      has_statistics = true;
      return {};
    }
    case Opcode::kSummaryOffset:
      return {};
    default:
      if (static_cast<std::uint8_t>(record.opcode) >= 0x80) return {};
      return WrongInput(fmt::format("its summary holds a record of kind {}", static_cast<int>(record.opcode)));
  }
}

// Sorts by place, and says where two overlap or one lies outside of [begin, end).
template <class Info>
Status CheckPlaces(std::vector<Info>& infos, std::uint64_t begin, std::uint64_t end, const char* what) {
  std::ranges::sort(infos, {}, &Info::offset);  // no ties: equal offsets are refused below
  std::uint64_t free_from = begin;
  for (const Info& info : infos) {
    if (info.offset < free_from || info.offset > end || info.record_bytes < kHeadBytes ||
        info.record_bytes > end - info.offset || info.record_bytes > kMaxRecordBytes + kHeadBytes) {
      return WrongInput(fmt::format("its summary names {} at byte {}, where none can be", what, info.offset));
    }
    free_from = info.offset + info.record_bytes;
  }
  return {};
}

Status CheckCounts(const Contents& contents) {
  const Statistics& s = contents.statistics;
  std::uint64_t messages = 0;
  bool known = true;
  for (const auto& [channel, count] : s.messages_by_channel) {
    messages += count;
    known = known && contents.definitions.channels.contains(channel);
  }
  if (messages != s.messages || !known || s.chunks != contents.chunks.size() ||
      s.attachments != contents.attachments.size() || s.metadata != contents.metadata.size() ||
      s.schemas != contents.definitions.schemas.size() || s.channels != contents.definitions.channels.size()) {
    return WrongInput("its summary's statistics do not fit the rest of the summary");
  }
  return {};
}

}  // namespace

base::Result<Contents> ReadSummary(const Source& source) {
  auto ending = ReadEnding(source);
  if (!ending) return ending.error();
  auto section = ReadSection(source, ending.value());
  if (!section) return section.error();

  Contents contents;
  bool has_statistics = false;
  for (std::uint64_t offset = 0; offset < section.value().size();) {
    const auto record = RecordAt(section.value(), offset);
    if (!record) return WrongInput("its summary holds an incomplete record");
    if (auto status = Take(*record, contents, has_statistics); !status) return status.error();
    offset += kHeadBytes + record->content.size();
  }
  if (!has_statistics) return WrongInput("its summary has no statistics");

  auto header = ReadRecord(source, kMagic.size(), ending.value().data_end);
  if (!header) return WrongInput("its header is damaged");
  auto parsed = ParseHeader(header.value().content());
  if (header.value().opcode != Opcode::kHeader || !parsed) return WrongInput("its header is damaged");
  contents.header = std::move(*parsed);

  const std::uint64_t begin = kMagic.size() + header.value().bytes.size();
  const std::uint64_t end = ending.value().data_end;
  if (auto status = CheckPlaces(contents.chunks, begin, end, "a chunk"); !status) return status.error();
  if (auto status = CheckPlaces(contents.attachments, begin, end, "an attachment"); !status) return status.error();
  if (auto status = CheckPlaces(contents.metadata, begin, end, "metadata"); !status) return status.error();
  if (auto status = CheckCounts(contents); !status) return status.error();
  for (ChunkInfo& chunk : contents.chunks) {
    if (chunk.index_offsets.empty()) continue;
    auto& channels = chunk.channels.emplace();
    for (const auto& [channel, at] : chunk.index_offsets) channels.insert(channel);
  }
  return contents;
}

}  // namespace rodeira::record
