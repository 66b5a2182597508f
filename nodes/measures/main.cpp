// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/dds/run.hpp"
#include "nodes/measures/measures_node.hpp"

int main(int argc, char** argv) {
  return rodeira::dds::RunNode("measures", argc, argv, rodeira::nodes::MakeMeasuresNode);
}
