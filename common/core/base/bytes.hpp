// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace rodeira::base {

using Bytes = std::vector<std::byte>;

static_assert(sizeof(double) == 8 && sizeof(float) == 4);

// Appends numbers little-endian without padding (all machines that Rodeira runs on are little-endian).
class ByteWriter {
 public:
  template <class T>
  requires(std::is_arithmetic_v<T> || std::is_enum_v<T>) void Put(T value) {
    const std::size_t at = bytes_.size();
    bytes_.resize(at + sizeof(T));
    std::memcpy(bytes_.data() + at, &value, sizeof(T));
  }
  // u32 length, then the bytes.
  void PutString(std::string_view text) {
    Put(static_cast<std::uint32_t>(text.size()));
    PutRaw(std::as_bytes(std::span(text)));
  }
  void PutRaw(std::span<const std::byte> raw) { bytes_.insert(bytes_.end(), raw.begin(), raw.end()); }

  const Bytes& bytes() const { return bytes_; }
  Bytes& bytes() { return bytes_; }
  void Clear() { bytes_.clear(); }

 private:
  Bytes bytes_;
};

// Reads what ByteWriter wrote. Reading past the end gives zeros and clears ok() for good; it never reads outside.
class ByteReader {
 public:
  explicit ByteReader(std::span<const std::byte> bytes) : bytes_(bytes) {}

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
  std::string GetString();
  // The next `size` bytes, or an empty span where fewer are left.
  std::span<const std::byte> GetRaw(std::size_t size);

  bool ok() const { return ok_; }
  std::size_t position() const { return at_; }
  std::size_t remaining() const { return bytes_.size() - at_; }

 private:
  bool Require(std::size_t size);

  std::span<const std::byte> bytes_;
  std::size_t at_ = 0;
  bool ok_ = true;
};

}  // namespace rodeira::base
