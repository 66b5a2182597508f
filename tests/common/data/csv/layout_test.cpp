// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "common/data/csv/layout.hpp"
#include "common/data/decode/idl_reader.hpp"
#include "idl/topics.hpp"

namespace rodeira::csv {
namespace {

Layout Of(std::string_view idl, const std::string& name) {
  const auto layout = LayoutOf(*decode::ReadType(idl, name).value());
  EXPECT_TRUE(layout.ok());
  return layout.value();
}

std::string Columns(const Layout& layout) {
  std::string text;
  for (const Slot& slot : layout.slots) {
    if (slot.use == Slot::Use::kDropped || slot.name.empty()) continue;
    const bool row = slot.use == Slot::Use::kRowCell || slot.use == Slot::Use::kRowList;
    const bool list = slot.use == Slot::Use::kList || slot.use == Slot::Use::kRowList;
    text += (text.empty() ? "" : " ") + std::string(row ? "*" : "") + slot.name + (list ? "[]" : "");
  }
  return text;
}

TEST(Layout, ArraysAreColumnsAndOneSequenceOfStructuresMakesTheRows) {
  const std::string idl =
      "struct P { double x; octet tag[2]; short g[2]; };"
      "struct A { long n; sequence<P> points; sequence<double> more; string s; };";
  const Layout layout = Of(idl, "A");
  EXPECT_EQ(layout.rows, "points");
  EXPECT_FALSE(layout.has_header);
  EXPECT_EQ(Columns(layout), "n *points.x *points.tag *points.g[0] *points.g[1] more[] s");
}

TEST(Layout, OfSeveralSequencesOfStructuresNoneMakesRows) {
  const std::string idl =
      "struct P { double x; }; struct Q { sequence<P> p; }; struct A { sequence<P> a; sequence<P> b; }; struct B { Q "
      "q[2]; };"
      "struct C { sequence<Q> q; double m[2][2]; };";
  EXPECT_EQ(Columns(Of(idl, "A")), "a[] b[]");
  EXPECT_EQ(Columns(Of(idl, "B")), "q[0].p[] q[1].p[]");
  EXPECT_EQ(Columns(Of(idl, "C")), "*q.p[] m[0][0] m[0][1] m[1][0] m[1][1]");
  EXPECT_EQ(Of(idl, "C").rows, "q");
}

TEST(Layout, TooManyColumnsAreRefused) {
  const auto layout = LayoutOf(*decode::ReadType("struct A { double x[4000000000]; };", "A").value());
  ASSERT_FALSE(layout.ok());
  EXPECT_EQ(layout.error().Text(), "'A' would make a table of more than 10000 columns");
  EXPECT_FALSE(LayoutOf(*decode::ReadType("typedef sequence<double> A;", "A").value()).ok());
}

TEST(Layout, OfTheProjectsTopics) {
  const auto of = [](std::string_view topic) {
    const auto* info = idl::FindTopic(topic);
    return Of(idl::IdlTextOf(info->subject), std::string(info->type));
  };
  ASSERT_FALSE(idl::Topics().empty());
  for (const idl::TopicInfo& topic : idl::Topics())
    EXPECT_EQ(of(topic.topic).has_header, topic.lockstep) << topic.topic;
  EXPECT_EQ(of(idl::topics::kTrafficState).rows, "agents");
  EXPECT_EQ(of(idl::topics::kScenarioEvents).rows, "events");
  EXPECT_EQ(of(idl::topics::kVehicleState).rows, "");
  EXPECT_EQ(Columns(of(idl::topics::kControls)),
            "steering_wheel_rad throttle brake clutch handbrake gear gearbox_mode starter indicators headlights horn");
}

}  // namespace
}  // namespace rodeira::csv
