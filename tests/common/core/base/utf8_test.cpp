// SPDX-License-Identifier: Apache-2.0
#include "common/core/base/utf8.hpp"

#include <gtest/gtest.h>

#include <cstdint>

#include "common/core/base/random.hpp"

namespace rodeira::base {
namespace {

// A Unicode scalar value, by the definition of UTF-8 (RFC 3629, 3).
std::string Encoded(std::uint32_t value) {
  const auto byte = [](std::uint32_t bits) { return static_cast<char>(bits); };
  if (value < 0x80) return {byte(value)};
  if (value < 0x800) return {byte(0xC0 | (value >> 6)), byte(0x80 | (value & 0x3F))};
  if (value < 0x10000) {
    return {byte(0xE0 | (value >> 12)), byte(0x80 | ((value >> 6) & 0x3F)), byte(0x80 | (value & 0x3F))};
  }
  return {byte(0xF0 | (value >> 18)), byte(0x80 | ((value >> 12) & 0x3F)), byte(0x80 | ((value >> 6) & 0x3F)),
          byte(0x80 | (value & 0x3F))};
}

TEST(Utf8, EveryScalarValueIsACharacter) {
  for (std::uint32_t value = 0; value <= 0x10FFFF; ++value) {
    if (value >= 0xD800 && value <= 0xDFFF) continue;  // surrogates
    const std::string text = Encoded(value);
    ASSERT_EQ(Utf8Length(text + "x"), text.size()) << value;
    ASSERT_FALSE(FirstNotUtf8(text)) << value;
  }
}

// There are as many characters of three bytes as scalar values from U+0800 to U+FFFF, and all of those are characters
// by the test above: so no other three bytes are one.
TEST(Utf8, NothingElseIs) {
  std::size_t characters[5] = {};
  for (std::uint32_t bits = 0; bits < 1u << 24; ++bits) {
    const char text[3] = {static_cast<char>(bits >> 16), static_cast<char>(bits >> 8), static_cast<char>(bits)};
    ++characters[Utf8Length({text, 3})];
  }
  EXPECT_EQ(characters[1], 0x80u << 16);
  EXPECT_EQ(characters[2], (0x800u - 0x80u) << 8);
  EXPECT_EQ(characters[3], 0x10000u - 0x800u - 0x800u);
  EXPECT_EQ(characters[4], 0u);
  for (const char* text : {"\xF0\x8F\xBF\xBF", "\xF4\x90\x80\x80", "\xF5\x80\x80\x80", "\xF1\x80\x80\x7F", ""}) {
    EXPECT_EQ(Utf8Length(text), 0u) << text;
  }
}

TEST(Utf8, OtherBytesBecomeVisible) {
  EXPECT_EQ(ToUtf8("gr\xFC\xDF"), "gr\\xfc\\xdf");
  EXPECT_EQ(ToUtf8("gr\xC3\xBC\n"), "gr\xC3\xBC\n");
  EXPECT_EQ(FirstNotUtf8("gr\xC3\xBC\xDF"), 4u);
  for (std::uint64_t number = 0; number < 20'000; ++number) {
    std::string text;
    for (std::uint64_t i = 0; i < number % 12; ++i) text += static_cast<char>(RandomBits({number, i}));
    ASSERT_FALSE(FirstNotUtf8(ToUtf8(text)));
    if (!FirstNotUtf8(text)) {
      ASSERT_EQ(ToUtf8(text), text);
    }
  }
}

}  // namespace
}  // namespace rodeira::base
