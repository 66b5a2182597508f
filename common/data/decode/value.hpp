// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <variant>

#include "common/core/base/bytes.hpp"

namespace rodeira::decode {

// One value of a message: signed and unsigned integers of all sizes (enumerations and characters are unsigned ones),
// single and double precision, truth, text, and a run of octets.
using Value = std::variant<std::int64_t, std::uint64_t, float, double, bool, std::string, base::Bytes>;

// Full precision: numbers in the shortest decimal form that reads back to the same bits ("nan", "inf", "-inf" where
// they are none), "true" or "false", texts as they are, octets as hexadecimal digits.
std::string Text(const Value& value);
// The same with the bits of a number behind it, where its text does not tell all: nan.
std::string TextWithBits(const Value& value);

// The same kind and the same bits: 0.0 and -0.0 differ, a NaN equals itself.
bool SameBits(const Value& a, const Value& b);

}  // namespace rodeira::decode
