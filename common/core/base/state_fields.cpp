// SPDX-License-Identifier: Apache-2.0
#include "common/core/base/state_fields.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "common/core/base/carried_state.hpp"

namespace rodeira::base {
namespace {

// Text of one scalar, or nothing for a type that no StateWriter writes.
std::optional<std::string> ScalarText(ByteReader& in, FieldScalar scalar, std::uint8_t size) {
  const auto text = [&]<class T>(T value) -> std::optional<std::string> { return fmt::format("{}", value); };
  switch (scalar) {
    case FieldScalar::kFloating:
      if (size == 8) return text(in.Get<double>());
      if (size == 4) return text(in.Get<float>());
      break;
    case FieldScalar::kSigned:
      if (size == 8) return text(in.Get<std::int64_t>());
      if (size == 4) return text(in.Get<std::int32_t>());
      if (size == 2) return text(in.Get<std::int16_t>());
      if (size == 1) return text(static_cast<int>(in.Get<std::int8_t>()));
      break;
    case FieldScalar::kUnsigned:
      if (size == 8) return text(in.Get<std::uint64_t>());
      if (size == 4) return text(in.Get<std::uint32_t>());
      if (size == 2) return text(in.Get<std::uint16_t>());
      if (size == 1) return text(static_cast<unsigned>(in.Get<std::uint8_t>()));
      break;
    case FieldScalar::kNone:
      break;
  }
  return std::nullopt;
}

// Of fields of the kind kCarried, contents are no difference.
std::vector<StateField> WithoutCarried(std::vector<StateField> fields) {
  const std::string within = "." + std::string(kCarried);
  std::erase_if(fields, [&](const StateField& field) {
    return field.path.starts_with(kCarried) || field.path.find(within) != std::string::npos;
  });
  return fields;
}

}  // namespace

Result<std::vector<StateField>> StateFields(std::span<const std::byte> state) {
  const auto cut = [] { return WrongInput("snapshot.wrong_field", "the snapshot's state ends within a field"); };
  ByteReader in(state);
  std::vector<StateField> fields;
  std::string part;
  while (in.remaining() > 0) {
    const std::string name = in.GetString();
    const auto shape = in.Get<FieldShape>();
    const auto scalar = in.Get<FieldScalar>();
    const auto size = in.Get<std::uint8_t>();
    if (!in.ok()) return cut();
    const std::string path = part.empty() ? name : part + "." + name;
    if (shape == FieldShape::kPart) {
      part = name;
    } else if (shape == FieldShape::kText) {
      fields.push_back({path, in.GetString()});
    } else if (shape == FieldShape::kScalar || shape == FieldShape::kList) {
      const bool list = shape == FieldShape::kList;
      const std::uint32_t count = list ? in.Get<std::uint32_t>() : 1;
      if (size == 0 || std::uint64_t{count} * size > in.remaining()) return cut();
      if (list) fields.push_back({path + ".size", fmt::format("{}", count)});
      for (std::uint32_t i = 0; i < count; ++i) {
        const auto value = ScalarText(in, scalar, size);
        if (!value)
          return WrongInput("snapshot.wrong_field",
                            fmt::format("state field '{}' has no type of a snapshot", path.substr(0, 64)));
        fields.push_back({list ? fmt::format("{}[{}]", path, i) : path, *value});
      }
    } else {
      return WrongInput("snapshot.wrong_field", fmt::format("state field '{}' has shape {}, which no snapshot has",
                                                            path.substr(0, 64), static_cast<int>(shape)));
    }
    if (!in.ok()) return cut();
  }
  return fields;
}

Result<std::optional<StateDifference>> FirstStateDifference(std::span<const std::byte> first,
                                                            std::span<const std::byte> second) {
  if (std::equal(first.begin(), first.end(), second.begin(), second.end())) return std::optional<StateDifference>();
  const auto a = StateFields(first);
  if (!a) return a.error();
  const auto b = StateFields(second);
  if (!b) return b.error();
  const std::vector<StateField> of_a = WithoutCarried(a.value()), of_b = WithoutCarried(b.value());
  for (std::size_t i = 0; i < std::max(of_a.size(), of_b.size()); ++i) {
    const bool in_a = i < of_a.size();
    const bool in_b = i < of_b.size();
    if (in_a && in_b && of_a[i] == of_b[i]) continue;
    if (in_a && in_b && of_a[i].path == of_b[i].path)
      return std::optional(StateDifference{of_a[i].path, of_a[i].value, of_b[i].value});
    return std::optional(StateDifference{in_a ? of_a[i].path : of_b[i].path, in_a ? of_a[i].value : "absent",
                                         in_b && !in_a ? of_b[i].value : "absent"});
  }
  if (SameButCarried(first, second)) return std::optional<StateDifference>();
  // The same texts of other bits: NaNs of another kind.
  return std::optional(StateDifference{"(a value that is no number)", "one pattern of bits", "another"});
}

}  // namespace rodeira::base
