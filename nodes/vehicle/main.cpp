// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/dds/run.hpp"
#include "nodes/vehicle/vehicle_node.hpp"

int main(int argc, char** argv) {
  return rodeira::dds::RunNode("vehicle", argc, argv, rodeira::nodes::MakeVehicleNode);
}
