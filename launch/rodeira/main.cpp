// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/commands.hpp"

int main(int argc, char** argv) { return rodeira::cli::Main(argc, argv); }
