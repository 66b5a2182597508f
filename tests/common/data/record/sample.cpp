// SPDX-License-Identifier: Apache-2.0
#include "tests/common/data/record/sample.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <ostream>

#include "common/core/base/random.hpp"

namespace rodeira::record {
namespace {

base::Bytes DataOf(std::size_t place, std::size_t size) {
  base::Bytes data(size);
  for (std::size_t i = 0; i < size; ++i) data[i] = static_cast<std::byte>(base::RandomBits({place, i / 4}));
  return data;
}

}  // namespace

void PrintTo(const Copied& message, std::ostream* out) {
  *out << message.topic << " #" << message.sequence << " at " << message.log_time_ns << " with " << message.data.size()
       << " bytes";
}

base::Status Make(McapWriter& writer, const std::vector<Call>& calls) {
  ChannelId channels[3];
  for (int i = 0; i < 3; ++i) {
    const std::string name = "probe::Type" + std::to_string(i);
    auto schema =
        writer.AddSchema(name, "omgidl", "module probe { struct Type" + std::to_string(i) + " { long x; }; };");
    if (!schema) return schema.error();
    auto channel = writer.AddChannel(kTopics[i], schema.value(), "cdr", {{"source", std::to_string(7 * i)}});
    if (!channel) return channel.error();
    channels[i] = channel.value();
  }
  for (std::size_t i = 0; i < calls.size(); ++i) {
    const Call& call = calls[i];
    base::Status status;
    switch (call.kind) {
      case Call::Kind::kMessage:
        status = writer.Write(channels[call.channel], static_cast<std::uint32_t>(i), call.log_time_ns,
                              call.log_time_ns + i, DataOf(i, call.bytes));
        break;
      case Call::Kind::kMetadata:
        status = writer.AddMetadata("meta" + std::to_string(i), {{"bytes", std::to_string(call.bytes)}, {"k", ""}});
        break;
      case Call::Kind::kAttachment:
        status =
            writer.AddAttachment("file" + std::to_string(i), "text/plain", DataOf(i, call.bytes), call.log_time_ns, i);
        break;
      case Call::Kind::kFlush:
        status = writer.Flush();
        break;
    }
    if (!status) return status;
  }
  return {};
}

base::Bytes Record(const std::vector<Call>& calls, const WriterSettings& settings) {
  base::Bytes bytes;
  auto writer = McapWriter::Open(std::make_unique<MemorySink>(&bytes), settings);
  EXPECT_TRUE(writer.ok());
  EXPECT_TRUE(Make(writer.value(), calls).ok());
  EXPECT_TRUE(writer.value().Close().ok());
  EXPECT_EQ(writer.value().written_bytes(), bytes.size());
  return bytes;
}

std::vector<Copied> MessagesOf(const std::vector<Call>& calls) {
  std::vector<Copied> messages;
  for (std::size_t i = 0; i < calls.size(); ++i) {
    const Call& call = calls[i];
    if (call.kind != Call::Kind::kMessage) continue;
    messages.push_back({kTopics[call.channel], static_cast<std::uint32_t>(i), call.log_time_ns, call.log_time_ns + i,
                        DataOf(i, call.bytes)});
  }
  return messages;
}

Read ReadAll(const McapReader& reader, const Query& query) {
  Read read;
  MessageCursor cursor = reader.Messages(query);
  // Each error uses up a chunk, so this ends.
  while (true) {
    auto next = cursor.Next();
    if (!next) {
      read.errors.push_back(next.error().Text());
      continue;
    }
    if (!next.value()) return read;
    const Message& m = *next.value();
    read.messages.push_back({reader.channels().at(m.channel).topic, m.sequence, m.log_time_ns, m.publish_time_ns,
                             base::Bytes(m.data.begin(), m.data.end())});
  }
}

std::vector<Call> SmallPlan() {
  using enum Call::Kind;
  return {{kMessage, 0, 0, 8},      {kMessage, 1, 0, 0},    {kMessage, 2, 5, 33},  {kMetadata, 0, 0, 3},
          {kMessage, 0, 900, 12},   {kMessage, 1, 400, 5},  {kFlush, 0, 0, 0},     {kMessage, 2, 350, 20},
          {kAttachment, 0, 77, 19}, {kMessage, 0, 2100, 9}, {kMessage, 0, 900, 7}, {kMessage, 1, 2200, 40}};
}

WriterSettings SmallSettings(Compression compression) {
  WriterSettings settings;
  settings.compression = compression;
  settings.chunk_span_ns = 1000;
  return settings;
}

}  // namespace rodeira::record
