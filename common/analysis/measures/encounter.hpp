// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "common/analysis/measures/measure.hpp"

namespace rodeira::measures {

// Another vehicle crosses the own path or joins it: both sweep a common area. Times are those of the recording;
// missing: the vehicle is still in the area at the end.
struct Encounter {
  std::int64_t other = 0;  // as in Neighbour::id
  double angle_rad = 0.0;  // between the headings where the paths are nearest, 0 to pi
  double own_enters_s = 0.0;
  double own_leaves_s = kMissing;
  double other_enters_s = 0.0;
  double other_leaves_s = kMissing;
};

// The post-encroachment time: from the first vehicle's leaving of the area to the second's entering. Negative where
// both are in it. Missing where the first one is still in it at the end.
inline double PostEncroachment_s(const Encounter& e) {
  return e.own_enters_s <= e.other_enters_s ? e.other_enters_s - e.own_leaves_s : e.own_enters_s - e.other_leaves_s;
}
// When the second vehicle enters: the time of the encounter.
inline double TimeOf(const Encounter& e) {
  return e.own_enters_s <= e.other_enters_s ? e.other_enters_s : e.own_enters_s;
}

}  // namespace rodeira::measures
