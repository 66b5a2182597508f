// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "common/core/base/bytes.hpp"
#include "common/core/base/result.hpp"
#include "common/data/decode/type.hpp"
#include "common/data/decode/value.hpp"

namespace rodeira::decode {

// Where in a message a value stands: members by name, elements by index.
struct PathStep {
  const std::string* member = nullptr;  // null: an element
  std::uint64_t index = 0;
};
using Path = std::vector<PathStep>;
std::string Text(const Path& path);  // "wheels[2].hub_b_m.x"

// Is called with the values of a message, by Walk.
class Visitor {
 public:
  virtual ~Visitor() = default;
  // In the order of the bytes. A sequence or array of octets is one value.
  virtual void OnValue(const Path& path, Value value) = 0;
  // Before and behind the elements of any other sequence, also where there are none.
  virtual void OnSequence(const Path&, std::uint64_t /*length*/) {}
  // Behind the last element.
  virtual void OnSequenceEnd(const Path&) {}
};

// Goes through a payload (CDR version 1 with its four encapsulation bytes, little- or big-endian) by its type.
// Wrong input, naming path and byte, where the bytes are no such message; the values before that have been visited. Up
// to three bytes behind the last value are a transport's padding and are passed over.
base::Status Walk(const Type& type, std::span<const std::byte> payload, Visitor& visitor);

// A value of a message and its path, as Text writes it.
struct Entry {
  std::string path;
  Value value;
};
// All values of a message.
base::Result<std::vector<Entry>> Flatten(const Type& type, std::span<const std::byte> payload);

}  // namespace rodeira::decode
