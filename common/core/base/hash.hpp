// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace rodeira::base {

// A 64-bit digest of bytes: XXH3-64 with seed 0, the same on every machine (https://xxhash.com).
using Digest = std::uint64_t;

Digest Hash(std::span<const std::byte> bytes);
Digest Hash(std::string_view text);
// The digest of the pair, for chains: neither commutative nor associative.
Digest Combine(Digest first, Digest second);
// 16 lower-case hexadecimal digits.
std::string Hex(Digest digest);

}  // namespace rodeira::base
