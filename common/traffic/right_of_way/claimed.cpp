// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/right_of_way/claimed.hpp"

#include "common/core/base/huge_pages.hpp"

namespace rodeira::traffic {

Claimed::Claimed(std::size_t vehicles, std::size_t zones)
    : passages(vehicles), known(vehicles), reaches(vehicles), leaves(vehicles), book(zones), is_asked(2 * zones) {
  base::PreferHugePages(passages);
}

void Claimed::Forget() {
  for (ConflictPassage& passage : passages) passage = {};
  for (auto& places : known) places = {};
}

}  // namespace rodeira::traffic
