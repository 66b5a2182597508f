// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/dds/run.hpp"
#include "nodes/recorder/recorder_node.hpp"

int main(int argc, char** argv) {
  return rodeira::dds::RunNode("recorder", argc, argv, rodeira::nodes::MakeRecorderNode);
}
