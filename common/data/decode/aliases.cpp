// SPDX-License-Identifier: Apache-2.0
#include "common/data/decode/aliases.hpp"

#include <vector>

namespace rodeira::decode {
namespace {

class Renamer {
 public:
  explicit Renamer(const Aliases& aliases) : aliases_(aliases) {}

  TypePtr Rename(const TypePtr& type) {
    const auto known = renamed_.find(type.get());
    if (known != renamed_.end()) return known->second;
    return renamed_[type.get()] = Make(type);
  }

 private:
  TypePtr Make(const TypePtr& type) {
    switch (type->kind) {
      case Kind::kSequence:
        return MakeSequence(Rename(type->element), type->bound);
      case Kind::kArray:
        return MakeArray(Rename(type->element), type->length);
      case Kind::kEnum:
        return MakeEnum(NameOf(*type), type->enumerators, type->extensibility);
      case Kind::kStruct:
        return Struct(*type);
      default:
        return type;
    }
  }
  TypePtr Struct(const Type& type) {
    const std::string name = NameOf(type);
    std::vector<Member> members;
    for (const Member& member : type.members) {
      const auto found = aliases_.members.find({name, member.name});
      members.push_back({found == aliases_.members.end() ? member.name : found->second, Rename(member.type)});
    }
    return MakeStruct(name, std::move(members), type.extensibility);
  }
  std::string NameOf(const Type& type) const {
    const auto found = aliases_.types.find(type.name);
    return found == aliases_.types.end() ? type.name : found->second;
  }

  const Aliases& aliases_;
  std::map<const Type*, TypePtr> renamed_;  // a type that is used often is renamed once
};

}  // namespace

std::string_view Aliases::Topic(std::string_view name) const {
  const auto found = topics.find(name);
  return found == topics.end() ? name : std::string_view(found->second);
}

TypePtr Aliases::Renamed(const TypePtr& type) const { return Renamer(*this).Rename(type); }

}  // namespace rodeira::decode
