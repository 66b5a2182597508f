// SPDX-License-Identifier: Apache-2.0
#include "common/data/decode/type_text.hpp"

#include <gtest/gtest.h>

#include "common/data/decode/aliases.hpp"
#include "common/data/decode/idl_reader.hpp"

namespace rodeira::decode {
namespace {

constexpr const char* kCar = R"(module m {
  enum Gear { kReverse, kNeutral };
  @final struct Wheel { double load_n; float slip; };
  @final struct Unused { long x; };
  @final struct Car { Wheel wheels[4]; sequence<Wheel, 2> spare; string<8> name; Gear gear; long cells[2][3]; };
};)";

TypePtr Read(const std::string& text, const std::string& name = "m::Car") {
  const auto type = ReadType(text, name);
  EXPECT_TRUE(type.ok()) << type.error().Text();
  return type.ok() ? type.value() : nullptr;
}

std::string With(const std::string& before, const std::string& after) {
  std::string text = kCar;
  EXPECT_NE(text.find(before), std::string::npos) << before;
  text.replace(text.find(before), before.size(), after);
  return text;
}

TEST(TypeText, IsTheTypeAndWhatItUses) {
  EXPECT_EQ(CanonicalIdl(*Read(kCar)),
            "module m { @final struct Wheel { double load_n; float slip; }; };\n"
            "module m { @final enum Gear { kReverse, kNeutral }; };\n"
            "module m { @final struct Car { m::Wheel wheels[4]; sequence<m::Wheel, 2> spare; string<8> name; m::Gear "
            "gear; long cells[2][3]; }; };\n");
}

TEST(TypeText, IsReadBackAsTheSameType) {
  const std::string every_kind =
      "module a { module b { @appendable struct T { boolean p; char q; octet r; int8 i; uint8 j; short s; unsigned "
      "short t; long u; unsigned long v; long long w; unsigned long long x; float f; double g; string n; "
      "sequence<sequence<long>> o; }; }; struct U { b::T t[2]; }; };";
  const std::string text = CanonicalIdl(*Read(every_kind, "a::U"));
  EXPECT_EQ(CanonicalIdl(*Read(text, "a::U")), text);
  EXPECT_FALSE(FirstTypeDifference(*Read(text, "a::U"), *Read(every_kind, "a::U")));
  EXPECT_NE(text.find("@appendable struct T"), std::string::npos) << text;
}

TEST(TypeText, CommentsLayoutAndUnusedTypesDoNotCount) {
  const base::Digest hash = TypeHash(*Read(kCar));
  EXPECT_EQ(TypeHash(*Read(With("float slip;", "float slip;  // longitudinal\n"))), hash);
  EXPECT_EQ(TypeHash(*Read(With("@final struct Unused { long x; };", ""))), hash);
  EXPECT_EQ(TypeHash(*Read(With("double load_n; float slip;", "@unit(\"N\") double load_n;\n\n float slip;"))), hash);
  EXPECT_EQ(TypeHash(*Read(With("@final struct Car", "struct Car"))), hash) << "an unmarked type is final";
  EXPECT_EQ(TypeHash(*Read(With("@final struct Car", "@extensibility(FINAL) struct Car"))), hash);
  EXPECT_EQ(TypeHash(*Read(With("Wheel wheels[4]", "m::Wheel wheels[4]"))), hash);
}

TEST(TypeText, EveryOtherChangeCountsAndIsNamed) {
  const TypePtr expected = Read(kCar);
  const auto difference = [&](const std::string& before, const std::string& after) {
    const TypePtr found = Read(With(before, after));
    EXPECT_NE(TypeHash(*found), TypeHash(*expected)) << after;
    return FirstTypeDifference(*found, *expected).value_or("none");
  };
  EXPECT_EQ(difference("float slip;", "double slip;"),
            "m::Wheel, member 2: found 'double slip', expected 'float slip'");
  EXPECT_EQ(difference("float slip;", "float slip_ratio;"),
            "m::Wheel, member 2: found 'float slip_ratio', expected 'float slip'");
  EXPECT_EQ(difference("double load_n; float slip;", "float slip; double load_n;"),
            "m::Wheel, member 1: found 'float slip', expected 'double load_n'");
  EXPECT_EQ(difference("float slip;", ""), "m::Wheel, member 2: found nothing, expected 'float slip'");
  EXPECT_EQ(difference("float slip;", "float slip; long more;"),
            "m::Wheel, member 3: found 'long more', expected nothing");
  EXPECT_EQ(difference("long cells[2][3];", "long cells[3][2];"),
            "m::Car, member 5: found 'long cells[3][2]', expected 'long cells[2][3]'");
  EXPECT_EQ(difference("sequence<Wheel, 2>", "sequence<Wheel>"),
            "m::Car, member 2: found 'sequence<m::Wheel> spare', expected 'sequence<m::Wheel, 2> spare'");
  EXPECT_EQ(difference("string<8> name", "string name"),
            "m::Car, member 3: found 'string name', expected 'string<8> name'");
  EXPECT_EQ(difference("kNeutral", "kPark"), "m::Gear, enumerator 2: found 'kPark', expected 'kNeutral'");
  EXPECT_EQ(difference("@final struct Wheel", "@appendable struct Wheel"),
            "m::Wheel: found @appendable, expected @final");
  const TypePtr other = Read("struct Car { long x; };", "Car");
  EXPECT_EQ(FirstTypeDifference(*other, *expected), "found 'Car', expected 'm::Car'");
  EXPECT_EQ(FirstTypeDifference(*Read(kCar), *expected), std::nullopt);
}

TEST(Aliases, GiveTodaysNamesAndKeepTheEncoding) {
  const Aliases aliases{.topics = {{"old/topic", "new/topic"}},
                        .types = {{"m::Tyre", "m::Wheel"}},
                        .members = {{{"m::Wheel", "load"}, "load_n"}}};
  const std::string before =
      "module m { enum Gear { kReverse, kNeutral }; struct Tyre { double load; float slip; }; "
      "struct Car { Tyre wheels[4]; sequence<Tyre, 2> spare; string<8> name; Gear gear; long "
      "cells[2][3]; }; };";
  EXPECT_EQ(FirstTypeDifference(*aliases.Renamed(Read(before)), *Read(kCar)), std::nullopt);
  EXPECT_EQ(aliases.Topic("old/topic"), "new/topic");
  EXPECT_EQ(aliases.Topic("new/topic"), "new/topic");
  EXPECT_EQ(aliases.Topic("another"), "another");
  EXPECT_EQ(aliases.Renamed(Read(kCar))->least_bytes, Read(kCar)->least_bytes);
}

TEST(IdlReader, ExtensibilityIsRead) {
  EXPECT_EQ(Read("@final struct A { long x; };", "A")->extensibility, Extensibility::kFinal);
  EXPECT_EQ(Read("@appendable @nested struct A { long x; };", "A")->extensibility, Extensibility::kAppendable);
  EXPECT_EQ(Read("@extensibility(APPENDABLE) struct A { long x; };", "A")->extensibility, Extensibility::kAppendable);
  EXPECT_EQ(Read("@final struct A { long x; }; struct B { long x; };", "B")->extensibility, Extensibility::kUnmarked);
  const auto refused = [](std::string_view text) { return IdlTypes::Read(text, "x.idl").error().Text(); };
  EXPECT_EQ(refused("@extensibility(MUTABLE) struct A { long x; };"),
            "x.idl:1: '@extensibility(MUTABLE)' is not read: it makes another encoding");
  EXPECT_EQ(refused("@extensibility(OPEN) struct A { long x; };"),
            "x.idl:1: 'OPEN' was found, FINAL or APPENDABLE was expected");
}

}  // namespace
}  // namespace rodeira::decode
