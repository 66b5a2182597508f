// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "common/core/base/result.hpp"

namespace rodeira::base {

// Writes the error as one line to standard error: "program: text of the error", or its text alone where `program` is
// empty. After PrintErrorsAsJson: ErrorJson. Returns the error's exit status.
int PrintError(std::string_view program, const Error& error);

// From now on PrintError writes JSON. Called while the program has one thread.
void PrintErrorsAsJson();
// Whether PrintErrorsAsJson was called.
bool ErrorsAreJson();

// The error as one line of JSON without its end:
// {"id":"config.unknown_key","message":"…","context":"demo.yaml:3","status":2}. The context is empty where the error
// has none; the status is the error's exit status.
std::string ErrorJson(const Error& error);

}  // namespace rodeira::base
