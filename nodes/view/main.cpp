// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/dds/run.hpp"
#include "nodes/view/view_node.hpp"

int main(int argc, char** argv) { return rodeira::dds::RunNode("view", argc, argv, rodeira::nodes::MakeViewNode); }
