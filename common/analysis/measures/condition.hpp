// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/analysis/measures/series.hpp"

namespace rodeira::measures {

// A road by the name that it has in files. It is one road of the network, or several: its parts between junctions and
// its ways through them.
struct NamedRoad {
  struct Part {
    double road = 0.0;      // as in the column `road`
    double from_s_m = 0.0;  // where the part begins along the named road
  };
  std::string name;
  std::vector<Part> parts;
};

// Comparisons of columns of the time series with numbers, all of which must hold: "s_m >= 100 and s_m < 200". The
// column `road` is compared with a name, too: "road == 'valley' and s_m >= 100"; then s_m counts along the road of that
// name. A missing value fulfils none.
struct Condition {
  enum class Relation { kBelow, kAtMost, kAbove, kAtLeast, kEqual, kNotEqual };
  // One comparison.
  struct Term {
    std::size_t column = 0;  // of SeriesNames
    Relation relation = Relation::kEqual;
    double number = 0.0;
    std::string road;                    // instead of the number; empty: there is a number
    std::vector<NamedRoad::Part> parts;  // of that road, after FindRoads
  };
  std::string text;
  std::vector<Term> terms;

  // Looks up the names of roads. A sentence with the nearest right name where a name is none of these; otherwise empty.
  std::string FindRoads(std::span<const NamedRoad> roads);

  // Precondition: a sample of the drive; a condition with the name of a road has found it.
  bool Holds(const Drive& drive, std::size_t k) const;
};
// Wrong input, with the nearest right name, where a column, relation or number is none. A road's name stands in '' or
// without them; an unquoted number is the index of a road.
base::Result<Condition> ParseCondition(std::string_view text);

// The longest runs of samples [first, second) within [from, to) in which the condition holds throughout.
std::vector<std::pair<std::size_t, std::size_t>> SamplesWhile(const Condition& condition, const Drive& drive,
                                                              std::size_t from, std::size_t to);

}  // namespace rodeira::measures
