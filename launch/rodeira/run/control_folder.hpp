// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/core/base/result.hpp"

namespace rodeira::cli {

// Where this user's runs on this PC have their control sockets: $XDG_RUNTIME_DIR/rodeira, else /tmp/rodeira-UID. Made
// where it is not there; failed where it belongs to another user or is open to others.
base::Result<std::filesystem::path> ControlFolder();
// The socket of a run in it. A name that is no good file name stands there as its hash.
std::filesystem::path ControlSocket(const std::filesystem::path& folder, const std::string& run);

// A connection to the socket, or -1 where no run listens there. Never waits: a run that hangs or is stopped, and has
// let its connections wait, gives -1 too, and `is_busy` is then true.
int ConnectTo(const std::filesystem::path& socket, bool* is_busy = nullptr);
// Whether this user has a run of this name, with its clock, on this PC.
bool IsRunning(const std::string& run);
// The sockets on which a process listens, by name.
std::vector<std::filesystem::path> LivingRuns(const std::filesystem::path& folder);

}  // namespace rodeira::cli
