// SPDX-License-Identifier: Apache-2.0
#include "common/data/decode/type_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "common/core/base/assert.hpp"

namespace rodeira::decode {
namespace {

constexpr std::string_view kIdlNames[] = {"boolean",
                                          "char",
                                          "octet",
                                          "int8",
                                          "uint8",
                                          "short",
                                          "unsigned short",
                                          "long",
                                          "unsigned long",
                                          "long long",
                                          "unsigned long long",
                                          "float",
                                          "double"};

bool IsNamed(const Type& type) { return type.kind == Kind::kStruct || type.kind == Kind::kEnum; }

// Without the lengths of an array, which stand behind the member's name.
std::string TypeName(const Type& type) {
  switch (type.kind) {
    case Kind::kStruct:
    case Kind::kEnum:
      return type.name;
    case Kind::kString:
      return type.bound == 0 ? "string" : fmt::format("string<{}>", type.bound);
    case Kind::kSequence:
      return type.bound == 0 ? fmt::format("sequence<{}>", Declaration(*type.element, ""))
                             : fmt::format("sequence<{}, {}>", Declaration(*type.element, ""), type.bound);
    case Kind::kArray:
      return TypeName(*type.element);
    default:
      return std::string(kIdlNames[static_cast<std::size_t>(type.kind)]);
  }
}

std::string_view Mark(const Type& type) {
  return type.extensibility == Extensibility::kAppendable ? "@appendable" : "@final";
}

class Writer {
 public:
  void Add(const Type& type) {
    if (type.element) Add(*type.element);
    if (!IsNamed(type) || !written_.insert(type.name).second) return;
    for (const Member& member : type.members) Add(*member.type);
    Define(type);
  }
  std::string text;

 private:
  void Define(const Type& type) {
    std::string_view name = type.name;
    std::string closing;
    for (std::size_t end = name.find("::"); end != std::string_view::npos; end = name.find("::")) {
      text += fmt::format("module {} {{ ", name.substr(0, end));
      closing += " };";
      name.remove_prefix(end + 2);
    }
    text += fmt::format("{} {} {} {{", Mark(type), type.kind == Kind::kStruct ? "struct" : "enum", name);
    for (const Member& member : type.members) text += " " + Declaration(*member.type, member.name) + ";";
    for (std::size_t i = 0; i < type.enumerators.size(); ++i)
      text += fmt::format("{} {}", i == 0 ? "" : ",", type.enumerators[i]);
    text += " };" + closing + "\n";
  }

  std::set<std::string> written_;
};

class Comparer {
 public:
  // The types of members with the same declaration; empty if they are the same.
  std::string Compare(const Type& found, const Type& expected) {
    if (found.element && expected.element) return Compare(*found.element, *expected.element);
    if (!IsNamed(found) || !compared_.insert(expected.name).second) return "";
    return found.kind == Kind::kStruct ? CompareStructs(found, expected) : CompareEnums(found, expected);
  }

 private:
  static std::string Difference(const Type& in, const std::string& place, std::string_view found,
                                std::string_view expected) {
    return fmt::format("{}{}: found {}, expected {}", in.name, place, found, expected);
  }
  std::string CompareStructs(const Type& found, const Type& expected) {
    if (Mark(found) != Mark(expected)) return Difference(expected, "", Mark(found), Mark(expected));
    const std::size_t members = std::max(found.members.size(), expected.members.size());
    for (std::size_t i = 0; i < members; ++i) {
      const std::string f = MemberText(found, i);
      const std::string e = MemberText(expected, i);
      if (f != e) return Difference(expected, fmt::format(", member {}", i + 1), f, e);
      std::string inner = Compare(*found.members[i].type, *expected.members[i].type);
      if (!inner.empty()) return inner;
    }
    return "";
  }
  std::string CompareEnums(const Type& found, const Type& expected) {
    if (Mark(found) != Mark(expected)) return Difference(expected, "", Mark(found), Mark(expected));
    const std::size_t count = std::max(found.enumerators.size(), expected.enumerators.size());
    for (std::size_t i = 0; i < count; ++i) {
      const auto text = [i](const Type& type) {
        return i < type.enumerators.size() ? "'" + type.enumerators[i] + "'" : "nothing";
      };
      if (text(found) != text(expected))
        return Difference(expected, fmt::format(", enumerator {}", i + 1), text(found), text(expected));
    }
    return "";
  }
  static std::string MemberText(const Type& type, std::size_t i) {
    if (i >= type.members.size()) return "nothing";
    return "'" + Declaration(*type.members[i].type, type.members[i].name) + "'";
  }

  std::set<std::string> compared_;
};

}  // namespace

std::string Declaration(const Type& type, std::string_view name) {
  std::string text = TypeName(type);
  if (!name.empty()) text += fmt::format(" {}", name);
  for (const Type* inner = &type; inner->kind == Kind::kArray; inner = inner->element.get())
    text += fmt::format("[{}]", inner->length);
  return text;
}

std::string CanonicalIdl(const Type& type) {
  Writer writer;
  writer.Add(type);
  return std::move(writer.text);
}

base::Digest TypeHash(const Type& type) { return base::Hash(CanonicalIdl(type)); }

std::optional<std::string> FirstTypeDifference(const Type& found, const Type& expected) {
  if (Declaration(found, "") != Declaration(expected, ""))
    return fmt::format("found '{}', expected '{}'", Declaration(found, ""), Declaration(expected, ""));
  std::string difference = Comparer().Compare(found, expected);
  if (!difference.empty()) return difference;
  return std::nullopt;
}

}  // namespace rodeira::decode
