// SPDX-License-Identifier: Apache-2.0
#include "common/data/decode/value.hpp"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <type_traits>

namespace rodeira::decode {
namespace {

std::uint64_t Bits(double value) { return std::bit_cast<std::uint64_t>(value); }
std::uint32_t Bits(float value) { return std::bit_cast<std::uint32_t>(value); }

}  // namespace

std::string Text(const Value& value) {
  return std::visit(
      [](const auto& v) -> std::string {
        using T = std::decay_t<decltype(v)>;
        if constexpr (std::is_same_v<T, std::string>) {
          return v;
        } else if constexpr (std::is_same_v<T, base::Bytes>) {
          constexpr char kDigits[] = "0123456789abcdef";
          std::string text;
          text.reserve(2 * v.size());
          for (const std::byte byte : v) {
            text += kDigits[std::to_integer<unsigned>(byte) >> 4];
            text += kDigits[std::to_integer<unsigned>(byte) & 15u];
          }
          return text;
        } else if constexpr (std::is_floating_point_v<T>) {
          return std::isnan(v) ? "nan" : fmt::format("{}", v);  // a NaN's sign is no part of its text
        } else {
          return fmt::format("{}", v);
        }
      },
      value);
}

std::string TextWithBits(const Value& value) {
  const auto* wide = std::get_if<double>(&value);
  if (wide != nullptr && std::isnan(*wide)) return fmt::format("nan (0x{:016x})", Bits(*wide));
  const auto* narrow = std::get_if<float>(&value);
  if (narrow != nullptr && std::isnan(*narrow)) return fmt::format("nan (0x{:08x})", Bits(*narrow));
  return Text(value);
}

bool SameBits(const Value& a, const Value& b) {
  if (a.index() != b.index()) return false;
  if (const auto* wide = std::get_if<double>(&a)) return Bits(*wide) == Bits(std::get<double>(b));
  if (const auto* narrow = std::get_if<float>(&a)) return Bits(*narrow) == Bits(std::get<float>(b));
  return a == b;
}

}  // namespace rodeira::decode
