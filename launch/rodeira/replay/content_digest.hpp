// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>

#include "common/core/base/hash.hpp"
#include "common/data/record/mcap_reader.hpp"
#include "common/data/record/text_number.hpp"
#include "common/runtime/lockstep/sample.hpp"

namespace rodeira::cli {

// A digest of all samples of the lockstep of a recording, in the order of the file: recordings with the same one are
// identical. Samples of the lockstep are those of a channel with a period.
class ContentDigest {
 public:
  // The next message of the file; others than samples of the lockstep change nothing.
  void Add(const record::Channel& channel, const record::Message& message) {
    auto found = names_.find(channel.id);
    if (found == names_.end()) found = names_.emplace(channel.id, NameOf(channel)).first;
    const auto& name = found->second;
    if (!name || !lockstep::SampleHeader::HasHeader(message.data)) return;
    digest_ = base::Combine(digest_, base::Combine(*name, lockstep::PayloadDigest(message.data)));
  }
  base::Digest digest() const { return digest_; }

 private:
  // Of topic and source; nothing for a channel beside the lockstep.
  static std::optional<base::Digest> NameOf(const record::Channel& channel) {
    const auto period = record::WholeNumber(channel.metadata, "period_steps");
    if (!period || *period <= 0) return std::nullopt;
    const auto source = channel.metadata.find("source");
    return base::Hash(channel.topic + '\n' + (source == channel.metadata.end() ? std::string() : source->second));
  }

  std::map<record::ChannelId, std::optional<base::Digest>> names_;
  base::Digest digest_ = 0;
};

}  // namespace rodeira::cli
