// SPDX-License-Identifier: Apache-2.0
#pragma once

/// @file
/// Errors as values.

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

#include "common/core/base/assert.hpp"
#include "common/core/base/error_id.hpp"
#include "common/core/base/printable.hpp"

/// Errors, bytes, digests, random numbers and snapshots: what every other module uses.
namespace rodeira::base {

/// The cause of an error. The exit status of a program follows from it.
enum class ErrorCode {
  kWrongInput,  ///< a file, option or message is wrong: exit status 2
  kFailed,      ///< the environment failed (disk full, peer lost, time-out): exit status 1
};

/// An error outside of the program's code, described for the reader and named for programs.
struct Error {
  ErrorCode code = ErrorCode::kWrongInput;  ///< the cause
  ErrorId id;                               ///< the kind of failure; stable, whatever the message says
  std::string message;                      ///< one sentence: what was found, what was expected, the nearest right name
  std::string context;                      ///< the place: file:line, topic, step; may be empty

  /// Joins context and message.
  /// @return "context: message", or the message alone if there is no context
  std::string Text() const { return context.empty() ? message : context + ": " + message; }
  /// Gives the exit status of a program that ends with this error.
  /// @return 2 for kWrongInput, 1 for kFailed
  int exit_status() const { return code == ErrorCode::kWrongInput ? 2 : 1; }

  /// Gives this error at another place, instead of its own.
  /// @param place the place (file:line, topic, step)
  /// @return the same code, id and message
  Error WithContext(std::string_view place) const { return Error{code, id, message, Printable(place)}; }
  /// Gives this error inside a larger place: its own place goes in front of the message.
  /// @param place the larger place (file, node, option)
  /// @return the same code and id; Text() is "place: context: message"
  Error In(std::string_view place) const { return Error{code, id, Text(), Printable(place)}; }
  /// Gives this error with another sentence.
  /// @param sentence what was found, what was expected
  /// @return the same code, id and context
  Error WithMessage(std::string_view sentence) const { return Error{code, id, Printable(sentence), context}; }
};

/// Makes an error of code kWrongInput. Both texts become one printable line each, so they may contain parts of files
/// and messages.
/// @param id the kind of failure, such as "config.unknown_key"
/// @param message one sentence: what was found, what was expected
/// @param context the place (file:line, topic, step); may be empty
/// @return the error
inline Error WrongInput(ErrorId id, std::string_view message, std::string_view context = {}) {
  return Error{ErrorCode::kWrongInput, id, Printable(message), Printable(context)};
}
/// Makes an error of code kFailed. Both texts become one printable line each.
/// @param id the kind of failure, such as "file.cannot_open"
/// @param message one sentence: what was found, what was expected
/// @param context the place (file, topic, step); may be empty
/// @return the error
inline Error Failed(ErrorId id, std::string_view message, std::string_view context = {}) {
  return Error{ErrorCode::kFailed, id, Printable(message), Printable(context)};
}

/// A value, or the Error that explains why there is none. Access to the absent one is an assertion failure.
/// @tparam T type of the value
template <class T>
class [[nodiscard]] Result {
 public:
  /// Makes a result with a value. Implicit, so that a function can return its value.
  /// @param value the value
  Result(T value) : content_(std::in_place_index<0>, std::move(value)) {}  // NOLINT: implicit by design
  /// Makes a result without a value. Implicit, so that a function can return an error.
  /// @param error the reason
  Result(Error error) : content_(std::in_place_index<1>, std::move(error)) {}  // NOLINT: implicit by design

  /// Says whether there is a value.
  /// @return true: value() is allowed; false: error() is allowed
  bool ok() const { return content_.index() == 0; }
  /// Converts to ok().
  explicit operator bool() const { return ok(); }
  /// Gives the value. Precondition: ok().
  /// @return the value
  T& value() & {
    RODEIRA_ASSERT(ok());
    return std::get<0>(content_);
  }
  /// Gives the value. Precondition: ok().
  /// @return the value
  const T& value() const& {
    RODEIRA_ASSERT(ok());
    return std::get<0>(content_);
  }
  /// Gives the value to move from. Precondition: ok().
  /// @return the value
  T&& value() && {
    RODEIRA_ASSERT(ok());
    return std::get<0>(std::move(content_));
  }
  /// Gives the error. Precondition: not ok().
  /// @return the error
  const Error& error() const {
    RODEIRA_ASSERT(!ok());
    return std::get<1>(content_);
  }

 private:
  std::variant<T, Error> content_;
};

/// Success, or the Error that explains the failure.
template <>
class [[nodiscard]] Result<void> {
 public:
  /// Makes a success.
  Result() = default;
  /// Makes a failure. Implicit, so that a function can return an error.
  /// @param error the reason
  Result(Error error) : error_(std::move(error)) {}  // NOLINT: implicit by design

  /// Says whether it is a success.
  /// @return false: error() is allowed
  bool ok() const { return !error_; }
  /// Converts to ok().
  explicit operator bool() const { return ok(); }
  /// Gives the error. Precondition: not ok().
  /// @return the error
  const Error& error() const {
    RODEIRA_ASSERT(error_.has_value());
    return *error_;
  }

 private:
  std::optional<Error> error_;
};

/// Success or an Error, for functions without a result.
using Status = Result<void>;

}  // namespace rodeira::base
