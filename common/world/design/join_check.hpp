// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "common/core/config/config.hpp"
#include "common/world/network/road.hpp"

namespace rodeira::design {

// One of two road ends that go on into each other.
struct JoinEnd {
  const network::Road& road;
  network::End end;
  std::string id;    // as the file has it, the road before junctions cut it
  double s_m = 0.0;  // on that road
};

// Whether both meet: ends within 5 cm in plan and in height, headings within 1 mrad, the edges of the lanes of the same
// number within 5 cm, and no step of more than that across what is driven on. What is farther apart is a problem of
// `link` (the first of these only; then false), a smaller step or gap of a millimetre or more is a warning; so are a
// kink of the grade, a lane that ends, a step of more than 5 cm on shoulders and verges.
bool CheckJoin(const config::Map& link, const JoinEnd& own, const JoinEnd& other, std::vector<std::string>& warnings);

}  // namespace rodeira::design
