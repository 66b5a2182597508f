// SPDX-License-Identifier: Apache-2.0
#include "common/core/base/bytes.hpp"

namespace rodeira::base {

bool ByteReader::Require(std::size_t size) {
  if (!ok_ || size > remaining()) {
    ok_ = false;
    at_ = bytes_.size();
    return false;
  }
  return true;
}

std::span<const std::byte> ByteReader::GetRaw(std::size_t size) {
  if (!Require(size)) return {};
  const auto raw = bytes_.subspan(at_, size);
  at_ += size;
  return raw;
}

std::string ByteReader::GetString() {
  const auto size = Get<std::uint32_t>();
  const auto raw = GetRaw(size);
  return {reinterpret_cast<const char*>(raw.data()), raw.size()};
}

}  // namespace rodeira::base
