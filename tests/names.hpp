// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gmock/gmock.h>

#include <string>
#include <string_view>

#include "common/core/base/result.hpp"

namespace rodeira {

// A message that names these things in this order: places, values and names, separated by " … ", such as
// "dir/a.yaml:3: … 'mas_kg' … 'mass_kg'". The words between them may change: one test a kind of message compares them,
// all others use this.
MATCHER_P(Names, things, "names, in this order, " + std::string(things)) {
  constexpr std::string_view kBetween = " … ";
  const std::string_view text(arg);
  std::string_view rest(things);
  std::size_t at = 0;
  while (true) {
    const std::size_t end = rest.find(kBetween);
    const std::string_view thing = rest.substr(0, end);
    const std::size_t found = thing.empty() ? std::string_view::npos : text.find(thing, at);
    if (found == std::string_view::npos) {
      *result_listener << "\"" << thing << "\" does not stand there";
      return false;
    }
    at = found + thing.size();
    if (end == std::string_view::npos) return true;
    rest.remove_prefix(end + kBetween.size());
  }
}

// An error with this id. Its text names these things.
inline testing::Matcher<const base::Error&> IsError(const std::string& id, const std::string& things) {
  return testing::AllOf(testing::ResultOf(
                            "the id", [](const base::Error& error) { return std::string(error.id.text()); }, id),
                        testing::ResultOf(
                            "the text", [](const base::Error& error) { return error.Text(); }, Names(things)));
}

}  // namespace rodeira
