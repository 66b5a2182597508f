// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/dds/run.hpp"
#include "nodes/empty/empty_node.hpp"

int main(int argc, char** argv) { return rodeira::dds::RunNode("empty", argc, argv, rodeira::nodes::MakeEmptyNode); }
