// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/vehicle/dynamics/controls.hpp"
#include "idl/messages.hpp"

namespace rodeira::nodes {

// Clamped to what a driver can do (dynamics::Clamp). Indicators, headlights and horn are not among them.
dynamics::Controls FromMessage(const msg::Controls& in);
// Indicators, headlights and horn are off.
msg::Controls ToMessage(const dynamics::Controls& in);

}  // namespace rodeira::nodes
