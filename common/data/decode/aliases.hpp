// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "common/data/decode/type.hpp"

namespace rodeira::decode {

// Today's names of what older recordings call otherwise. A name that is not in a table is today's.
struct Aliases {
  std::map<std::string, std::string, std::less<>> topics;
  std::map<std::string, std::string, std::less<>> types;               // "module::Type"
  std::map<std::pair<std::string, std::string>, std::string> members;  // (today's name of the type, old name)

  // Today's name of a topic. It may refer to `name`, or to this table.
  std::string_view Topic(std::string_view name) const;
  // The type with today's names, also in all types that it uses. The encoding is the same.
  TypePtr Renamed(const TypePtr& type) const;
};

}  // namespace rodeira::decode
