// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace rodeira::cli {

// The front door: finds the command, reads its options, returns the exit status (docs/explanation/architecture.md).
int Main(int argc, char** argv);

}  // namespace rodeira::cli
