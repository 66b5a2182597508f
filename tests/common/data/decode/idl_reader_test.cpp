// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/data/decode/idl_reader.hpp"
#include "idl/topics.hpp"
#include "tests/names.hpp"

namespace rodeira::decode {
namespace {

using ::testing::HasSubstr;

IdlTypes Good(std::string_view text) {
  auto types = IdlTypes::Read(text, "x.idl");
  EXPECT_TRUE(types.ok()) << types.error().Text();
  return types.ok() ? std::move(types).value() : IdlTypes();
}

std::string Refused(std::string_view text) {
  const auto types = IdlTypes::Read(text, "x.idl");
  EXPECT_FALSE(types.ok()) << text;
  if (types.ok()) return "";
  EXPECT_EQ(types.error().exit_status(), 2);
  return types.error().Text();
}

TEST(IdlReader, ReadsEveryTextOfTheProject) {
  ASSERT_FALSE(idl::IdlTexts().empty());
  for (const idl::IdlText& text : idl::IdlTexts()) {
    const auto types = IdlTypes::Read(text.text, text.subject);
    ASSERT_TRUE(types.ok()) << types.error().Text();
    EXPECT_TRUE(types.value().types().contains("rodeira::msg::SampleHeader") ||
                text.text.find("Header") == std::string::npos)
        << text.subject;
  }
}

TEST(IdlReader, ReadsAllThatARecordingMayUse) {
  const IdlTypes types = Good(R"(// Ünïcode in a comment
/* two
   lines */ module a { module b {
  const long kN = 3; const string kText = "a } ; // no comment"; const boolean kOn = TRUE; const double kPi = -3.1;
  enum Gear { @default_value kReverse, kNeutral, kFirst };
  @final struct Inner { @key unsigned long long id; @unit("m") double x, y[2]; };
  typedef sequence<Inner, 8> Inners;
}; };
module a { // opened again
  typedef long Number;
  struct Outer {
    b::Inner one; a::b::Inner two[b::kN][2]; ::a::b::Inner three; b::Gear gear; sequence<b::Gear> gears;
    string<16> text; string free;
    boolean p; octet q; char r; short s; unsigned short t; long u; unsigned long v; long long w; float f; double g;
    int8 i1; uint8 i2; int16 i3; uint16 i4; int32 i5; uint32 i6; int64 i7; uint64 i8; b::Inners inners; Number number;
    @range(min=0, max=(1)) sequence<sequence<double>> grid;
  };
};)");
  const auto outer = types.Find("a::Outer").value();
  ASSERT_EQ(outer->kind, Kind::kStruct);
  EXPECT_EQ(outer->name, "a::Outer");
  const Type* two = FindMember(*outer, "two");
  ASSERT_EQ(two->kind, Kind::kArray);
  EXPECT_EQ(two->length, 3u);
  EXPECT_EQ(two->element->length, 2u);
  EXPECT_EQ(two->element->element->name, "a::b::Inner");
  EXPECT_EQ(two->least_bytes, 3u * 2u * 32u);
  EXPECT_EQ(FindMember(*outer, "text")->bound, 16u);
  EXPECT_EQ(FindMember(*outer, "inners")->bound, 8u);
  EXPECT_EQ(FindMember(*outer, "gears")->element->enumerators,
            (std::vector<std::string>{"kReverse", "kNeutral", "kFirst"}));
  const std::map<std::string, Kind> kinds = {
      {"p", Kind::kBool},   {"q", Kind::kOctet},   {"r", Kind::kChar},       {"s", Kind::kInt16},
      {"t", Kind::kUint16}, {"u", Kind::kInt32},   {"v", Kind::kUint32},     {"w", Kind::kInt64},
      {"f", Kind::kFloat},  {"g", Kind::kDouble},  {"i1", Kind::kInt8},      {"i2", Kind::kUint8},
      {"i3", Kind::kInt16}, {"i4", Kind::kUint16}, {"i5", Kind::kInt32},     {"i6", Kind::kUint32},
      {"i7", Kind::kInt64}, {"i8", Kind::kUint64}, {"number", Kind::kInt32}, {"gear", Kind::kEnum}};
  for (const auto& [name, kind] : kinds) EXPECT_EQ(FindMember(*outer, name)->kind, kind) << name;
  EXPECT_EQ(FindMember(*outer, "nothing"), nullptr);
}

TEST(IdlReader, AnInnerNameStandsBeforeAnOuterOne) {
  const IdlTypes types = Good("struct T { octet a; }; module m { struct T { double a; }; struct U { T t; ::T r; }; };");
  const auto user = types.Find("m::U").value();
  EXPECT_EQ(FindMember(*user, "t")->name, "m::T");
  EXPECT_EQ(FindMember(*user, "r")->name, "T");
}

TEST(IdlReader, RefusesWithPlaceAndReason) {
  EXPECT_EQ(Refused("struct A {\n  doubel x;\n};"), "x.idl:2: the type 'doubel' is not defined before this line");
  EXPECT_EQ(Refused("struct Wheel { long x; };\nstruct Car {\n  Weel x;\n};"),
            "x.idl:3: the type 'Weel' is not defined before this line; did you mean 'Wheel'?");
}

TEST(IdlReader, RefusesWhatItCannotDecodeRightly) {
  EXPECT_THAT(Refused("struct A {\n long x;\n"), Names("x.idl:3: … end … a type"));
  EXPECT_THAT(Refused("struct A { long x };"), HasSubstr("'}' was found, ';' was expected"));
  EXPECT_THAT(Refused("struct A { };"), HasSubstr("the structure 'A' has no members"));
  EXPECT_THAT(Refused("struct A { long x; long x; };"), HasSubstr("the member 'x' is there twice"));
  EXPECT_THAT(Refused("struct A { long x; }; struct A { long y; };"), HasSubstr("'A' is defined twice"));
  EXPECT_THAT(Refused("struct A { A a; };"), Names("the type 'A' … before"));
  EXPECT_THAT(Refused("struct A;"), HasSubstr("forward declarations are not read"));
  EXPECT_THAT(Refused("struct A { long x; }; struct B : A { long y; };"), HasSubstr("inherit"));
  EXPECT_THAT(Refused("union U switch (long) { case 1: long x; };"), HasSubstr("'union' is not read"));
  EXPECT_THAT(Refused("struct A { map<long, long> x; };"), HasSubstr("'map' is not read"));
  EXPECT_THAT(Refused("struct A { wstring x; };"), HasSubstr("'wstring' is not read"));
  EXPECT_THAT(Refused("struct A { long double x; };"), HasSubstr("'long double' is not read"));
  EXPECT_THAT(Refused("@mutable struct A { long x; };"), HasSubstr("'@mutable' is not read"));
  EXPECT_THAT(Refused("struct A { @optional long x; };"), HasSubstr("'@optional' is not read"));
  EXPECT_THAT(Refused("enum E { @value(3) kA };"), HasSubstr("'@value' is not read"));
  EXPECT_THAT(Refused("struct A { long x[0]; };"), HasSubstr("a length of 0 was found"));
  EXPECT_THAT(Refused("struct A { long x[010]; };"), HasSubstr("a whole number was expected"));
  EXPECT_THAT(Refused("struct A { long x[99999999999999999999]; };"), HasSubstr("a whole number was expected"));
  EXPECT_THAT(Refused("struct A { long x[kN]; };"), HasSubstr("'kN' is no whole number that is defined"));
  EXPECT_THAT(Refused("#include \"a.idl\"\n"), HasSubstr("x.idl:1: a preprocessor line was found"));
  EXPECT_THAT(Refused("/* no end"), HasSubstr("a comment begins here that does not end"));
  EXPECT_THAT(Refused("const string k = \"no end\n\";"), HasSubstr("a text begins here that does not end"));
  EXPECT_THAT(Refused("struct A { long x; }; $"), HasSubstr("the character '$' has no meaning here"));
  EXPECT_THAT(Refused("module m {"), HasSubstr("was found"));
  EXPECT_THAT(Refused("@unit(\"m\" struct A { long x; };"), HasSubstr("')' was expected"));
}

TEST(IdlReader, NestingIsBounded) {
  std::string modules;
  std::string sequences = "struct A { ";
  std::string structs = "struct S0 { octet x; };";
  for (int i = 1; i <= 5000; ++i) {
    modules += "module m { ";
    sequences += "sequence<";
    structs +=
        "struct S" + std::to_string(i) + " { S" + std::to_string(i - 1) + " a; S" + std::to_string(i - 1) + " b; };";
  }
  for (const std::string& text : {modules, sequences, structs})
    EXPECT_THAT(Refused(text), HasSubstr("nested more than 64 deep"));
}

TEST(IdlReader, ATypeThatIsNotThereIsNamedWithTheNearest) {
  const IdlTypes types = Good("module m { struct Controls { long x; }; };");
  EXPECT_EQ(types.Find("m::Control").error().Text(),
            "x.idl: the type 'm::Control' is not in its IDL text; did you mean 'm::Controls'?");
  EXPECT_THAT(ReadType("struct A { long x; };", "B").error().Text(), HasSubstr("IDL of 'B'"));
}

}  // namespace
}  // namespace rodeira::decode
