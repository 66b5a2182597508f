// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace rodeira::base {

// Asks the system to keep a large piece of memory in large pages (2 MB), so that random places in it are found with
// fewer look-ups. Changes nothing but time; where the system has none, or the piece is small, nothing at all.
void PreferHugePages(const void* begin, std::size_t bytes);

// Of all that a vector holds now.
template <class Vector>
void PreferHugePages(const Vector& all) {
  PreferHugePages(all.data(), all.size() * sizeof(*all.data()));
}

}  // namespace rodeira::base
