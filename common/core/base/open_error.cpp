// SPDX-License-Identifier: Apache-2.0
#include "common/core/base/open_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

namespace rodeira::base {

Error OpenError(std::string_view message, int error_number, std::string_view context) {
  constexpr std::array kOfTheMachine{EMFILE, ENFILE, ENOMEM, EAGAIN, ENOSPC, EDQUOT, EIO, ENOBUFS};
  const std::string text = fmt::format("{}: {}", message, std::strerror(error_number));
  return std::ranges::find(kOfTheMachine, error_number) != kOfTheMachine.end()
             ? Failed("file.cannot_open", text, context)
             : WrongInput("file.cannot_open", text, context);
}

}  // namespace rodeira::base
