// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace rodeira::cli {

// `rodeira info FILE.mcap`: what a recording holds, and its condition. Status 2 where it is none.
int Info(const std::string& file);

}  // namespace rodeira::cli
