// SPDX-License-Identifier: Apache-2.0
#include "common/core/base/hash.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <array>
#include <cstring>

namespace rodeira::base {

Digest Hash(std::span<const std::byte> bytes) { return XXH3_64bits(bytes.data(), bytes.size()); }

Digest Hash(std::string_view text) { return XXH3_64bits(text.data(), text.size()); }

Digest Combine(Digest first, Digest second) {
  const std::array<Digest, 2> pair{first, second};
  return Hash(std::as_bytes(std::span(pair)));
}

std::string Hex(Digest digest) { return fmt::format("{:016x}", digest); }

}  // namespace rodeira::base
