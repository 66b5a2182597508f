// SPDX-License-Identifier: Apache-2.0
#include "nodes/recorder/written_samples.hpp"

#include <gtest/gtest.h>

namespace rodeira::nodes {
namespace {

using lockstep::Role;
using lockstep::Step;

// Two sources, one each step and one each third, and their writer.
lockstep::Roster MakeRoster() {
  return lockstep::Roster::Create(
             1'000'000, 100,
             {{"fast", "t", Role::kStepped, 1, 0, 0, {"a"}, {}},
              {"slow", "t", Role::kStepped, 3, 0, 0, {"b"}, {}},
              {"recorder",
               "t",
               Role::kStepped,
               5,
               0,
               0,
               {},
               {{"a", lockstep::PortKind::kEvent, {"fast"}}, {"b", lockstep::PortKind::kEvent, {"slow"}}}}})
      .value();
}

std::string Missing(const WrittenSamples& written, Step last) { return written.Entries(last).at("missing"); }

TEST(WrittenSamples, AWholeRunMissesNothing) {
  const lockstep::Roster roster = MakeRoster();
  WrittenSamples written(roster, 2);
  for (Step step = 0; step <= 10; ++step) {
    written.Note(step, 0);
    if (step % 3 == 0) written.Note(step, 1);
  }
  EXPECT_EQ(written.Entries(10), (record::TextMap{{"samples", "15"}, {"sources", "2"}, {"missing", "0"}}));
  EXPECT_EQ(Missing(written, 11), "1") << "step 11 of the fast one";
  EXPECT_EQ(Missing(written, 12), "3");
}

TEST(WrittenSamples, GapsAtTheBeginningWithinAndAtTheEndAreCounted) {
  const lockstep::Roster roster = MakeRoster();
  WrittenSamples written(roster, 2);
  for (const Step step : {2, 3, 6, 7}) written.Note(step, 0);  // 0, 1, 4, 5 and 8, 9 are missing
  for (const Step step : {0, 9}) written.Note(step, 1);        // 3 and 6
  EXPECT_EQ(written.Entries(9), (record::TextMap{{"samples", "6"}, {"sources", "2"}, {"missing", "8"}}));
}

TEST(WrittenSamples, AnotherLifeBeginsWhereTheFirstOneEnded) {
  const lockstep::Roster roster = MakeRoster();
  WrittenSamples written(roster, 2);
  written.BeginBehind(6, 0);  // the fast one's sample of step 6 is there, the slow one's is not
  EXPECT_EQ(Missing(written, 6), "1");
  written.Note(6, 1);
  written.Note(7, 0);
  EXPECT_EQ(written.Entries(7), (record::TextMap{{"samples", "11"}, {"sources", "2"}, {"missing", "0"}}))
      << "0 to 7 and 0, 3, 6";
}

}  // namespace
}  // namespace rodeira::nodes
