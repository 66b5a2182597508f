// SPDX-License-Identifier: Apache-2.0
#include "common/core/base/print_error.hpp"

#include <fmt/format.h>

#include <cstdio>

#include "common/core/base/json_text.hpp"
#include "common/core/base/printable.hpp"

namespace rodeira::base {
namespace {

bool g_errors_are_json = false;

}  // namespace

void PrintErrorsAsJson() { g_errors_are_json = true; }
bool ErrorsAreJson() { return g_errors_are_json; }

std::string ErrorJson(const Error& error) {
  // An error that WrongInput or Failed did not make may hold any bytes.
  return fmt::format(R"({{"id":{},"message":{},"context":{},"status":{}}})", JsonText(error.id.text()),
                     JsonText(Printable(error.message)), JsonText(Printable(error.context)), error.exit_status());
}

int PrintError(std::string_view program, const Error& error) {
  if (ErrorsAreJson())
    fmt::print(stderr, "{}\n", ErrorJson(error));
  else
    fmt::print(stderr, "{}{}{}\n", program, program.empty() ? "" : ": ", error.Text());
  return error.exit_status();
}

}  // namespace rodeira::base
