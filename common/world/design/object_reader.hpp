// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "common/core/config/declared.hpp"
#include "common/world/network/furniture.hpp"

namespace rodeira::design {

// The most objects in a row, as of a row of trees.
inline constexpr double kMaxInRow = 1e5;

// The types of objects.
std::vector<std::string> ObjectTypes();

// What stands somewhere, by the keys that do not say where.
struct ObjectReading {
  network::Object object;
  bool continuous = false;  // a guard rail, a wall: it goes on from one place to another
};

// 'type', 'name', 'model', 'length_m', 'width_m', 'height_m', 'radius_m' and 'z_m' of an object, with the usual sizes
// of its type.
ObjectReading ReadObjectItself(const config::DeclaredMap& item, std::string id);

}  // namespace rodeira::design
