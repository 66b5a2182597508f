// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/doctor/doctor_gl.hpp"

namespace rodeira::cli {

Finding CheckGl(const GlSettings&) { return Ok("GL", "not looked at: built without the view (RODEIRA_VIEW=OFF)"); }

}  // namespace rodeira::cli
