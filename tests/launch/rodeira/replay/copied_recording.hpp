// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <map>
#include <string>

#include "common/data/record/mcap_reader.hpp"
#include "common/data/record/mcap_writer.hpp"

namespace rodeira::cli {

// A copy of a recording, its metadata, messages, IDL and embedded files changed on the way; a message or an embedded
// file for which `keep` says no is left out.
using Entries = std::function<void(const std::string& name, record::TextMap& entries)>;
using Keep = std::function<bool(const std::string& topic, const record::Message& message, base::Bytes& data)>;
using KeepFile = std::function<bool(const std::string& name)>;
using ChangeFile = std::function<void(const std::string& name, std::string& media_type, base::Bytes& data)>;
using ChangeIdl = std::function<void(const std::string& type, std::string& text)>;

inline void CopyRecording(
    const std::string& file, const std::string& copy, const Entries& change, const Keep& keep,
    const KeepFile& keep_file, const record::WriterSettings& settings = {},
    const ChangeIdl& change_idl = [](const std::string&, std::string&) {},
    const ChangeFile& change_file = [](const std::string&, std::string&, base::Bytes&) {}) {
  std::filesystem::remove(copy);
  auto reader = record::McapReader::Open(file);
  auto writer = record::McapWriter::Open(copy, settings);
  const auto& in = reader.value();
  for (const auto& info : in.metadata()) {
    record::TextMap entries = in.ReadMetadata(info).value().entries;
    change(info.name, entries);
    EXPECT_TRUE(writer.value().AddMetadata(info.name, entries).ok());
  }
  for (const auto& info : in.attachments()) {
    if (!keep_file(info.name)) continue;
    std::string media_type = info.media_type;
    base::Bytes data = in.ReadAttachment(info).value().data;
    change_file(info.name, media_type, data);
    EXPECT_TRUE(writer.value().AddAttachment(info.name, media_type, data, 0, 0).ok());
  }
  std::map<record::ChannelId, record::ChannelId> ids;
  for (const auto& [id, channel] : in.channels()) {
    const auto& schema = in.schemas().at(channel.schema);
    std::string text = schema.text;
    change_idl(schema.name, text);
    const auto made = writer.value().AddSchema(schema.name, schema.encoding, text);
    ids[id] =
        writer.value().AddChannel(channel.topic, made.value(), channel.message_encoding, channel.metadata).value();
  }
  auto cursor = in.Messages();
  for (auto message = cursor.Next(); message.value(); message = cursor.Next()) {
    const auto& m = *message.value();
    base::Bytes data(m.data.begin(), m.data.end());
    if (!keep(in.channels().at(m.channel).topic, m, data)) continue;
    EXPECT_TRUE(writer.value().Write(ids[m.channel], m.sequence, m.log_time_ns, m.publish_time_ns, data).ok());
  }
  EXPECT_TRUE(writer.value().Close().ok());
}

}  // namespace rodeira::cli
