// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/dds/run.hpp"
#include "common/vehicle/sdl_devices/sdl_devices.hpp"
#include "nodes/input/input_node.hpp"

int main(int argc, char** argv) {
  rodeira::sdl_devices::UseSdlDevices();
  return rodeira::dds::RunNode("input", argc, argv, rodeira::nodes::MakeInputNode);
}
