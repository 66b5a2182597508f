// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "common/core/config/declared.hpp"
#include "common/world/design/context.hpp"
#include "common/world/network/road.hpp"

namespace rodeira::design {

// 'signs', 'objects', 'bridges', 'tunnels' and 'surfaces' of a road. The road's lanes must be there already.
void ReadFurniture(const config::DeclaredMap& road, const Context& context, double length_m, network::RoadSpec& spec,
                   std::vector<std::string>& warnings);

// A sign by its name here, as a signal without its place: its number in the German catalogue (StVO), which most
// OpenDRIVE files use. `value` (km/h, %, t …) where the sign shows one.
struct SignKind {
  const char* name;
  const char* type;
  const char* subtype;
  double height_m, width_m;
  bool with_value;
};
const std::vector<SignKind>& SignKinds();
// Country "DE"; the value's unit is km/h for limits, else %.
network::Signal MakeSign(const SignKind& kind, std::optional<double> value);
// Null where no sign has this name.
const SignKind* FindSign(std::string_view name);

}  // namespace rodeira::design
