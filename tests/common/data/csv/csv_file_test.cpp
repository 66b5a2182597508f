// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstdint>
#include <limits>

#include "common/data/csv/csv_file.hpp"

namespace rodeira::csv {
namespace {

std::string Seconds(std::int64_t time_ns) {
  std::string text;
  AppendSeconds(time_ns, text);
  return text;
}

std::string Cell(std::string_view text) {
  std::string out;
  AppendCell(text, out);
  return out;
}

TEST(CsvFile, SecondsAreExact) {
  EXPECT_EQ(Seconds(0), "0");
  EXPECT_EQ(Seconds(1), "0.000000001");
  EXPECT_EQ(Seconds(1'500'000'000), "1.5");
  EXPECT_EQ(Seconds(3'600'000'000'001), "3600.000000001");
  EXPECT_EQ(Seconds(-1'000'000), "-0.001");
  EXPECT_EQ(Seconds(std::numeric_limits<std::int64_t>::max()), "9223372036.854775807");
  EXPECT_EQ(Seconds(std::numeric_limits<std::int64_t>::min()), "-9223372036.854775808");
}

TEST(CsvFile, CellsAreQuotedWhereTheyMustBe) {
  EXPECT_EQ(Cell("plain text"), "plain text");
  EXPECT_EQ(Cell(""), "");
  EXPECT_EQ(Cell("a,b"), "\"a,b\"");
  EXPECT_EQ(Cell("say \"x\""), "\"say \"\"x\"\"\"");
  EXPECT_EQ(Cell("two\nlines"), "\"two\nlines\"");
}

TEST(CsvFile, WhatCannotBeWrittenIsSaid) {
  EXPECT_FALSE(CsvFile::Create("/no/such/folder/a.csv").ok());
  EXPECT_EQ(CsvFile::Create("/no/such/folder/a.csv").error().exit_status(), 1);
}

}  // namespace
}  // namespace rodeira::csv
