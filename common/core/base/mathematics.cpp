// SPDX-License-Identifier: Apache-2.0
#include "common/core/base/mathematics.hpp"

#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <iterator>
#include <string>

#include "common/core/base/bytes.hpp"
#include "common/core/base/random.hpp"

namespace rodeira::base {
namespace {

constexpr const char* kTunables = "glibc.cpu.hwcaps=-FMA,-FMA4,-AVX2";

// Written through volatile so that the compiler asks the library at run time instead of folding the constant.
double Evaluate(double (*function)(double), double x) {
  const volatile double argument = x;
  return function(argument);
}

constexpr std::uint64_t kArguments = 3000;

Digest ComputeFingerprint() {
  using Function = double (*)(double);
  const Function functions[] = {std::sin, std::cos,   std::tan,  std::asin, std::acos, std::atan, std::exp,  std::exp2,
                                std::log, std::log10, std::log2, std::sinh, std::cosh, std::tanh, std::sqrt, std::cbrt};
  // With and without FMA at most one result in a thousand differs (measured over a million), so it takes tens of
  // thousands of them, at arguments without pattern, to be sure that a difference is seen.
  ByteWriter out;
  out.bytes().reserve(kArguments * ((std::size(functions) + 4) * sizeof(double) + 2 * sizeof(float)));
  for (std::uint64_t i = 0; i < kArguments; ++i) {
    const double x = RandomUniform({i}, -1.0, 1.0) * (i % 3 == 0 ? 1.0 : 30.0);
    for (const Function function : functions) {
      const double y = Evaluate(function, x);
      out.Put(std::isnan(y) ? 0.0 : y);  // the sign of a NaN is no promise of IEEE 754
    }
    const volatile double a = std::fabs(x);
    const volatile double b = RandomUniform({i, 1}, -3.0, 3.0);
    out.Put(std::pow(a, b));
    out.Put(std::atan2(b, x));
    out.Put(std::hypot(a, b));
    out.Put(std::fmod(b, a));
    const volatile float f = static_cast<float>(x);
    out.Put(std::sin(f));
    out.Put(std::exp(f));
  }
  return Hash(out.bytes());
}

bool g_is_set_for_children = false;

bool IsSet() {
  const char* tunables = std::getenv("GLIBC_TUNABLES");
  return tunables != nullptr && std::strstr(tunables, kTunables) != nullptr;
}

void Set() {
  const char* tunables = std::getenv("GLIBC_TUNABLES");
  const std::string wanted =
      tunables == nullptr || *tunables == '\0' ? std::string(kTunables) : std::string(tunables) + ":" + kTunables;
  ::setenv("GLIBC_TUNABLES", wanted.c_str(), 1);
}

}  // namespace

Digest MathLibraryFingerprint() {
  static const Digest digest = ComputeFingerprint();  // the library of a process does not change
  return digest;
}

bool MathematicsFixed() { return IsSet() && !g_is_set_for_children; }

void PinMathLibraryOfChildren() {
  if (IsSet()) return;
  Set();
  g_is_set_for_children = true;
}

void PinMathLibrary(char** argv) {
  if (MathematicsFixed()) return;
  if (!IsSet()) Set();
  ::execv("/proc/self/exe", argv);
  // Where /proc is not mounted the run goes on; the mathematics digest in the hello finds a machine that differs.
}

}  // namespace rodeira::base
