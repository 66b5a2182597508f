// SPDX-License-Identifier: Apache-2.0
#include "common/data/decode/idl_tokens.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

namespace rodeira::decode {
namespace {

bool IsDigit(char c) { return c >= '0' && c <= '9'; }
bool IsLetter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool IsSpace(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f' || c == '\v'; }

class Tokeniser {
 public:
  Tokeniser(std::string_view text, std::string_view place) : text_(text), place_(place) {}

  base::Result<std::vector<Token>> Run() {
    while (SkipSpace() && at_ < text_.size()) {
      if (!Take()) break;
    }
    if (error_) return *error_;
    tokens_.push_back({Token::Kind::kEnd, "the end of the text", line_});
    return std::move(tokens_);
  }

 private:
  bool SkipSpace() {
    while (at_ < text_.size()) {
      if (IsSpace(text_[at_])) {
        Advance(at_ + 1);
      } else if (text_.substr(at_).starts_with("//")) {
        Advance(std::min(text_.find('\n', at_), text_.size()));
      } else if (text_.substr(at_).starts_with("/*")) {
        const std::size_t end = text_.find("*/", at_ + 2);
        if (end == std::string_view::npos) return Refuse("a comment begins here that does not end");
        Advance(end + 2);
      } else {
        return true;
      }
    }
    return true;
  }

  bool Take() {
    const char c = text_[at_];
    if (IsLetter(c)) return TakeWhile(Token::Kind::kName, [](char d) { return IsLetter(d) || IsDigit(d); });
    if (IsDigit(c))
      return TakeWhile(Token::Kind::kNumber, [](char d) { return IsLetter(d) || IsDigit(d) || d == '.'; });
    if (c == '"' || c == '\'') return TakeQuoted(c);
    if (c == '#') return Refuse("a preprocessor line was found; the text must be complete in itself");
    if (text_.substr(at_).starts_with("::")) return Put(Token::Kind::kSign, 2);
    if (std::string_view("{}[]()<>;,:=@+-|&^~*/%").find(c) != std::string_view::npos) return Put(Token::Kind::kSign, 1);
    return Refuse(fmt::format("the character '{}' has no meaning here", std::string_view(&c, 1)));
  }

  template <class Belongs>
  bool TakeWhile(Token::Kind kind, const Belongs& belongs) {
    std::size_t size = 1;
    while (at_ + size < text_.size() && belongs(text_[at_ + size])) ++size;
    return Put(kind, size);
  }

  bool TakeQuoted(char quote) {
    for (std::size_t end = at_ + 1; end < text_.size(); ++end) {
      if (text_[end] == '\n') break;
      if (text_[end] == '\\') {
        ++end;
      } else if (text_[end] == quote) {
        return Put(Token::Kind::kText, end + 1 - at_);
      }
    }
    return Refuse("a text begins here that does not end in its line");
  }

  bool Put(Token::Kind kind, std::size_t size) {
    tokens_.push_back({kind, std::string(text_.substr(at_, size)), line_});
    Advance(at_ + size);
    return true;
  }
  void Advance(std::size_t to) {
    line_ += static_cast<int>(std::ranges::count(text_.substr(at_, to - at_), '\n'));
    at_ = to;
  }
  bool Refuse(const std::string& what) {
    error_ = base::WrongInput("message.wrong_idl", what, fmt::format("{}:{}", place_, line_));
    return false;
  }

  std::string_view text_;
  std::string_view place_;
  std::size_t at_ = 0;
  int line_ = 1;
  std::vector<Token> tokens_;
  std::optional<base::Error> error_;
};

}  // namespace

base::Result<std::vector<Token>> Tokenise(std::string_view text, std::string_view place) {
  return Tokeniser(text, place).Run();
}

}  // namespace rodeira::decode
