// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <concepts>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "common/core/base/bytes.hpp"
#include "common/core/base/hash.hpp"
#include "common/core/base/result.hpp"

namespace rodeira::base {

template <class T>
concept StateScalar = std::is_arithmetic_v<T> || std::is_enum_v<T>;

// How a field lies in a snapshot: what follows its name, and of which scalars.
enum class FieldShape : std::uint8_t { kScalar = 0, kList = 1, kText = 2, kPart = 3 };
enum class FieldScalar : std::uint8_t { kNone = 0, kSigned = 1, kUnsigned = 2, kFloating = 3 };

template <class T>
constexpr FieldScalar ScalarOf() {
  if constexpr (std::is_floating_point_v<T>) return FieldScalar::kFloating;
  if constexpr (std::is_enum_v<T>) return ScalarOf<std::underlying_type_t<T>>();
  return std::is_signed_v<T> ? FieldScalar::kSigned : FieldScalar::kUnsigned;
}

// Writes a node's state as named fields in a fixed order. Without names it is the input of a state digest.
class StateWriter {
 public:
  enum class Names { kWith, kWithout };
  explicit StateWriter(Names names = Names::kWith) : names_(names) {}

  template <StateScalar T>
  void Put(std::string_view name, T value) {
    Name(name, FieldShape::kScalar, ScalarOf<T>(), sizeof(T));
    out_.Put(value);
  }
  // Any contiguous range of scalars: Eigen vectors by std::span(v.data(), v.size()).
  template <StateScalar T>
  void Put(std::string_view name, std::span<const T> values) {
    Name(name, FieldShape::kList, ScalarOf<T>(), sizeof(T));
    out_.Put(static_cast<std::uint32_t>(values.size()));
    out_.PutRaw(std::as_bytes(values));
  }
  template <StateScalar T>
  void Put(std::string_view name, const std::vector<T>& values) {
    Put(name, std::span<const T>(values));
  }
  void Put(std::string_view name, const std::string& text) {
    Name(name, FieldShape::kText, FieldScalar::kNone, 1);
    out_.PutString(text);
  }
  // A part that saves itself: Save(StateWriter&) const.
  template <class Part>
  requires requires(const Part& part, StateWriter& writer) { part.Save(writer); }
  void Put(std::string_view name, const Part& part) {
    Name(name, FieldShape::kPart, FieldScalar::kNone, 0);
    part.Save(*this);
  }

  const Bytes& bytes() const { return out_.bytes(); }
  Digest digest() const { return Hash(out_.bytes()); }
  void Clear() { out_.Clear(); }

 private:
  void Name(std::string_view name, FieldShape shape, FieldScalar scalar, std::uint8_t size);

  Names names_;
  ByteWriter out_;
};

// Reads what StateWriter wrote with names. A field of another name or type is an error that names both.
class StateReader {
 public:
  explicit StateReader(std::span<const std::byte> bytes) : in_(bytes) {}

  template <StateScalar T>
  void Get(std::string_view name, T& value) {
    if (Expect(name, FieldShape::kScalar, ScalarOf<T>(), sizeof(T))) value = in_.Get<T>();
  }
  template <StateScalar T>
  void Get(std::string_view name, std::span<T> values) {
    if (!Expect(name, FieldShape::kList, ScalarOf<T>(), sizeof(T))) return;
    const auto count = in_.Get<std::uint32_t>();
    if (count != values.size()) return Fail(name, "another number of values");
    const auto raw = in_.GetRaw(values.size_bytes());
    if (in_.ok() && !raw.empty()) std::memcpy(values.data(), raw.data(), raw.size());
  }
  template <StateScalar T>
  void Get(std::string_view name, std::vector<T>& values) {
    if (!Expect(name, FieldShape::kList, ScalarOf<T>(), sizeof(T))) return;
    const auto count = in_.Get<std::uint32_t>();
    const auto raw = in_.GetRaw(std::size_t{count} * sizeof(T));
    if (!in_.ok()) return Fail(name, "the end of the snapshot");
    values.resize(count);
    if (!raw.empty()) std::memcpy(values.data(), raw.data(), raw.size());
  }
  void Get(std::string_view name, std::string& text) {
    if (Expect(name, FieldShape::kText, FieldScalar::kNone, 1)) text = in_.GetString();
  }
  template <class Part>
  requires requires(Part& part, StateReader& reader) { part.Restore(reader); }
  void Get(std::string_view name, Part& part) {
    if (Expect(name, FieldShape::kPart, FieldScalar::kNone, 0)) part.Restore(*this);
  }

  // The first field that did not fit, or what is left over at the end.
  Status Finish() const;

 private:
  bool Expect(std::string_view name, FieldShape shape, FieldScalar scalar, std::uint8_t size);
  void Fail(std::string_view name, std::string_view found);

  ByteReader in_;
  std::string problem_;
};

}  // namespace rodeira::base
