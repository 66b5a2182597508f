// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>

#include "common/core/base/bytes.hpp"
#include "common/data/decode/type.hpp"

namespace rodeira::decode {

// Where two messages of one type differ, and the values there.
struct Difference {
  std::string path;  // "wheels[2].load_n"; "agents" where the lengths differ; "byte 44" where no value differs
  std::string a;     // the values in full precision, "3 elements", or why there is none
  std::string b;
};

// The first value, in the order of the bytes, in which two payloads of one type differ; none where all bytes are equal.
// Every difference is found: where values agree to the bit and bytes do not (padding, what follows the last value), or
// where a payload is no message of that type, the path is the first differing byte or the place of the fault.
std::optional<Difference> FirstDifference(const Type& type, std::span<const std::byte> a, std::span<const std::byte> b);

}  // namespace rodeira::decode
