// SPDX-License-Identifier: Apache-2.0
// Each template is a whole map: the check finds nothing, and traffic drives on it without touching.
#include "common/editor/templates.hpp"

#include <gtest/gtest.h>

#include "common/traffic/results/study.hpp"
#include "common/world/traffic_map/map_network.hpp"
#include "tests/common/editor/drawing.hpp"

namespace rodeira::editor {
namespace {

class ATemplate : public testing::TestWithParam<Template> {};

TEST_P(ATemplate, IsWholeWhereverItIsPlaced) {
  for (const TemplatePlace& place : {TemplatePlace{}, TemplatePlace{{-300.0, 250.0}, 0.7, 3.5, 25.0},
                                     TemplatePlace{{40.0, 0.0}, -2.0, 2.75, 200.0}}) {
    History history(EmptyDocument());
    ExpectUndone(history, [&](Document& d) { return Place(d, GetParam(), place); });
    const auto findings = traffic_map::CheckMap(history.document().map, history.document().companion);
    EXPECT_TRUE(findings.empty()) << findings.front().Text();
  }
}

TEST_P(ATemplate, IsDrivenOn) {
  History history(EmptyDocument());
  ASSERT_TRUE(history.Do([](Document& d) { return Place(d, GetParam(), {}); }).ok());
  const auto lanes = traffic_map::MakeLaneMap(history.document().map, history.document().companion, "map");
  ASSERT_TRUE(lanes.ok()) << lanes.error().Text();
  const auto network = traffic_map::ToNetwork(lanes.value(), "map");
  ASSERT_TRUE(network.ok()) << network.error().Text();
  traffic::StudySettings settings;
  settings.traffic.vehicles = 10;
  settings.duration_s = 60.0;
  const auto result = traffic::RunStudy(settings, network.value());
  ASSERT_TRUE(result.ok()) << result.error().Text();
  EXPECT_EQ(result.value().collisions, 0);
  EXPECT_EQ(result.value().off_lane, 0);
  EXPECT_GT(result.value().arrivals, 10);
}

INSTANTIATE_TEST_SUITE_P(All, ATemplate, testing::Values(Template::kCrossing, Template::kRoundabout, Template::kMerge));

TEST(Templates, TwoBesideEachOtherAreTwo) {
  History history(Parsed(traffic_map::GoodMap()));
  ASSERT_TRUE(history.Do([](Document& d) { return Place(d, Template::kMerge, {{0.0, 300.0}, 0.0, 3.25, 60.0}); }).ok());
  ASSERT_TRUE(history.Do([](Document& d) {
                       return Place(d, Template::kCrossing, {{400.0, 300.0}, 0.3, 3.25, 60.0});
                     })
                  .ok());
  for (const traffic_map::Finding& finding :
       traffic_map::CheckMap(history.document().map, history.document().companion))
    EXPECT_NE(finding.severity, traffic_map::Severity::kError) << finding.Text();
}

}  // namespace
}  // namespace rodeira::editor
