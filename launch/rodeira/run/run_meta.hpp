// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "common/core/base/result.hpp"
#include "common/runtime/launch/launch.hpp"

namespace rodeira::cli {

// `--meta KEY=VALUE`: adds overrides that hand each pair to the recorder of `launch`. Wrong input where it is no pair,
// the key is no name (letters, digits, _ and -), or nothing is recorded.
base::Status AddMeta(const launch::Launch& launch, const std::vector<std::string>& meta, launch::Overrides& overrides);

}  // namespace rodeira::cli
