// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/runtime/dds/run.hpp"
#include "common/runtime/launch/node_library.hpp"

// RODEIRA_NODE(MakeEyeTracker), once, at the end of a source: the whole of an external node's program, or the entry
// points of its shared object. CMake's function rodeira_add_node builds either. MakeEyeTracker is a
// launch::NodeFactory.
#ifdef RODEIRA_NODE_LIBRARY
#define RODEIRA_NODE(make)                                                                                          \
  extern "C" __attribute__((visibility("default"))) const char* rodeira_node_build() {                              \
    static const std::string build = ::rodeira::launch::NodeBuild();                                                \
    return build.c_str();                                                                                           \
  }                                                                                                                 \
  extern "C" __attribute__((visibility("default"))) void rodeira_make_node(::rodeira::launch::NodeContext& context, \
                                                                           ::rodeira::launch::MadeNode& made) {     \
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
