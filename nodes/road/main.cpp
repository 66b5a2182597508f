// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/dds/run.hpp"
#include "nodes/road/road_service.hpp"

int main(int argc, char** argv) {
  return rodeira::dds::RunService("road", argc, argv, rodeira::nodes::MakeRoadService);
}
