// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/graphics/all_graphics.hpp"

#include "launch/rodeira/graphics/graphics.hpp"
#include "launch/rodeira/replay/watch_command.hpp"
#include "launch/rodeira/start_window/start_window.hpp"
#include "nodes/editor/editor_app.hpp"
#include "nodes/view/frame/surface.hpp"
#include "nodes/view/view_node.hpp"

namespace rodeira::cli {

void UseAllGraphics() {
  UseGraphics({.has_display = nodes::HasDisplay,
               .start_window = StartByWindow,
               .edit = [](const EditOptions& options) { return nodes::RunEditor(options.file); },
               .watch = WatchRecording,
               .write_frames = WriteRecordedFrames,
               .write_tiles = nodes::WriteDatabase,
               .view = nodes::MakeViewNode});
}

}  // namespace rodeira::cli
