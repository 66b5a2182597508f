// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <string>

#include "common/core/base/version.hpp"
#include "common/runtime/dds/run.hpp"
#include "common/vehicle/dynamics/vehicle_model.hpp"

int main() {
  std::printf("built with Rodeira %s\n", std::string(rodeira::base::Version()).c_str());
  return 0;
}
