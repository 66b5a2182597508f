// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

namespace rodeira::scene {

// Calls `each(part_a, part_b)` for the parts of both lists with one id. Both are sorted by `id`.
template <class Part, class Each>
void ForEqualIds(const std::vector<Part>& a, const std::vector<Part>& b, Each each) {
  for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
    if (a[i].id == b[j].id)
      each(a[i++], b[j++]);
    else if (a[i].id < b[j].id)
      ++i;
    else
      ++j;
  }
}

}  // namespace rodeira::scene
