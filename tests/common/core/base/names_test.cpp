// SPDX-License-Identifier: Apache-2.0
// The matchers by which tests look at messages.
#include "tests/names.hpp"

#include <gtest/gtest.h>

namespace rodeira::base {
namespace {

using testing::Not;

TEST(Names, AreLookedForInTheirOrder) {
  const std::string text = "dir/a.yaml:3: unknown key 'mas_kg'; did you mean 'mass_kg'?";
  EXPECT_THAT(text, Names("dir/a.yaml:3: … 'mas_kg' … 'mass_kg'"));
  EXPECT_THAT(text, Names("'mas_kg'"));
  EXPECT_THAT(text, Not(Names("'mass_kg' … 'mas_kg'")));
  EXPECT_THAT(text, Not(Names("dir/a.yaml:4: … 'mas_kg'")));
  EXPECT_THAT(text, Not(Names("'mas_kg' … 'mas_kg'"))) << "it stands there once";
  EXPECT_THAT(text, Not(Names(""))) << "nothing would be looked for";
  EXPECT_THAT(text, Not(Names("'mas_kg' … "))) << "the second thing is missing";
  EXPECT_THAT(std::string(), Not(Names("a")));
}

TEST(Names, StandOnOneLine) {
  const std::string text = "node 'a' was lost\nnode 'b' ended\nwith status 1\n";
  EXPECT_THAT(text, HasLine("'a' … lost"));
  EXPECT_THAT(text, HasLine("node 'b'"));
  EXPECT_THAT(text, HasLine("status 1"));
  EXPECT_THAT(text, Not(HasLine("'a' … 'b'")));
  EXPECT_THAT(text, Not(HasLine("'b' … status 1")));
  EXPECT_THAT(text, Not(HasLine("lost … 'a'")));
  EXPECT_THAT(text, Not(HasLine("")));
  EXPECT_THAT("'a' is lost", HasLine("'a' … lost")) << "the last line may be without an end";
  EXPECT_THAT(std::string(), Not(HasLine("a")));
}

TEST(Names, OfAnErrorGoWithItsId) {
  const Error error = WrongInput("config.unknown_key", "unknown key 'mas_kg'", "a.yaml:3");
  EXPECT_THAT(error, IsError("config.unknown_key", "a.yaml:3: … 'mas_kg'"));
  EXPECT_THAT(error, Not(IsError("config.missing_key", "a.yaml:3: … 'mas_kg'")));
  EXPECT_THAT(error, Not(IsError("config.unknown_key", "a.yaml:2: … 'mas_kg'")));
}

}  // namespace
}  // namespace rodeira::base
