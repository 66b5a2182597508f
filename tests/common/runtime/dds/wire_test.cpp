// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/dds/wire.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/runtime/dds/hello_change.hpp"
#include "tests/names.hpp"
#include "tests/system/change_type.hpp"

namespace rodeira::dds {
namespace {

const launch::Launch& Empty() {
  static const launch::Launch kLaunch =
      launch::Launch::Parse("rodeira: launch/1\nnodes:\n  a: {kind: empty}\n  b: {kind: empty}\n", "launch.yaml")
          .value();
  return kLaunch;
}

// Node 'a' of a program that has another type of a topic.
Hello Pretended(const char* change) {
  ChangeOfHellos().type = [change](std::vector<idl::TopicText>& topics) { system_test::ChangeType(change, topics); };
  const Hello hello = OwnHello(Empty(), 0);
  ChangeOfHellos() = {};
  return hello;
}

NamedReport ReportOf(const Hello& hello) {
  NamedReport report;
  report.node = "a";
  report.hello = hello;
  report.clock_id = 7;
  report.report.progress = 42;
  report.report.safe = 17;
  report.report.message = "none";
  return report;
}

TEST(Wire, AReportComesBackAsItWas) {
  const auto back = DecodeReport(EncodeReport(ReportOf(OwnHello(Empty(), 0))));
  ASSERT_TRUE(back.ok()) << back.error().Text();
  EXPECT_EQ(back.value().node, "a");
  EXPECT_EQ(back.value().clock_id, 7u);
  EXPECT_EQ(back.value().report.progress, 42);
  EXPECT_EQ(back.value().report.safe, 17);
  EXPECT_EQ(back.value().hello.host, OwnHello(Empty(), 0).host);
  ASSERT_NE(back.value().hello.topics, nullptr);
  EXPECT_EQ(back.value().hello.topics->size(), OwnHello(Empty(), 0).topics->size());
  EXPECT_TRUE(CheckHello(OwnHello(Empty(), 0), back.value().hello).ok());
}

TEST(Wire, ANodeWithAnotherTopicIsRefusedWithTheMember) {
  const Hello other = Pretended("rodeira/pulse|unsigned long long value|double value");
  const auto sent = DecodeReport(EncodeReport(ReportOf(other)));
  ASSERT_TRUE(sent.ok()) << sent.error().Text();
  const auto refused = CheckHello(OwnHello(Empty(), 0), sent.value().hello);
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().exit_status(), 2);
  EXPECT_EQ(refused.error().Text(),
            "its type of topic rodeira/pulse differs from the clock's: rodeira::msg::Pulse, member 2: found 'double "
            "value', expected 'unsigned long long value'; all programs of a run need the same version of Rodeira");
}

TEST(Wire, ANodeWithOtherUnusedTopicsIsNotRefused) {
  EXPECT_TRUE(CheckHello(OwnHello(Empty(), 0), Pretended("rodeira/controls|double throttle|float throttle")).ok());
}

TEST(Wire, WithoutItsTypesANodeIsRefusedWithBothHashes) {
  Hello other = Pretended("rodeira/pulse|unsigned long long value|double value");
  other.topics = nullptr;
  const Hello own = OwnHello(Empty(), 0);
  const auto refused = CheckHello(own, other);
  ASSERT_FALSE(refused.ok());
  EXPECT_THAT(refused.error().Text(),
              Names("protocol hash … " + base::Hex(other.protocol) + " … clock's … " + base::Hex(own.protocol)));
}

TEST(Wire, ANodeThatUsesOtherTopicsIsRefused) {
  Hello more = OwnHello(Empty(), 0);
  auto texts = *more.topics;
  texts.push_back({"rodeira/new", "rodeira::msg::New", "module rodeira { module msg { struct New { long x; }; }; };"});
  more.topics = std::make_shared<const std::vector<idl::TopicText>>(texts);
  more.protocol = idl::ProtocolHash(texts);
  const auto refused = CheckHello(OwnHello(Empty(), 0), more);
  ASSERT_FALSE(refused.ok());
  EXPECT_THAT(refused.error().Text(), Names("uses topic rodeira/new … not expect"));
  const auto less = CheckHello(more, OwnHello(Empty(), 0));
  ASSERT_FALSE(less.ok());
  EXPECT_THAT(less.error().Text(), Names("not use topic rodeira/new … expects"));
}

// Nothing behind its identity is read.
TEST(Wire, AReportOfAnotherTypeNamesItsNode) {
  const Hello other = Pretended("rodeira/report|long long busy_ns|double busy_s");
  base::Bytes payload = EncodeReport(ReportOf(other));
  payload.resize(80);
  const auto refused = DecodeReport(payload);
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().exit_status(), 2);
  EXPECT_TRUE(refused.error().Text().starts_with("node 'a' (process " + std::to_string(other.pid) + " on host " +
                                                 other.host +
                                                 ") was refused: its type of topic rodeira/report differs"))
      << refused.error().Text();
}

TEST(Wire, AGrantOfAnotherTypeIsNotRead) {
  NumberedGrant grant;
  grant.clock_id = 5;
  grant.grant.through = 12;
  base::Bytes payload = EncodeGrant(grant);
  ASSERT_TRUE(DecodeGrant(payload).ok());
  EXPECT_EQ(DecodeGrant(payload).value().grant.through, 12);
  payload[5] ^= std::byte{1};
  EXPECT_FALSE(DecodeGrant(payload).ok());
}

}  // namespace
}  // namespace rodeira::dds
