// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/commands/edit_command.hpp"

#include "launch/rodeira/graphics/graphics.hpp"

namespace rodeira::cli {

int Edit(const EditOptions& options) {
  const Graphics* graphics = RegisteredGraphics();
  return graphics != nullptr ? graphics->edit(options) : ContinueInGraphics("edit");
}

}  // namespace rodeira::cli
