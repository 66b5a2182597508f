// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include "common/core/base/bytes.hpp"
#include "common/core/base/result.hpp"

namespace eprosima::fastcdr {
class Cdr;
}

namespace rodeira::idl {

namespace detail {
// Serialises into a zeroed buffer: the library skips alignment padding without writing it.
base::Bytes EncodeWith(std::size_t size, const void* message, void (*serialise)(const void*, eprosima::fastcdr::Cdr&));
base::Status DecodeWith(std::span<const std::byte> payload, void* message,
                        void (*deserialise)(void*, eprosima::fastcdr::Cdr&));
}  // namespace detail

// Little-endian CDR (XCDR1) with its four encapsulation bytes; the length is a multiple of four.
template <class Message>
base::Bytes Encode(const Message& message) {
  return detail::EncodeWith(
      Message::getCdrSerializedSize(message), &message,
      [](const void* m, eprosima::fastcdr::Cdr& cdr) { static_cast<const Message*>(m)->serialize(cdr); });
}

// Wrong input where the bytes are no such message.
template <class Message>
base::Result<Message> Decode(std::span<const std::byte> payload) {
  Message message;
  if (auto status = detail::DecodeWith(
          payload, &message, [](void* m, eprosima::fastcdr::Cdr& cdr) { static_cast<Message*>(m)->deserialize(cdr); });
      !status) {
    return status.error();
  }
  return message;
}

}  // namespace rodeira::idl
