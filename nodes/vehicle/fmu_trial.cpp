// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/fmi/trial.hpp"

int main(int argc, char** argv) { return rodeira::fmi::RunTrial(argc, argv); }
