// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "common/core/base/random.hpp"

namespace rodeira::property {

// Random numbers of one mutated text: a pure function of its number.
class Draw {
 public:
  explicit Draw(std::uint64_t text) : text_(text) {}
  std::uint64_t Bits() { return base::RandomBits({20250117, text_, count_++}); }
  // In [0, end); 0 where end is 0.
  std::size_t Below(std::size_t end) { return end == 0 ? 0 : static_cast<std::size_t>(Bits() % end); }

 private:
  std::uint64_t text_;
  std::uint64_t count_ = 0;
};

// A number as a malicious author may write it: zero, huge, tiny, none, with a comma.
std::string_view EdgeNumber(Draw& draw);

// One change such as a slip of the hand, a broken transfer or malice makes: bytes flipped, put in, cut out
// or cut off; pieces said twice; lines swapped, doubled, lost or shifted; numbers replaced by ones at an edge; brackets
// without end.
void Mutate(std::string& text, Draw& draw);

}  // namespace rodeira::property
