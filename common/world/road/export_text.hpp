// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "common/core/geometry/cubic.hpp"

// Pieces of OpenDRIVE's XML.
namespace rodeira::road {

// The text with &, <, > and " as entities.
std::string Escaped(std::string_view text);
// <element from_name="from" a= b= c= d=/>
std::string CubicText(const char* element, const char* from_name, double from, const geometry::Cubic& cubic);

}  // namespace rodeira::road
