// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "common/core/base/bytes.hpp"
#include "common/core/base/result.hpp"
#include "common/data/record/mcap_types.hpp"

namespace rodeira::record {

// Settings of a reader.
struct ReaderSettings {
  bool scan = false;                                    // read from the start even where the summary is whole
  std::uint64_t memory_bytes = std::uint64_t{1} << 30;  // chunks held at a time, uncompressed: beyond, an Error
};

// How a file was opened, and what of it is gone.
struct Condition {
  bool by_summary = false;  // false: scanned from the start
  bool whole = false;       // the file ends as it should and nothing is damaged, as far as was looked
  std::uint64_t file_bytes = 0;
  std::uint64_t good_bytes = 0;       // bytes from the start that were accepted
  std::vector<std::string> findings;  // sentences: why the summary was not used, what was lost
};

// A chunk of the file: its place, size and times. Offsets are bytes from the start of the file.
struct ChunkInfo {
  std::uint64_t offset = 0;        // of the chunk's record in the file
  std::uint64_t record_bytes = 0;  // with opcode and length
  std::uint64_t first_log_time_ns = 0;
  std::uint64_t last_log_time_ns = 0;
  std::uint64_t compressed_bytes = 0;
  std::uint64_t uncompressed_bytes = 0;
  std::string compression;                           // "", "zstd", "lz4"
  std::map<ChannelId, std::uint64_t> index_offsets;  // of the MessageIndex records
  std::uint64_t index_bytes = 0;                     // of all of them
  std::optional<std::set<ChannelId>> channels;       // those with messages in it, where that is known
  bool unchunked = false;                            // no Chunk record: a run of messages that lie outside of chunks
};

// Place of a metadata record, in bytes from the start of the file.
struct MetadataInfo {
  std::string name;
  std::uint64_t offset = 0;
  std::uint64_t record_bytes = 0;
};

// An attachment without its data; `offset` is that of its record.
struct AttachmentInfo {
  std::string name;
  std::string media_type;
  std::uint64_t log_time_ns = 0;
  std::uint64_t create_time_ns = 0;
  std::uint64_t data_bytes = 0;
  std::uint64_t offset = 0;
  std::uint64_t record_bytes = 0;
};

// Which messages, by log time (both ends belong to it) and channel.
struct Query {
  std::uint64_t from_ns = 0;
  std::uint64_t through_ns = std::numeric_limits<std::uint64_t>::max();
  std::optional<std::set<ChannelId>> channels;                   // none: all
  enum class Order { kLogTime, kFile } order = Order::kLogTime;  // equal log times come in file order
};

// What one chunk holds, in file order.
struct ChunkMessages {
  base::Bytes records;
  std::vector<Message> messages;  // their bytes lie in `records`; moving keeps them there, copying does not
};

class McapReader;

// Walks over messages. It shares the file with the reader and may outlive it.
class MessageCursor {
 public:
  MessageCursor(MessageCursor&&) noexcept;
  MessageCursor& operator=(MessageCursor&&) noexcept;
  ~MessageCursor();
  // The next message, nothing at the end, or an Error at a damaged chunk (it says which times are lost); calling again
  // after an Error goes on behind that chunk. The message's bytes live until the next call.
  base::Result<std::optional<Message>> Next();

 private:
  friend class McapReader;
  class Walk;
  explicit MessageCursor(std::unique_ptr<Walk> walk);
  std::unique_ptr<Walk> walk_;
};

// Reads an MCAP file. Never crashes, whatever the bytes: lengths are checked before memory is allocated, and a message
// is handed out only when its chunk's checksum is right.
//
// By the summary when that is whole; otherwise from the start, taking complete records as far as they go: then what
// follows the first incomplete or damaged record is lost, and condition() says so.
//
// A file with kLibrary in its header must be as McapWriter writes it. For other files the MCAP specification holds:
// chunks may be compressed by lz4, messages may lie outside of chunks, and the summary and all indexes are optional. A
// file with a summary that does not name all of it is read from the start. A damaged chunk is lost, what follows is
// not.
//
// One reader and its cursors are for one thread.
class McapReader {
 public:
  // Wrong input where the file cannot be read or does not begin as an MCAP file.
  static base::Result<McapReader> Open(const std::filesystem::path& path, const ReaderSettings& settings = {});
  // The same of a file in memory.
  static base::Result<McapReader> OpenBytes(base::Bytes bytes, const ReaderSettings& settings = {});
  McapReader(McapReader&&) noexcept;
  McapReader& operator=(McapReader&&) noexcept;
  ~McapReader();

  const Condition& condition() const;
  const Header& header() const;
  const std::map<SchemaId, Schema>& schemas() const;
  const std::map<ChannelId, Channel>& channels() const;
  // The ids of the channels of a topic, smallest first.
  std::vector<ChannelId> ChannelsOf(std::string_view topic) const;
  const Statistics& statistics() const;
  const std::vector<ChunkInfo>& chunks() const;  // in file order, with the runs of messages outside of chunks
  const std::vector<MetadataInfo>& metadata() const;
  const std::vector<AttachmentInfo>& attachments() const;

  // A record of metadata() or attachments(). Wrong input where it is damaged.
  base::Result<Metadata> ReadMetadata(const MetadataInfo& info) const;
  // Every metadata record of that name, later entries over earlier ones; nothing where there is none.
  base::Result<std::optional<Metadata>> FindMetadata(std::string_view name) const;
  base::Result<Attachment> ReadAttachment(const AttachmentInfo& info) const;
  base::Result<std::optional<Attachment>> FindAttachment(std::string_view name) const;  // the last of that name

  // Those of the query, by log time or in file order.
  MessageCursor Messages(Query query = {}) const;
  // One of chunks(), alone: nothing else of the file is read. Wrong input where it is damaged (it says which times are
  // lost).
  base::Result<ChunkMessages> ReadChunk(const ChunkInfo& info) const;

  // Reads everything and compares: each checksum, each index with what it points to, the statistics with the messages.
  // One sentence a finding, at most a hundred; none where the file is whole.
  std::vector<std::string> Verify() const;

  class Shared;

 private:
  explicit McapReader(std::shared_ptr<const Shared> shared);
  std::shared_ptr<const Shared> shared_;
};

}  // namespace rodeira::record
