// SPDX-License-Identifier: Apache-2.0
// Promises of callers that make types: an array has an element, a struct a member, a plain type a size.
#include <gtest/gtest.h>

#include "common/data/decode/type.hpp"

namespace rodeira::decode {
namespace {

TEST(ContractsDeathTest, ATypeHoldsSomething) {
  const TypePtr number = MakePlain(Kind::kDouble);
  EXPECT_EQ(MakeArray(number, 1)->length, 1U);
  EXPECT_DEATH((void)MakeArray(number, 0), "length > 0");
  EXPECT_EQ(MakeStruct("m::A", {{"x", number}})->members.size(), 1U);
  EXPECT_DEATH((void)MakeStruct("m::A", {}), "members.empty\\(\\)");
}

TEST(ContractsDeathTest, OnlyAPlainTypeHasAFixedSize) {
  EXPECT_EQ(PlainBytes(Kind::kDouble), 8U);
  for (const Kind kind : {Kind::kString, Kind::kSequence, Kind::kArray, Kind::kStruct})
    EXPECT_DEATH((void)PlainBytes(kind), "type.cpp:[0-9]+: assertion failed: false");
}

}  // namespace
}  // namespace rodeira::decode
