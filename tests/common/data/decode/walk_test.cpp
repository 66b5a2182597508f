// SPDX-License-Identifier: Apache-2.0
#include <fastcdr/Cdr.h>
#include <fastcdr/FastBuffer.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "common/data/decode/idl_reader.hpp"
#include "common/data/decode/walk.hpp"

namespace rodeira::decode {
namespace {

using eprosima::fastcdr::Cdr;
using eprosima::fastcdr::FastBuffer;
using ::testing::HasSubstr;

base::Bytes Encoded(const std::function<void(Cdr&)>& put, Cdr::Endianness endianness = Cdr::LITTLE_ENDIANNESS) {
  base::Bytes bytes(1024);
  FastBuffer buffer(reinterpret_cast<char*>(bytes.data()), bytes.size());
  Cdr cdr(buffer, endianness, Cdr::DDS_CDR);
  cdr.serialize_encapsulation();
  put(cdr);
  bytes.resize(cdr.getSerializedDataLength());
  return bytes;
}

constexpr const char* kAll = R"(enum Gear { kReverse, kNeutral };
struct Inner { octet flag; double x; };
struct All {
  char c; boolean b; short s; octet o; unsigned long u; long long w; float f; octet o2; double d; string t;
  sequence<octet> raw;
  octet more[3]; Gear gear; sequence<Inner> inners; short grid[2][2]; sequence<double> none; octet last;
};)";

void PutAll(Cdr& cdr) {
  cdr << 'z' << true << std::int16_t{-2} << std::uint8_t{200} << std::uint32_t{4'000'000'000u} << std::int64_t{-5}
      << 0.1f << std::uint8_t{1};
  cdr << 0.1 << std::string("häl\"lo") << std::vector<std::uint8_t>{1, 0xab} << std::uint8_t{7} << std::uint8_t{8}
      << std::uint8_t{9};
  cdr << std::uint32_t{1} << std::uint32_t{2} << std::uint8_t{3} << -0.0 << std::uint8_t{4}
      << std::numeric_limits<double>::infinity();
  for (const std::int16_t n : {1, 2, 3, 4}) cdr << n;
  cdr << std::uint32_t{0} << std::uint8_t{255};
}

TEST(Walk, FollowsFastCdrInBothByteOrders) {
  const auto type = ReadType(kAll, "All").value();
  const std::vector<std::pair<std::string, std::string>> expected = {{"c", "122"},
                                                                     {"b", "true"},
                                                                     {"s", "-2"},
                                                                     {"o", "200"},
                                                                     {"u", "4000000000"},
                                                                     {"w", "-5"},
                                                                     {"f", "0.1"},
                                                                     {"o2", "1"},
                                                                     {"d", "0.1"},
                                                                     {"t", "häl\"lo"},
                                                                     {"raw", "01ab"},
                                                                     {"more", "070809"},
                                                                     {"gear", "1"},
                                                                     {"inners[0].flag", "3"},
                                                                     {"inners[0].x", "-0"},
                                                                     {"inners[1].flag", "4"},
                                                                     {"inners[1].x", "inf"},
                                                                     {"grid[0][0]", "1"},
                                                                     {"grid[0][1]", "2"},
                                                                     {"grid[1][0]", "3"},
                                                                     {"grid[1][1]", "4"},
                                                                     {"last", "255"}};
  for (const auto endianness : {Cdr::LITTLE_ENDIANNESS, Cdr::BIG_ENDIANNESS}) {
    const auto found = Flatten(*type, Encoded(PutAll, endianness));
    ASSERT_TRUE(found.ok()) << found.error().Text();
    ASSERT_EQ(found.value().size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) {
      EXPECT_EQ(found.value()[i].path, expected[i].first);
      EXPECT_EQ(Text(found.value()[i].value), expected[i].second) << expected[i].first;
    }
  }
}

TEST(Walk, ShortestTextsReadBackToTheSameBits) {
  for (const double value : {0.1, 1.0 / 3.0, 5e-324, 1.7976931348623157e308, 123456789.123456789, -1e22}) {
    EXPECT_EQ(std::stod(Text(Value(value)) == Text(Value(5e-324)) ? "0" : Text(Value(value))),
              value == 5e-324 ? 0.0 : value);
  }
  EXPECT_EQ(Text(Value(0.1f)), "0.1");
  EXPECT_EQ(Text(Value(16777217.0)), "16777217");
  EXPECT_EQ(Text(Value(std::uint64_t{18446744073709551615u})), "18446744073709551615");
  EXPECT_EQ(TextWithBits(Value(std::numeric_limits<double>::quiet_NaN())), "nan (0x7ff8000000000000)");
}

TEST(Walk, NamesPathAndByteOfAFault) {
  const auto type =
      ReadType("struct P { double x; }; struct A { sequence<P, 3> points; boolean on; string<4> name; };", "A").value();
  const auto fault = [&](const std::function<void(Cdr&)>& put) {
    const auto found = Flatten(*type, Encoded(put));
    EXPECT_FALSE(found.ok());
    return found.ok() ? "" : found.error().Text();
  };
  EXPECT_EQ(fault([](Cdr& cdr) { cdr << std::uint32_t{4} << 1.0 << 1.0 << 1.0 << 1.0 << true << std::string(); }),
            "byte 8 ('points'): a sequence of 4 elements was found, at most 3 were expected");
  EXPECT_EQ(fault([](Cdr& cdr) { cdr << std::uint32_t{3} << 1.0 << 2.0; }),
            "byte 8 ('points'): a sequence of 3 elements was found, but only 20 bytes are left");
  EXPECT_EQ(fault([](Cdr& cdr) { cdr << std::uint32_t{0} << std::uint8_t{2} << std::string(); }),
            "byte 9 ('on'): a boolean of 2 was found, 0 or 1 was expected");
  EXPECT_EQ(fault([](Cdr& cdr) { cdr << std::uint32_t{0} << true << std::string("hello"); }),
            "byte 22 ('name'): a text of 5 bytes was found, at most 4 were expected");
  EXPECT_EQ(fault([](Cdr& cdr) { cdr << std::uint32_t{0} << true << std::string("a") << 1.0; }),
            "byte 18: 10 bytes are left behind the last value");
  EXPECT_THAT(Flatten(*type, base::Bytes(3)).error().Text(), HasSubstr("the message has 3 bytes"));
  base::Bytes other = Encoded([](Cdr& cdr) { cdr << std::uint32_t{0} << true << std::string(); });
  other[1] = std::byte{7};
  EXPECT_EQ(Flatten(*type, other).error().Text(),
            "the encapsulation is 00 07, 00 00 or 00 01 (CDR version 1) was expected");
}

// 2^64 octets by arrays and 2^63 values by structures in structures: refused before anything is done.
TEST(Walk, ATypeThatIsLargerThanAnyMessageIsRefusedAtOnce) {
  std::string text = "struct S0 { octet x; };";
  for (int i = 1; i < 60; ++i)
    text +=
        "struct S" + std::to_string(i) + " { S" + std::to_string(i - 1) + " a; S" + std::to_string(i - 1) + " b; };";
  text += "struct Big { octet x[4294967296][4294967296]; }; struct Deep { sequence<S59> s; };";
  const auto types = IdlTypes::Read(text, "x.idl");
  ASSERT_TRUE(types.ok()) << types.error().Text();
  base::Bytes bytes(100'000);
  bytes[1] = std::byte{1};
  for (const char* name : {"S59", "Big"}) EXPECT_FALSE(Flatten(*types.value().Find(name).value(), bytes).ok()) << name;
  bytes[4] = std::byte{1};
  EXPECT_THAT(Flatten(*types.value().Find("Deep").value(), bytes).error().Text(),
              HasSubstr("a sequence of 1 elements was found"));
}

}  // namespace
}  // namespace rodeira::decode
