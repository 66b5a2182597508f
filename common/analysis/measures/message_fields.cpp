// SPDX-License-Identifier: Apache-2.0
#include "common/analysis/measures/message_fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>

#include "common/core/base/suggest.hpp"

namespace rodeira::measures {
namespace {

using decode::Kind;

template <class T>
double NumberAt(const std::byte* at, bool swap) {
  std::byte raw[sizeof(T)];
  std::memcpy(raw, at, sizeof(T));
  if (swap) std::reverse(raw, raw + sizeof(T));
  T value;
  std::memcpy(&value, raw, sizeof(T));
  return static_cast<double>(value);
}

double PlainAt(Kind kind, const std::byte* at, bool swap) {
  switch (kind) {
    case Kind::kInt8:
      return NumberAt<std::int8_t>(at, swap);
    case Kind::kInt16:
      return NumberAt<std::int16_t>(at, swap);
    case Kind::kUint16:
      return NumberAt<std::uint16_t>(at, swap);
    case Kind::kInt32:
      return NumberAt<std::int32_t>(at, swap);
    case Kind::kUint32:
    case Kind::kEnum:
      return NumberAt<std::uint32_t>(at, swap);
    case Kind::kInt64:
      return NumberAt<std::int64_t>(at, swap);
    case Kind::kUint64:
      return NumberAt<std::uint64_t>(at, swap);
    case Kind::kFloat:
      return NumberAt<float>(at, swap);
    case Kind::kDouble:
      return NumberAt<double>(at, swap);
    default:
      return NumberAt<std::uint8_t>(at, swap);
  }
}

std::size_t BytesOf(Kind kind) {
  return kind == Kind::kEnum ? sizeof(std::uint32_t) : static_cast<std::size_t>(decode::PlainBytes(kind));
}

}  // namespace

// Appends the numbers of the type in the order of their bytes. False where something else comes before stop_before, or
// before the last field.
bool MessageFields::AddSteps(const decode::Type& type, const std::string& path, const std::vector<std::string>& fields,
                             std::string_view stop_before, std::vector<Step>& steps) {
  if (decode::IsPlain(type.kind) || type.kind == Kind::kEnum) {
    const auto found = std::ranges::find(fields, path);
    const int slot = found == fields.end() ? -1 : static_cast<int>(found - fields.begin());
    steps.push_back({type.kind, BytesOf(type.kind), slot});
    return true;
  }
  if (type.kind == Kind::kArray) {
    for (std::uint64_t i = 0; i < type.length; ++i) {
      if (!AddSteps(*type.element, fmt::format("{}[{}]", path, i), fields, {}, steps)) return false;
    }
    return true;
  }
  if (type.kind != Kind::kStruct) return false;
  for (const decode::Member& member : type.members) {
    if (!stop_before.empty() && member.name == stop_before) return true;
    const std::string inner = path.empty() ? member.name : path + "." + member.name;
    if (!AddSteps(*member.type, inner, fields, {}, steps)) return false;
  }
  return true;
}

base::Result<MessageFields> MessageFields::Make(const decode::Type& type, const std::vector<std::string>& fields,
                                                std::string_view sequence, const std::vector<std::string>& row_fields) {
  MessageFields made;
  // What follows the last field may be anything: it is not read.
  AddSteps(type, "", fields, sequence, made.steps_);
  const auto missing = [&type](const std::vector<std::string>& names, const std::vector<Step>& steps) -> base::Status {
    for (std::size_t i = 0; i < names.size(); ++i) {
      const auto is_it = [i](const Step& step) { return step.slot == static_cast<int>(i); };
      if (std::ranges::none_of(steps, is_it))
        return base::WrongInput("message.unknown_field",
                                fmt::format("its type {} has no number '{}'", type.name, names[i]));
    }
    return {};
  };
  if (auto status = missing(fields, made.steps_); !status) return status.error();
  if (sequence.empty()) {
    while (!made.steps_.empty() && made.steps_.back().slot < 0) made.steps_.pop_back();
    return made;
  }
  const decode::Type* rows = decode::FindMember(type, sequence);
  if (rows == nullptr || rows->kind != Kind::kSequence)
    return base::WrongInput("message.unknown_field",
                            fmt::format("its type {} has no sequence '{}'", type.name, sequence));
  if (!AddSteps(*rows->element, "", row_fields, {}, made.row_steps_))
    return base::WrongInput(
        "message.unknown_field",
        fmt::format("the elements of '{}' of its type {} are not numbers alone", sequence, type.name));
  if (auto status = missing(row_fields, made.row_steps_); !status) return status.error();
  made.has_rows_ = true;
  made.row_size_ = row_fields.size();
  return made;
}

bool MessageFields::Read(std::span<const std::byte> payload, std::span<double> out,
                         const std::function<void(std::span<const double>)>& row) const {
  constexpr std::size_t kEncapsulation = 4;
  if (payload.size() < kEncapsulation || payload[0] != std::byte{0} || payload[1] > std::byte{1}) return false;
  const bool little = payload[1] == std::byte{1};
  const bool swap = little != (std::endian::native == std::endian::little);
  const auto body = payload.subspan(kEncapsulation);
  std::size_t at = 0;
  const auto read = [&](const std::vector<Step>& steps, std::span<double> into) {
    for (const Step& step : steps) {
      at = (at + step.bytes - 1) & ~(step.bytes - 1);  // a power of 2: a division here costs a tenth of all reading
      if (at + step.bytes > body.size()) return false;
      if (step.slot >= 0) into[static_cast<std::size_t>(step.slot)] = PlainAt(step.kind, body.data() + at, swap);
      at += step.bytes;
    }
    return true;
  };
  if (!read(steps_, out)) return false;
  if (!has_rows_ || !row) return true;
  at = (at + 3) / 4 * 4;
  if (at + 4 > body.size()) return false;
  const auto length = static_cast<std::size_t>(PlainAt(Kind::kUint32, body.data() + at, swap));
  at += 4;
  std::vector<double> values(row_size_);
  for (std::size_t i = 0; i < length; ++i) {
    if (!read(row_steps_, values)) return false;
    row(values);
  }
  return true;
}

}  // namespace rodeira::measures
