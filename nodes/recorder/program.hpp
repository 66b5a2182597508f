// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace rodeira::nodes {

// Which program wrote a recording: the release, and the commit it was built from ("+changes": with others beside it).
std::string_view ProgramVersion();
std::string_view ProgramCommit();

}  // namespace rodeira::nodes
