// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/world/opendrive/finding.hpp"

// Changes of an XML text that leave every other byte as it is.
namespace rodeira::opendrive {

// The text is well-formed XML, and an element begins at `begin` with its '<'.
std::size_t TagEnd(std::string_view text, std::size_t begin);      // behind the '>' of its start tag
std::size_t ElementEnd(std::string_view text, std::size_t begin);  // behind its end tag
// Replaces an attribute's value, or adds the attribute behind the element's name. The value is written as it is,
// without escaping.
Edit SetAttribute(std::string_view text, std::size_t begin, std::string_view name, std::string_view value);
// XML as the element's last child.
Edit AppendChild(std::string_view text, std::size_t begin, std::string_view xml);

// Where the bytes of a text were before it was edited.
class OffsetMap {
 public:
  // Edits ascending, none overlapping.
  explicit OffsetMap(std::span<const Edit> edits);
  // Of a byte of the edited text, its offset in the original; of inserted text, the beginning of what it replaced.
  std::size_t Before(std::size_t offset) const;

 private:
  struct Piece {
    std::size_t now, before;
    bool kept;
  };
  std::vector<Piece> pieces_;  // ascending
};

// Sorts the edits and takes those out that reach into a kept one: the longer of two is kept. Equal ones are one.
std::vector<Edit> Compatible(std::vector<Edit> edits);
// Edits ascending, none overlapping; their offsets are those of `text`.
std::string Apply(std::string_view text, std::span<const Edit> edits);

}  // namespace rodeira::opendrive
