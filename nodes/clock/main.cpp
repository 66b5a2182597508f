// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/dds/run.hpp"

int main(int argc, char** argv) { return rodeira::dds::RunClock(argc, argv); }
