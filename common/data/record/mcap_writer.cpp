// SPDX-License-Identifier: Apache-2.0
#include "common/data/record/mcap_writer.hpp"
#include "common/core/base/utf8.hpp"

#include <fmt/format.h>

#include <utility>

#include "common/data/record/writer_work.hpp"

namespace rodeira::record {
namespace {

using base::Status;

constexpr std::uint64_t kMaxSpanNs = 1'000'000'000;
constexpr std::uint64_t kMinChunkBytes = 4u << 10;
constexpr std::uint64_t kMaxChunkBytes = 64u << 20;
constexpr std::uint64_t kMaxHeaderBytes = 64u << 10;

Status CheckSettings(const WriterSettings& settings, const std::string& where) {
  if (settings.chunk_span_ns == 0 || settings.chunk_span_ns > kMaxSpanNs) {
    return base::WrongInput(
        "recording.wrong_settings",
        fmt::format("chunk_span_ns is {}, 1 to {} (one second) was expected", settings.chunk_span_ns, kMaxSpanNs),
        where);
  }
  if (settings.chunk_bytes < kMinChunkBytes || settings.chunk_bytes > kMaxChunkBytes) {
    return base::WrongInput(
        "recording.wrong_settings",
        fmt::format("chunk_bytes is {}, {} to {} was expected", settings.chunk_bytes, kMinChunkBytes, kMaxChunkBytes),
        where);
  }
  if (settings.zstd_level < -7 || settings.zstd_level > 19) {
    return base::WrongInput("recording.wrong_settings",
                            fmt::format("zstd_level is {}, -7 (fastest) to 19 was expected", settings.zstd_level),
                            where);
  }
  if (settings.profile.size() + settings.library.size() > kMaxHeaderBytes) {
    return base::WrongInput("recording.wrong_settings", "profile and library are too long", where);
  }
  return {};
}

TextMap InUtf8(const TextMap& entries) {
  TextMap texts;
  for (const auto& [key, value] : entries) texts.emplace(base::ToUtf8(key), base::ToUtf8(value));
  return texts;
}

}  // namespace

McapWriter::McapWriter(std::unique_ptr<Work> work) : work_(std::move(work)) {}
McapWriter::McapWriter(McapWriter&&) noexcept = default;
McapWriter& McapWriter::operator=(McapWriter&& other) noexcept {
  if (this != &other) {
    if (work_ && !work_->closed()) static_cast<void>(work_->Finish().ok());
    work_ = std::move(other.work_);
  }
  return *this;
}
McapWriter::~McapWriter() {
  if (work_ && !work_->closed()) static_cast<void>(work_->Finish().ok());
}

base::Result<McapWriter> McapWriter::Open(const std::filesystem::path& path, const WriterSettings& settings) {
  if (auto status = CheckSettings(settings, path.string()); !status) return status.error();
  std::error_code problem;
  const bool is_new = !std::filesystem::exists(path, problem);
  auto sink = OpenFileSink(path, settings.overwrite);
  if (!sink) return sink.error();
  auto writer = Open(std::move(sink).value(), settings);
  if (!writer && is_new) std::filesystem::remove(path, problem);  // nothing but its beginning
  return writer;
}

base::Result<McapWriter> McapWriter::Open(std::unique_ptr<Sink> sink, const WriterSettings& settings) {
  if (auto status = CheckSettings(settings, sink->name()); !status) return status.error();
  auto work = std::make_unique<Work>(std::move(sink), settings);
  if (auto status = work->Begin(); !status) return status.error();
  return McapWriter(std::move(work));
}

base::Result<SchemaId> McapWriter::AddSchema(std::string_view name, std::string_view encoding, std::string_view text) {
  RODEIRA_ASSERT(!work_->closed());
  return work_->AddSchema(base::ToUtf8(name), base::ToUtf8(encoding), text);
}

base::Result<ChannelId> McapWriter::AddChannel(std::string_view topic, SchemaId schema,
                                               std::string_view message_encoding, const TextMap& metadata) {
  RODEIRA_ASSERT(!work_->closed());
  return work_->AddChannel(base::ToUtf8(topic), schema, base::ToUtf8(message_encoding), InUtf8(metadata));
}

Status McapWriter::Write(ChannelId channel, std::uint32_t sequence, std::uint64_t log_time_ns,
                         std::uint64_t publish_time_ns, std::span<const std::byte> data) {
  RODEIRA_ASSERT(!work_->closed());
  return work_->Write(Message{channel, sequence, log_time_ns, publish_time_ns, data});
}

Status McapWriter::AddMetadata(std::string_view name, const TextMap& entries) {
  RODEIRA_ASSERT(!work_->closed());
  return work_->AddMetadata(base::ToUtf8(name), InUtf8(entries));
}

Status McapWriter::AddAttachment(std::string_view name, std::string_view media_type, std::span<const std::byte> data,
                                 std::uint64_t log_time_ns, std::uint64_t create_time_ns) {
  RODEIRA_ASSERT(!work_->closed());
  AttachmentInfo info;
  info.name = base::ToUtf8(name);
  info.media_type = base::ToUtf8(media_type);
  info.log_time_ns = log_time_ns;
  info.create_time_ns = create_time_ns;
  return work_->AddAttachment(std::move(info), data);
}

Status McapWriter::Flush() {
  RODEIRA_ASSERT(!work_->closed());
  return work_->CloseChunk();
}

Status McapWriter::Sync() {
  RODEIRA_ASSERT(!work_->closed());
  return work_->Sync();
}

Status McapWriter::Close() {
  if (work_->closed()) return work_->failure() ? Status(*work_->failure()) : Status();
  return work_->Finish();
}

const Statistics& McapWriter::statistics() const { return work_->statistics(); }
std::uint64_t McapWriter::written_bytes() const { return work_->written_bytes(); }

}  // namespace rodeira::record
