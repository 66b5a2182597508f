// SPDX-License-Identifier: Apache-2.0
// The generic decoder against broken payloads of every topic and broken IDL texts: never a crash, never another value
// than the generated code reads, always a sentence. RODEIRA_FUZZ_FILES sets how many are tried a topic,
// RODEIRA_FUZZ_FIRST the first.
#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>

#include "common/data/decode/difference.hpp"
#include "common/data/decode/idl_reader.hpp"
#include "idl/codec.hpp"
#include "idl/topics.hpp"
#include "tests/common/data/decode/fields.hpp"
#include "tests/property/fuzz.hpp"
#include "tests/property/mutate.hpp"

namespace rodeira::decode {
namespace {

using property::Draw;
using property::Setting;

// A change that a broken disk, a wrong length or malice makes.
void Break(base::Bytes& bytes, Draw& draw) {
  if (bytes.empty()) return;
  const std::size_t at = draw.Below(bytes.size());
  const std::uint32_t lengths[] = {
      0,    1,    2,      3,          4,          5,          7,
      0x7F, 0xFF, 0xFFFF, 0x7FFFFFFF, 0x80000000, 0xFFFFFFFF, static_cast<std::uint32_t>(bytes.size())};
  const std::size_t aligned = at / 4 * 4;
  switch (draw.Below(7)) {
    case 0:
      bytes[at] ^= static_cast<std::byte>(1u << draw.Below(8));
      break;
    case 1:
      bytes[at] = static_cast<std::byte>(draw.Bits());
      break;
    case 2:
    case 3: {
      const std::uint32_t length = lengths[draw.Below(std::size(lengths))];
      if (aligned + 4 <= bytes.size()) std::memcpy(bytes.data() + aligned, &length, 4);
      break;
    }
    case 4:
      bytes.resize(at);
      break;
    case 5:
      bytes.insert(bytes.begin() + static_cast<std::ptrdiff_t>(at), 1 + draw.Below(9),
                   static_cast<std::byte>(draw.Bits()));
      break;
    default:
      bytes.erase(bytes.begin() + static_cast<std::ptrdiff_t>(at),
                  bytes.begin() + static_cast<std::ptrdiff_t>(std::min(bytes.size(), at + 1 + draw.Below(9))));
  }
}

TEST(Decode, BrokenPayloadsGiveWhatTheGeneratedCodeReadsOrASentence) {
  const std::size_t first = Setting("RODEIRA_FUZZ_FIRST", 0);
  const std::size_t count = Setting("RODEIRA_FUZZ_FILES", 4000);
  ForEveryTopicType([&](auto tag, std::string_view name) {
    using Message = typename decltype(tag)::type;
    const auto info =
        std::find_if(idl::Topics().begin(), idl::Topics().end(), [&](const auto& topic) { return topic.type == name; });
    const TypePtr type = ReadType(idl::IdlTextOf(info->subject), std::string(name)).value();
    std::size_t read = 0;
    std::size_t refused = 0;
    for (std::size_t number = first; number < first + count; ++number) {
      Draw draw(number);
      const base::Bytes whole = idl::Encode(Filled<Message>(draw.Bits() % 64));
      base::Bytes bytes = whole;
      for (std::size_t changes = 1 + draw.Below(3); changes > 0; --changes) Break(bytes, draw);
      const auto found = Flatten(*type, bytes);
      auto typed = idl::Decode<Message>(bytes);
      const auto difference = FirstDifference(*type, whole, bytes);
      ASSERT_EQ(difference.has_value(), whole != bytes) << name << ", " << number;
      if (difference) {
        ASSERT_NE(difference->a, difference->b) << name << ", " << number << ", " << difference->path;
      }
      if (!found) {
        ++refused;
        ASSERT_FALSE(found.error().message.empty());
        const bool left_over = found.error().message.find("are left behind") != std::string::npos;
        const bool big_endian = bytes.size() > 1 && bytes[1] == std::byte{0};
        ASSERT_TRUE(!typed || left_over || big_endian) << name << ", " << number << ": " << found.error().message;
        continue;
      }
      ++read;
      if (bytes[1] == std::byte{0}) continue;  // big-endian: the generated code's door takes little-endian only
      ASSERT_TRUE(typed.ok()) << name << ", " << number << ": " << typed.error().Text();
      const auto expected = Listed(typed.value());
      ASSERT_EQ(found.value().size(), expected.size()) << name << ", " << number;
      for (std::size_t i = 0; i < expected.size(); ++i) {
        ASSERT_EQ(found.value()[i].path, expected[i].path) << name << ", " << number;
        ASSERT_TRUE(SameBits(found.value()[i].value, expected[i].value))
            << name << ", " << number << ", " << expected[i].path;
      }
    }
    if (count < 1000) return;
    EXPECT_GT(read, count / 50) << name << ": all is refused at the door";
    EXPECT_GT(refused, count / 50) << name << ": nothing is refused";
  });
}

TEST(Decode, BrokenIdlTextsGiveATypeThatWorksOrASentence) {
  const std::string rich =
      "module a { const long kN = 2; enum E { kA, kB }; @final struct I { @key long x[a::kN]; double y; }; typedef "
      "sequence<I, 3> L;\n"
      "struct O { I i; L l; string<5> s; sequence<octet> o; E e; boolean b; @unit(\"m\") short g[2][3]; }; };\n";
  const std::size_t first = Setting("RODEIRA_FUZZ_FIRST", 0);
  const std::size_t count = Setting("RODEIRA_FUZZ_FILES", 4000) * 3;
  std::size_t accepted = 0;
  for (std::size_t number = first; number < first + count; ++number) {
    Draw draw(number);
    const auto& texts = idl::IdlTexts();
    std::string text = draw.Below(2) == 0 ? rich : texts[draw.Below(texts.size())].text;
    for (std::size_t changes = 1 + draw.Below(3); changes > 0; --changes) property::Mutate(text, draw);
    const auto types = IdlTypes::Read(text, "fuzz.idl");
    if (!types) {
      ASSERT_EQ(types.error().exit_status(), 2);
      ASSERT_TRUE(types.error().context.starts_with("fuzz.idl:")) << types.error().Text();
      for (const char c : types.error().Text()) ASSERT_FALSE((c >= 0 && c < 0x20) || c == 0x7F) << types.error().Text();
      continue;
    }
    ++accepted;
    base::Bytes payload(4 + draw.Below(300));
    for (std::byte& byte : payload) byte = static_cast<std::byte>(draw.Below(3));
    payload[0] = std::byte{0};
    payload[1] = std::byte{1};
    for (const auto& [name, type] : types.value().types()) {
      const auto found = Flatten(*type, payload);
      if (found) {
        ASSERT_LE(found.value().size(), payload.size());
      } else {
        ASSERT_FALSE(found.error().message.empty());
      }
    }
  }
  if (count < 1000) return;
  EXPECT_GT(accepted, count / 50);
  EXPECT_LT(accepted, count - count / 5);
}

}  // namespace
}  // namespace rodeira::decode
