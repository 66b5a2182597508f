// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/core/base/bytes.hpp"
#include "common/data/record/mcap_reader.hpp"
#include "common/data/record/mcap_types.hpp"
#include "common/data/record/mcap_writer.hpp"

// Recordings for the tests: a list of calls, what they must come back as, and their bytes.
namespace rodeira::record {

struct Call {
  enum class Kind : std::uint8_t { kMessage, kMetadata, kAttachment, kFlush };
  Kind kind = Kind::kMessage;
  std::uint8_t channel = 0;  // 0 to 2, of the sample's three
  std::uint64_t log_time_ns = 0;
  std::uint16_t bytes = 0;
};

struct Copied {  // a message with its own bytes
  std::string topic;
  std::uint32_t sequence = 0;
  std::uint64_t log_time_ns = 0;
  std::uint64_t publish_time_ns = 0;
  base::Bytes data;
  bool operator==(const Copied&) const = default;
  auto operator<=>(const Copied&) const = default;
};
void PrintTo(const Copied& message, std::ostream* out);

inline constexpr const char* kTopics[3] = {"vehicle/state", "clock/grant", "events"};

// Opens a writer, makes the calls, and closes it. Data, sequence numbers and names follow from a call's place.
base::Bytes Record(const std::vector<Call>& calls, const WriterSettings& settings);
// The same calls on a writer that is open; stops at the first failure.
base::Status Make(McapWriter& writer, const std::vector<Call>& calls);
// The messages of the calls in their order.
std::vector<Copied> MessagesOf(const std::vector<Call>& calls);

struct Read {
  std::vector<Copied> messages;
  std::vector<std::string> errors;
};
// Everything that a cursor gives, going on behind errors.
Read ReadAll(const McapReader& reader, const Query& query = {});

// About a dozen messages in several chunks, with metadata and an attachment in between.
std::vector<Call> SmallPlan();
WriterSettings SmallSettings(Compression compression);

}  // namespace rodeira::record
