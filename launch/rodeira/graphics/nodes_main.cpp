// SPDX-License-Identifier: Apache-2.0
// rodeira-nodes-graphics: rodeira-nodes with views, and with wheels and game pads.
#include <utility>

#include "common/vehicle/sdl_devices/sdl_devices.hpp"
#include "launch/rodeira/graphics/graphics.hpp"
#include "launch/rodeira/run/shared_nodes.hpp"
#include "nodes/view/view_node.hpp"

int main(int argc, char** argv) {
  rodeira::sdl_devices::UseSdlDevices();
  rodeira::cli::Graphics graphics;
  graphics.view = rodeira::nodes::MakeViewNode;  // nothing else of it is used here
  rodeira::cli::UseGraphics(std::move(graphics));
  return rodeira::cli::RunSharedNodes("rodeira-nodes-graphics", argc, argv);
}
