// SPDX-License-Identifier: Apache-2.0
#pragma once

/// @file
/// Messages as bytes, and back.

#include <span>
#include <string>

#include "common/core/base/bytes.hpp"
#include "common/core/base/result.hpp"

/// @cond
namespace eprosima::fastcdr {
class Cdr;
}
/// @endcond

/// Topics and messages of Rodeira.
namespace rodeira::idl {

/// @cond
namespace detail {
// Serialises into a zeroed buffer: the library skips alignment padding without writing it.
base::Bytes EncodeWith(std::size_t size, const void* message, void (*serialise)(const void*, eprosima::fastcdr::Cdr&));
base::Status DecodeWith(std::span<const std::byte> payload, void* message,
                        void (*deserialise)(void*, eprosima::fastcdr::Cdr&));
}  // namespace detail
/// @endcond

/// Serialises a message: little-endian CDR (XCDR version 1) with its four encapsulation bytes.
/// @tparam Message type that fastddsgen made of an IDL file; it must end on four bytes, so that the length is a
/// multiple
///   of four (asserted)
/// @param message the message
/// @return the payload, for lockstep::Outbox::Put
template <class Message>
base::Bytes Encode(const Message& message) {
  return detail::EncodeWith(
      Message::getCdrSerializedSize(message), &message,
      [](const void* m, eprosima::fastcdr::Cdr& cdr) { static_cast<const Message*>(m)->serialize(cdr); });
}

/// Deserialises a message.
/// @tparam Message type that fastddsgen made of an IDL file
/// @param payload bytes of a message (lockstep::Sample::payload)
/// @return the message; wrong input if the bytes are no little-endian CDR or end within the message
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
