// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <memory>

#include "common/core/base/bytes.hpp"
#include "common/data/record/compress.hpp"
#include "common/data/record/mcap_format.hpp"

namespace rodeira::record {

// Gathers the records of one chunk and writes the chunk with its message indexes.
class ChunkBuilder {
 public:
  ChunkBuilder(Compression compression, int zstd_level);

  // A schema or channel comes before the first message that needs it.
  void Add(const Schema& schema) { PutSchema(records_, schema); }
  void Add(const Channel& channel) { PutChannel(records_, channel); }
  void Add(const Message& message);

  bool empty() const { return records_.bytes().empty(); }
  std::uint64_t bytes() const { return records_.bytes().size(); }
  // The span of log times, in nanoseconds, that the chunk would have with one more message.
  std::uint64_t SpanWith(std::uint64_t log_time_ns) const;

  // Appends the Chunk and its MessageIndex records to `out`, with its first byte at `file_offset`, empties the
  // builder, and returns what the chunk's index says.
  ChunkInfo Finish(std::uint64_t file_offset, base::ByteWriter& out);

 private:
  base::ByteWriter records_;
  std::map<ChannelId, IndexEntries> index_;
  bool has_messages_ = false;
  std::uint64_t first_log_time_ns_ = 0;
  std::uint64_t last_log_time_ns_ = 0;
  Compression compression_;
  std::unique_ptr<ZstdCompressor> zstd_;
};

}  // namespace rodeira::record
