// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace rodeira::decode {

// Kind of a type. Numbers are those of IDL: kChar and kOctet take one byte.
enum class Kind {
  kBool,
  kChar,
  kOctet,
  kInt8,
  kUint8,
  kInt16,
  kUint16,
  kInt32,
  kUint32,
  kInt64,
  kUint64,
  kFloat,
  kDouble,
  kEnum,  // four bytes, unsigned
  kString,
  kSequence,
  kArray,
  kStruct,
};

// Whether later versions of a type may add members (XTypes). In CDR version 1 the bytes of both are the same.
enum class Extensibility {
  kUnmarked,  // means kFinal
  kFinal,
  kAppendable,
};

struct Type;
using TypePtr = std::shared_ptr<const Type>;

// A member of a struct, in the order of the bytes.
struct Member {
  std::string name;
  TypePtr type;
};

// A type of an IDL text. It never holds itself, so that a value's nesting is bounded by `depth`.
struct Type {
  Kind kind = Kind::kBool;
  std::string name;                                        // "module::Type" of a struct or an enumeration
  Extensibility extensibility = Extensibility::kUnmarked;  // of a struct or an enumeration
  std::uint64_t bound = 0;               // most elements of a sequence, most bytes of a string; 0: none
  std::uint64_t length = 0;              // elements of an array, at least 1
  TypePtr element;                       // of a sequence or an array
  std::vector<Member> members;           // of a struct, at least one
  std::vector<std::string> enumerators;  // number 0, 1, 2 …
  std::uint64_t least_bytes = 1;         // no encoded value is shorter; stays at kHuge where it would be more
  int depth = 0;                         // 0 for numbers and texts; else one more than what it holds
};

inline constexpr int kMaxDepth = 64;
inline constexpr std::uint64_t kHuge = std::uint64_t{1} << 40;

// A number or boolean: what needs no other type.
bool IsPlain(Kind kind);
// Bytes that such a value takes, which is also its alignment in CDR version 1.
std::uint64_t PlainBytes(Kind kind);

// Precondition: IsPlain(kind).
TypePtr MakePlain(Kind kind);
// A bound of 0: none. Lengths are of elements, of a string of its bytes.
TypePtr MakeString(std::uint64_t bound);
TypePtr MakeSequence(TypePtr element, std::uint64_t bound);
TypePtr MakeArray(TypePtr element, std::uint64_t length);
TypePtr MakeEnum(std::string name, std::vector<std::string> enumerators,
                 Extensibility extensibility = Extensibility::kUnmarked);
TypePtr MakeStruct(std::string name, std::vector<Member> members,
                   Extensibility extensibility = Extensibility::kUnmarked);

// The member of a struct; null where there is none of that name.
const Type* FindMember(const Type& type, std::string_view name);

}  // namespace rodeira::decode
