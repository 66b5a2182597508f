// SPDX-License-Identifier: Apache-2.0
#include "common/data/decode/idl_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <set>
#include <utility>

#include "common/core/base/suggest.hpp"
#include "common/data/decode/idl_tokens.hpp"

namespace rodeira::decode {
namespace {

constexpr std::uint64_t kMaxElements = std::uint64_t{1} << 32;  // of an array or a bound: what a length in CDR can say

// Words that begin or name what is not read here.
const std::set<std::string, std::less<>> kNotRead = {
    "union", "map", "bitmask", "bitset", "interface", "valuetype", "wstring", "wchar",
    "fixed", "any", "Object",  "native", "exception", "switch",    "typeid",  "import"};
// Annotations that change what lies in a payload.
const std::set<std::string, std::less<>> kOtherEncoding = {"mutable", "optional", "value", "bit_bound"};

const std::map<std::string, Kind, std::less<>> kPlainNames = {
    {"boolean", Kind::kBool}, {"char", Kind::kChar},     {"octet", Kind::kOctet}, {"short", Kind::kInt16},
    {"float", Kind::kFloat},  {"double", Kind::kDouble}, {"int8", Kind::kInt8},   {"uint8", Kind::kUint8},
    {"int16", Kind::kInt16},  {"uint16", Kind::kUint16}, {"int32", Kind::kInt32}, {"uint32", Kind::kUint32},
    {"int64", Kind::kInt64},  {"uint64", Kind::kUint64},
};

}  // namespace

// By recursive descent; every function returns false where the text is refused, and error_ says why.
class IdlParser {
 public:
  IdlParser(std::vector<Token> tokens, std::string_view place) : tokens_(std::move(tokens)) { result_.place_ = place; }

  base::Result<IdlTypes> Run() {
    while (Now().kind != Token::Kind::kEnd) {
      if (!Definition(0)) return *error_;
    }
    return std::move(result_);
  }

 private:
  bool Definition(int depth) {
    extensibility_ = Extensibility::kUnmarked;
    if (!Annotations()) return false;
    if (IsSign(";")) return Skip();  // behind a definition
    if (Is("module")) return Module(depth);
    if (Is("struct")) return Struct();
    if (Is("enum")) return Enum();
    if (Is("typedef")) return Typedef();
    if (Is("const")) return Const();
    return Expected("module, struct, enum, typedef or const");
  }

  bool Module(int depth) {
    if (depth >= kMaxDepth) return Refuse(fmt::format("modules are nested more than {} deep", kMaxDepth));
    Skip();
    std::string name;
    if (!Name(name) || !Sign("{")) return false;
    const std::size_t outer = scope_.size();
    scope_ += name + "::";
    while (!IsSign("}")) {
      if (!Definition(depth + 1)) return false;
    }
    scope_.resize(outer);
    return Skip();
  }

  bool Struct() {
    const Extensibility extensibility = extensibility_;
    Skip();
    std::string name;
    if (!Name(name)) return false;
    if (IsSign(":")) return Refuse("structures that inherit are not read");
    if (IsSign(";")) return Refuse("forward declarations are not read");
    if (!Sign("{")) return false;
    std::vector<Member> members;
    std::set<std::string> names;
    while (!IsSign("}")) {
      if (!Annotations()) return false;
      const bool good = Declarators([&](const std::string& member, const TypePtr& type) {
        if (!names.insert(member).second) return Refuse(fmt::format("the member '{}' is there twice", member));
        members.push_back({member, type});
        return true;
      });
      if (!good) return false;
    }
    if (members.empty()) return Refuse(fmt::format("the structure '{}' has no members", name));
    TypePtr type = MakeStruct(scope_ + name, std::move(members), extensibility);
    if (type->depth > kMaxDepth) return Refuse(fmt::format("'{}' is nested more than {} deep", name, kMaxDepth));
    return Skip() && Define(name, std::move(type));
  }

  bool Enum() {
    const Extensibility extensibility = extensibility_;
    Skip();
    std::string name;
    if (!Name(name) || !Sign("{")) return false;
    std::vector<std::string> enumerators;
    do {
      std::string enumerator;
      if (!Annotations() || !Name(enumerator)) return false;
      enumerators.push_back(std::move(enumerator));
    } while (IsSign(",") && Skip());
    return Sign("}") && Define(name, MakeEnum(scope_ + name, std::move(enumerators), extensibility));
  }

  bool Typedef() {
    Skip();
    return Declarators([this](const std::string& name, const TypePtr& type) { return Define(name, type); });
  }

  // Only whole numbers are kept: an array's length may be one.
  bool Const() {
    Skip();
    TypePtr type;
    std::string name;
    if (!TypeSpec(type, 0) || !Name(name) || !Sign("=")) return false;
    const Token value = Now();
    if (value.kind == Token::Kind::kSign && !IsSign("-") && !IsSign("+")) return Expected("a literal");
    while (!IsSign(";")) {
      if (Now().kind == Token::Kind::kEnd || IsSign("{") || IsSign("}")) return Expected("';'");
      Skip();
    }
    std::uint64_t number = 0;
    if (value.kind == Token::Kind::kNumber && ToNumber(value.text, number)) constants_[scope_ + name] = number;
    return Skip();
  }

  // TYPE NAME[3][2], NAME … ;
  template <class Use>
  bool Declarators(const Use& use) {
    TypePtr base;
    if (!TypeSpec(base, 0)) return false;
    while (true) {
      std::string name;
      if (!Name(name)) return false;
      std::vector<std::uint64_t> lengths;
      while (IsSign("[")) {
        std::uint64_t length = 0;
        Skip();
        if (!Length(length) || !Sign("]")) return false;
        lengths.push_back(length);
        if (lengths.size() > kMaxDepth) return Refuse(fmt::format("'{}' has more than {} dimensions", name, kMaxDepth));
      }
      TypePtr type = base;
      for (auto length = lengths.rbegin(); length != lengths.rend(); ++length) type = MakeArray(type, *length);
      if (type->depth > kMaxDepth) return Refuse(fmt::format("'{}' is nested more than {} deep", name, kMaxDepth));
      if (!use(name, type)) return false;
      if (!IsSign(",")) return Sign(";");
      Skip();
    }
  }

  bool TypeSpec(TypePtr& type, int depth) {
    if (depth > kMaxDepth) return Refuse(fmt::format("sequences are nested more than {} deep", kMaxDepth));
    if (Now().kind != Token::Kind::kName && !IsSign("::")) return Expected("a type");
    if (kNotRead.contains(Now().text)) return Refuse(fmt::format("'{}' is not read", Now().text));
    if (Is("unsigned") || Is("long")) return LongSpec(type);
    if (Is("sequence")) return SequenceSpec(type, depth);
    if (Is("string")) {
      std::uint64_t bound = 0;
      Skip();
      if (IsSign("<") && !(Skip() && Length(bound) && Sign(">"))) return false;
      type = MakeString(bound);
      return true;
    }
    const auto plain = kPlainNames.find(Now().text);
    if (plain != kPlainNames.end()) {
      type = MakePlain(plain->second);
      return Skip();
    }
    return Reference(type);
  }

  bool LongSpec(TypePtr& type) {
    const bool is_unsigned = Is("unsigned") && Skip();
    if (Is("short")) {
      type = MakePlain(is_unsigned ? Kind::kUint16 : Kind::kInt16);
      return Skip();
    }
    if (!Is("long")) return Expected("'short' or 'long'");
    Skip();
    if (Is("double")) return Refuse("'long double' is not read");
    if (Is("long")) {
      type = MakePlain(is_unsigned ? Kind::kUint64 : Kind::kInt64);
      return Skip();
    }
    type = MakePlain(is_unsigned ? Kind::kUint32 : Kind::kInt32);
    return true;
  }

  bool SequenceSpec(TypePtr& type, int depth) {
    Skip();
    TypePtr element;
    std::uint64_t bound = 0;
    if (!Sign("<") || !TypeSpec(element, depth + 1)) return false;
    if (IsSign(",") && !(Skip() && Length(bound))) return false;
    if (!Sign(">")) return false;
    type = MakeSequence(element, bound);
    return true;
  }

  bool Reference(TypePtr& type) {
    const std::string name = ScopedName();
    if (name.empty()) return false;
    const auto found = Lookup(result_.types_, name);
    if (found == result_.types_.end()) {
      std::vector<std::string> known;
      for (const auto& [full, unused] : result_.types_) known.push_back(full);
      return Refuse(
          fmt::format("the type '{}' is not defined before this line{}", name, base::DidYouMean(name, known)));
    }
    type = found->second;
    return true;
  }

  // A positive number, or a constant that is one.
  bool Length(std::uint64_t& length) {
    if (Now().kind == Token::Kind::kNumber) {
      if (!ToNumber(Now().text, length)) return Expected("a whole number");
      Skip();
    } else {
      if (Now().kind != Token::Kind::kName && !IsSign("::")) return Expected("a length");
      const std::string name = ScopedName();
      if (name.empty()) return false;
      const auto found = Lookup(constants_, name);
      if (found == constants_.end())
        return Refuse(fmt::format("'{}' is no whole number that is defined before this line", name));
      length = found->second;
    }
    const bool fits = length > 0 && length <= kMaxElements;
    return fits || Refuse(fmt::format("a length of {} was found; 1 to {} was expected", length, kMaxElements));
  }

  static bool ToNumber(const std::string& text, std::uint64_t& number) {
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), number);
    return problem == std::errc() && end == text.data() + text.size() &&
           (text.size() == 1 || text[0] != '0');  // 010 is octal
  }

  // "a::b" with "::" before it where it counts from the root; empty where it is refused.
  std::string ScopedName() {
    std::string name = IsSign("::") ? "::" : "";
    if (!name.empty()) Skip();
    std::string part;
    if (!Name(part)) return "";
    name += part;
    while (IsSign("::")) {
      Skip();
      if (!Name(part)) return "";
      name += "::" + part;
    }
    return name;
  }

  // From the innermost module outwards.
  template <class Known>
  typename Known::const_iterator Lookup(const Known& known, const std::string& name) const {
    if (name.starts_with("::")) return known.find(name.substr(2));
    for (std::string scope = scope_;;) {
      const auto found = known.find(scope + name);
      if (found != known.end() || scope.empty()) return found;
      scope.resize(scope.size() - 2);
      const std::size_t outer = scope.rfind("::");
      scope.resize(outer == std::string::npos ? 0 : outer + 2);
    }
  }

  bool Define(const std::string& name, TypePtr type) {
    const bool fresh = result_.types_.emplace(scope_ + name, std::move(type)).second;
    return fresh || Refuse(fmt::format("'{}' is defined twice", scope_ + name));
  }

  // @name, @name(…): ignored if they leave the encoding as it is; extensibility is kept for the definition that
  // follows.
  bool Annotations() {
    while (IsSign("@")) {
      Skip();
      const std::string name = Now().text;
      if (name == "extensibility") {
        if (!ExtensibilityOfArgument()) return false;
        continue;
      }
      if (name == "final") extensibility_ = Extensibility::kFinal;
      if (name == "appendable") extensibility_ = Extensibility::kAppendable;
      if (kOtherEncoding.contains(name))
        return Refuse(fmt::format("'@{}' is not read: it makes another encoding", name));
      if (ScopedName().empty()) return false;
      if (!IsSign("(")) continue;
      int open = 0;
      do {
        if (Now().kind == Token::Kind::kEnd) return Expected("')'");
        open += IsSign("(") ? 1 : IsSign(")") ? -1 : 0;
        Skip();
      } while (open > 0);
    }
    return true;
  }

  // @extensibility(FINAL)
  bool ExtensibilityOfArgument() {
    Skip();
    std::string kind;
    if (!Sign("(") || !Name(kind)) return false;
    if (kind == "MUTABLE") return Refuse("'@extensibility(MUTABLE)' is not read: it makes another encoding");
    if (kind != "FINAL" && kind != "APPENDABLE")
      return Refuse(fmt::format("'{}' was found, FINAL or APPENDABLE was expected", kind));
    extensibility_ = kind == "FINAL" ? Extensibility::kFinal : Extensibility::kAppendable;
    return Sign(")");
  }

  const Token& Now() const { return tokens_[at_]; }
  bool Is(std::string_view word) const { return Now().kind == Token::Kind::kName && Now().text == word; }
  bool IsSign(std::string_view sign) const { return Now().kind == Token::Kind::kSign && Now().text == sign; }
  bool Skip() {
    if (at_ + 1 < tokens_.size()) ++at_;
    return true;
  }
  bool Sign(std::string_view sign) { return IsSign(sign) ? Skip() : Expected(fmt::format("'{}'", sign)); }
  bool Name(std::string& name) {
    if (Now().kind != Token::Kind::kName) return Expected("a name");
    name = Now().text;
    return Skip();
  }
  bool Expected(const std::string& what) {
    const bool not_read = Now().kind == Token::Kind::kName && kNotRead.contains(Now().text);
    if (not_read) return Refuse(fmt::format("'{}' is not read", Now().text));
    return Refuse(fmt::format("'{}' was found, {} was expected", Now().text, what));
  }
  bool Refuse(const std::string& what) {
    error_ = base::WrongInput("message.wrong_idl", what, fmt::format("{}:{}", result_.place_, Now().line));
    return false;
  }

  std::vector<Token> tokens_;  // the last one is the end
  std::size_t at_ = 0;
  std::string scope_;                                       // "a::b::"
  Extensibility extensibility_ = Extensibility::kUnmarked;  // of the definition that follows
  std::map<std::string, std::uint64_t> constants_;
  IdlTypes result_;
  std::optional<base::Error> error_;
};

base::Result<IdlTypes> IdlTypes::Read(std::string_view text, std::string_view place) {
  auto tokens = Tokenise(text, place);
  if (!tokens) return tokens.error();
  return IdlParser(std::move(tokens).value(), place).Run();
}

base::Result<TypePtr> IdlTypes::Find(const std::string& name) const {
  const auto found = types_.find(name);
  if (found != types_.end()) return found->second;
  std::vector<std::string> known;
  for (const auto& [full, unused] : types_) known.push_back(full);
  return base::WrongInput("message.unknown_type",
                          fmt::format("the type '{}' is not in its IDL text{}", name, base::DidYouMean(name, known)),
                          place_);
}

base::Result<TypePtr> ReadType(std::string_view idl, const std::string& name) {
  const auto types = IdlTypes::Read(idl, fmt::format("IDL of '{}'", name));
  if (!types) return types.error();
  return types.value().Find(name);
}

}  // namespace rodeira::decode
