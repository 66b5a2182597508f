// SPDX-License-Identifier: Apache-2.0
// Prints the mathematics digest: with law L7's choice, or, for comparison, with the processor's own.
#include "common/core/base/mathematics.hpp"

#include <cstdio>
#include <cstdlib>

int main(int, char** argv) {
  if (std::getenv("RODEIRA_TEST_KEEP_MATHEMATICS") == nullptr) rodeira::base::PinMathLibrary(argv);
  std::printf("%s\n", rodeira::base::Hex(rodeira::base::MathLibraryFingerprint()).c_str());
}
