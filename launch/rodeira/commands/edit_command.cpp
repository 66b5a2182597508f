// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/commands/edit_command.hpp"

#include "nodes/editor/desk.hpp"

namespace rodeira::cli {

int Edit(const EditOptions& options) { return nodes::RunEditor(options.file); }

}  // namespace rodeira::cli
