// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/core/base/hash.hpp"
#include "common/data/record/mcap_reader.hpp"
#include "idl/codec.hpp"

// What whole runs left in their recordings.
namespace rodeira::system_test {

// One sample of a recording.
struct Recorded {
  std::string topic;
  std::uint32_t source = 0;
  std::int64_t step = 0;
  base::Digest payload = 0;  // of all its bytes
  base::Digest state = 0;    // of its node's state, as the node said it

  bool operator==(const Recorded&) const = default;
};

// Every sample of the lockstep in the file's order, which is what makes two recordings identical: wall times and
// remarks are passed over. A file that cannot be read whole fails the test.
std::vector<Recorded> SamplesOf(const std::string& recording);
// Where two runs part: node, step, topic and both digests. Empty where they never do.
std::string FirstDifference(const std::vector<Recorded>& a, const std::vector<Recorded>& b);

// Waits until more of a recording is on the disk than now, or nothing comes for 10 s: the run may be over.
void WaitForGrowth(const std::string& recording);

// All messages of one topic, in order; `source` names the node where several publish it.
template <class Message>
std::vector<Message> MessagesOf(const std::string& recording, std::string_view topic, const std::string& source = "") {
  std::vector<Message> messages;
  const auto reader = record::McapReader::Open(recording);
  if (!reader) return messages;
  record::Query query;
  query.channels.emplace();
  for (const record::ChannelId channel : reader.value().ChannelsOf(topic)) {
    if (source.empty() || reader.value().channels().at(channel).metadata.at("source") == source)
      query.channels->insert(channel);
  }
  auto cursor = reader.value().Messages(query);
  for (;;) {
    const auto message = cursor.Next();
    if (!message || !message.value()) return messages;
    auto decoded = idl::Decode<Message>(message.value()->data);
    if (!decoded) return messages;
    messages.push_back(std::move(decoded).value());
  }
}

}  // namespace rodeira::system_test
