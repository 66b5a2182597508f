// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace rodeira::nodes {

// Commit that the program was built from, 12 hexadecimal digits; "+changes" follows if the tree had other changes;
// "unknown" without git.
std::string_view ProgramCommit();

}  // namespace rodeira::nodes
