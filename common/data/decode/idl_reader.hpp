// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "common/core/base/result.hpp"
#include "common/data/decode/type.hpp"

namespace rodeira::decode {

// What an IDL text defines. It reads the plain IDL that docs/reference/recordings.md lists for recordings; what would
// change the encoding or is not read (unions, maps, inheritance, forward declarations, @optional, @mutable,
// preprocessor lines …) is refused. Wrong input says "PLACE:LINE: …".
class IdlTypes {
 public:
  // `place`: of the text, for messages.
  static base::Result<IdlTypes> Read(std::string_view text, std::string_view place);

  // By its full name, "module::Type". Wrong input, with the nearest right name, where there is none.
  base::Result<TypePtr> Find(const std::string& name) const;
  const std::map<std::string, TypePtr>& types() const { return types_; }  // by full name

 private:
  friend class IdlParser;
  std::string place_;
  std::map<std::string, TypePtr> types_;
};

// The type of a recording's schema: its name and its IDL text.
base::Result<TypePtr> ReadType(std::string_view idl, const std::string& name);

}  // namespace rodeira::decode
