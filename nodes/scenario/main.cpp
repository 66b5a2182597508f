// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/dds/run.hpp"
#include "nodes/scenario/scenario_node.hpp"

int main(int argc, char** argv) {
  return rodeira::dds::RunNode("scenario", argc, argv, rodeira::nodes::MakeScenarioNode);
}
