// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

#include "common/core/base/assert.hpp"
#include "common/core/base/printable.hpp"

namespace rodeira::base {

// What went wrong outside of our code, for a person: the exit status follows from the code.
enum class ErrorCode {
  kWrongInput,  // a file, option or message is wrong: exit status 2
  kFailed,      // the world did not let us (disk full, peer dead, time-out): exit status 1
};

struct Error {
  ErrorCode code = ErrorCode::kWrongInput;
  std::string message;  // one sentence: what was found, what was expected, the nearest right name
  std::string context;  // where: file:line, topic, step; may be empty

  // "context: message", or the message alone where there is no context.
  std::string Text() const { return context.empty() ? message : context + ": " + message; }
  int exit_status() const { return code == ErrorCode::kWrongInput ? 2 : 1; }
};

// What others wrote may stand in both texts: they come out as one printable line.
inline Error WrongInput(std::string_view message, std::string_view context = {}) {
  return Error{ErrorCode::kWrongInput, Printable(message), Printable(context)};
}
inline Error Failed(std::string_view message, std::string_view context = {}) {
  return Error{ErrorCode::kFailed, Printable(message), Printable(context)};
}

// A T, or the Error that explains why there is none. Asking for the one that is not there is our mistake.
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : content_(std::in_place_index<0>, std::move(value)) {}      // NOLINT: implicit by design
  Result(Error error) : content_(std::in_place_index<1>, std::move(error)) {}  // NOLINT: implicit by design

  bool ok() const { return content_.index() == 0; }
  explicit operator bool() const { return ok(); }
  T& value() & {
    RODEIRA_ASSERT(ok());
    return std::get<0>(content_);
  }
  const T& value() const& {
    RODEIRA_ASSERT(ok());
    return std::get<0>(content_);
  }
  T&& value() && {
    RODEIRA_ASSERT(ok());
    return std::get<0>(std::move(content_));
  }
  const Error& error() const {
    RODEIRA_ASSERT(!ok());
    return std::get<1>(content_);
  }

 private:
  std::variant<T, Error> content_;
};

// Done, or the Error that explains why not.
template <>
class [[nodiscard]] Result<void> {
 public:
  Result() = default;
  Result(Error error) : error_(std::move(error)) {}  // NOLINT: implicit by design

  bool ok() const { return !error_; }
  explicit operator bool() const { return ok(); }
  const Error& error() const {
    RODEIRA_ASSERT(error_.has_value());
    return *error_;
  }

 private:
  std::optional<Error> error_;
};

using Status = Result<void>;

}  // namespace rodeira::base
