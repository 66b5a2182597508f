// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/dds/run.hpp"
#include "nodes/traffic/traffic_node.hpp"

int main(int argc, char** argv) {
  return rodeira::dds::RunNode("traffic", argc, argv, rodeira::nodes::MakeTrafficNode);
}
