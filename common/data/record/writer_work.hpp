// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/data/record/chunk_builder.hpp"
#include "common/data/record/mcap_contents.hpp"
#include "common/data/record/mcap_format.hpp"
#include "common/data/record/mcap_writer.hpp"

namespace rodeira::record {

// The file that is being written. McapWriter is its public face.
class McapWriter::Work {
 public:
  Work(std::unique_ptr<Sink> sink, const WriterSettings& settings)
      : sink_(std::move(sink)), settings_(settings), chunk_(settings.compression, settings.zstd_level) {}

  // Writes magic bytes and header. Once a function has failed all others return its Error.
  base::Status Begin();
  // Instead of Begin(): the sink holds `bytes` bytes with this checksum, and this is what they say.
  void Resume(Contents contents, std::uint64_t bytes, std::uint32_t crc);
  base::Result<SchemaId> AddSchema(std::string_view name, std::string_view encoding, std::string_view text);
  base::Result<ChannelId> AddChannel(std::string_view topic, SchemaId schema, std::string_view message_encoding,
                                     const TextMap& metadata);
  base::Status Write(const Message& message);
  base::Status AddMetadata(std::string_view name, const TextMap& entries);
  base::Status AddAttachment(AttachmentInfo info, std::span<const std::byte> data);
  // Writes the records gathered so far as a chunk; nothing where there are none.
  base::Status CloseChunk();
  // All that is written lies on the disk.
  base::Status Sync();
  // Writes the summary and closes the sink.
  base::Status Finish();

  bool closed() const { return closed_; }
  const Statistics& statistics() const { return statistics_; }
  std::uint64_t written_bytes() const { return offset_; }
  // With the sink's name as its place.
  base::Error Refuse(std::string message) const {
    return base::WrongInput("recording.wrong_message", std::move(message), sink_->name());
  }
  const std::optional<base::Error>& failure() const { return failure_; }

 private:
  base::Status Emit();
  // Closes the chunk where another record of that size would make it too large.
  base::Status MakeRoom(std::uint64_t record_bytes);
  void PutSummary(std::vector<SummaryOffset>& groups);

  std::unique_ptr<Sink> sink_;
  WriterSettings settings_;
  ChunkBuilder chunk_;
  base::ByteWriter out_;      // what goes to the sink next
  std::uint64_t offset_ = 0;  // bytes in the sink
  std::uint32_t crc_ = 0;     // of these
  bool closed_ = false;
  std::optional<base::Error> failure_;
  Statistics statistics_;
  std::vector<Schema> schemas_;    // id − 1
  std::vector<Channel> channels_;  // id − 1
  std::vector<ChunkInfo> chunks_;
  std::vector<AttachmentInfo> attachments_;
  std::vector<MetadataInfo> metadata_;
};

}  // namespace rodeira::record
