// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/world/network/furniture.hpp"

// Which sign a signal is, by its number.
namespace rodeira::network {

// The kind of a signal with a number of the German catalogue (StVO; most OpenDRIVE files use them, for the country
// "OpenDRIVE" too) or of another one (SignKindAbroad): "stop", "speed_limit" …; empty: it is only paint on the road;
// nothing: it is none of these.
std::optional<std::string_view> SignKindOf(const Signal& signal);
// Every kind once, in the order of their numbers.
std::vector<std::string_view> SignKindNames();

// The number that a sign shows, in the unit that people read (km/h for limits); empty: none. Old files say limits by
// the subtype: 51 is 10 km/h … 63 is 130.
std::string SignNumberOf(const Signal& signal);

}  // namespace rodeira::network
