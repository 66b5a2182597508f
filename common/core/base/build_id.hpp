// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/core/base/hash.hpp"

namespace rodeira::base {

// Of the code of the running program: two programs with equal digests were linked from the same bytes. It is the
// linker's build id or, where the program has none, the hash of its file. Random where neither can be read.
Digest BuildDigest();

}  // namespace rodeira::base
