// SPDX-License-Identifier: Apache-2.0
#pragma once

/// @file
/// Snapshots: the state of a node or model as named fields.

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

/// A type of one field: a number, a bool or an enumeration.
/// @tparam T type that is tested
template <class T>
concept StateScalar = std::is_arithmetic_v<T> || std::is_enum_v<T>;

/// The layout of a field in a snapshot, behind its name.
enum class FieldShape : std::uint8_t {
  kScalar = 0,  ///< one scalar
  kList = 1,    ///< number of scalars (32 bits), then the scalars
  kText = 2,    ///< number of bytes (32 bits), then the bytes
  kPart = 3,    ///< the fields of a part that saves itself
};
/// The kind of a field's scalars.
enum class FieldScalar : std::uint8_t {
  kNone = 0,      ///< a text or a part
  kSigned = 1,    ///< signed integers
  kUnsigned = 2,  ///< unsigned integers, bool
  kFloating = 3,  ///< floating-point numbers
};

/// Gives the kind of a scalar type; an enumeration counts as its underlying type.
/// @tparam T arithmetic or enumeration type
/// @return the kind
template <class T>
constexpr FieldScalar ScalarOf() {
  if constexpr (std::is_floating_point_v<T>) return FieldScalar::kFloating;
  if constexpr (std::is_enum_v<T>) return ScalarOf<std::underlying_type_t<T>>();
  return std::is_signed_v<T> ? FieldScalar::kSigned : FieldScalar::kUnsigned;
}

/// Writes the state of a node or model as named fields in a fixed order. Without names the bytes are the input of a
/// state digest.
class StateWriter {
 public:
  /// Whether the names and types of the fields are written.
  enum class Names {
    kWith,     ///< for snapshots, which StateReader reads
    kWithout,  ///< for digests
  };
  /// Makes a writer without fields.
  /// @param names whether names and types are written
  explicit StateWriter(Names names = Names::kWith) : names_(names) {}

  /// Writes a scalar.
  /// @tparam T type of the scalar
  /// @param name name of the field; StateReader::Get expects the same name
  /// @param value the value
  template <StateScalar T>
  void Put(std::string_view name, T value) {
    Name(name, FieldShape::kScalar, ScalarOf<T>(), sizeof(T));
    out_.Put(value);
  }
  /// Writes a contiguous range of scalars. An Eigen vector `v` is written as std::span<const double>(v.data(), 3).
  /// @tparam T type of the scalars
  /// @param name name of the field
  /// @param values the values
  template <StateScalar T>
  void Put(std::string_view name, std::span<const T> values) {
    Name(name, FieldShape::kList, ScalarOf<T>(), sizeof(T));
    out_.Put(static_cast<std::uint32_t>(values.size()));
    out_.PutRaw(std::as_bytes(values));
  }
  /// Writes a vector of scalars.
  /// @tparam T type of the scalars
  /// @param name name of the field
  /// @param values the values
  template <StateScalar T>
  void Put(std::string_view name, const std::vector<T>& values) {
    Put(name, std::span<const T>(values));
  }
  /// Writes a text.
  /// @param name name of the field
  /// @param text the text
  void Put(std::string_view name, const std::string& text) {
    Name(name, FieldShape::kText, FieldScalar::kNone, 1);
    out_.PutString(text);
  }
  /// Writes a part that has the function `void Save(StateWriter&) const`.
  /// @tparam Part type of the part
  /// @param name name of the field
  /// @param part the part
  template <class Part>
  requires requires(const Part& part, StateWriter& writer) { part.Save(writer); }
  void Put(std::string_view name, const Part& part) {
    Name(name, FieldShape::kPart, FieldScalar::kNone, 0);
    part.Save(*this);
  }

  /// Gives the written bytes.
  /// @return all bytes since construction or Clear
  const Bytes& bytes() const { return out_.bytes(); }
  /// Computes the digest of the written bytes.
  /// @return digest of bytes()
  Digest digest() const { return Hash(out_.bytes()); }
  /// Removes all fields.
  void Clear() { out_.Clear(); }

 private:
  void Name(std::string_view name, FieldShape shape, FieldScalar scalar, std::uint8_t size);

  Names names_;
  ByteWriter out_;
};

/// Reads the fields that a StateWriter wrote with names, in the same order. A field of another name or type is an error
/// that names both. After the first error every Get leaves its value as it is; Finish gives the error.
class StateReader {
 public:
  /// Starts at the first field.
  /// @param bytes a snapshot; the bytes must outlive the reader
  explicit StateReader(std::span<const std::byte> bytes) : in_(bytes) {}

  /// Reads a scalar.
  /// @tparam T type of the scalar, as it was written
  /// @param name name of the field
  /// @param value the variable that receives the value
  template <StateScalar T>
  void Get(std::string_view name, T& value) {
    if (Expect(name, FieldShape::kScalar, ScalarOf<T>(), sizeof(T))) value = in_.Get<T>();
  }
  /// Reads a range of scalars; another number of scalars is an error.
  /// @tparam T type of the scalars, as they were written
  /// @param name name of the field
  /// @param values the variables that receive the values
  template <StateScalar T>
  void Get(std::string_view name, std::span<T> values) {
    if (!Expect(name, FieldShape::kList, ScalarOf<T>(), sizeof(T))) return;
    const auto count = in_.Get<std::uint32_t>();
    if (count != values.size()) return Fail(name, "another number of values");
    const auto raw = in_.GetRaw(values.size_bytes());
    if (in_.ok() && !raw.empty()) std::memcpy(values.data(), raw.data(), raw.size());
  }
  /// Reads a vector of scalars; the vector takes the number of scalars of the snapshot.
  /// @tparam T type of the scalars, as they were written
  /// @param name name of the field
  /// @param values the vector that receives the values
  template <StateScalar T>
  void Get(std::string_view name, std::vector<T>& values) {
    if (!Expect(name, FieldShape::kList, ScalarOf<T>(), sizeof(T))) return;
    const auto count = in_.Get<std::uint32_t>();
    const auto raw = in_.GetRaw(std::size_t{count} * sizeof(T));
    if (!in_.ok()) return Fail(name, "the end of the snapshot");
    values.resize(count);
    if (!raw.empty()) std::memcpy(values.data(), raw.data(), raw.size());
  }
  /// Reads a text.
  /// @param name name of the field
  /// @param text the variable that receives the text
  void Get(std::string_view name, std::string& text) {
    if (Expect(name, FieldShape::kText, FieldScalar::kNone, 1)) text = in_.GetString();
  }
  /// Reads a part that has the function `void Restore(StateReader&)`.
  /// @tparam Part type of the part
  /// @param name name of the field
  /// @param part the part that is restored
  template <class Part>
  requires requires(Part& part, StateReader& reader) { part.Restore(reader); }
  void Get(std::string_view name, Part& part) {
    if (Expect(name, FieldShape::kPart, FieldScalar::kNone, 0)) part.Restore(*this);
  }

  /// Says whether the next field has this name: of a field that is written only where it is needed.
  /// @param name name of the field
  /// @return false also at the end of the snapshot, and after an error
  bool Has(std::string_view name) const;

  /// Ends the reading.
  /// @return wrong input if a field did not fit, the snapshot ends within a field, or bytes are left over
  Status Finish() const;

 private:
  bool Expect(std::string_view name, FieldShape shape, FieldScalar scalar, std::uint8_t size);
  void Fail(std::string_view name, std::string_view found);

  ByteReader in_;
  std::string problem_;
};

}  // namespace rodeira::base
