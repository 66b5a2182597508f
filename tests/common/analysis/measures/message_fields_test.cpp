// SPDX-License-Identifier: Apache-2.0
// The oracle is decode::Flatten, which visits every value of a message by its type.
#include "common/analysis/measures/message_fields.hpp"

#include <gtest/gtest.h>

#include <map>
#include <random>

#include "common/core/base/bytes.hpp"
#include "common/data/decode/idl_reader.hpp"
#include "common/data/decode/walk.hpp"

namespace rodeira::measures {
namespace {

constexpr const char* kIdl = R"(module m {
  struct Pose { double x; float y; unsigned short n; };
  struct Row { octet flag; long long id; float speed; };
  struct Sample { long long step; octet small; Pose poses[2]; short last; sequence<Row> rows; string name; };
};)";

double Number(const decode::Value& value) {
  return std::visit(
      [](const auto& v) -> double {
        if constexpr (std::is_arithmetic_v<std::decay_t<decltype(v)>>)
          return static_cast<double>(v);
        else
          return 0.0;
      },
      value);
}

// Random bytes with two rows and a name.
base::Bytes Message(std::mt19937& draw, bool whole = true) {
  base::Bytes bytes{std::byte{0}, std::byte{1}, std::byte{0}, std::byte{0}};
  const auto pad = [&](std::size_t to) {
    while ((bytes.size() - 4) % to != 0) bytes.push_back(std::byte{0});
  };
  const auto some = [&](std::size_t n) {
    pad(n);
    for (std::size_t i = 0; i < n; ++i) bytes.push_back(static_cast<std::byte>(draw() & 0x3f));
  };
  const auto length = [&](unsigned n) {
    pad(4);
    for (int i = 0; i < 4; ++i) bytes.push_back(static_cast<std::byte>(i == 0 ? n : 0));
  };
  for (const std::size_t n : {8u, 1u, 8u, 4u, 2u, 8u, 4u, 2u, 2u}) some(n);
  length(2);
  for (int row = 0; row < 2; ++row) {
    for (const std::size_t n : {1u, 8u, 4u}) some(n);
  }
  if (whole) {
    length(2);
    bytes.push_back(std::byte{'a'});
    bytes.push_back(std::byte{0});
  }
  return bytes;
}

TEST(MessageFields, NumbersAreThoseOfTheDecoder) {
  const auto type = decode::ReadType(kIdl, "m::Sample").value();
  const std::vector<std::string> fields{"last", "poses[1].y", "step", "poses[0].n"}, row_fields{"speed", "id"};
  const auto reader = MessageFields::Make(*type, fields, "rows", row_fields);
  ASSERT_TRUE(reader.ok()) << reader.error().Text();
  std::mt19937 draw(4);
  for (int i = 0; i < 50; ++i) {
    const base::Bytes bytes = Message(draw);
    std::map<std::string, double> expected;
    const auto flat = decode::Flatten(*type, bytes);
    ASSERT_TRUE(flat.ok()) << flat.error().Text();
    for (const decode::Entry& entry : flat.value()) expected[entry.path] = Number(entry.value);
    std::vector<double> values(fields.size());
    std::size_t rows = 0;
    ASSERT_TRUE(reader.value().Read(bytes, values, [&](std::span<const double> row) {
      EXPECT_EQ(row[0], expected.at("rows[" + std::to_string(rows) + "].speed"));
      EXPECT_EQ(row[1], expected.at("rows[" + std::to_string(rows) + "].id"));
      ++rows;
    }));
    EXPECT_EQ(rows, 2u);
    for (std::size_t f = 0; f < fields.size(); ++f) EXPECT_EQ(values[f], expected.at(fields[f])) << fields[f];
  }
}

TEST(MessageFields, CutMessagesAndWrongNamesAreRefused) {
  const auto type = decode::ReadType(kIdl, "m::Sample").value();
  const auto reader = MessageFields::Make(*type, {"step"}, "rows", {"id"}).value();
  std::mt19937 draw(1);
  const base::Bytes bytes = Message(draw, false);
  std::vector<double> values(1);
  const auto none = [](std::span<const double>) {};
  EXPECT_TRUE(reader.Read(bytes, values, none));
  for (std::size_t n = 0; n < bytes.size(); ++n)
    EXPECT_FALSE(reader.Read(std::span(bytes).first(n), values, none)) << n;
  EXPECT_FALSE(MessageFields::Make(*type, {"stepp"}).ok());
  EXPECT_FALSE(MessageFields::Make(*type, {"step"}, "poses", {"x"}).ok());
  EXPECT_FALSE(MessageFields::Make(*type, {"step"}, "rows", {"x"}).ok());
}

}  // namespace
}  // namespace rodeira::measures
