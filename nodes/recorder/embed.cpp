// SPDX-License-Identifier: Apache-2.0
#include "nodes/recorder/embed.hpp"

#include <span>

#include "common/data/record/compress.hpp"
#include "common/runtime/launch/agreement.hpp"
#include "common/runtime/launch/files_of.hpp"

namespace rodeira::nodes {
namespace {

constexpr std::size_t kCompressFrom = 4096;  // bytes
constexpr int kLevel = 9;

}  // namespace

base::Status EmbedFiles(const launch::Launch& launch, record::McapWriter& writer) {
  const auto text = std::as_bytes(std::span(launch.text()));
  if (auto status = writer.AddAttachment("launch.yaml", "application/yaml", text, 0, 0); !status) return status;
  for (const auto& [key, value] : launch.overrides()) {
    if (!launch::IsOfTheRun(launch, key)) continue;
    const std::string line = key + "=" + value;
    if (auto status = writer.AddAttachment("override", "text/plain", std::as_bytes(std::span(line)), 0, 0); !status)
      return status;
  }
  const auto files = launch::FilesOf(launch);
  if (!files) return files.error();
  record::ZstdCompressor compressor(kLevel);
  for (std::size_t i = 1; i < files.value().size(); ++i) {  // the first is the launch file
    const launch::NamedFile& file = files.value()[i];
    if (file.bytes.size() < kCompressFrom) {
      if (auto status = writer.AddAttachment("files/" + file.name, "application/octet-stream", file.bytes, 0, 0);
          !status)
        return status;
      continue;
    }
    base::ByteWriter packed;
    packed.Put(static_cast<std::uint64_t>(file.bytes.size()));
    compressor.Append(file.bytes, packed.bytes());
    if (auto status = writer.AddAttachment("files/" + file.name, "application/x-rodeira-zstd", packed.bytes(), 0, 0);
        !status)
      return status;
  }
  return {};
}

}  // namespace rodeira::nodes
