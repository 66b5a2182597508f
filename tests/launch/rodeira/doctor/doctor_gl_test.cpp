// SPDX-License-Identifier: Apache-2.0
// OpenGL off-screen, and what is said where one of the three packages that it needs is out of sight.
#include "launch/rodeira/doctor/doctor_gl.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/launch/rodeira/temporary_folder.hpp"

namespace rodeira::cli {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;

constexpr const char* kInstall =
    "without it the view node cannot run: sudo apt-get install libegl1 libegl-mesa0 libgl1-mesa-dri";

TEST(GlCheck, DrawsOffScreen) {
  const Finding finding = CheckGl();
  EXPECT_EQ(finding.verdict, Verdict::kOk) << finding.sentence;
  EXPECT_THAT(finding.sentence, HasSubstr("OpenGL "));
}

TEST(GlCheck, WithoutLibegl1ItIsAFault) {
  const Finding finding = CheckGl({"libEGL-that-is-not-there.so.1", {}});
  EXPECT_EQ(finding.verdict, Verdict::kFault);
  EXPECT_THAT(finding.sentence, HasSubstr("libEGL-that-is-not-there.so.1 cannot be loaded"));
  EXPECT_THAT(finding.sentence, EndsWith(kInstall));
  EXPECT_THAT(CheckGl({"libm.so.6", {}}).sentence, HasSubstr("libm.so.6 is no EGL"));
}

TEST(GlCheck, WithoutMesasEglItIsAFault) {
  const TemporaryFolder empty;
  const Finding finding = CheckGl({"libEGL.so.1", {{"__EGL_VENDOR_LIBRARY_DIRS", empty.path().string()}}});
  EXPECT_EQ(finding.verdict, Verdict::kFault) << finding.sentence;
  EXPECT_THAT(finding.sentence, EndsWith(kInstall));
}

TEST(GlCheck, WithoutMesasDriversItIsAFault) {
  const TemporaryFolder empty;
  const Finding finding = CheckGl({"libEGL.so.1", {{"LIBGL_DRIVERS_PATH", empty.path().string()}}});
  EXPECT_EQ(finding.verdict, Verdict::kFault) << finding.sentence;
  EXPECT_THAT(finding.sentence, EndsWith(kInstall));
}

}  // namespace
}  // namespace rodeira::cli
