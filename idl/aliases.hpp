// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/data/decode/aliases.hpp"

namespace rodeira::idl {

// The names that recordings of earlier versions use for today's topics, types and members. A change of the IDL that
// keeps the encoding and changes a name adds a row (docs/reference/wire.md).
const decode::Aliases& Aliases();

}  // namespace rodeira::idl
