// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "common/core/base/mathematics.hpp"

// The runs here must compute like the programs do (law L7).
int main(int argc, char** argv) {
  rodeira::base::PinMathLibrary(argv);
  ::testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
