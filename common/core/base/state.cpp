// SPDX-License-Identifier: Apache-2.0
#include "common/core/base/state.hpp"

#include <fmt/format.h>

namespace rodeira::base {

void StateWriter::Name(std::string_view name, FieldShape shape, FieldScalar scalar, std::uint8_t size) {
  if (names_ == Names::kWithout) return;
  out_.PutString(name);
  out_.Put(shape);
  out_.Put(scalar);
  out_.Put(size);
}

bool StateReader::Expect(std::string_view name, FieldShape shape, FieldScalar scalar, std::uint8_t size) {
  if (!problem_.empty()) return false;
  const std::string found = in_.GetString();
  const auto found_shape = in_.Get<FieldShape>();
  const auto found_scalar = in_.Get<FieldScalar>();
  const auto found_size = in_.Get<std::uint8_t>();
  if (!in_.ok()) {
    Fail(name, "the end of the snapshot");
    return false;
  }
  if (found != name) {
    Fail(name, "field '" + found.substr(0, 64) + "'");
    return false;
  }
  if (found_shape != shape || found_scalar != scalar || found_size != size) {
    Fail(name, fmt::format("another type (shape {}, scalar {}, {} bytes instead of {}, {}, {})",
                           static_cast<int>(found_shape), static_cast<int>(found_scalar), found_size,
                           static_cast<int>(shape), static_cast<int>(scalar), size));
    return false;
  }
  return true;
}

bool StateReader::Has(std::string_view name) const {
  ByteReader ahead = in_;
  return problem_.empty() && ahead.ok() && ahead.remaining() > 0 && ahead.GetString() == name && ahead.ok();
}

void StateReader::Fail(std::string_view name, std::string_view found) {
  if (problem_.empty()) problem_ = fmt::format("state field '{}' was expected, found {}", name, found);
}

Status StateReader::Finish() const {
  if (!problem_.empty()) return WrongInput("snapshot.wrong_field", problem_);
  if (!in_.ok()) return WrongInput("snapshot.wrong_field", "the snapshot ends within a field");
  if (in_.remaining() != 0)
    return WrongInput("snapshot.wrong_field",
                      fmt::format("{} bytes are left over after the last state field", in_.remaining()));
  return {};
}

}  // namespace rodeira::base
