// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "common/data/decode/difference.hpp"
#include "common/data/decode/idl_reader.hpp"
#include "idl/codec.hpp"
#include "idl/messages.hpp"
#include "idl/topics.hpp"

namespace rodeira::decode {
namespace {

template <class Message>
std::string Between(const char* subject, const char* type, const Message& a, const Message& b) {
  const auto read = ReadType(idl::IdlTextOf(subject), type);
  const auto difference = FirstDifference(*read.value(), idl::Encode(a), idl::Encode(b));
  return difference ? difference->path + ": " + difference->a + " | " + difference->b : "";
}

TEST(FirstDifference, NamesMemberAndBothValuesInFullPrecision) {
  msg::VehicleState a;
  msg::VehicleState b;
  a.wheels()[2].load_n(0.1F);
  b.wheels()[2].load_n(std::nextafter(0.1F, 1.0F));
  b.wheels()[3].load_n(5.0F);
  EXPECT_EQ(Between("vehicle", "rodeira::msg::VehicleState", a, b), "wheels[2].load_n: 0.1 | 0.10000001");
  b = a;
  a.odometer_m(0.1);
  b.odometer_m(std::nextafter(0.1, 1.0));
  EXPECT_EQ(Between("vehicle", "rodeira::msg::VehicleState", a, b), "odometer_m: 0.1 | 0.10000000000000002");
  EXPECT_EQ(Between("vehicle", "rodeira::msg::VehicleState", a, a), "");
  b = a;
  b.fuel_used_kg(-0.0);
  EXPECT_EQ(Between("vehicle", "rodeira::msg::VehicleState", a, b), "fuel_used_kg: 0 | -0");
}

TEST(FirstDifference, OfLengthsTextsAndOctets) {
  msg::ScenarioEvents a;
  msg::ScenarioEvents b;
  a.events().resize(2);
  b.events().resize(3);
  EXPECT_EQ(Between("scenario", "rodeira::msg::ScenarioEvents", a, b), "events: 2 elements | 3 elements");
  b.events().resize(2);
  b.events()[1].name("traffic.brake");
  EXPECT_EQ(Between("scenario", "rodeira::msg::ScenarioEvents", a, b), "events[1].name:  | traffic.brake");
  msg::Snapshot c;
  msg::Snapshot d;
  c.content({1, 2, 3});
  d.content({1, 2, 4});
  EXPECT_EQ(Between("snapshot", "rodeira::msg::Snapshot", c, d), "content[2]: 0x03 | 0x04");
  d.content({1, 2});
  EXPECT_EQ(Between("snapshot", "rodeira::msg::Snapshot", c, d), "content[2]: 0x03 | nothing");
}

TEST(FirstDifference, OfTwoKindsOfNoNumberSaysTheBits) {
  msg::Controls a;
  msg::Controls b;
  a.brake(std::numeric_limits<double>::quiet_NaN());
  b.brake(-std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(Between("controls", "rodeira::msg::Controls", a, a), "");
  EXPECT_EQ(Between("controls", "rodeira::msg::Controls", a, b),
            "brake: nan (0x7ff8000000000000) | nan (0xfff8000000000000)");
}

TEST(FirstDifference, OfPaddingAndOfWhatIsNoMessage) {
  const auto type = ReadType("struct A { octet a; double b; };", "A").value();
  base::Bytes a(20);
  a[1] = std::byte{1};
  base::Bytes b = a;
  b[7] = std::byte{9};
  const auto padding = FirstDifference(*type, a, b);
  ASSERT_TRUE(padding);
  EXPECT_EQ(padding->path + padding->a + padding->b, "byte 70x000x09");
  b = a;
  b.resize(16);
  const auto cut = FirstDifference(*type, a, b);
  ASSERT_TRUE(cut);
  EXPECT_EQ(cut->path, "byte 16");
  EXPECT_EQ(cut->a, "0x00");
  EXPECT_EQ(cut->b, "byte 5 ('b'): the message ends after 11 bytes, where at least 15 more were expected");
  b.clear();
  EXPECT_EQ(FirstDifference(*type, a, b)->path, "byte 0");
}

}  // namespace
}  // namespace rodeira::decode
