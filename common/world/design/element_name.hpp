// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "common/core/config/config.hpp"

namespace rodeira::design {

// What an item of an axis is: `line`, `arc` or `clothoid`, and the key that says so. A name that is none of them is a
// problem; it is read as the one that was meant, so that nothing else is found wrong because of it. Where none can
// tell which was meant the kind is empty, and what the key says is passed over.
struct ElementName {
  std::string kind, key;
};
// Problems stay in the file's collection.
ElementName ReadElementName(const config::Map& item);

}  // namespace rodeira::design
