// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <span>
#include <string>

#include "common/core/base/bytes.hpp"
#include "common/core/base/result.hpp"

namespace rodeira::record {

// Where a recording's bytes go. Tests put a disk of their own in this place.
class Sink {
 public:
  virtual ~Sink() = default;
  // Hands all of the bytes to the operating system, or says with path and reason why not.
  virtual base::Status Append(std::span<const std::byte> bytes) = 0;
  // Waits until what was appended lies on the disk.
  virtual base::Status Sync() = 0;
  // Begins to bring what was appended to the disk, without waiting for it. Where that fails, the next Append says so.
  virtual void SyncSoon() {}
  // After a failed Append: drops what lies behind the first `size` bytes, as well as that can be done.
  virtual void CutTo(std::uint64_t size) = 0;
  // What was appended is on the disk, and no more can be appended.
  virtual base::Status Close() = 0;
  // For error sentences.
  virtual std::string name() const = 0;
};

// A file. It is locked while it is open: a second writer of the same path is refused. An existing regular file is
// refused unless `overwrite`. A program that wants an Error and not a signal from a limit on the size of files ignores
// SIGXFSZ.
base::Result<std::unique_ptr<Sink>> OpenFileSink(const std::filesystem::path& path, bool overwrite);
// An existing file, to go on behind its first `size` bytes; the rest is dropped. Locked too.
base::Result<std::unique_ptr<Sink>> OpenFileSinkBehind(const std::filesystem::path& path, std::uint64_t size);

// True while a sink of some process has this file open.
bool IsBeingWritten(const std::filesystem::path& path);

// Memory that can be made to fail: Append fails, after writing what fits, beyond `capacity` bytes.
class MemorySink final : public Sink {
 public:
  // `into` outlives the sink.
  explicit MemorySink(base::Bytes* into, std::uint64_t capacity = std::numeric_limits<std::uint64_t>::max())
      : into_(into), capacity_(capacity) {}
  base::Status Append(std::span<const std::byte> bytes) override;
  base::Status Sync() override { return {}; }
  void CutTo(std::uint64_t size) override;
  base::Status Close() override { return {}; }
  std::string name() const override { return "memory"; }

 private:
  base::Bytes* into_;
  std::uint64_t capacity_;
};

}  // namespace rodeira::record
