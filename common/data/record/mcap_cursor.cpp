// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <tuple>
#include <utility>

#include "common/data/record/mcap_contents.hpp"

namespace rodeira::record {

// Merges the chunks that overlap in time: each open chunk stands at its next message, and the earliest goes first.
class MessageCursor::Walk {
 public:
  Walk(std::shared_ptr<const McapReader::Shared> shared, Query query);
  base::Result<std::optional<Message>> Next();

 private:
  struct OpenChunk {
    const ChunkInfo* info = nullptr;
    Chunk chunk;
    std::size_t next = 0;  // of chunk.entries

    bool done() const { return next == chunk.entries.size(); }
    // By log time, then by place in the file.
    auto Key() const {
      const Chunk::Entry& entry = chunk.entries[next];
      return std::tuple(entry.log_time_ns, info->offset, entry.offset);
    }
  };

  bool by_time() const { return query_.order == Query::Order::kLogTime; }
  bool Wanted(const ChunkInfo& chunk) const;
  bool Wanted(const Chunk::Entry& entry) const;
  bool NeedsNextChunk() const;
  base::Status OpenNextChunk();
  void CloseDoneChunks();

  std::shared_ptr<const McapReader::Shared> shared_;
  Query query_;
  std::vector<const ChunkInfo*> waiting_;  // in the order in which they are opened
  std::size_t next_chunk_ = 0;             // of waiting_
  std::vector<OpenChunk> open_;            // few: as many as overlap
  std::uint64_t open_bytes_ = 0;
};

MessageCursor::Walk::Walk(std::shared_ptr<const McapReader::Shared> shared, Query query)
    : shared_(std::move(shared)), query_(std::move(query)) {
  for (const ChunkInfo& chunk : shared_->contents.chunks) {
    if (Wanted(chunk)) waiting_.push_back(&chunk);
  }
  if (by_time()) {
    std::ranges::stable_sort(waiting_, {}, [](const ChunkInfo* chunk) { return chunk->first_log_time_ns; });
  }
}

bool MessageCursor::Walk::Wanted(const ChunkInfo& chunk) const {
  if (chunk.last_log_time_ns < query_.from_ns || chunk.first_log_time_ns > query_.through_ns) return false;
  if (!query_.channels || !chunk.channels) return true;
  return std::ranges::any_of(*chunk.channels, [&](ChannelId channel) { return query_.channels->contains(channel); });
}

bool MessageCursor::Walk::Wanted(const Chunk::Entry& entry) const {
  return entry.log_time_ns >= query_.from_ns && entry.log_time_ns <= query_.through_ns &&
         (!query_.channels || query_.channels->contains(entry.channel));
}

bool MessageCursor::Walk::NeedsNextChunk() const {
  if (next_chunk_ == waiting_.size()) return false;
  if (open_.empty()) return true;
  if (!by_time()) return false;
  // A chunk that begins at the very time of the next message may lie before it in the file.
  const auto earliest = std::ranges::min_element(open_, {}, &OpenChunk::Key);
  return waiting_[next_chunk_]->first_log_time_ns <= earliest->chunk.entries[earliest->next].log_time_ns;
}

base::Status MessageCursor::Walk::OpenNextChunk() {
  const ChunkInfo& info = *waiting_[next_chunk_++];
  if (!open_.empty() && info.uncompressed_bytes > shared_->settings.memory_bytes - open_bytes_) {
    return base::Failed("recording.too_much_memory",
                        fmt::format("the chunks that overlap at {} need more than {} bytes of memory",
                                    Seconds(info.first_log_time_ns), shared_->settings.memory_bytes),
                        fmt::format("{}: byte {}", shared_->source->name(), info.offset));
  }
  auto loaded = LoadChunk(*shared_->source, info, shared_->contents);
  if (!loaded) return loaded.error();
  OpenChunk chunk{&info, std::move(loaded).value()};
  auto& entries = chunk.chunk.entries;
  std::erase_if(entries, [&](const Chunk::Entry& entry) { return !Wanted(entry); });
  if (entries.empty()) return {};
  if (by_time()) std::ranges::stable_sort(entries, {}, &Chunk::Entry::log_time_ns);
  open_bytes_ += std::min(chunk.chunk.records.size(), shared_->settings.memory_bytes);
  open_.push_back(std::move(chunk));
  return {};
}

void MessageCursor::Walk::CloseDoneChunks() {
  std::erase_if(open_, [&](const OpenChunk& chunk) {
    if (chunk.done()) open_bytes_ -= std::min(chunk.chunk.records.size(), shared_->settings.memory_bytes);
    return chunk.done();
  });
}

base::Result<std::optional<Message>> MessageCursor::Walk::Next() {
  CloseDoneChunks();
  while (NeedsNextChunk()) {
    if (auto status = OpenNextChunk(); !status) return status.error();
  }
  if (open_.empty()) return std::optional<Message>();
  OpenChunk& chunk = *std::ranges::min_element(open_, {}, &OpenChunk::Key);
  const auto record = RecordAt(chunk.chunk.records, chunk.chunk.entries[chunk.next++].offset);
  return ParseMessage(record->content);
}

MessageCursor::MessageCursor(std::unique_ptr<Walk> walk) : walk_(std::move(walk)) {}
MessageCursor::MessageCursor(MessageCursor&&) noexcept = default;
MessageCursor& MessageCursor::operator=(MessageCursor&&) noexcept = default;
MessageCursor::~MessageCursor() = default;

base::Result<std::optional<Message>> MessageCursor::Next() { return walk_->Next(); }

MessageCursor McapReader::Messages(Query query) const {
  return MessageCursor(std::make_unique<MessageCursor::Walk>(shared_, std::move(query)));
}

}  // namespace rodeira::record
