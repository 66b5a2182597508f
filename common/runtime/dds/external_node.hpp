// SPDX-License-Identifier: Apache-2.0
#pragma once

/// @file
/// The entry of an external node's program or shared object.

#include "common/runtime/dds/run.hpp"
#include "common/runtime/launch/node_library.hpp"

/// Defines the entry of an external node: `main` of its program, or the entry points of its shared object if
/// RODEIRA_NODE_LIBRARY is defined. Used once, at the end of a source outside of all namespaces:
/// `RODEIRA_NODE(MakeEyeTracker);`. CMake's function rodeira_add_node builds either.
/// @param make the function that makes the node, a rodeira::launch::NodeFactory
#ifdef RODEIRA_NODE_LIBRARY
#define RODEIRA_NODE(make)                                                                                          \
  extern "C" __attribute__((visibility("default"))) const char* rodeira_node_build() {                              \
    static const std::string build = ::rodeira::launch::NodeBuild();                                                \
    return build.c_str();                                                                                           \
  }                                                                                                                 \
  extern "C" __attribute__((visibility("default"))) void rodeira_make_node(::rodeira::launch::NodeContext& context, \
                                                                           ::rodeira::launch::NodeResult& made) {   \
    if (auto status = ::rodeira::launch::CheckCompiledTypes(context); !status) {                                    \
      made = status.error();                                                                                        \
      return;                                                                                                       \
    }                                                                                                               \
    made = make(context);                                                                                           \
  }                                                                                                                 \
  static_assert(true)
#else
#define RODEIRA_NODE(make)                                                                          \
  int main(int argc, char** argv) { return ::rodeira::dds::RunNode("external", argc, argv, make); } \
  static_assert(true)
#endif
