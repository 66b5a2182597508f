// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace rodeira::record {

// CRC-32 as in MCAP, zip and Ethernet (ISO-HDLC: polynomial 0x04C11DB7 reflected). `so_far` is the checksum of what
// came before, so that a long text may be given in pieces.
std::uint32_t Crc32(std::span<const std::byte> bytes, std::uint32_t so_far = 0);

}  // namespace rodeira::record
