// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/dds/run.hpp"
#include "nodes/input/input_node.hpp"
#include "nodes/input/use_devices.hpp"

int main(int argc, char** argv) {
  rodeira::nodes::UseDevices();
  return rodeira::dds::RunNode("input", argc, argv, rodeira::nodes::MakeInputNode);
}
