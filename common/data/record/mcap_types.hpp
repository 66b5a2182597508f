// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>

#include "common/core/base/bytes.hpp"

// What an MCAP file holds (https://mcap.dev/spec). All times are nanoseconds, here of simulated time.
namespace rodeira::record {

using SchemaId = std::uint16_t;  // 0 means "no schema"
using ChannelId = std::uint16_t;
using TextMap = std::map<std::string, std::string>;

// Nothing larger is written, nor believed when read.
inline constexpr std::uint64_t kMaxMessageBytes = 64u << 20;
inline constexpr std::uint64_t kMaxRecordBytes = 256u << 20;

// Header.library of the recordings that McapWriter writes unless it is told another name.
inline constexpr const char* kLibrary = "rodeira";

enum class Compression { kNone, kZstd };

// First record of a file: profile and program that wrote it.
struct Header {
  std::string profile;
  std::string library;
  bool operator==(const Header&) const = default;
};

// The type of messages.
struct Schema {
  SchemaId id = 0;
  std::string name;      // "module::Type"
  std::string encoding;  // "omgidl"
  std::string text;      // one self-contained IDL text without preprocessor lines
  bool operator==(const Schema&) const = default;
};

// A sequence of messages of one type. Several channels may have the same topic.
struct Channel {
  ChannelId id = 0;
  SchemaId schema = 0;
  std::string topic;
  std::string message_encoding;  // "cdr": the payload with its 4-byte encapsulation header
  TextMap metadata;
  bool operator==(const Channel&) const = default;
};

// A message. Times are nanoseconds; in a recording of Rodeira, simulated time.
struct Message {
  ChannelId channel = 0;
  std::uint32_t sequence = 0;
  std::uint64_t log_time_ns = 0;
  std::uint64_t publish_time_ns = 0;
  std::span<const std::byte> data;  // the function that hands out the message says how long these bytes live
};

// A named table of texts.
struct Metadata {
  std::string name;
  TextMap entries;
  bool operator==(const Metadata&) const = default;
};

// A named file within the recording.
struct Attachment {
  std::string name;
  std::string media_type;
  std::uint64_t log_time_ns = 0;
  std::uint64_t create_time_ns = 0;
  base::Bytes data;
  bool operator==(const Attachment&) const = default;
};

// Counts of a file. Times are nanoseconds, as of messages.
struct Statistics {
  std::uint64_t messages = 0;
  std::uint16_t schemas = 0;
  std::uint32_t channels = 0;
  std::uint32_t attachments = 0;
  std::uint32_t metadata = 0;
  std::uint32_t chunks = 0;
  std::uint64_t first_log_time_ns = 0;  // 0 where there is no message
  std::uint64_t last_log_time_ns = 0;
  std::map<ChannelId, std::uint64_t> messages_by_channel;  // channels without a message are not named
  bool operator==(const Statistics&) const = default;
};

}  // namespace rodeira::record
