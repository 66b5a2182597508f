// SPDX-License-Identifier: Apache-2.0
#pragma once

/// @file
/// Digests of bytes.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace rodeira::base {

/// A 64-bit digest of bytes: XXH3-64 with seed 0, the same on every machine (https://xxhash.com).
using Digest = std::uint64_t;

/// Computes the digest of bytes.
/// @param bytes bytes to hash; may be empty
/// @return digest
Digest Hash(std::span<const std::byte> bytes);
/// Computes the digest of a text's bytes.
/// @param text text to hash; may be empty
/// @return digest
Digest Hash(std::string_view text);
/// Computes the digest of a pair, for chains. It is neither commutative nor associative.
/// @param first first digest of the pair
/// @param second second digest of the pair
/// @return digest of both
Digest Combine(Digest first, Digest second);
/// Writes a digest as text.
/// @param digest digest to write
/// @return 16 lower-case hexadecimal digits
std::string Hex(Digest digest);

}  // namespace rodeira::base
