// SPDX-License-Identifier: Apache-2.0
#include "common/world/network/furniture.hpp"

#include <string_view>

namespace rodeira::network {

bool IsFlat(const Object& object) {
  const std::string_view type = object.type;
  return type == "crosswalk" || type == "parkingSpace" || type == "roadMark" || type == "patch" ||
         (type == "roadSurface" && object.subtype != "speedBump");
}

bool IsPatch(const Object& object) {
  return object.type == "patch" || (object.type == "roadSurface" && object.subtype == "patch");
}

}  // namespace rodeira::network
