// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

// Which elements and attributes OpenDRIVE 1.4 to 1.8 has where, as far as this project reads or knows them.
namespace rodeira::opendrive {

// The names that may stand in an element.
struct KnownElement {
  std::vector<std::string> children, attributes;
  std::vector<std::string> once;  // of the children: those that may stand there only once
};

// By the element's own name and its parent's, since a name may mean two things (<type> of a road and of a mark).
// Null: what is known of such an element is nothing, and nothing below it is looked at.
const KnownElement* FindKnown(std::string_view parent, std::string_view element);

// The names of all elements that are known, each once, ascending.
std::vector<std::string> KnownNames();

// Words that an attribute may say; empty: anything. Files of others write them in letters of either case.
const std::vector<std::string>& WordsOf(std::string_view parent, std::string_view element, std::string_view attribute);

}  // namespace rodeira::opendrive
