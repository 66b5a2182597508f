// SPDX-License-Identifier: Apache-2.0
#include "common/data/decode/type.hpp"

#include <algorithm>
#include <utility>

#include "common/core/base/assert.hpp"

namespace rodeira::decode {
namespace {

TypePtr Finish(Type type) { return std::make_shared<const Type>(std::move(type)); }

}  // namespace

bool IsPlain(Kind kind) { return kind <= Kind::kEnum; }

std::uint64_t PlainBytes(Kind kind) {
  switch (kind) {
    case Kind::kBool:
    case Kind::kChar:
    case Kind::kOctet:
    case Kind::kInt8:
    case Kind::kUint8:
      return 1;
    case Kind::kInt16:
    case Kind::kUint16:
      return 2;
    case Kind::kInt32:
    case Kind::kUint32:
    case Kind::kFloat:
    case Kind::kEnum:
      return 4;
    case Kind::kInt64:
    case Kind::kUint64:
    case Kind::kDouble:
      return 8;
    default:
      break;
  }
  RODEIRA_ASSERT(false);
  return 0;
}

TypePtr MakePlain(Kind kind) {
  Type type;
  type.kind = kind;
  type.least_bytes = PlainBytes(kind);
  return Finish(std::move(type));
}

TypePtr MakeString(std::uint64_t bound) {
  Type type;
  type.kind = Kind::kString;
  type.bound = bound;
  type.least_bytes = 4;
  return Finish(std::move(type));
}

TypePtr MakeSequence(TypePtr element, std::uint64_t bound) {
  Type type;
  type.kind = Kind::kSequence;
  type.bound = bound;
  type.least_bytes = 4;
  type.depth = element->depth + 1;
  type.element = std::move(element);
  return Finish(std::move(type));
}

TypePtr MakeArray(TypePtr element, std::uint64_t length) {
  RODEIRA_ASSERT(length > 0);
  Type type;
  type.kind = Kind::kArray;
  type.length = length;
  type.least_bytes = length > kHuge / element->least_bytes ? kHuge : length * element->least_bytes;
  type.depth = element->depth + 1;
  type.element = std::move(element);
  return Finish(std::move(type));
}

TypePtr MakeEnum(std::string name, std::vector<std::string> enumerators, Extensibility extensibility) {
  Type type;
  type.extensibility = extensibility;
  type.kind = Kind::kEnum;
  type.name = std::move(name);
  type.enumerators = std::move(enumerators);
  type.least_bytes = 4;
  return Finish(std::move(type));
}

TypePtr MakeStruct(std::string name, std::vector<Member> members, Extensibility extensibility) {
  RODEIRA_ASSERT(!members.empty());
  Type type;
  type.extensibility = extensibility;
  type.kind = Kind::kStruct;
  type.name = std::move(name);
  type.least_bytes = 0;
  for (const Member& member : members) {
    type.least_bytes = std::min(kHuge, type.least_bytes + member.type->least_bytes);
    type.depth = std::max(type.depth, member.type->depth + 1);
  }
  type.members = std::move(members);
  return Finish(std::move(type));
}

const Type* FindMember(const Type& type, std::string_view name) {
  for (const Member& member : type.members) {
    if (member.name == name) return member.type.get();
  }
  return nullptr;
}

}  // namespace rodeira::decode
