// SPDX-License-Identifier: Apache-2.0
// Shared objects that are no vehicle model: without entry points, or of another build.
#ifdef WITH_ENTRY_POINTS
extern "C" __attribute__((visibility("default"))) const char* rodeira_vehicle_build() { return "an earlier Rodeira"; }
extern "C" __attribute__((visibility("default"))) void rodeira_make_vehicle() {}
#else
extern "C" __attribute__((visibility("default"))) int something_else() { return 0; }
#endif
