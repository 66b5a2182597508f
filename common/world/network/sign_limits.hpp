// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "common/world/network/network.hpp"

// Speed limits by signs.
namespace rodeira::network {

// What a sign does to the limit where it stands: it begins one, in m/s, or ends the one before (nothing).
struct SignLimit {
  std::optional<double> speed_mps;
};
// Nothing: it is no sign of a speed limit or of an end of one, or shows no number. A number without a unit is km/h, on
// signs of the United States and the United Kingdom mph.
std::optional<SignLimit> SignLimitOf(const Signal& signal);

// The limits by signs on every lane, by Network::Number; empty where no sign limits the speed. A sign holds for the
// traffic and the lanes that it is for, from where it stands: until the next limit, an end of limits or a junction. It
// goes on over joints of roads and lane sections with the lanes. Where lanes come together the lower limit holds; a
// lane that opens has the limit of the lane beside it.
std::vector<std::vector<SignSpeed>> SignSpeeds(const Network& network);

}  // namespace rodeira::network
