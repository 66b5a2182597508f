// SPDX-License-Identifier: Apache-2.0
#pragma once

/// @file
/// Numbers and texts as bytes, and back.

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace rodeira::base {

/// Bytes of a sample, a snapshot or a file.
using Bytes = std::vector<std::byte>;

static_assert(sizeof(double) == 8 && sizeof(float) == 4);

/// Appends numbers little-endian without padding. All machines that Rodeira runs on are little-endian.
class ByteWriter {
 public:
  /// Appends one number.
  /// @tparam T arithmetic or enumeration type
  /// @param value number to append; it takes sizeof(T) bytes
  template <class T>
  requires(std::is_arithmetic_v<T> || std::is_enum_v<T>) void Put(T value) {
    const std::size_t at = bytes_.size();
    bytes_.resize(at + sizeof(T));
    std::memcpy(bytes_.data() + at, &value, sizeof(T));
  }
  /// Appends a text: its length as 32-bit unsigned number, then its bytes.
  /// @param text text to append
  void PutString(std::string_view text) {
    Put(static_cast<std::uint32_t>(text.size()));
    PutRaw(std::as_bytes(std::span(text)));
  }
  /// Appends bytes without a length.
  /// @param raw bytes to append
  void PutRaw(std::span<const std::byte> raw) { bytes_.insert(bytes_.end(), raw.begin(), raw.end()); }

  /// Gives the written bytes.
  /// @return all bytes since construction or Clear
  const Bytes& bytes() const { return bytes_; }
  /// Gives the written bytes, to be changed or moved from.
  /// @return all bytes since construction or Clear
  Bytes& bytes() { return bytes_; }
  /// Removes all bytes.
  void Clear() { bytes_.clear(); }

 private:
  Bytes bytes_;
};

/// Reads the bytes of a ByteWriter. Reading past the end gives zeros and sets ok() to false for good. It never reads
/// outside of the given bytes.
class ByteReader {
 public:
  /// Starts at the first byte.
  /// @param bytes bytes to read; they must outlive the reader
  explicit ByteReader(std::span<const std::byte> bytes) : bytes_(bytes) {}

  /// Reads one number.
  /// @tparam T arithmetic or enumeration type
  /// @return the number; zero if fewer than sizeof(T) bytes are left
  template <class T>
  requires(std::is_arithmetic_v<T> || std::is_enum_v<T>) T Get() {
    T value{};
    if (!Require(sizeof(T))) return value;
    if constexpr (std::is_same_v<T, bool>) {
      value = bytes_[at_] != std::byte{0};  // any other bit pattern in a bool would be undefined behaviour
    } else {
      std::memcpy(&value, bytes_.data() + at_, sizeof(T));
    }
    at_ += sizeof(T);
    return value;
  }
  /// Reads a text of ByteWriter::PutString.
  /// @return the text; empty if fewer bytes are left than its length says
  std::string GetString();
  /// Reads bytes without a length.
  /// @param size number of bytes to read
  /// @return the next `size` bytes, or an empty span if fewer are left
  std::span<const std::byte> GetRaw(std::size_t size);

  /// Says whether all reads were inside the bytes.
  /// @return false after the first read past the end
  bool ok() const { return ok_; }
  /// Gives the position of the next read.
  /// @return bytes from the start; the size of all bytes after a read past the end
  std::size_t position() const { return at_; }
  /// Gives the number of bytes that are left.
  /// @return bytes behind position()
  std::size_t remaining() const { return bytes_.size() - at_; }

 private:
  bool Require(std::size_t size);

  std::span<const std::byte> bytes_;
  std::size_t at_ = 0;
  bool ok_ = true;
};

}  // namespace rodeira::base
