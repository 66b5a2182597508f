// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "launch/rodeira/replay/replay_command.hpp"

namespace rodeira::cli {

// `rodeira replay FILE --from T --branch KEY=VALUE … --record NEW`: exit status 0, 1 where the parent could not be
// repeated, 2 for wrong input.
int MakeBranch(const ReplayOptions& options);

}  // namespace rodeira::cli
