// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gmock/gmock.h>

#include <optional>
#include <string>
#include <string_view>

#include "common/core/base/result.hpp"

namespace rodeira {

// Messages are compared by the things that they name: places, values and names in their order, separated by " … ", such
// as "dir/a.yaml:3: … 'mas_kg' … 'mass_kg'". The words between them may change: one test a kind of message compares
// them, all others use what follows.

// The first of the things that a text does not name in their order; nothing: it names them all.
inline std::optional<std::string_view> MissingOf(std::string_view things, std::string_view text) {
  constexpr std::string_view kBetween = " … ";
  std::size_t at = 0;
  while (true) {
    const std::size_t end = things.find(kBetween);
    const std::string_view thing = things.substr(0, end);
    const std::size_t found = thing.empty() ? std::string_view::npos : text.find(thing, at);
    if (found == std::string_view::npos) return thing;
    at = found + thing.size();
    if (end == std::string_view::npos) return std::nullopt;
    things.remove_prefix(end + kBetween.size());
  }
}

// Whether one line of a text names them all.
inline bool HasLineWith(std::string_view things, std::string_view text) {
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    if (!MissingOf(things, text.substr(0, end))) return true;
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  }
  return false;
}

MATCHER_P(Names, things, "names, in this order, " + std::string(things)) {
  const auto missing = MissingOf(things, arg);
  if (missing) *result_listener << "\"" << *missing << "\" does not stand there";
  return !missing;
}

// For texts of several lines, such as what a run says.
MATCHER_P(HasLine, things, "has a line that names, in this order, " + std::string(things)) {
  return HasLineWith(things, arg);
}

// An error with this id. Its text names these things.
inline testing::Matcher<const base::Error&> IsError(const std::string& id, const std::string& things) {
  return testing::AllOf(testing::ResultOf(
                            "the id", [](const base::Error& error) { return std::string(error.id.text()); }, id),
                        testing::ResultOf(
                            "the text", [](const base::Error& error) { return error.Text(); }, Names(things)));
}

}  // namespace rodeira
