// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "common/core/base/bytes.hpp"
#include "common/core/base/random.hpp"

// Files with changes drawn from a number, for tests of what reads them.
namespace rodeira::record {

// Draws of one mutated file: a pure function of its number.
class Draw {
 public:
  explicit Draw(std::uint64_t file) : file_(file) {}
  std::uint64_t Bits() { return base::RandomBits({20240611, file_, count_++}); }
  std::size_t Below(std::size_t end) { return end == 0 ? 0 : static_cast<std::size_t>(Bits() % end); }

 private:
  std::uint64_t file_;
  std::uint64_t count_ = 0;
};

// Changes a few bytes at a drawn place: turns, overwrites, takes out, doubles, cuts off, clears.
void Mutate(base::Bytes& bytes, Draw& draw);
// The same at or behind the beginning of one of the file's records, so that small records are met as often as large
// ones.
void MutateARecord(base::Bytes& bytes, Draw& draw);
// Makes the checksums right again (of uncompressed chunks, of attachments, of all data, of the summary), so that the
// changes reach what lies behind them.
void Reseal(base::Bytes& bytes);

}  // namespace rodeira::record
