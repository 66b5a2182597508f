// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>

#include "common/core/base/bytes.hpp"
#include "common/core/base/result.hpp"

namespace rodeira::record {

// The bytes of a recording. Its size is that at the time of opening; a file may grow meanwhile.
class Source {
 public:
  virtual ~Source() = default;
  std::uint64_t size() const { return size_; }
  const std::string& name() const { return name_; }
  // The `size` bytes from `offset`; the caller has checked that they lie within the file.
  base::Result<base::Bytes> Read(std::uint64_t offset, std::uint64_t size) const;

 protected:
  Source(std::string name, std::uint64_t size) : name_(std::move(name)), size_(size) {}
  // Reads all of `into` from `offset` on. Failed where it cannot.
  virtual base::Status Fill(std::uint64_t offset, std::span<std::byte> into) const = 0;

 private:
  std::string name_;
  std::uint64_t size_;
};

// Wrong input where the path is no regular file that can be opened.
base::Result<std::unique_ptr<Source>> OpenFileSource(const std::filesystem::path& path);
std::unique_ptr<Source> MemorySource(base::Bytes bytes);

}  // namespace rodeira::record
