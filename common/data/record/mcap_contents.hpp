// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/core/base/result.hpp"
#include "common/data/record/mcap_format.hpp"
#include "common/data/record/mcap_reader.hpp"
#include "common/data/record/source.hpp"

// What is known of a recording, whether its summary or a scan said so. For the reader's own files.
namespace rodeira::record {

// Schemas and channels met so far.
struct Definitions {
  std::map<SchemaId, Schema> schemas;
  std::map<ChannelId, Channel> channels;
  bool operator==(const Definitions&) const = default;

  // Wrong input where an id would get another meaning, or where a channel's schema is not known.
  base::Status Add(const Schema& schema);
  base::Status Add(const Channel& channel);
};

// What a file holds, without its messages.
struct Contents {
  Header header;
  Rules rules = Rules::kOwn;
  Definitions definitions;
  Statistics statistics;
  std::vector<ChunkInfo> chunks;  // these three in file order
  std::vector<MetadataInfo> metadata;
  std::vector<AttachmentInfo> attachments;
};

// A chunk's records, uncompressed, their checksum found right, and the places of its messages.
struct Chunk {
  // Where a message lies.
  struct Entry {
    std::uint64_t log_time_ns = 0;
    std::uint64_t offset = 0;  // of the message's record within `records`
    ChannelId channel = 0;
  };
  ChunkHead head;  // without its records
  base::Bytes records;
  std::vector<Entry> entries;  // in file order
  std::uint64_t skipped = 0;   // records of applications or of later revisions of MCAP
};

// A record read from the file.
struct FileRecord {
  Opcode opcode = Opcode::kHeader;
  base::Bytes bytes;  // with opcode and length
  std::span<const std::byte> content() const { return std::span(bytes).subspan(kHeadBytes); }
};

// Reads the record at `offset` that must end at or before `end`. Wrong input where it does not, or is too large.
base::Result<FileRecord> ReadRecord(const Source& source, std::uint64_t offset, std::uint64_t end);

// Uncompresses a Chunk record's content, checks it, adds its schemas and channels to `definitions` (only where all of
// the chunk is right) and lists its messages.
base::Result<Chunk> DecodeChunk(std::span<const std::byte> content, Definitions& definitions, Rules rules);

// The chunk, or the run of messages outside of chunks, that `info` describes. Its definitions must be among the
// contents'.
base::Result<Chunk> LoadChunk(const Source& source, const ChunkInfo& info, const Contents& contents);

// Contents by the summary at the end of a file.
struct Summary {
  Contents contents;
  bool has_statistics = false;
  std::string shortage;  // why it does not name everything in the file; only in files of other programs
};
// What the summary says. Wrong input says why it cannot be used: it is damaged, or the file was not closed.
base::Result<Summary> ReadSummary(const Source& source);

// What can be read from the start.
struct Scan {
  Contents contents;
  bool ended = false;            // DataEnd was reached
  bool lost = false;             // something in the file is not in `contents`, or was changed after it was written
  std::uint64_t skipped = 0;     // records of applications or of later revisions of MCAP
  std::uint64_t good_bytes = 0;  // up to the end of the last record that was taken
  std::vector<std::string> findings;
};
// Wrong input where a file does not begin as an MCAP file of the version that this program reads.
base::Status CheckMark(const Source& source);
// Wrong input where not even the header is there.
base::Result<Scan> ScanFile(const Source& source);

// Adds schemas and channels that only the summary names: other programs write those without messages so.
void AddNamed(const Contents& summary, Contents& scanned);

// How a summary differs from the file, one sentence each. Of other programs' files only what their summary says is
// compared.
std::vector<std::string> Compare(const Summary& said, const Contents& found);

// State of a reader and its cursors; constant once the file is open.
class McapReader::Shared {
 public:
  std::unique_ptr<Source> source;
  ReaderSettings settings;
  Condition condition;
  Contents contents;
};

// "12.345 s", for sentences.
std::string Seconds(std::uint64_t time_ns);

}  // namespace rodeira::record
