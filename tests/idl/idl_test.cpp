// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "common/runtime/lockstep/sample.hpp"
#include "idl/codec.hpp"
#include "idl/messages.hpp"
#include "idl/topics.hpp"

namespace rodeira::idl {
namespace {

// Fills the stack with rubbish, so that a byte that is never written would show.
[[gnu::noinline]] void Dirty(unsigned char with) {
  volatile unsigned char rubbish[16384];
  for (auto& byte : rubbish) byte = with;
}

TEST(Codec, TheHeaderLiesWhereTheLockstepReadsIt) {
  msg::Controls controls;
  controls.header().step(0x0102030405060708);
  controls.header().time_ns(-5);
  controls.header().source(77);
  controls.header().incarnation(88);
  controls.header().state_digest(0xfedcba9876543210ull);
  const auto header = lockstep::SampleHeader::Read(Encode(controls));
  EXPECT_EQ(header.step, 0x0102030405060708);
  EXPECT_EQ(header.time_ns, -5);
  EXPECT_EQ(header.source, 77u);
  EXPECT_EQ(header.incarnation, 88u);
  EXPECT_EQ(header.state_digest, 0xfedcba9876543210ull);

  base::Bytes bytes = Encode(msg::Controls());
  header.Write(bytes);
  EXPECT_EQ(Decode<msg::Controls>(bytes).value().header().incarnation(), 88u);
  EXPECT_EQ(lockstep::SampleHeader::kIncarnationAt, 24u);
}

TEST(Codec, TheSameMessageGivesTheSameBytes) {
  const auto encode = [](unsigned char rubbish) {
    Dirty(rubbish);
    msg::TrafficState state;
    state.agents().resize(3);
    state.agents()[1].speed_mps(12.5);
    return Encode(state);
  };
  EXPECT_EQ(encode(0x00), encode(0xff));
  EXPECT_EQ(encode(0x55).size() % 4, 0u);
}

TEST(Codec, ComesBackAsItWas) {
  msg::VehicleState state;
  state.position_w_m().x(1.5);
  state.wheels()[3].load_n(2500.25);
  state.gear(-1);
  const auto back = Decode<msg::VehicleState>(Encode(state)).value();
  EXPECT_EQ(back.position_w_m().x(), 1.5);
  EXPECT_EQ(back.wheels()[3].load_n(), 2500.25);
  EXPECT_EQ(back.gear(), -1);
}

TEST(Codec, CutOrForeignBytesAreRefused) {
  msg::ScenarioEvents events;
  events.events().resize(2);
  events.events()[0].name("brake");
  const base::Bytes whole = Encode(events);
  ASSERT_GT(whole.size(), 40U);
  for (std::size_t size = 0; size < whole.size(); ++size) {
    EXPECT_FALSE(Decode<msg::ScenarioEvents>(std::span(whole).first(size)).ok()) << size;
  }
  base::Bytes huge = whole;
  for (std::size_t i = 36; i < 40; ++i) huge[i] = std::byte{0xff};  // the sequence's length
  EXPECT_FALSE(Decode<msg::ScenarioEvents>(huge).ok());
  base::Bytes foreign = whole;
  foreign[1] = std::byte{0};  // big-endian
  EXPECT_FALSE(Decode<msg::ScenarioEvents>(foreign).ok());
}

TEST(Topics, EveryTopicHasATypeInItsText) {
  ASSERT_GE(Topics().size(), 20u);
  for (const TopicInfo& info : Topics()) {
    const std::string& text = IdlTextOf(info.subject);
    const std::string name = "struct " + std::string(info.type.substr(info.type.rfind(':') + 1)) + " ";
    EXPECT_NE(text.find(name), std::string::npos) << info.topic;
    EXPECT_EQ(text.find('#'), std::string::npos) << info.subject;
    EXPECT_EQ(info.lockstep, text.find(name + "{\n      SampleHeader header;") != std::string::npos) << info.topic;
  }
  EXPECT_EQ(FindTopic("rodeira/control"), nullptr);
}

}  // namespace
}  // namespace rodeira::idl
