// SPDX-License-Identifier: Apache-2.0
// rodeira-nodes: several nodes of a run in one process.
#include "launch/rodeira/run/shared_nodes.hpp"

int main(int argc, char** argv) { return rodeira::cli::RunSharedNodes("rodeira-nodes", argc, argv); }
