// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

// What the build knows and `rodeira doctor` asks for.
namespace rodeira::cli {

// The text of tools/packages/run.txt when this program was built.
std::string_view PackageList();
// The programs that were built with this one and belong beside it: "rodeira-clock", …
const std::vector<std::string>& NodePrograms();

}  // namespace rodeira::cli
