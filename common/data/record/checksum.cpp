// SPDX-License-Identifier: Apache-2.0
#include "common/data/record/checksum.hpp"

#include <zlib.h>

namespace rodeira::record {

std::uint32_t Crc32(std::span<const std::byte> bytes, std::uint32_t so_far) {
  return static_cast<std::uint32_t>(
      ::crc32_z(so_far, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()));
}

}  // namespace rodeira::record
