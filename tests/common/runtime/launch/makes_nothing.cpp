// SPDX-License-Identifier: Apache-2.0
// A shared object of the build that RODEIRA_TEST_NODE_BUILD names; its entry point makes no node.
#include <cstdlib>

extern "C" __attribute__((visibility("default"))) const char* rodeira_node_build() {
  return std::getenv("RODEIRA_TEST_NODE_BUILD");
}
extern "C" __attribute__((visibility("default"))) void rodeira_make_node() {}
