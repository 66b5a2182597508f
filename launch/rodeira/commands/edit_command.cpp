#include "launch/rodeira/commands/edit_command.hpp"

#include "nodes/editor/desk.hpp"

namespace rodeira::front {

int Edit(const EditOptions& options) { return desk::RunDesk(options.file); }

}  // namespace rodeira::front
