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
  bool has_summary = true;
  Footer footer;
  std::uint64_t data_end = 0;   // offset of the DataEnd record
  std::uint64_t footer_at = 0;  // offset of the Footer record
};

base::Result<Ending> ReadEnding(const Source& source, Rules rules) {
  const std::uint64_t tail = kFooterBytes + kMagic.size();
  if (source.size() < kMagic.size() + tail)
    return WrongInput("recording.no_summary", "the recording was not closed: it has no footer");
  Ending ending;
  ending.footer_at = source.size() - tail;
  auto bytes = source.Read(ending.footer_at, tail);
  if (!bytes) return bytes.error();
  if (!std::ranges::equal(std::span(bytes.value()).last(kMagic.size()), MagicBytes())) {
    return WrongInput("recording.no_summary", "the recording was not closed: it does not end with MCAP's mark");
  }
  const auto record = RecordAt(bytes.value(), 0);
  if (!record || record->opcode != Opcode::kFooter) return WrongInput("recording.damaged", "its footer is damaged");
  const auto footer = ParseFooter(record->content);
  if (!footer) return WrongInput("recording.damaged", "its footer is damaged");
  if (footer->summary_start == 0 && rules == Rules::kSpecification) {
    ending.has_summary = false;
    return ending;
  }
  if (footer->summary_start == 0) return WrongInput("recording.no_summary", "it was written without a summary");
  if (footer->summary_start < kMagic.size() + kDataEndBytes || footer->summary_start > ending.footer_at) {
    return WrongInput(
        "recording.damaged",
        fmt::format("its footer says that the summary begins at byte {}, which cannot be", footer->summary_start));
  }
  if (ending.footer_at - footer->summary_start > kMaxRecordBytes)
    return WrongInput("recording.damaged", "its summary is too large");
  ending.footer = *footer;
  ending.data_end = footer->summary_start - kDataEndBytes;
  return ending;
}

base::Result<bool> IsMarked(const Source& source, const Ending& ending) {
  auto data_end = source.Read(ending.data_end, kDataEndBytes);
  if (!data_end) return data_end.error();
  const auto record = RecordAt(data_end.value(), 0);
  return record && record->opcode == Opcode::kDataEnd && record->content.size() == kDataEndBytes - kHeadBytes;
}

// The summary's bytes, their checksum found right.
base::Result<base::Bytes> ReadSection(const Source& source, const Ending& ending) {
  const std::uint64_t start = ending.footer.summary_start;
  const std::uint64_t crc_at = ending.footer_at + kFooterBytes - sizeof(std::uint32_t);
  auto bytes = source.Read(start, crc_at - start);
  if (!bytes) return bytes.error();
  const std::uint32_t crc = Crc32(bytes.value());
  if (ending.footer.summary_crc != 0 && crc != ending.footer.summary_crc) {
    return WrongInput("recording.damaged", fmt::format("its summary's checksum is {:08x}, {:08x} was expected", crc,
                                                       ending.footer.summary_crc));
  }
  bytes.value().resize(static_cast<std::size_t>(ending.footer_at - start));
  return bytes;
}

template <class Record, class List>
Status Append(std::optional<Record> record, List& list, const char* what) {
  if (!record) return WrongInput("recording.damaged", fmt::format("its summary holds a damaged {}", what));
  list.push_back(std::move(*record));
  return {};
}

Status Define(const std::optional<Schema>& record, Summary& summary) {
  if (!record) return WrongInput("recording.damaged", "its summary holds a damaged schema");
  return summary.contents.definitions.Add(*record);
}

Status Define(const std::optional<Channel>& record, Summary& summary) {
  if (!record) return WrongInput("recording.damaged", "its summary holds a damaged channel");
  Contents& contents = summary.contents;
  const bool has_schema = record->schema == 0 || contents.definitions.schemas.contains(record->schema);
  if (!has_schema && contents.rules == Rules::kSpecification) {
    summary.shortage = "its summary does not repeat all schemas";
    return {};
  }
  return contents.definitions.Add(*record);
}

Status Take(const RecordView& record, Summary& summary) {
  Contents& contents = summary.contents;
  const Rules rules = contents.rules;
  switch (record.opcode) {
    case Opcode::kSchema:
      return Define(ParseSchema(record.content, rules), summary);
    case Opcode::kChannel:
      return Define(ParseChannel(record.content, rules), summary);
    case Opcode::kChunkIndex:
      return Append(ParseChunkIndex(record.content, rules), contents.chunks, "chunk index");
    case Opcode::kAttachmentIndex:
      return Append(ParseAttachmentIndex(record.content, rules), contents.attachments, "attachment index");
    case Opcode::kMetadataIndex:
      return Append(ParseMetadataIndex(record.content, rules), contents.metadata, "metadata index");
    case Opcode::kStatistics: {
      auto statistics = ParseStatistics(record.content, rules);
      if (!statistics || summary.has_statistics) {
        return WrongInput("recording.damaged", "its summary's statistics are damaged or there twice");
      }
      contents.statistics = std::move(*statistics);
      summary.has_statistics = true;
      return {};
    }
    case Opcode::kSummaryOffset:
      return {};
    default:
      if (IsSkipped(record.opcode, rules)) return {};
      return WrongInput("recording.damaged",
                        fmt::format("its summary holds a record of kind {}", static_cast<int>(record.opcode)));
  }
}

// Groups of records may come in any order, but a channel needs its schema.
Status TakeAll(const base::Bytes& section, Summary& summary) {
  const bool any_order = summary.contents.rules == Rules::kSpecification;
  for (const bool schemas : {true, false}) {
    if (schemas && !any_order) continue;
    for (std::uint64_t offset = 0; offset < section.size();) {
      const auto record = RecordAt(section, offset);
      if (!record) return WrongInput("recording.damaged", "its summary holds an incomplete record");
      if (!any_order || schemas == (record->opcode == Opcode::kSchema)) {
        if (auto status = Take(*record, summary); !status) return status;
      }
      offset += kHeadBytes + record->content.size();
    }
  }
  return {};
}

// Sorts by place, and says where two overlap or one lies outside of [begin, end).
template <class Info>
Status CheckPlaces(std::vector<Info>& infos, std::uint64_t begin, std::uint64_t end, const char* what) {
  std::ranges::sort(infos, {}, &Info::offset);  // no ties: equal offsets are refused below
  std::uint64_t free_from = begin;
  for (const Info& info : infos) {
    if (info.offset < free_from || info.offset > end || info.record_bytes < kHeadBytes ||
        info.record_bytes > end - info.offset || info.record_bytes > kMaxRecordBytes + kHeadBytes) {
      return WrongInput("recording.damaged",
                        fmt::format("its summary names {} at byte {}, where none can be", what, info.offset));
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
    return WrongInput("recording.damaged", "its summary's statistics do not fit the rest of the summary");
  }
  return {};
}

// True where nothing lies in [begin, end) but what the summary names.
bool NamesAll(const Contents& contents, std::uint64_t begin, std::uint64_t end) {
  std::vector<std::pair<std::uint64_t, std::uint64_t>> places;  // begin and length
  for (const ChunkInfo& chunk : contents.chunks) {
    places.emplace_back(chunk.offset, chunk.record_bytes);
    places.emplace_back(chunk.offset + chunk.record_bytes, chunk.index_bytes);
  }
  for (const AttachmentInfo& attachment : contents.attachments) {
    places.emplace_back(attachment.offset, attachment.record_bytes);
  }
  for (const MetadataInfo& metadata : contents.metadata) places.emplace_back(metadata.offset, metadata.record_bytes);
  std::ranges::sort(places);
  std::uint64_t at = begin;
  for (const auto& [place, length] : places) {
    if (place != at || length > end - at) return false;
    at += length;
  }
  return at == end;
}

// For files of other programs: says in summary.shortage what the summary does not name.
void LookForShortage(Summary& summary, std::uint64_t begin, std::uint64_t end) {
  if (!summary.shortage.empty()) return;
  if (!summary.has_statistics) {
    summary.shortage = "its summary has no statistics";
  } else if (auto status = CheckCounts(summary.contents); !status) {
    summary.shortage = status.error().message;
  } else if (!NamesAll(summary.contents, begin, end)) {
    summary.shortage = "its data hold more than its summary names";
  }
}

}  // namespace

base::Result<Summary> ReadSummary(const Source& source) {
  Summary summary;
  Contents& contents = summary.contents;
  std::optional<Header> parsed;
  std::uint64_t begin = kMagic.size();
  if (source.size() > begin) {
    const auto header = ReadRecord(source, begin, source.size());
    if (header && header.value().opcode == Opcode::kHeader) parsed = ParseHeader(header.value().content());
    if (header) begin += header.value().bytes.size();
  }
  if (parsed) contents.rules = RulesOf(*parsed);

  const auto ending = ReadEnding(source, contents.rules);
  if (!ending) return ending.error();
  if (!ending.value().has_summary) {
    contents.header = std::move(*parsed);  // its rules say that there may be no summary
    summary.shortage = "it was written without a summary";
    return summary;
  }
  const auto marked = IsMarked(source, ending.value());
  if (!marked) return marked.error();
  if (!marked.value()) {
    summary.shortage = "before its summary the end of the data is not marked";
    if (contents.rules == Rules::kOwn) return WrongInput("recording.no_summary", summary.shortage);
  }
  const auto section = ReadSection(source, ending.value());
  if (!section) return section.error();
  if (auto status = TakeAll(section.value(), summary); !status) return status.error();
  const bool own = contents.rules == Rules::kOwn;
  if (own && !summary.has_statistics) return WrongInput("recording.no_summary", "its summary has no statistics");

  const std::uint64_t end = ending.value().data_end;
  if (!parsed || begin > end) return WrongInput("recording.damaged", "its header is damaged");
  contents.header = std::move(*parsed);

  if (auto status = CheckPlaces(contents.chunks, begin, end, "a chunk"); !status) return status.error();
  if (auto status = CheckPlaces(contents.attachments, begin, end, "an attachment"); !status) return status.error();
  if (auto status = CheckPlaces(contents.metadata, begin, end, "metadata"); !status) return status.error();
  if (!own) {
    LookForShortage(summary, begin, end);
  } else if (auto status = CheckCounts(contents); !status) {
    return status.error();
  }
  for (ChunkInfo& chunk : contents.chunks) {
    if (chunk.index_offsets.empty()) continue;
    auto& channels = chunk.channels.emplace();
    for (const auto& [channel, at] : chunk.index_offsets) channels.insert(channel);
  }
  return summary;
}

}  // namespace rodeira::record
