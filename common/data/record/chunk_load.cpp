// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "common/data/record/checksum.hpp"
#include "common/data/record/compress.hpp"
#include "common/data/record/mcap_contents.hpp"

namespace rodeira::record {
namespace {

base::Result<base::Bytes> Uncompress(const ChunkHead& head, Rules rules) {
  if (head.uncompressed_bytes > kMaxRecordBytes) {
    return base::WrongInput("recording.damaged",
                            fmt::format("its records are said to have {} bytes, at most {} were expected",
                                        head.uncompressed_bytes, kMaxRecordBytes));
  }
  if (head.compression == "zstd") return ZstdDecompress(head.records, head.uncompressed_bytes);
  const bool lz4 = rules == Rules::kSpecification;
  if (lz4 && head.compression == "lz4") return Lz4Decompress(head.records, head.uncompressed_bytes);
  if (!head.compression.empty()) {
    return base::WrongInput("recording.wrong_compression",
                            fmt::format("its compression is '{:.16}', {} was expected", head.compression,
                                        lz4 ? "none, 'zstd' or 'lz4'" : "none or 'zstd'"));
  }
  if (head.records.size() != head.uncompressed_bytes) {
    return base::WrongInput("recording.damaged", fmt::format("it holds {} bytes, {} were expected", head.records.size(),
                                                             head.uncompressed_bytes));
  }
  return base::Bytes(head.records.begin(), head.records.end());
}

// Takes the records apart: definitions into `found`, messages into chunk.entries.
base::Status List(Chunk& chunk, Definitions& found, Rules rules) {
  for (std::uint64_t offset = 0; offset < chunk.records.size();) {
    const auto record = RecordAt(chunk.records, offset);
    const auto fail = [&](const char* what) {
      return base::WrongInput("recording.damaged", fmt::format("{} at byte {} of its records", what, offset));
    };
    if (!record) return fail("an incomplete record lies");
    if (record->opcode == Opcode::kMessage) {
      const auto message = ParseMessage(record->content);
      if (!message) return fail("a damaged message lies");
      if (!found.channels.contains(message->channel)) return fail("a message of an unknown channel lies");
      chunk.entries.push_back({message->log_time_ns, offset, message->channel});
    } else if (record->opcode == Opcode::kSchema) {
      const auto schema = ParseSchema(record->content, rules);
      if (!schema) return fail("a damaged schema lies");
      if (auto status = found.Add(*schema); !status) return status;
    } else if (record->opcode == Opcode::kChannel) {
      const auto channel = ParseChannel(record->content, rules);
      if (!channel) return fail("a damaged channel lies");
      if (auto status = found.Add(*channel); !status) return status;
    } else if (IsSkipped(record->opcode, rules)) {
      ++chunk.skipped;
    } else {
      return fail("a record that does not belong in a chunk lies");
    }
    offset += kHeadBytes + record->content.size();
  }
  return {};
}

base::Status CheckTimes(const Chunk& chunk) {
  if (chunk.entries.empty()) return {};
  const auto [first, last] =
      std::minmax_element(chunk.entries.begin(), chunk.entries.end(),
                          [](const Chunk::Entry& a, const Chunk::Entry& b) { return a.log_time_ns < b.log_time_ns; });
  if (first->log_time_ns == chunk.head.first_log_time_ns && last->log_time_ns == chunk.head.last_log_time_ns) return {};
  return base::WrongInput("recording.damaged", "its messages have other times than it says");
}

// A run of messages that lie outside of chunks.
base::Result<Chunk> LoadRun(const Source& source, const ChunkInfo& info, Definitions& definitions, Rules rules) {
  if (info.offset > source.size() || info.record_bytes > source.size() - info.offset) {
    return base::WrongInput("recording.damaged", "the file is shorter");
  }
  auto records = source.Read(info.offset, info.record_bytes);
  if (!records) return records.error();
  Chunk chunk;
  chunk.records = std::move(records).value();
  chunk.head.first_log_time_ns = info.first_log_time_ns;
  chunk.head.last_log_time_ns = info.last_log_time_ns;
  chunk.head.uncompressed_bytes = info.uncompressed_bytes;
  if (auto status = List(chunk, definitions, rules); !status) return status.error();
  if (auto status = CheckTimes(chunk); !status) return status.error();
  return chunk;
}

base::Result<Chunk> LoadChunkRecord(const Source& source, const ChunkInfo& info, Definitions& definitions,
                                    Rules rules) {
  auto record = ReadRecord(source, info.offset, info.offset + info.record_bytes);
  if (!record) return record.error();
  if (record.value().opcode != Opcode::kChunk || record.value().bytes.size() != info.record_bytes) {
    return base::WrongInput("recording.damaged", "no chunk of that length lies there");
  }
  return DecodeChunk(record.value().content(), definitions, rules);
}

// The specification lets a chunk define what the summary does not name; its messages need what the summary names.
bool AreNamed(const Chunk& chunk, const Definitions& used, const Contents& contents) {
  if (contents.rules == Rules::kOwn) return used == contents.definitions;
  return std::ranges::all_of(
      chunk.entries, [&](const Chunk::Entry& entry) { return contents.definitions.channels.contains(entry.channel); });
}

}  // namespace

base::Status Definitions::Add(const Schema& schema) {
  if (schema.id == 0) return {};  // to be ignored, by the specification
  const auto [place, added] = schemas.emplace(schema.id, schema);
  if (added || place->second == schema) return {};
  return base::WrongInput("recording.damaged", fmt::format("schema {} is defined twice, differently", schema.id));
}

base::Status Definitions::Add(const Channel& channel) {
  if (channel.schema != 0 && !schemas.contains(channel.schema)) {
    return base::WrongInput("recording.damaged", fmt::format("channel {} names schema {}, which is not defined",
                                                             channel.id, channel.schema));
  }
  const auto [place, added] = channels.emplace(channel.id, channel);
  if (added || place->second == channel) return {};
  return base::WrongInput("recording.damaged", fmt::format("channel {} is defined twice, differently", channel.id));
}

base::Result<FileRecord> ReadRecord(const Source& source, std::uint64_t offset, std::uint64_t end) {
  RODEIRA_ASSERT(offset <= end && end <= source.size());
  if (end - offset < kHeadBytes) return base::WrongInput("recording.damaged", "the file ends within a record's head");
  auto head = source.Read(offset, kHeadBytes);
  if (!head) return head.error();
  base::ByteReader in(head.value());
  FileRecord record;
  record.opcode = in.Get<Opcode>();
  const auto length = in.Get<std::uint64_t>();
  const std::uint64_t room = end - offset - kHeadBytes;
  if (length > room) {
    return base::WrongInput("recording.damaged",
                            fmt::format("a record of {} bytes begins there, {} are left", length, room));
  }
  if (length > kMaxRecordBytes) {
    return base::WrongInput(
        "recording.damaged",
        fmt::format("a record of {} bytes begins there, at most {} were expected", length, kMaxRecordBytes));
  }
  auto bytes = source.Read(offset, kHeadBytes + length);
  if (!bytes) return bytes.error();
  record.bytes = std::move(bytes).value();
  return record;
}

base::Result<Chunk> DecodeChunk(std::span<const std::byte> content, Definitions& definitions, Rules rules) {
  auto head = ParseChunk(content, rules);
  if (!head) return base::WrongInput("recording.damaged", "its fields do not fit its length");
  auto records = Uncompress(*head, rules);
  if (!records) return records.error();
  Chunk chunk;
  chunk.records = std::move(records).value();
  chunk.head = std::move(*head);
  chunk.head.records = {};
  const std::uint32_t crc = Crc32(chunk.records);
  if (chunk.head.crc != 0 && chunk.head.crc != crc) {
    return base::WrongInput("recording.damaged",
                            fmt::format("its checksum is {:08x}, {:08x} was expected", crc, chunk.head.crc));
  }
  Definitions found = definitions;
  if (auto status = List(chunk, found, rules); !status) return status.error();
  if (auto status = CheckTimes(chunk); !status) return status.error();
  definitions = std::move(found);
  return chunk;
}

base::Result<Chunk> LoadChunk(const Source& source, const ChunkInfo& info, const Contents& contents) {
  const auto fail = [&](const std::string& why) {
    return base::WrongInput("recording.damaged",
                            fmt::format("the {} with the messages from {} to {} is damaged: {}",
                                        info.unchunked ? "run outside of chunks" : "chunk",
                                        Seconds(info.first_log_time_ns), Seconds(info.last_log_time_ns), why),
                            fmt::format("{}: byte {}", source.name(), info.offset));
  };
  Definitions definitions = contents.definitions;
  auto chunk = info.unchunked ? LoadRun(source, info, definitions, contents.rules)
                              : LoadChunkRecord(source, info, definitions, contents.rules);
  if (!chunk) return fail(chunk.error().message);
  const ChunkHead& head = chunk.value().head;
  if (!AreNamed(chunk.value(), definitions, contents)) {
    return fail("it defines a schema or channel that the summary does not name");
  }
  if (head.first_log_time_ns != info.first_log_time_ns || head.last_log_time_ns != info.last_log_time_ns ||
      head.uncompressed_bytes != info.uncompressed_bytes || head.compression != info.compression) {
    return fail("it differs from what the summary says of it");
  }
  return chunk;
}

std::string Seconds(std::uint64_t time_ns) {
  return fmt::format("{}.{:03} s", time_ns / 1'000'000'000, time_ns / 1'000'000 % 1000);
}

}  // namespace rodeira::record
