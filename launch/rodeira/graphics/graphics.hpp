// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "common/core/base/result.hpp"
#include "common/runtime/launch/launch.hpp"
#include "common/runtime/launch/node_context.hpp"
#include "launch/rodeira/commands/edit_command.hpp"
#include "launch/rodeira/replay/watch_command.hpp"
#include "nodes/view/visual_database/database.hpp"

// `rodeira` links nothing that draws. rodeira-graphics is the same program with everything that draws, and with SDL's
// devices: it registers them here. `rodeira` continues in it where a command needs a picture or a device
// (docs/decisions/0026-light-front-door.md).
namespace rodeira::cli {

// The entries of what draws. Those that return an int return the exit status.
struct Graphics {
  bool (*has_display)() = nullptr;  // whether a display answers
  int (*start_window)() = nullptr;
  int (*edit)(const EditOptions& options) = nullptr;
  int (*watch)(const WatchOptions& options) = nullptr;         // replay --view
  int (*write_frames)(const WatchOptions& options) = nullptr;  // replay --frames
  base::Result<nodes::DatabaseReport> (*write_tiles)(const road::World& world,
                                                     const nodes::DatabaseOptions& options) = nullptr;
  launch::NodeFactory view;  // of runs in one process
};

// Registers them, at the start of a program; every member is given.
void UseGraphics(Graphics graphics);
// Null in programs that do not draw.
const Graphics* RegisteredGraphics();

// Arguments of this program, for ContinueInGraphics.
void KeepArguments(int argc, char** argv);
// Whether this program is not rodeira-graphics, but that program was built.
bool CanContinueInGraphics();
// Why there is no rodeira-graphics, for the end of a sentence.
std::string WhyNoGraphics();
// Replaces this program by rodeira-graphics with the same arguments: process, terminal and exit status stay. It returns
// only where that is not possible: one sentence, which begins with `command`, and status 2.
int ContinueInGraphics(const std::string& command);

// Whether the node takes live input from a wheel or a game pad.
bool ReadsDevice(const launch::LaunchNode& node);
// Whether a run of these nodes in one process draws, or reads a device.
bool NeedsGraphics(const launch::Launch& launch);

}  // namespace rodeira::cli
