// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "common/core/base/hash.hpp"
#include "common/data/decode/type.hpp"

namespace rodeira::decode {

// "sequence<m::Wheel, 4> wheels", "long cells[2][3]": a member as IDL declares it.
std::string Declaration(const Type& type, std::string_view name);

// The type and all types that it uses as one IDL text without comments: the same for two types with the same
// names, members, order and extensibility, whatever their source looked like. An unmarked type is written as final.
std::string CanonicalIdl(const Type& type);

// XXH3-64 of the canonical text.
base::Digest TypeHash(const Type& type);

// The first place, in the order of the members, where two types differ: "m::Car, member 3: found 'double speed',
// expected 'float speed_mps'". None if their canonical texts are equal.
std::optional<std::string> FirstTypeDifference(const Type& found, const Type& expected);

}  // namespace rodeira::decode
