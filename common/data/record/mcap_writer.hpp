// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "common/core/base/result.hpp"
#include "common/data/record/mcap_types.hpp"
#include "common/data/record/sink.hpp"

namespace rodeira::record {

// Settings of a writer. Open refuses values outside of the ranges.
struct WriterSettings {
  Compression compression = Compression::kZstd;
  int zstd_level = -1;                          // -7 (fastest) to 19
  std::uint64_t chunk_span_ns = 1'000'000'000;  // the log times of a chunk span less than this; at most one second
  std::uint64_t chunk_bytes = 1u << 20;         // a chunk is closed before it would grow beyond (4 KiB to 64 MiB)
  bool overwrite = false;                       // an existing file is refused otherwise
  std::string profile;
  std::string library = kLibrary;
};

// Writes one MCAP file with chunks, indexes and checksums. The bytes are a pure function of the calls and the settings.
//
// Schemas and channels lie in the chunks, before the messages that need them. A chunk goes to the operating system as
// soon as it is complete: a crash of this process loses at most the messages of one chunk, less after Flush().
//
// The first failure (disk full, file too large) is final: what was complete before it stays readable, nothing more is
// written, and every later call returns the same Error. A call refused with kWrongInput (a text that is too long, an
// unknown channel) changes nothing and the writer goes on.
//
// MCAP's texts are UTF-8: of names, topics and metadata, each other byte is written as "\xe4". A schema's text and the
// data of messages and attachments stay as they are.
//
// Not for use by several threads at the same time.
class McapWriter {
 public:
  // Creates the file and writes its header.
  static base::Result<McapWriter> Open(const std::filesystem::path& path, const WriterSettings& settings = {});
  // The same into another sink, which is empty.
  static base::Result<McapWriter> Open(std::unique_ptr<Sink> sink, const WriterSettings& settings = {});
  // Goes on with a recording of a dead writer, also after it was closed: behind its last whole chunk, which is
  // handed in with those before it as far as tail.span_ns of log time reach; what lay behind (a torn chunk, closing
  // metadata, the summary) is cut off. Nothing where it has no whole chunk yet. Wrong input where the file is no
  // recording or was written by another program, Failed where what can be read of it ends before `least_end_ns`: it is
  // left as it is then.
  struct Tail {
    std::uint64_t span_ns = 0;
    std::uint64_t least_end_ns = 0;                                          // log time; 0: anything will do
    std::function<base::Status(const Channel&, const Message&)> on_message;  // in file order
  };
  static base::Result<std::optional<McapWriter>> Resume(const std::filesystem::path& path,
                                                        const WriterSettings& settings, const Tail& tail);
  McapWriter(McapWriter&&) noexcept;
  McapWriter& operator=(McapWriter&&) noexcept;
  // Closes the file where Close() was not called; an error is lost then.
  ~McapWriter();

  // `name` is "module::Type", `text` the whole IDL. The same three again give the same id. Ids count from 1.
  base::Result<SchemaId> AddSchema(std::string_view name, std::string_view encoding, std::string_view text);
  // `schema` comes from AddSchema, or is 0 for none. The same four again give the same id. Ids count from 1.
  base::Result<ChannelId> AddChannel(std::string_view topic, SchemaId schema, std::string_view message_encoding,
                                     const TextMap& metadata = {});
  // Messages may come in any order of time. Wrong input for an unknown channel, or more than kMaxMessageBytes.
  base::Status Write(ChannelId channel, std::uint32_t sequence, std::uint64_t log_time_ns,
                     std::uint64_t publish_time_ns, std::span<const std::byte> data);
  // Metadata and attachments close the current chunk, so that the file keeps the order of the calls. Metadata has no
  // checksum of its own (McapReader::Verify sees damage by the file's): what must be beyond doubt is an attachment or
  // a message.
  base::Status AddMetadata(std::string_view name, const TextMap& entries);
  base::Status AddAttachment(std::string_view name, std::string_view media_type, std::span<const std::byte> data,
                             std::uint64_t log_time_ns, std::uint64_t create_time_ns);
  // Closes the current chunk and hands it to the operating system: it survives the end of this process.
  base::Status Flush();
  // Flush(), and waits for the disk: it survives the end of power.
  base::Status Sync();
  // Writes the rest, the summary and the footer. Later calls are our own mistake, except Close(), which does nothing.
  base::Status Close();

  // Counts of everything accepted so far.
  const Statistics& statistics() const;
  // Bytes handed to the operating system so far.
  std::uint64_t written_bytes() const;

 private:
  class Work;
  explicit McapWriter(std::unique_ptr<Work> work);
  std::unique_ptr<Work> work_;
};

}  // namespace rodeira::record
