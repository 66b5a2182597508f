// SPDX-License-Identifier: Apache-2.0
#include "tests/common/data/record/foreign.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <lz4frame.h>
#include <zlib.h>
#include <zstd.h>

#include <algorithm>
#include <limits>
#include <map>

namespace rodeira::record {
namespace {

using base::Bytes;
using base::ByteWriter;
using Texts = std::vector<std::pair<std::string, std::string>>;

// Opcodes of the specification.
constexpr int kHeader = 1, kFooter = 2, kSchema = 3, kChannel = 4, kMessage = 5, kChunk = 6, kMessageIndex = 7,
              kChunkIndex = 8, kAttachment = 9, kAttachmentIndex = 10, kStatistics = 11, kMetadata = 12,
              kMetadataIndex = 13, kSummaryOffset = 14, kDataEnd = 15;
constexpr const char kMark[] = "\x89MCAP0\r\n";

std::uint32_t Crc(std::span<const std::byte> bytes) {
  return static_cast<std::uint32_t>(
      ::crc32(0, reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uInt>(bytes.size())));
}

Bytes Compressed(const Bytes& bytes, const std::string& compression) {
  if (compression.empty()) return bytes;
  Bytes out;
  if (compression == "zstd") {
    out.resize(ZSTD_compressBound(bytes.size()));
    out.resize(ZSTD_compress(out.data(), out.size(), bytes.data(), bytes.size(), 1));
  } else {
    out.resize(LZ4F_compressFrameBound(bytes.size(), nullptr));
    out.resize(LZ4F_compressFrame(out.data(), out.size(), bytes.data(), bytes.size(), nullptr));
  }
  return out;
}

struct ChunkPlace {
  std::uint64_t first = 0, last = 0, offset = 0, length = 0, index_length = 0, packed = 0, bytes = 0;
  std::map<ChannelId, std::uint64_t> indexes;
};

class ForeignWriter {
 public:
  explicit ForeignWriter(const Form& form) : form_(form) {}

  Bytes Write(const std::vector<Call>& calls) {
    out_.PutRaw(Mark());
    Record(out_, kHeader, Header());
    if (form_.definitions_outside || form_.messages_a_chunk == 0) PutDefinitions(out_);
    const std::vector<Copied> messages = MessagesOf(calls);
    for (std::size_t i = 0; i < messages.size(); ++i) {
      if (i == messages.size() / 2) PutOthers();
      Put(messages[i], form_.every_nth_outside > 0 && i % static_cast<std::size_t>(form_.every_nth_outside) == 0);
    }
    if (messages.empty()) PutOthers();
    CloseChunk();
    if (form_.data_end) {
      const std::uint32_t crc = form_.checksums ? Crc(out_.bytes()) : 0;
      ByteWriter end;
      end.Put(crc);
      Record(out_, kDataEnd, end);
    }
    PutSummary();
    return out_.bytes();
  }

 private:
  std::span<const std::byte> Mark() const { return std::as_bytes(std::span(kMark, 8)); }

  // Appends a record; the specification lets new fields follow the known ones, except in Message and Footer.
  void Record(ByteWriter& out, int opcode, const ByteWriter& content) const {
    ByteWriter whole;
    whole.PutRaw(content.bytes());
    if (form_.unknown_fields && opcode != kMessage && opcode != kFooter) whole.PutString("a later field");
    out.Put(static_cast<std::uint8_t>(opcode));
    out.Put(static_cast<std::uint64_t>(whole.bytes().size()));
    out.PutRaw(whole.bytes());
    if (!form_.unknown_records || opcode == kDataEnd || opcode == kFooter || opcode == kMessageIndex) return;
    if (opcode == kChunk) return;  // its message indexes follow immediately
    out.Put(static_cast<std::uint8_t>(content.bytes().size() % 2 == 0 ? 0x80 : 0x7F));
    out.Put(std::uint64_t{5});
    out.PutRaw(std::as_bytes(std::span("12345", 5)));
  }

  ByteWriter Header() const {
    ByteWriter content;
    content.PutString("profile");
    content.PutString(form_.library);
    return content;
  }
  static ByteWriter TextsOf(const Texts& texts) {
    ByteWriter block;
    for (const auto& [key, value] : texts) {
      block.PutString(key);
      block.PutString(value);
    }
    ByteWriter content;
    content.Put(static_cast<std::uint32_t>(block.bytes().size()));
    content.PutRaw(block.bytes());
    return content;
  }
  int topics() const { return form_.silent_channel ? 4 : 3; }
  static SchemaId SchemaOf(int topic) { return static_cast<SchemaId>(3 + 7 * topic); }
  static ChannelId ChannelOf(int topic) { return static_cast<ChannelId>(5 * topic); }  // 0 is a channel id, too
  void PutSchema(ByteWriter& out, int topic) const {
    ByteWriter content;
    content.Put(SchemaOf(topic));
    content.PutString(fmt::format("probe::Type{}", topic));
    content.PutString("omgidl");
    content.PutString(fmt::format("module probe {{ struct Type{} {{ long x; }}; }};", topic));
    Record(out, kSchema, content);
  }
  void PutChannel(ByteWriter& out, int topic) const {
    ByteWriter content;
    content.Put(ChannelOf(topic));
    content.Put(topic == 1 ? SchemaId{0} : SchemaOf(topic));  // one channel has no schema
    content.PutString(topic < 3 ? kTopics[topic] : "silent");
    content.PutString("cdr");
    content.PutRaw(TextsOf({{"source", std::to_string(topic)}}).bytes());
    Record(out, kChannel, content);
  }
  void PutDefinitions(ByteWriter& out) const {
    for (int topic = 0; topic < topics(); ++topic) {
      PutSchema(out, topic);
      PutChannel(out, topic);
    }
  }

  void Put(const Copied& message, bool outside) {
    const int topic = static_cast<int>(std::ranges::find(kTopics, message.topic) - std::begin(kTopics));
    ByteWriter content;
    content.Put(ChannelOf(topic));
    content.Put(message.sequence);
    content.Put(message.log_time_ns);
    content.Put(message.publish_time_ns);
    content.PutRaw(message.data);
    ++counts_[ChannelOf(topic)];
    first_ = std::min(first_, message.log_time_ns);
    last_ = std::max(last_, message.log_time_ns);
    if (form_.messages_a_chunk == 0 || (outside && (form_.definitions_outside || !chunks_.empty()))) {
      CloseChunk();
      Record(out_, kMessage, content);
      return;
    }
    const bool needs_definitions = !form_.definitions_outside && chunks_.empty();
    if (chunk_.bytes().empty() && (needs_definitions || form_.repeats_definitions)) PutDefinitions(chunk_);
    index_[ChannelOf(topic)].emplace_back(message.log_time_ns, chunk_.bytes().size());
    Record(chunk_, kMessage, content);
    if (++in_chunk_ == form_.messages_a_chunk) CloseChunk();
  }

  void CloseChunk() {
    if (chunk_.bytes().empty()) return;
    ChunkPlace place;
    place.first = std::numeric_limits<std::uint64_t>::max();
    for (const auto& [channel, entries] : index_) {
      for (const auto& [time, offset] : entries) {
        place.first = std::min(place.first, time);
        place.last = std::max(place.last, time);
      }
    }
    const Bytes packed = Compressed(chunk_.bytes(), form_.compression);
    place.packed = packed.size();
    place.bytes = chunk_.bytes().size();
    ByteWriter content;
    content.Put(place.first);
    content.Put(place.last);
    content.Put(place.bytes);
    content.Put(form_.checksums ? Crc(chunk_.bytes()) : 0);
    content.PutString(form_.compression);
    content.Put(static_cast<std::uint64_t>(packed.size()));
    content.PutRaw(packed);
    place.offset = out_.bytes().size();
    Record(out_, kChunk, content);
    place.length = out_.bytes().size() - place.offset;
    if (form_.message_indexes) PutIndexes(place);
    chunks_.push_back(place);
    chunk_.Clear();
    index_.clear();
    in_chunk_ = 0;
  }
  void PutIndexes(ChunkPlace& place) {
    const std::uint64_t begin = out_.bytes().size();
    if (form_.empty_message_indexes) {
      for (int topic = 0; topic < topics(); ++topic) index_[ChannelOf(topic)];
    }
    for (const auto& [channel, entries] : index_) {
      ByteWriter content;
      content.Put(channel);
      content.Put(static_cast<std::uint32_t>(16 * entries.size()));
      for (const auto& [time, offset] : entries) {
        content.Put(time);
        content.Put(offset);
      }
      place.indexes[channel] = out_.bytes().size();
      Record(out_, kMessageIndex, content);
    }
    place.index_length = out_.bytes().size() - begin;
  }

  void PutOthers() {
    CloseChunk();
    ByteWriter metadata;
    metadata.PutString("about");
    metadata.PutRaw(TextsOf({{"key", "value"}}).bytes());
    metadata_at_ = out_.bytes().size();
    Record(out_, kMetadata, metadata);
    metadata_length_ = Length(metadata_at_);
    ByteWriter attachment;
    attachment.Put(std::uint64_t{7});
    attachment.Put(std::uint64_t{8});
    attachment.PutString("file.txt");
    attachment.PutString("text/plain");
    attachment.Put(std::uint64_t{4});
    attachment.PutRaw(std::as_bytes(std::span("data", 4)));
    attachment.Put(form_.checksums ? Crc(attachment.bytes()) : 0);
    attachment_at_ = out_.bytes().size();
    Record(out_, kAttachment, attachment);
    attachment_length_ = Length(attachment_at_);
  }
  // Of the record at that place, with opcode and length.
  std::uint64_t Length(std::uint64_t at) const {
    std::uint64_t length = 0;
    std::memcpy(&length, out_.bytes().data() + at + 1, sizeof length);
    return length + 9;
  }

  template <class Write>
  void Group(int opcode, bool wanted, Write write) {
    const std::uint64_t begin = out_.bytes().size();
    if (wanted) write();
    if (out_.bytes().size() > begin) groups_.push_back({opcode, begin, out_.bytes().size() - begin});
  }
  void PutSummary() {
    const std::uint64_t begin = out_.bytes().size();
    const auto schemas = [&] {
      for (int topic = 0; topic < topics(); ++topic) PutSchema(out_, topic);
    };
    const auto channels = [&] {
      for (int topic = 0; topic < topics(); ++topic) PutChannel(out_, topic);
    };
    if (!form_.channels_first) Group(kSchema, form_.schemas, schemas);
    Group(kChannel, form_.channels, channels);
    if (form_.channels_first) Group(kSchema, form_.schemas, schemas);
    Group(kStatistics, form_.statistics, [&] { PutStatistics(); });
    Group(kChunkIndex, form_.chunk_indexes, [&] { PutChunkIndexes(); });
    Group(kAttachmentIndex, form_.attachment_indexes, [&] {
      ByteWriter content;
      for (const std::uint64_t number : {attachment_at_, attachment_length_, std::uint64_t{7}, std::uint64_t{8}}) {
        content.Put(number);
      }
      content.Put(std::uint64_t{4});
      content.PutString("file.txt");
      content.PutString("text/plain");
      Record(out_, kAttachmentIndex, content);
    });
    Group(kMetadataIndex, form_.metadata_indexes, [&] {
      ByteWriter content;
      content.Put(metadata_at_);
      content.Put(metadata_length_);
      content.PutString("about");
      Record(out_, kMetadataIndex, content);
    });
    const bool has_summary = out_.bytes().size() > begin;
    const std::uint64_t offsets = out_.bytes().size();
    if (form_.summary_offsets) {
      for (const auto& [opcode, start, length] : groups_) {
        ByteWriter content;
        content.Put(static_cast<std::uint8_t>(opcode));
        content.Put(start);
        content.Put(length);
        Record(out_, kSummaryOffset, content);
      }
    }
    ByteWriter footer;
    footer.Put(static_cast<std::uint8_t>(kFooter));
    footer.Put(std::uint64_t{20});
    footer.Put(has_summary ? begin : 0);
    footer.Put(out_.bytes().size() > offsets ? offsets : 0);
    out_.PutRaw(footer.bytes());
    out_.Put(form_.checksums ? Crc(std::span(out_.bytes()).subspan(begin)) : 0);
    out_.PutRaw(Mark());
  }
  void PutStatistics() {
    std::uint64_t messages = 0;
    ByteWriter counts;
    for (const auto& [channel, count] : counts_) {
      messages += count;
      counts.Put(channel);
      counts.Put(count);
    }
    ByteWriter content;
    content.Put(messages);
    content.Put(static_cast<std::uint16_t>(topics()));
    content.Put(static_cast<std::uint32_t>(topics()));
    content.Put(std::uint32_t{1});
    content.Put(std::uint32_t{1});
    content.Put(static_cast<std::uint32_t>(chunks_.size()));
    content.Put(messages == 0 ? 0 : first_);
    content.Put(last_);
    content.Put(static_cast<std::uint32_t>(form_.channel_counts ? counts.bytes().size() : 0));
    if (form_.channel_counts) content.PutRaw(counts.bytes());
    Record(out_, kStatistics, content);
  }
  void PutChunkIndexes() {
    for (const ChunkPlace& chunk : chunks_) {
      ByteWriter content;
      for (const std::uint64_t number : {chunk.first, chunk.last, chunk.offset, chunk.length}) content.Put(number);
      content.Put(static_cast<std::uint32_t>(10 * chunk.indexes.size()));
      for (const auto& [channel, offset] : chunk.indexes) {
        content.Put(channel);
        content.Put(offset);
      }
      content.Put(chunk.index_length);
      content.PutString(form_.compression);
      content.Put(chunk.packed);
      content.Put(chunk.bytes);
      Record(out_, kChunkIndex, content);
    }
  }

  const Form& form_;
  ByteWriter out_;
  ByteWriter chunk_;
  std::map<ChannelId, std::vector<std::pair<std::uint64_t, std::uint64_t>>> index_;
  int in_chunk_ = 0;
  std::vector<ChunkPlace> chunks_;
  struct Place {
    int opcode;
    std::uint64_t begin, length;
  };
  std::vector<Place> groups_;
  std::map<ChannelId, std::uint64_t> counts_;
  std::uint64_t first_ = std::numeric_limits<std::uint64_t>::max(), last_ = 0;
  std::uint64_t metadata_at_ = 0, metadata_length_ = 0, attachment_at_ = 0, attachment_length_ = 0;
};

}  // namespace

Form DrawForm(Draw& draw) {
  Form form;
  const auto flag = [&] { return draw.Below(2) == 0; };
  const char* const compressions[] = {"", "zstd", "lz4"};
  form.messages_a_chunk = static_cast<int>(draw.Below(6));
  form.every_nth_outside = flag() ? 0 : static_cast<int>(1 + draw.Below(4));
  form.compression = compressions[draw.Below(3)];
  for (bool* one : {&form.definitions_outside, &form.repeats_definitions, &form.checksums, &form.message_indexes,
                    &form.empty_message_indexes, &form.silent_channel, &form.unknown_fields, &form.unknown_records,
                    &form.summary_offsets, &form.channels_first}) {
    *one = flag();
  }
  const std::size_t summary = draw.Below(4);  // 0: none, 1: all, else drawn
  for (bool* one : {&form.schemas, &form.channels, &form.statistics, &form.channel_counts, &form.chunk_indexes,
                    &form.attachment_indexes, &form.metadata_indexes}) {
    *one = summary == 1 || (summary > 1 && flag());
  }
  form.data_end = form.has_summary() || flag();
  if (!form.has_summary()) form.summary_offsets = false;
  return form;
}

std::string Text(const Form& form) {
  std::string text = fmt::format("{} messages a chunk, every {}th outside, '{}'", form.messages_a_chunk,
                                 form.every_nth_outside, form.compression);
  const auto add = [&](bool has, const char* what) {
    if (has) text += fmt::format(", {}", what);
  };
  add(form.definitions_outside, "definitions outside");
  add(form.repeats_definitions, "repeated definitions");
  add(form.checksums, "checksums");
  add(form.data_end, "data end");
  add(form.message_indexes, "message indexes");
  add(form.empty_message_indexes, "empty ones too");
  add(form.schemas, "schemas");
  add(form.channels, "channels");
  add(form.statistics, "statistics");
  add(form.channel_counts, "counts");
  add(form.chunk_indexes, "chunk indexes");
  add(form.attachment_indexes, "attachment indexes");
  add(form.metadata_indexes, "metadata indexes");
  add(form.summary_offsets, "summary offsets");
  add(form.channels_first, "channels first");
  add(form.silent_channel, "a silent channel");
  add(form.unknown_fields, "unknown fields");
  add(form.unknown_records, "unknown records");
  return text;
}

base::Bytes ForeignRecord(const std::vector<Call>& calls, const Form& form) { return ForeignWriter(form).Write(calls); }

std::vector<Call> DrawPlan(Draw& draw) {
  std::vector<Call> calls(draw.Below(41));
  for (Call& call : calls) {
    call = {Call::Kind::kMessage, static_cast<std::uint8_t>(draw.Below(3)), draw.Below(3'000'000'000),
            static_cast<std::uint16_t>(draw.Below(60))};
  }
  return calls;
}

}  // namespace rodeira::record
