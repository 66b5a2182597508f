// SPDX-License-Identifier: Apache-2.0
// The project's worlds of version 2 as OpenDRIVE: read again by the strict rules they hold the same roads, lanes, ways,
// lines, signs and objects, and SUMO's netconvert finds all of their edges, lanes and ways.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <tuple>
#include <utility>
#include <vector>

#include "common/core/base/files.hpp"
#include "common/core/base/random.hpp"
#include "common/world/network/marking.hpp"
#include "common/world/opendrive/import.hpp"
#include "common/world/road/world.hpp"
#include "common/world/road/world_export.hpp"
#include "common/world/terrain/geographic.hpp"
#include "tests/common/world/road/netconvert.hpp"
#include "tests/launch/rodeira/temporary_folder.hpp"
#include "tests/setting.hpp"
#include "tests/tree.hpp"

namespace rodeira::road {
namespace {

using network::LaneKey;
using network::Network;

class NetworkExport : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    const auto loaded = World::Load(std::filesystem::path(SourceDir()) / "configs/worlds" / GetParam());
    ASSERT_TRUE(loaded.ok()) << loaded.error().Text();
    world_ = loaded.value();
    const auto written = WriteOpenDrive(*world_, file_);
    ASSERT_TRUE(written.ok()) << written.error().Text();
    // The example shows that gaps of up to 5 cm between an author's elements are closed, which strictly they may not
    // be.
    const auto import =
        opendrive::Load(file_, IsExample() ? opendrive::Tolerance::Usual() : opendrive::Tolerance::Strict());
    ASSERT_TRUE(import.ok()) << import.error().Text();
    for (const auto& error : import.value().errors) ADD_FAILURE() << error.Text();
    again_ = import.value().network;
    ASSERT_NE(again_, nullptr);
    ASSERT_EQ(again_->roads().size(), ours().roads().size());
  }
  const Network& ours() const { return *world_->network(); }
  static bool IsExample() { return std::string(GetParam()).starts_with("example"); }

  const cli::TemporaryFolder folder_;
  const std::filesystem::path file_ = folder_.path() / "it.xodr";
  std::shared_ptr<const World> world_;
  std::shared_ptr<const Network> again_;
};

TEST_P(NetworkExport, RoadsComeBackWithTheirSurfaces) {
  double worst_m = 0.0;
  for (std::uint32_t r = 0; r < ours().roads().size(); ++r) {
    const network::Road &a = ours().roads()[r], &b = again_->roads()[r];
    EXPECT_EQ(a.id(), b.id());
    EXPECT_EQ(a.spec().name, b.spec().name);
    EXPECT_EQ(a.spec().junction, b.spec().junction);
    EXPECT_EQ(a.spec().left_hand, b.spec().left_hand);
    EXPECT_NEAR(a.length_m(), b.length_m(), 1e-9);
    ASSERT_EQ(a.spec().sections.size(), b.spec().sections.size());
    const double left_m =
        a.SpanAt(0, static_cast<int>(a.spec().sections[0].left.size()), 0.0).value_or(network::LaneSpan{}).outer_t_m;
    const double right_m =
        a.SpanAt(0, -static_cast<int>(a.spec().sections[0].right.size()), 0.0).value_or(network::LaneSpan{}).outer_t_m;
    for (std::uint64_t i = 0; i < 300; ++i) {
      const double s = base::RandomUniform({r, i, 1}, 0.0, a.length_m()),
                   t = base::RandomUniform({r, i, 2}, right_m, left_m);
      const network::SurfaceSample ours = a.Surface(s, t), theirs = b.Surface(s, t);
      worst_m = std::max(worst_m, (ours.p_W - theirs.p_W).norm());
      EXPECT_NEAR((ours.ds_W.cross(ours.dt_W).normalized() - theirs.ds_W.cross(theirs.dt_W).normalized()).norm(), 0.0,
                  1e-8)
          << a.id() << " " << s << " " << t;
      EXPECT_NEAR(a.spec().superelevation.Value(s), b.spec().superelevation.Value(s), 1e-9);
      EXPECT_NEAR(a.CentreAt(s).value, b.CentreAt(s).value, 1e-9);
    }
  }
  EXPECT_LT(worst_m, 1e-8);
}

TEST_P(NetworkExport, LanesComeBackWithTheirWidthsLimitsGroundsAndWays) {
  const auto lanes = ours().Lanes();
  EXPECT_EQ(lanes, again_->Lanes());
  const auto same = [](std::span<const network::LaneEnd> a, std::span<const network::LaneEnd> b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end());
  };
  for (const LaneKey& key : lanes) {
    const network::Road &a = ours().roads()[key.road], &b = again_->roads()[key.road];
    const network::Lane &ours_lane = *ours().Find(key), &theirs = *again_->Find(key);
    EXPECT_EQ(ours_lane.type, theirs.type);
    EXPECT_EQ(ours_lane.direction, theirs.direction);
    EXPECT_TRUE(same(ours().AtEnd(key), again_->AtEnd(key)) && same(ours().AtStart(key), again_->AtStart(key)))
        << a.id() << " " << key.lane;
    for (std::uint64_t i = 0; i < 40; ++i) {
      const double s = base::RandomUniform({key.road, i, 3}, 0.0, a.length_m());
      EXPECT_NEAR(ours().Span(key, s)->inner_t_m, again_->Span(key, s)->inner_t_m, 1e-9);
      EXPECT_NEAR(ours().Span(key, s)->outer_t_m, again_->Span(key, s)->outer_t_m, 1e-9);
      const auto limit = a.SpeedLimitAt(ours_lane, s), again = b.SpeedLimitAt(theirs, s);
      ASSERT_EQ(limit.has_value(), again.has_value());
      EXPECT_NEAR(limit.value_or(0.0), again.value_or(0.0), 1e-12);
      const network::LaneMaterial *ground = a.MaterialAt(ours_lane, s), *theirs_ground = b.MaterialAt(theirs, s);
      ASSERT_EQ(ground == nullptr, theirs_ground == nullptr);
      if (ground == nullptr) continue;
      EXPECT_EQ(ground->surface, theirs_ground->surface);
      EXPECT_EQ(ground->friction, theirs_ground->friction);
    }
  }
}

// The lines at a station: where, how wide, of which colour, in which strokes.
std::vector<std::tuple<double, double, std::string, double, double>> LinesAt(
    const network::Road& road, const std::vector<network::Marking>& markings, double s_m) {
  std::vector<std::tuple<double, double, std::string, double, double>> lines;
  for (const network::Marking& line : markings) {
    if (line.from_s_m > s_m || line.to_s_m <= s_m) continue;
    lines.emplace_back(network::MarkingAt(road, line, s_m).value, line.width_m, std::string(line.colour), line.stroke_m,
                       line.gap_m);
  }
  // By how they are painted, and only then by t: a crossing's stripes lie over the road's own lines.
  std::sort(lines.begin(), lines.end(), [](const auto& a, const auto& b) {
    return std::tuple(std::get<1>(a), std::get<2>(a), std::get<3>(a), std::get<4>(a), std::get<0>(a)) <
           std::tuple(std::get<1>(b), std::get<2>(b), std::get<3>(b), std::get<4>(b), std::get<0>(b));
  });
  return lines;
}

// A line keeps the distance to the nearest lane's edge that it has in its middle: those of the example that cross over
// their road alone are moved.
TEST_P(NetworkExport, LinesComeBackWhereTheyWere) {
  double worst_m = 0.0;
  for (std::uint32_t r = 0; r < ours().roads().size(); ++r) {
    const network::Road &a = ours().roads()[r], &b = again_->roads()[r];
    const auto lines = network::MarkingsOf(a), again = network::MarkingsOf(b);
    for (std::uint64_t i = 0; i < 60; ++i) {
      const double s = base::RandomUniform({r, i, 4}, 0.0, a.length_m());
      const auto painted = LinesAt(a, lines, s), theirs = LinesAt(b, again, s);
      ASSERT_EQ(painted.size(), theirs.size()) << a.id() << " " << s;
      for (std::size_t k = 0; k < painted.size(); ++k) {
        const double apart_m = std::fabs(std::get<0>(painted[k]) - std::get<0>(theirs[k]));
        worst_m = std::max(worst_m, apart_m);
        EXPECT_EQ(std::get<1>(painted[k]), std::get<1>(theirs[k])) << a.id() << " " << s;
        EXPECT_EQ(std::get<2>(painted[k]), std::get<2>(theirs[k])) << a.id() << " " << s;
        EXPECT_EQ(std::get<3>(painted[k]), std::get<3>(theirs[k])) << a.id() << " " << s;
        EXPECT_EQ(std::get<4>(painted[k]), std::get<4>(theirs[k])) << a.id() << " " << s;
      }
    }
  }
  EXPECT_LT(worst_m, IsExample() ? 0.6 : 1e-9);
}

std::string Said(const std::vector<network::LaneValidity>& lanes) {
  std::string text;
  for (const auto& [from, to] : lanes) text += fmt::format(" [{} {}]", from, to);
  return text;
}
std::string Said(const network::Signal& s) {
  return fmt::format("{} {} {} {} {} {} {} {} {} {} {} '{}' {} {} {} {} {} {}{} {}", s.id, s.name, s.s_m, s.t_m,
                     s.z_offset_m, s.orientation, s.dynamic, s.country, s.type, s.subtype, s.unit, s.text,
                     s.value.value_or(-1.0), s.height_m, s.width_m, s.h_offset_rad, s.pitch_rad, s.roll_rad,
                     Said(s.validity), fmt::join(s.depends_on, " "));
}
std::string Said(const network::Object& o) {
  std::string text =
      fmt::format("{} {} {} {} {} {} {} {} {} {} {} {} {} {} {} {} {}{}", o.id, o.name, o.type, o.subtype,
                  o.orientation, o.s_m, o.t_m, o.z_offset_m, o.hdg_rad, o.pitch_rad, o.roll_rad, o.length_m, o.width_m,
                  o.height_m, o.radius_m, o.valid_length_m, o.dynamic, Said(o.validity));
  for (const network::Repeat& r : o.repeats) {
    text += fmt::format(" ({} {} {} {} {} {} {} {} {} {} {})", r.s_m, r.length_m, r.distance_m, r.t_start_m, r.t_end_m,
                        r.z_start_m, r.z_end_m, r.height_start_m, r.height_end_m, r.width_start_m, r.width_end_m);
  }
  if (o.material.friction) text += fmt::format(" '{}' {}", o.material.surface, *o.material.friction);
  for (const network::Outline& outline : o.outlines) {
    text += outline.closed ? " closed" : " open";
    for (const network::Corner& c : outline.corners)
      text += fmt::format(" ({} {} {} {} {})", c.local, c.first_m, c.second_m, c.dz_m, c.height_m);
  }
  return text;
}
template <class Container>
std::vector<std::string> AllSaid(const Container& things) {
  std::vector<std::string> said;
  for (const auto& thing : things) said.push_back(Said(thing));
  return said;
}

TEST_P(NetworkExport, WhatStandsThereComesBack) {
  std::size_t things = 0;
  for (std::uint32_t r = 0; r < ours().roads().size(); ++r) {
    const network::RoadSpec &a = ours().roads()[r].spec(), &b = again_->roads()[r].spec();
    EXPECT_EQ(AllSaid(a.signals), AllSaid(b.signals));
    EXPECT_EQ(AllSaid(a.objects), AllSaid(b.objects));
    things += a.signals.size() + a.objects.size();
    ASSERT_EQ(a.structures.size(), b.structures.size());
    for (std::size_t i = 0; i < a.structures.size(); ++i) {
      // Bridges are written before tunnels or behind them, as they were said; they are read tunnels first.
      const auto same = [&](const network::Structure& other) {
        return other.id == a.structures[i].id && other.bridge == a.structures[i].bridge &&
               other.name == a.structures[i].name && other.s_m == a.structures[i].s_m &&
               other.length_m == a.structures[i].length_m;
      };
      EXPECT_EQ(std::count_if(b.structures.begin(), b.structures.end(), same), 1) << a.structures[i].id;
    }
    EXPECT_EQ(a.crg.size(), b.crg.size());
    EXPECT_EQ(a.unevenness.size(), b.unevenness.size());
  }
  if (std::string(GetParam()) == "ring.yaml")
    EXPECT_EQ(things, 0u);
  else
    EXPECT_GT(things, 3u);
}

TEST_P(NetworkExport, JunctionsAndLightsComeBack) {
  ASSERT_EQ(ours().junctions().size(), again_->junctions().size());
  for (std::size_t j = 0; j < ours().junctions().size(); ++j) {
    const network::Junction &a = ours().junctions()[j], &b = again_->junctions()[j];
    const auto said = [](const network::Junction& junction) {
      std::string text = junction.id + " '" + junction.name + "'";
      for (const auto& c : junction.connections) {
        text +=
            fmt::format(" {} {} {} {}", c.id, c.incoming_road, c.connecting_road, c.contact == network::End::kStart);
        for (const auto& link : c.lane_links) text += fmt::format(" {}>{}", link.from, link.to);
      }
      for (const auto& p : junction.priorities) text += fmt::format(" {} before {}", p.high, p.low);
      return text + fmt::format(" {}", fmt::join(junction.controllers, " "));
    };
    EXPECT_EQ(said(a), said(b));
  }
  ASSERT_EQ(ours().controllers().size(), again_->controllers().size());
  for (std::size_t c = 0; c < ours().controllers().size(); ++c) {
    const network::Controller &a = ours().controllers()[c], &b = again_->controllers()[c];
    EXPECT_EQ(a.id, b.id);
    EXPECT_EQ(a.name, b.name);
    ASSERT_EQ(a.controls.size(), b.controls.size());
    for (std::size_t i = 0; i < a.controls.size(); ++i) EXPECT_EQ(a.controls[i].signal_id, b.controls[i].signal_id);
    ASSERT_EQ(a.times.has_value(), b.times.has_value());
    if (!a.times) continue;
    EXPECT_TRUE(a.times->cycle_s == b.times->cycle_s && a.times->green_from_s == b.times->green_from_s &&
                a.times->green_s == b.times->green_s && a.times->amber_s == b.times->amber_s &&
                a.times->red_amber_s == b.times->red_amber_s);
  }
}

TEST_P(NetworkExport, NetconvertFindsEveryEdgeWithItsLength) {
  if (!HasNetconvert()) GTEST_SKIP() << "SUMO's netconvert is not installed";
  ExpectEveryEdge(folder_.path(), ours(), IdsOf(ours()), std::string(GetParam()) == "ring.yaml" ? 1 : 2);
  ExpectEveryLane(folder_.path(), ours(), IdsOf(ours()));
  ExpectEveryWay(folder_.path(), ours(), IdsOf(ours()));
}

// Within a junction the exported file's ground is made of its ways, the world's is one surface: SUELO of both, at
// places on the lanes of its ways. They lie up to 12.0 mm apart (docs/reference/opendrive.md), which is not the
// millimetre that is wanted; the bound holds that it becomes no more.
constexpr double kMeasuredApart_m = 0.0125;

class NetworkExportOfJunctions : public NetworkExport {};

TEST_P(NetworkExportOfJunctions, HasTheWorldsGroundNearly) {
  ASSERT_FALSE(ours().junctions().empty());
  const auto again = World::Load(file_);
  ASSERT_TRUE(again.ok()) << again.error().Text();
  for (std::size_t j = 0; j < ours().junctions().size(); ++j) {
    const network::Junction& junction = ours().junctions()[j];
    std::vector<std::uint32_t> ways;
    for (std::uint32_t r = 0; r < ours().roads().size(); ++r) {
      if (ours().roads()[r].spec().junction == junction.id) ways.push_back(r);
    }
    ASSERT_FALSE(ways.empty());
    double worst_m = 0.0, worst_x = 0.0, worst_y = 0.0;
    const int points = static_cast<int>(Setting("RODEIRA_JUNCTION_POINTS", 10'000));
    for (int i = 0; i < points; ++i) {
      const auto draw = [&](std::uint64_t what) {
        return base::RandomUniform({static_cast<std::uint64_t>(j), static_cast<std::uint64_t>(i), what});
      };
      const network::Road& way =
          ours().roads()[ways[static_cast<std::size_t>(draw(1) * static_cast<double>(ways.size()))]];
      const double s = draw(2) * way.length_m();
      const network::LaneSection& section = way.SectionAt(s);
      double low = 0.0, high = 0.0;  // over the lanes that are driven on
      for (const auto* side : {&section.left, &section.right}) {
        for (const network::Lane& lane : *side) {
          const auto span = section.Span(lane.id, way.CentreAt(s), s);
          if (network::IsDrivable(lane.type))
            low = std::min({low, span->inner_t_m, span->outer_t_m}),
            high = std::max({high, span->inner_t_m, span->outer_t_m});
        }
      }
      const Eigen::Vector3d p = way.Surface(s, low + draw(3) * (high - low)).p_W;
      const SurfacePoint a = world_->At(p.x(), p.y(), p.z()), b = again.value()->At(p.x(), p.y(), p.z());
      ASSERT_TRUE(a.inside && b.inside);
      if (const double apart = std::fabs(a.z_m - b.z_m); apart > worst_m)
        worst_m = apart, worst_x = p.x(), worst_y = p.y();
    }
    EXPECT_LT(worst_m, kMeasuredApart_m) << junction.id << " at (" << worst_x << ", " << worst_y << ")";
  }
}

TEST_P(NetworkExport, GeoReferenceIsAProjStringOfTheSamePlaces) {
  EXPECT_EQ(again_->geo_reference().empty(), ours().geo_reference().empty());
  if (ours().geo_reference().empty()) return;
  EXPECT_TRUE(again_->geo_reference().starts_with("+proj=")) << again_->geo_reference();
  EXPECT_EQ(again_->geo_reference().find("+type"), std::string::npos);
  const auto a = terrain::Geographic::Make(ours().geo_reference()),
             b = terrain::Geographic::Make(again_->geo_reference());
  ASSERT_TRUE(a.ok() && b.ok());
  for (const double x : {-1000.0, 0.0, 500'000.0}) {
    const auto here = a.value().ToEarth(x, 20'000.0), there = b.value().ToEarth(x, 20'000.0);
    ASSERT_TRUE(here && there);
    EXPECT_NEAR(here->longitude_deg, there->longitude_deg, 1e-9);
    EXPECT_NEAR(here->latitude_deg, there->latitude_deg, 1e-9);
  }
}

// The world of docs/tutorials/first-road.md; its junction is called 'at the farm'.
TEST(NetworkExportIds, HaveNoBlanksAndNamesAreKept) {
  const std::string document =
      base::ReadText(std::filesystem::path(SourceDir()) / "docs/tutorials/first-road.md").value();
  const std::size_t begin = document.find("```yaml\n") + 8;
  const auto world =
      World::Parse(document.substr(begin, document.find("\n```\n", begin) + 1 - begin), "first_road.yaml");
  ASSERT_TRUE(world.ok()) << world.error().Text();
  const cli::TemporaryFolder folder;
  ASSERT_TRUE(WriteOpenDrive(*world.value(), folder.path() / "it.xodr").ok());
  const auto again = opendrive::LoadNetwork(folder.path() / "it.xodr", opendrive::Tolerance::Strict());
  ASSERT_TRUE(again.ok()) << again.error().Text();
  ASSERT_EQ(again.value()->junctions().size(), 1u);
  EXPECT_EQ(again.value()->junctions()[0].id, "at_the_farm");
  EXPECT_EQ(again.value()->junctions()[0].name, "at the farm");
  EXPECT_TRUE(again.value()->FindRoad("at_the_farm/valley").has_value());
  if (!HasNetconvert()) GTEST_SKIP() << "SUMO's netconvert is not installed";
  ExpectEveryEdge(folder.path(), *world.value()->network(), IdsOf(*again.value()), 6);
}

// What differs goes on differing, and links follow.
TEST(NetworkExportIds, StayDifferent) {
  const auto world = World::Parse(
      "rodeira: world/2\nname: odd\nground: {kind: plane}\nroads:\n"
      "  - {id: a b, axis: [line: {length_m: 100}], z_m: 0, section: {template: rural}, successor: {road: a_b}}\n"
      "  - {id: a_b, start: {x_m: 100, y_m: 0}, axis: [line: {length_m: 100}], z_m: 0, section: {template: rural}, "
      "successor: {road: \"a,b\"}}\n"
      "  - {id: \"a,b\", start: {x_m: 200, y_m: 0}, axis: [line: {length_m: 100}], z_m: 0, section: {template: "
      "rural}}\n",
      "odd.yaml");
  ASSERT_TRUE(world.ok()) << world.error().Text();
  const cli::TemporaryFolder folder;
  ASSERT_TRUE(WriteOpenDrive(*world.value(), folder.path() / "it.xodr").ok());
  const auto again = opendrive::LoadNetwork(folder.path() / "it.xodr", opendrive::Tolerance::Strict());
  ASSERT_TRUE(again.ok()) << again.error().Text();
  EXPECT_EQ(IdsOf(*again.value()), (std::vector<std::string>{"a_b_2", "a_b", "a_b_3"}));
  const auto& roads = again.value()->roads();
  EXPECT_EQ(roads[0].spec().name, "a b");
  EXPECT_EQ(roads[0].spec().successor->id, "a_b");
  EXPECT_EQ(roads[1].spec().predecessor->id, "a_b_2");
  EXPECT_EQ(roads[1].spec().successor->id, "a_b_3");
  if (!HasNetconvert()) GTEST_SKIP() << "SUMO's netconvert is not installed";
  ExpectEveryEdge(folder.path(), *world.value()->network(), IdsOf(*again.value()), 6);
}

std::string NameOf(const testing::TestParamInfo<const char*>& file) {
  return std::string(file.param).substr(0, std::string(file.param).find_first_of("./"));
}
INSTANTIATE_TEST_SUITE_P(All, NetworkExport,
                         testing::Values("haste.yaml", "motorway.yaml", "flat.yaml", "lights.yaml", "n222.yaml",
                                         "ring.yaml", "example/world.yaml"),
                         NameOf);
INSTANTIATE_TEST_SUITE_P(All, NetworkExportOfJunctions,
                         testing::Values("haste.yaml", "lights.yaml", "example/world.yaml"), NameOf);

}  // namespace
}  // namespace rodeira::road
