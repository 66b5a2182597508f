// SPDX-License-Identifier: Apache-2.0
#include "idl/codec.hpp"

#include <fastcdr/Cdr.h>
#include <fastcdr/FastBuffer.h>
#include <fmt/format.h>

#include <exception>

#include "common/core/base/assert.hpp"
#include "common/core/base/recycled_bytes.hpp"

namespace rodeira::idl::detail {

using eprosima::fastcdr::Cdr;
using eprosima::fastcdr::FastBuffer;

base::Bytes EncodeWith(std::size_t size, const void* message, void (*serialise)(const void*, Cdr&)) {
  base::Bytes bytes = base::TakeBytes(size + 8);
  bytes.assign(size + 8, std::byte{0});
  FastBuffer buffer(reinterpret_cast<char*>(bytes.data()), bytes.size());
  Cdr cdr(buffer, Cdr::LITTLE_ENDIANNESS, Cdr::DDS_CDR);
  cdr.serialize_encapsulation();
  serialise(message, cdr);
  bytes.resize(cdr.getSerializedDataLength());
  RODEIRA_ASSERT(bytes.size() % 4 == 0);  // our types end on four bytes
  return bytes;
}

base::Status DecodeWith(std::span<const std::byte> payload, void* message, void (*deserialise)(void*, Cdr&)) {
  if (payload.size() < 4 || payload[0] != std::byte{0} || payload[1] != std::byte{1}) {
    return base::WrongInput("message.damaged",
                            fmt::format("{} bytes were found that are no little-endian CDR", payload.size()));
  }
  FastBuffer buffer(reinterpret_cast<char*>(const_cast<std::byte*>(payload.data())), payload.size());
  Cdr cdr(buffer, Cdr::LITTLE_ENDIANNESS, Cdr::DDS_CDR);
  try {
    cdr.read_encapsulation();
    deserialise(message, cdr);
  } catch (const std::exception& problem) {
    return base::WrongInput("message.damaged",
                            fmt::format("the message of {} bytes cannot be read: {}", payload.size(), problem.what()));
  }
  return {};
}

}  // namespace rodeira::idl::detail
