// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rodeira::base {

// The candidate with the smallest edit distance (insert, delete, replace, swap of neighbours), or an empty text
// where even that differs in more than a third of the longer name's letters. Ties: the first candidate.
std::string NearestName(std::string_view name, std::span<const std::string> candidates);

// "; did you mean 'x'?" or, where nothing is near, "; known are a, b, c" (at most twelve), for the end of a sentence.
std::string DidYouMean(std::string_view name, const std::vector<std::string>& candidates);

}  // namespace rodeira::base
