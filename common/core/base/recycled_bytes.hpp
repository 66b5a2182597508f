// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>

#include "common/core/base/bytes.hpp"

// Buffers of messages that are used again, so that a step in the steady state allocates nothing. Any thread may call
// these functions, and a buffer may be given back by another thread than the one that took it.
namespace rodeira::base {

// Buffers with more room than this are not kept.
inline constexpr std::size_t kMaxRecycled_bytes = std::size_t{1} << 16;

// No bytes, with room for `size`.
Bytes TakeBytes(std::size_t size);
// Gives a buffer back. It may come from elsewhere than TakeBytes; only its room counts.
void RecycleBytes(Bytes&& bytes);
// Shared bytes. The last owner gives the buffer back.
std::shared_ptr<const Bytes> ShareBytes(Bytes bytes);

}  // namespace rodeira::base
