// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/analysis/measures/series.hpp"

namespace rodeira::measures {

// Comparisons of columns of the time series with numbers, all of which must hold: "s_m >= 100 and s_m < 200". A missing
// value fulfils none.
struct Condition {
  enum class Relation { kBelow, kAtMost, kAbove, kAtLeast, kEqual, kNotEqual };
  // One comparison.
  struct Term {
    std::size_t column = 0;  // of SeriesNames
    Relation relation = Relation::kEqual;
    double number = 0.0;
  };
  std::string text;
  std::vector<Term> terms;

  // Precondition: a sample of the drive.
  bool Holds(const Drive& drive, std::size_t k) const;
};
// Wrong input, with the nearest right name, where a column, relation or number is none.
base::Result<Condition> ParseCondition(std::string_view text);

// The longest runs of samples [first, second) within [from, to) in which the condition holds throughout.
std::vector<std::pair<std::size_t, std::size_t>> SamplesWhile(const Condition& condition, const Drive& drive,
                                                              std::size_t from, std::size_t to);

}  // namespace rodeira::measures
