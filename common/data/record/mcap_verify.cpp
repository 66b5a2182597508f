// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "common/data/record/mcap_contents.hpp"

namespace rodeira::record {
namespace {

constexpr std::size_t kMaxFindings = 100;

using Findings = std::vector<std::string>;

// Compares two lists in file order and names the first place where they differ.
template <class Info, class Same>
void CompareLists(const std::vector<Info>& said, const std::vector<Info>& found, const char* what, Same same,
                  Findings& findings) {
  if (said.size() != found.size()) {
    findings.push_back(fmt::format("the summary names {} {}, the file holds {}", said.size(), what, found.size()));
  }
  for (std::size_t i = 0; i < std::min(said.size(), found.size()); ++i) {
    if (said[i].offset == found[i].offset && said[i].record_bytes == found[i].record_bytes && same(said[i], found[i])) {
      continue;
    }
    findings.push_back(
        fmt::format("byte {}: what the summary says of the {} differs from what lies there", found[i].offset, what));
    return;
  }
}

bool SameChunk(const ChunkInfo& said, const ChunkInfo& found) {
  return said.first_log_time_ns == found.first_log_time_ns && said.last_log_time_ns == found.last_log_time_ns &&
         said.index_offsets == found.index_offsets && said.index_bytes == found.index_bytes &&
         said.compression == found.compression && said.compressed_bytes == found.compressed_bytes &&
         said.uncompressed_bytes == found.uncompressed_bytes;
}

bool SameAttachment(const AttachmentInfo& said, const AttachmentInfo& found) {
  return said.name == found.name && said.media_type == found.media_type && said.log_time_ns == found.log_time_ns &&
         said.create_time_ns == found.create_time_ns && said.data_bytes == found.data_bytes;
}

bool SameMetadata(const MetadataInfo& a, const MetadataInfo& b) { return a.name == b.name; }

void CompareOwn(const Contents& said, const Contents& found, Findings& findings) {
  if (said.header != found.header) findings.push_back("the header changed while it was read");
  if (said.definitions != found.definitions) {
    findings.push_back("the summary's schemas and channels differ from those in the data");
  }
  if (said.statistics != found.statistics) {
    findings.push_back(fmt::format("the summary's statistics name {} messages, {} were found; or another count differs",
                                   said.statistics.messages, found.statistics.messages));
  }
  CompareLists(said.chunks, found.chunks, "chunks", SameChunk, findings);
  CompareLists(said.attachments, found.attachments, "attachments", SameAttachment, findings);
  CompareLists(said.metadata, found.metadata, "metadata records", SameMetadata, findings);
}

// Schemas and channels that nothing refers to may stand in the summary alone.
bool AreCopies(const Definitions& said, const Definitions& found) {
  const auto agree = [](const auto& one, const auto& other) {
    return std::ranges::all_of(one, [&](const auto& entry) {
      const auto same = other.find(entry.first);
      return same == other.end() || same->second == entry.second;
    });
  };
  return agree(said.schemas, found.schemas) && agree(said.channels, found.channels);
}

// The counts of schemas and channels are not compared: writers differ in whether they count those without messages.
void CompareStatistics(const Statistics& said, const Statistics& found, Findings& findings) {
  const auto differ = [&](const char* what, std::uint64_t a, std::uint64_t b) {
    if (a != b) findings.push_back(fmt::format("the summary's statistics name {} {}, {} were found", a, what, b));
  };
  differ("messages", said.messages, found.messages);
  differ("chunks", said.chunks, found.chunks);
  differ("attachments", said.attachments, found.attachments);
  differ("metadata records", said.metadata, found.metadata);
  if (said.first_log_time_ns != found.first_log_time_ns || said.last_log_time_ns != found.last_log_time_ns) {
    findings.push_back("the summary's statistics name other times than the messages have");
  }
  std::map<ChannelId, std::uint64_t> counts = said.messages_by_channel;
  std::erase_if(counts, [](const auto& entry) { return entry.second == 0; });
  if (!said.messages_by_channel.empty() && counts != found.messages_by_channel) {
    findings.push_back("the summary's statistics name another number of messages of a channel than were found");
  }
}

// What the summary says must be so; it need not say everything.
void CompareForeign(const Summary& summary, const Contents& found, Findings& findings) {
  const Contents& said = summary.contents;
  if (!AreCopies(said.definitions, found.definitions)) {
    findings.push_back("the summary's schemas and channels differ from those in the data");
  }
  if (summary.has_statistics) CompareStatistics(said.statistics, found.statistics, findings);
  if (!said.chunks.empty()) {
    std::vector<ChunkInfo> chunks = found.chunks;
    std::erase_if(chunks, [](const ChunkInfo& chunk) { return chunk.unchunked; });
    CompareLists(said.chunks, chunks, "chunks", SameChunk, findings);
  }
  if (!said.attachments.empty()) {
    CompareLists(said.attachments, found.attachments, "attachments", SameAttachment, findings);
  }
  if (!said.metadata.empty()) {
    CompareLists(said.metadata, found.metadata, "metadata records", SameMetadata, findings);
  }
}

}  // namespace

std::vector<std::string> Compare(const Summary& said, const Contents& found) {
  Findings findings;
  if (found.rules == Rules::kOwn) {
    CompareOwn(said.contents, found, findings);
  } else {
    CompareForeign(said, found, findings);
  }
  return findings;
}

std::vector<std::string> McapReader::Verify() const {
  auto scan = ScanFile(*shared_->source);
  if (!scan) return {scan.error().Text()};
  Findings findings = std::move(scan.value().findings);
  auto summary = ReadSummary(*shared_->source);
  if (!summary) {
    findings.insert(findings.begin(), summary.error().message);
  } else if (scan.value().ended) {
    const Findings differences = Compare(summary.value(), scan.value().contents);
    findings.insert(findings.end(), differences.begin(), differences.end());
  }
  if (findings.size() > kMaxFindings) {
    const std::size_t more = findings.size() - (kMaxFindings - 1);
    findings.resize(kMaxFindings - 1);
    findings.push_back(fmt::format("and {} findings more", more));
  }
  return findings;
}

}  // namespace rodeira::record
