// SPDX-License-Identifier: Apache-2.0
#include "common/core/base/carried_state.hpp"

#include <algorithm>
#include <string>

#include "common/core/base/state.hpp"

namespace rodeira::base {
namespace {

// Behind the next field, and whether it is carried.
struct NextField {
  std::size_t end = 0;  // 0: no whole field
  bool is_carried = false;
};

NextField FieldAt(std::span<const std::byte> state) {
  ByteReader in(state);
  const std::string name = in.GetString();
  const auto shape = in.Get<FieldShape>();
  (void)in.Get<FieldScalar>();
  const auto size = in.Get<std::uint8_t>();
  if (!in.ok()) return {};
  std::uint64_t content = 0;
  if (shape == FieldShape::kScalar) content = size;
  if (shape == FieldShape::kList) content = std::uint64_t{in.Get<std::uint32_t>()} * size;
  if (shape == FieldShape::kText) content = in.Get<std::uint32_t>();
  if (!in.ok() || content > in.remaining()) return {};
  return {state.size() - in.remaining() + static_cast<std::size_t>(content), name.starts_with(kCarried)};
}

}  // namespace

bool SameButCarried(std::span<const std::byte> first, std::span<const std::byte> second) {
  while (!first.empty() && !second.empty()) {
    const NextField a = FieldAt(first), b = FieldAt(second);
    if (a.end == 0 || b.end == 0 || a.is_carried != b.is_carried) return false;
    if (!a.is_carried && !std::ranges::equal(first.first(a.end), second.first(b.end))) return false;
    first = first.subspan(a.end);
    second = second.subspan(b.end);
  }
  return first.empty() && second.empty();
}

}  // namespace rodeira::base
