// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "common/core/base/result.hpp"

namespace rodeira::base {

// What a shared object of a laboratory's own has: an entry point that returns the text of its build
// (`const char* build()`), and one that makes what it is for.
struct SharedObjectEntries {
  const char* build = nullptr;
  const char* make = nullptr;
  std::string_view written_by;  // the macro that writes both, for messages
};

// Loads a shared object and returns the address of its `make`. It stays loaded until the process ends. Wrong input if
// it cannot be loaded, lacks an entry point, or its build is not `own_build`.
Result<void*> LoadSharedObject(const std::filesystem::path& path, const SharedObjectEntries& entries,
                               const std::string& own_build);

// The text of a build: version, compiler, and a number for the layout of the types that pass between both.
std::string BuildText(std::size_t layout);

}  // namespace rodeira::base
