// SPDX-License-Identifier: Apache-2.0
// A shared object that is no node of this build.
#ifdef WITH_ENTRY_POINTS
extern "C" const char* rodeira_node_build() { return "an earlier Rodeira"; }
extern "C" void rodeira_make_node() {}
#else
extern "C" int nothing_of_use() { return 0; }
#endif
