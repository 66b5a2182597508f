// SPDX-License-Identifier: Apache-2.0
#include "common/world/design/element_name.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "common/core/base/suggest.hpp"

namespace rodeira::design {

ElementName ReadElementName(const config::Map& item) {
  static const std::vector<std::string> kinds = {"line", "arc", "clothoid"};
  for (const std::string& kind : kinds) {
    if (item.Has(kind)) return {kind, kind};
  }
  std::vector<std::string> keys = item.Keys();
  std::erase(keys, "from");
  const std::string found = keys.empty() ? "" : keys.front();
  item.Problem(found, "config.unknown_name",
               fmt::format("'{}' is no element of an axis{}", found, base::DidYouMean(found, kinds)));
  return {keys.empty() ? "" : base::NearestName(found, kinds), found};
}

}  // namespace rodeira::design
