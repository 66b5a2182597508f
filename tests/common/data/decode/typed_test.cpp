// SPDX-License-Identifier: Apache-2.0
// What the generic decoder makes of the embedded IDL texts is what the generated code makes of the IDL files.
#include <gtest/gtest.h>

#include <set>

#include "common/data/decode/difference.hpp"
#include "common/data/decode/idl_reader.hpp"
#include "idl/codec.hpp"
#include "idl/topics.hpp"
#include "tests/common/data/decode/fields.hpp"

namespace rodeira::decode {
namespace {

TypePtr TypeOf(std::string_view name) {
  for (const idl::TopicInfo& topic : idl::Topics()) {
    if (topic.type != name) continue;
    auto type = ReadType(idl::IdlTextOf(topic.subject), std::string(name));
    EXPECT_TRUE(type.ok()) << type.error().Text();
    return type.ok() ? type.value() : nullptr;
  }
  ADD_FAILURE() << name;
  return nullptr;
}

void ExpectSame(const std::vector<Entry>& found, const std::vector<Entry>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    ASSERT_EQ(found[i].path, expected[i].path);
    ASSERT_TRUE(SameBits(found[i].value, expected[i].value))
        << found[i].path << ": " << Text(found[i].value) << ", " << Text(expected[i].value);
  }
}

TEST(Typed, EveryTopicIsTried) {
  std::set<std::string_view> tried;
  ForEveryTopicType([&](auto, std::string_view name) { tried.insert(name); });
  ASSERT_FALSE(idl::Topics().empty());
  for (const idl::TopicInfo& topic : idl::Topics()) EXPECT_TRUE(tried.contains(topic.type)) << topic.type;
}

TEST(Typed, EveryValueOfEveryTopicComesBackToTheBit) {
  ForEveryTopicType([](auto tag, std::string_view name) {
    using Message = typename decltype(tag)::type;
    const TypePtr type = TypeOf(name);
    ASSERT_NE(type, nullptr);
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
      Message message = Filled<Message>(seed);
      const auto found = Flatten(*type, idl::Encode(message));
      ASSERT_TRUE(found.ok()) << name << ": " << found.error().Text();
      ExpectSame(found.value(), Listed(message));
      if (testing::Test::HasFailure()) FAIL() << name << ", message " << seed;
    }
  });
}

// A payload cut anywhere is refused here where the generated code refuses it, and says where.
TEST(Typed, EveryCutIsRefused) {
  ForEveryTopicType([](auto tag, std::string_view name) {
    using Message = typename decltype(tag)::type;
    const TypePtr type = TypeOf(name);
    ASSERT_NE(type, nullptr);
    const base::Bytes whole = idl::Encode(Filled<Message>(7));
    ASSERT_FALSE(whole.empty());
    for (std::size_t size = 0; size < whole.size(); ++size) {
      const auto cut = std::span(whole).first(size);
      const auto found = Flatten(*type, cut);
      ASSERT_FALSE(found.ok()) << name << " cut at " << size;
      EXPECT_FALSE(found.error().message.empty());
      EXPECT_FALSE(idl::Decode<Message>(cut).ok());
    }
  });
}

// Each bit that is flipped is found, and where the typed code sees the change in one member, that member is named.
TEST(Typed, EveryFlippedBitIsADifferenceAndIsNamed) {
  ForEveryTopicType([](auto tag, std::string_view name) {
    using Message = typename decltype(tag)::type;
    const TypePtr type = TypeOf(name);
    ASSERT_NE(type, nullptr);
    Message message = Filled<Message>(3);
    const base::Bytes whole = idl::Encode(message);
    EXPECT_FALSE(FirstDifference(*type, whole, whole).has_value());
    std::size_t named = 0;
    for (std::size_t bit = 32; bit < 8 * whole.size(); ++bit) {
      base::Bytes changed = whole;
      changed[bit / 8] ^= static_cast<std::byte>(1u << (bit % 8));
      const auto difference = FirstDifference(*type, whole, changed);
      ASSERT_TRUE(difference.has_value()) << name << ", bit " << bit;
      ASSERT_NE(difference->a, difference->b) << name << ", bit " << bit << ", " << difference->path;
      auto other = idl::Decode<Message>(changed);
      if (!other) continue;
      const auto before = Listed(message);
      const auto after = Listed(other.value());
      if (before.size() != after.size()) continue;
      std::size_t at = 0;
      while (at < before.size() && SameBits(before[at].value, after[at].value)) ++at;
      if (at == before.size()) continue;  // padding
      ++named;
      if (!std::holds_alternative<base::Bytes>(before[at].value)) {
        ASSERT_EQ(difference->path, before[at].path) << name << ", bit " << bit;
        ASSERT_EQ(difference->a, TextWithBits(before[at].value));
        ASSERT_EQ(difference->b, TextWithBits(after[at].value));
      }
    }
    EXPECT_GT(named, 8u) << name;
  });
}

}  // namespace
}  // namespace rodeira::decode
