// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "launch/rodeira/doctor/finding.hpp"

namespace rodeira::cli {

// What the check loads, and in which environment.
struct GlSettings {
  std::string library = "libEGL.so.1";
  std::vector<std::pair<std::string, std::string>> environment;  // set in the process that draws
};

// An off-screen OpenGL context is made in the way the view makes its own (EGL, a pbuffer, a compatibility profile),
// draws a triangle with a shader, and the pixels are looked at. In a child process, with libraries loaded there: a
// driver that crashes or hangs is a finding too, and `rodeira` links no OpenGL.
Finding CheckGl(const GlSettings& settings = {});

}  // namespace rodeira::cli
