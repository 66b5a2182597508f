// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/core/base/bytes.hpp"
#include "common/data/record/mcap_reader.hpp"
#include "common/data/record/mcap_types.hpp"

// The bytes of MCAP's records, for the writer and the reader. A record is an opcode (u8), a length (u64) and its
// content; little-endian; a text is u32 length and UTF-8; a map and an array begin with their length in bytes (u32).
namespace rodeira::record {

// First byte of a record, by MCAP's specification.
enum class Opcode : std::uint8_t {
  kHeader = 0x01,
  kFooter = 0x02,
  kSchema = 0x03,
  kChannel = 0x04,
  kMessage = 0x05,
  kChunk = 0x06,
  kMessageIndex = 0x07,
  kChunkIndex = 0x08,
  kAttachment = 0x09,
  kAttachmentIndex = 0x0A,
  kStatistics = 0x0B,
  kMetadata = 0x0C,
  kMetadataIndex = 0x0D,
  kSummaryOffset = 0x0E,
  kDataEnd = 0x0F,
};

// Which records a reader accepts.
enum class Rules : std::uint8_t {
  kOwn,            // exactly what McapWriter writes
  kSpecification,  // all that MCAP's specification permits: unknown fields and records, messages outside of chunks, lz4
};
inline Rules RulesOf(const Header& header) { return header.library == kLibrary ? Rules::kOwn : Rules::kSpecification; }
// True for records that a reader skips: those of applications and, by the specification, those of later revisions.
inline bool IsSkipped(Opcode opcode, Rules rules) {
  return static_cast<std::uint8_t>(opcode) >= 0x80 || (rules == Rules::kSpecification && opcode > Opcode::kDataEnd);
}

inline constexpr std::array<unsigned char, 8> kMagic = {0x89, 'M', 'C', 'A', 'P', '0', '\r', '\n'};
inline constexpr std::uint64_t kHeadBytes = 9;  // opcode and length
inline constexpr std::uint64_t kFooterBytes = kHeadBytes + 20;
inline constexpr std::uint64_t kDataEndBytes = kHeadBytes + 4;
inline constexpr std::uint64_t kMessageHeadBytes = 22;  // of a message's content, before its data

// The first and the last bytes of each file.
inline std::span<const std::byte> MagicBytes() { return std::as_bytes(std::span(kMagic)); }

// Log time and offset within the uncompressed chunk of one message, in the order of the messages.
using IndexEntries = std::vector<std::pair<std::uint64_t, std::uint64_t>>;

// Last record of a file. Offsets are bytes from its start; 0: there is no such part.
struct Footer {
  std::uint64_t summary_start = 0;
  std::uint64_t summary_offset_start = 0;
  std::uint32_t summary_crc = 0;
};

// Record of a chunk, before its records are uncompressed.
struct ChunkHead {
  std::uint64_t first_log_time_ns = 0;
  std::uint64_t last_log_time_ns = 0;
  std::uint64_t uncompressed_bytes = 0;
  std::uint32_t crc = 0;  // of the uncompressed records; 0 where there is none
  std::string compression;
  std::span<const std::byte> records;  // as they lie in the file
};

// Log times of a channel's messages in a chunk, with their places in its uncompressed records.
struct MessageIndex {
  ChannelId channel = 0;
  IndexEntries entries;
};

// Place of the records of one opcode in the summary, in bytes from the file's start.
struct SummaryOffset {
  Opcode group = Opcode::kSchema;
  std::uint64_t start = 0;
  std::uint64_t length = 0;
};

// A record's opcode and the place of its length, filled in by EndRecord.
std::size_t BeginRecord(base::ByteWriter& out, Opcode opcode);
// `begin`: what BeginRecord returned. What was written since is the record's content.
void EndRecord(base::ByteWriter& out, std::size_t begin);

// Each appends a whole record, in the form of MCAP's specification.
void PutHeader(base::ByteWriter& out, const Header& header);
void PutSchema(base::ByteWriter& out, const Schema& schema);
void PutChannel(base::ByteWriter& out, const Channel& channel);
void PutMessage(base::ByteWriter& out, const Message& message);
void PutMessageIndex(base::ByteWriter& out, ChannelId channel, const IndexEntries& entries);
void PutChunkIndex(base::ByteWriter& out, const ChunkInfo& chunk);
void PutAttachment(base::ByteWriter& out, const AttachmentInfo& info, std::span<const std::byte> data);
void PutAttachmentIndex(base::ByteWriter& out, const AttachmentInfo& info);
void PutMetadata(base::ByteWriter& out, std::string_view name, const TextMap& entries);
void PutMetadataIndex(base::ByteWriter& out, const MetadataInfo& info);
void PutStatistics(base::ByteWriter& out, const Statistics& statistics);
void PutSummaryOffset(base::ByteWriter& out, const SummaryOffset& group);
void PutDataEnd(base::ByteWriter& out, std::uint32_t crc);
// All but the checksum, which the caller appends: it covers these bytes too.
void PutFooterStart(base::ByteWriter& out, std::uint64_t summary_start, std::uint64_t summary_offset_start);

// A record within `bytes`.
struct RecordView {
  Opcode opcode = Opcode::kHeader;
  std::uint64_t offset = 0;  // of the opcode
  std::span<const std::byte> content;
};

// The record at `offset`, or nothing where no whole record lies there.
std::optional<RecordView> RecordAt(std::span<const std::byte> bytes, std::uint64_t offset);

// Each reads a record's whole content; nothing where it does not fit. By the specification, unknown fields may follow
// the known ones, except in Footer and Message. ParseHeader applies the rules that follow from the header.
std::optional<Header> ParseHeader(std::span<const std::byte> content);
std::optional<Footer> ParseFooter(std::span<const std::byte> content);
std::optional<Schema> ParseSchema(std::span<const std::byte> content, Rules rules);
std::optional<Channel> ParseChannel(std::span<const std::byte> content, Rules rules);
std::optional<Message> ParseMessage(std::span<const std::byte> content);
std::optional<ChunkHead> ParseChunk(std::span<const std::byte> content, Rules rules);
std::optional<MessageIndex> ParseMessageIndex(std::span<const std::byte> content, Rules rules);
std::optional<ChunkInfo> ParseChunkIndex(std::span<const std::byte> content, Rules rules);
// The checksum is checked where there is one.
std::optional<Attachment> ParseAttachment(std::span<const std::byte> content, Rules rules);
std::optional<AttachmentInfo> ParseAttachmentIndex(std::span<const std::byte> content, Rules rules);
std::optional<Metadata> ParseMetadata(std::span<const std::byte> content, Rules rules);
std::optional<MetadataInfo> ParseMetadataIndex(std::span<const std::byte> content, Rules rules);
std::optional<Statistics> ParseStatistics(std::span<const std::byte> content, Rules rules);
std::optional<SummaryOffset> ParseSummaryOffset(std::span<const std::byte> content);
std::optional<std::uint32_t> ParseDataEnd(std::span<const std::byte> content, Rules rules);

}  // namespace rodeira::record
