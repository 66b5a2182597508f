// SPDX-License-Identifier: Apache-2.0
// The land beside the roads of OpenDRIVE files: banks between roads of different heights, and no step anywhere.
#include "common/world/road/network_land.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <vector>

#include "common/core/base/random.hpp"
#include "common/world/road/world.hpp"
#include "tests/common/world/opendrive/sample.hpp"
#include "tests/launch/rodeira/temporary_folder.hpp"

namespace rodeira::road {
namespace {

using Eigen::Vector2d;
using network::Network;

std::shared_ptr<const World> Load(const std::string& roads) {
  const cli::TemporaryFolder folder;
  return World::Load(folder.Write("land.xodr", opendrive::Document(roads))).value();
}

// Straight along x from 0 to 100, of two lanes of 3.5 m.
opendrive::RoadText Along(const char* id, double y_m, double z_m) {
  opendrive::RoadText road;
  road.id = id;
  road.geometry = fmt::format(R"(<geometry s="0" x="0" y="{}" hdg="0" length="100"><line/></geometry>)", y_m);
  road.elevation = fmt::format(R"(<elevation s="0" a="{}" b="0" c="0" d="0"/>)", z_m);
  return road;
}

// Edges at y = 3.5 (z = 6) and 43.5 (z = 0): level, then 12 m of bank in the middle, then level.
TEST(NetworkLand, BetweenRoadsOfDifferentHeightsABankOfOneInTwoLies) {
  const auto world = Load(Along("1", 0.0, 6.0).Text() + Along("2", 47.0, 0.0).Text());
  for (std::uint64_t i = 0; i < 1000; ++i) {
    const double x = base::RandomUniform({i, 1}, 5.0, 95.0), away = base::RandomUniform({i, 2}, 0.01, 39.99);
    const SurfacePoint at = world->At(x, 3.5 + away);
    EXPECT_NEAR(at.z_m, std::clamp(13.0 - 0.5 * away, 0.0, 6.0), 1e-9) << away;
    if (std::fabs(away - 14.0) > 1e-3 && std::fabs(away - 26.0) > 1e-3) {
      EXPECT_NEAR(at.slope_y, away > 14.0 && away < 26.0 ? -0.5 : 0.0, 1e-9) << away;
    }
    EXPECT_EQ(at.surface, ground::Surface::kGrass);
  }
}

// 8 m for the same 6 m.
TEST(NetworkLand, WhereRoadsStandCloserItIsAsSteepAsItMustBe) {
  const auto world = Load(Along("1", 0.0, 6.0).Text() + Along("2", 15.0, 0.0).Text());
  for (std::uint64_t i = 0; i < 1000; ++i) {
    const double x = base::RandomUniform({i, 1}, 5.0, 95.0), away = base::RandomUniform({i, 2}, 0.01, 7.99);
    const SurfacePoint at = world->At(x, 3.5 + away);
    EXPECT_NEAR(at.z_m, 6.0 - 0.75 * away, 1e-9) << away;
    EXPECT_NEAR(at.slope_y, -0.75, 1e-9) << away;
  }
}

// Around the origin lie edges 5 m away at 10 m and at 0 m, which meet by a slope of 1 at 5 m, one 2 m away at 8 m, and
// one 0.6 m away at 4.5 m. The third lets them meet by 8 / 7 at 5.71 m, and only by such a slope the fourth holds
// anything: it and the third meet by 3.5 / 2.6.
TEST(NetworkLand, WhatIsNearerCountsWhereASlopeIsSteeperThanTheFirstTwoAsk) {
  const auto road = [](const char* id, double x_m, double y_m, double heading_rad, double z_m) {
    opendrive::RoadText text = Along(id, 0.0, z_m);
    text.length = 8.0;
    text.geometry =
        fmt::format(R"(<geometry s="0" x="{}" y="{}" hdg="{}" length="8"><line/></geometry>)", x_m, y_m, heading_rad);
    return text.Text();
  };
  const auto world = Load(road("1", -4.0, 8.5, 0.0, 10.0) + road("2", -4.0, -8.5, 0.0, 0.0) +
                          road("3", 5.5, -4.0, 0.5 * M_PI, 8.0) + road("4", -4.1, -4.0, 0.5 * M_PI, 4.5));
  EXPECT_NEAR(world->At(0.0, 0.0).z_m, 4.5 + 0.6 * 3.5 / 2.6, 1e-9);
}

// Roads beyond its reach, between the others in the file, hold no land here.
TEST(NetworkLand, WhatIsFarAwayChangesNoBit) {
  const std::string one = Along("1", 0.0, 6.0).Text(), two = Along("2", 15.0, 0.0).Text(),
                    three = Along("3", 60.0, 3.0).Text();
  const auto alone = Load(one + two + three);
  const auto among = Load(one + Along("a", 900.0, -40.0).Text() + two + Along("b", -700.0, 90.0).Text() +
                          Along("c", 1500.0, 5.0).Text() + three);
  for (std::uint64_t i = 0; i < 3000; ++i) {
    const double x = base::RandomUniform({i, 1}, -60.0, 160.0), y = base::RandomUniform({i, 2}, -60.0, 120.0);
    const SurfacePoint a = alone->At(x, y), b = among->At(x, y);
    ASSERT_EQ(a.inside, b.inside) << x << " " << y;
    EXPECT_EQ(a.z_m, b.z_m) << x << " " << y;
    EXPECT_EQ(a.slope_x, b.slope_x) << x << " " << y;
  }
}

TEST(NetworkLand, WhatWasAskedBeforeChangesNoBit) {
  const auto files = opendrive::RealFiles();
  const auto file =
      std::find_if(files.begin(), files.end(), [](const auto& name) { return name.stem() == "carla_Town04"; });
  if (file == files.end()) GTEST_SKIP() << "skipped: carla_Town04.xodr is not beside the project";
  const auto world = World::Load(*file).value();
  const Extents extents = world->extents();
  std::vector<Vector2d> places;
  for (std::uint64_t i = 0; i < 4000; ++i) {  // half of them beside the one before
    const bool beside = i % 2 == 1;
    places.push_back(beside ? Vector2d(places.back() + Vector2d(base::RandomUniform({i, 1}, -9.0, 9.0),
                                                                base::RandomUniform({i, 2}, -9.0, 9.0)))
                            : Vector2d(base::RandomUniform({i, 1}, extents.west_m, extents.east_m),
                                       base::RandomUniform({i, 2}, extents.south_m, extents.north_m)));
  }
  std::vector<SurfacePoint> forward;
  for (const Vector2d& p_W : places) forward.push_back(world->At(p_W.x(), p_W.y()));
  for (std::size_t i = places.size(); i-- > 0;) {
    const SurfacePoint again = world->At(places[i].x(), places[i].y());
    ASSERT_EQ(again.inside, forward[i].inside);
    EXPECT_EQ(again.z_m, forward[i].z_m) << places[i].transpose();
  }
}

// By every edge of the file. The places lie anywhere, and close to roads, where edges of different heights touch.
TEST(NetworkLand, ListsLeaveNothingOutThatChangesABit) {
  const auto files = opendrive::RealFiles();
  if (files.empty()) GTEST_SKIP() << "no real .xodr files beside the project";
  for (const auto& file : files) {
    const auto world = World::Load(file).value();
    const NetworkLand& land = *world->land();
    const Extents extents = world->extents();
    const auto roads = world->network()->roads();
    std::size_t held = 0, steep = 0;
    for (std::uint64_t i = 0; i < 6000; ++i) {
      Vector2d p_W(base::RandomUniform({i, 1}, extents.west_m, extents.east_m),
                   base::RandomUniform({i, 2}, extents.south_m, extents.north_m));
      if (i % 2 == 1) {
        const network::Road& road =
            roads[static_cast<std::size_t>(base::RandomUniform({i, 3}, 0.0, static_cast<double>(roads.size())))];
        p_W = road.Surface(base::RandomUniform({i, 4}, 0.0, road.length_m()), 0.0).p_W.head<2>() +
              Vector2d(base::RandomUniform({i, 5}, -25.0, 25.0), base::RandomUniform({i, 6}, -25.0, 25.0));
      }
      thread_local std::vector<network::Surfacing> surfaces;
      world->network()->Surfaces(p_W.x(), p_W.y(), surfaces);
      if (!surfaces.empty()) continue;  // there it is no land
      const auto at = land.At(p_W), searched = land.AtBySearch(p_W);
      ASSERT_EQ(at.has_value(), searched.has_value()) << file.filename() << " " << p_W.transpose();
      if (!at) continue;
      ++held, steep += at->slope_W.norm() > 0.6;
      ASSERT_EQ(at->z_m, searched->z_m) << file.filename() << " " << p_W.transpose();
      ASSERT_EQ(at->slope_W, searched->slope_W) << file.filename() << " " << p_W.transpose();
    }
    EXPECT_GT(held, 300u) << file.filename();
    std::printf("%s: %zu places of land, %zu of them steep\n", file.stem().c_str(), held, steep);
  }
}

// Whether the road's lines lie over themselves near a station, where it bends faster than its lanes are wide: there a
// place has two heights of one road.
bool FoldsNear(const network::Road& road, double s_m) {
  for (double s = std::max(0.0, s_m - 8.0); s <= std::min(road.length_m(), s_m + 8.0); s += 0.1) {
    double right, left;
    road.SectionAt(s).Bounds(road.spec().lane_offset, s, s, right, left);
    const double curvature = road.axis().Evaluate(s).curvature_1pm;
    if (std::max(curvature * left, curvature * right) > 0.95) return true;
  }
  return false;
}

// Where roads lie over one another both edges are at the point itself, at different heights: no slope meets both. Where
// two elements of a line meet by a kink (a milliradian at most) the panels before and after it share a strip of some
// millimetres within the bend.
TEST(NetworkLand, OnRoadsItLiesBetweenTheirHeights) {
  constexpr double kKink_m = 1e-4;
  const auto files = opendrive::RealFiles();
  if (files.empty()) GTEST_SKIP() << "no real .xodr files beside the project";
  for (const auto& file : files) {
    const auto world = World::Load(file).value();
    const NetworkLand& land = *world->land();
    const auto roads = world->network()->roads();
    std::size_t asked = 0, apart = 0, folds = 0;
    for (std::uint64_t i = 0; i < 40'000; ++i) {
      const network::Road& road =
          roads[static_cast<std::size_t>(base::RandomUniform({i, 1}, 0.0, static_cast<double>(roads.size())))];
      const double s = base::RandomUniform({i, 2}, 0.0, road.length_m());
      double right, left;
      road.SectionAt(s).Bounds(road.spec().lane_offset, s, s, right, left);
      const Vector2d p_W = road.Surface(s, base::RandomUniform({i, 3}, right, left)).p_W.head<2>();
      const auto at = land.At(p_W);
      if (!at) continue;  // a deck, and nothing near it
      ASSERT_TRUE(std::isfinite(at->z_m) && at->slope_W.allFinite())
          << file.filename() << " " << road.spec().id << " s " << s;
      thread_local std::vector<network::Surfacing> surfaces;
      world->network()->Surfaces(p_W.x(), p_W.y(), surfaces);
      double low = std::numeric_limits<double>::infinity(), high = -low;
      for (const network::Surfacing& at_road : surfaces) {
        const auto& place = at_road.place;
        if (land.IsOnDeck(place.lane.road, place.s_m)) continue;
        low = std::min(low, at_road.sample.p_W.z()), high = std::max(high, at_road.sample.p_W.z());
      }
      if (!(low <= high)) continue;
      ++asked, apart += high - low > 1e-3;
      if (at->z_m >= low - kKink_m && at->z_m <= high + kKink_m) continue;
      ASSERT_TRUE(
          std::any_of(surfaces.begin(), surfaces.end(),
                      [&](const auto& other) { return FoldsNear(roads[other.place.lane.road], other.place.s_m); }))
          << file.filename() << " " << road.spec().id << " s " << s << ": " << at->z_m << " is not between " << low
          << " and " << high;
      ++folds;
    }
    EXPECT_GT(asked, 30'000u) << file.filename();
    std::printf("%s: %zu places on roads, %zu of them at different heights, %zu where one road lies over itself\n",
                file.stem().c_str(), asked, apart, folds);
  }
}

// Road 2 crosses road 1 at x = 50, 6 m higher: a deck from where banks of 1 in 2 come down to road 1's edges, y = ±3.5.
// Under it and beside it lies the land, which rises to the road's height where the deck ends.
TEST(NetworkLand, GoesThroughUnderADeck) {
  opendrive::RoadText across = Along("2", 0.0, 6.0);
  across.geometry = R"(<geometry s="0" x="50" y="-50" hdg="1.5707963267948966" length="100"><line/></geometry>)";
  const auto world = Load(Along("1", 0.0, 0.0).Text() + across.Text());
  const auto& deck = world->land()->decks().at(1);
  ASSERT_EQ(deck.size(), 1u);
  EXPECT_TRUE(world->land()->decks().at(0).empty());
  EXPECT_NEAR(deck[0].from_s_m, 50.0 - 3.5 - 12.0, 2.0);
  EXPECT_NEAR(deck[0].to_s_m, 50.0 + 3.5 + 12.0, 2.0);
  EXPECT_EQ(world->At(50.0, 5.0).z_m, 6.0);
  for (double y = 3.6; y < deck[0].to_s_m - 50.0; y += 0.1) {  // between road 1's edge and the deck's end
    const double from_edge = y - 3.5, from_end = deck[0].to_s_m - 50.0 - y;
    EXPECT_NEAR(
        world->At(50.0, y, 0.0).z_m,
        0.5 * (std::min(0.5 * from_edge, 6.0 + 0.5 * from_end) + std::max(6.0 - 0.5 * from_end, -0.5 * from_edge)),
        1e-9)
        << y;
  }
  EXPECT_NEAR(world->At(58.0, 4.0).z_m, 0.0, 1e-9);
  EXPECT_NEAR(world->At(50.0, deck[0].to_s_m - 50.0 - 1e-6, 0.5).z_m, 6.0, 1e-3);
  EXPECT_EQ(world->At(50.0, deck[0].to_s_m - 50.0 + 1e-6, 0.5).z_m, 6.0);
  EXPECT_EQ(world->At(50.0, 40.0, -20.0).z_m, 6.0);  // on the ground: nothing lies under it
}

// What lies at a place under a point at a height.
struct Spot {
  Vector2d p_W = Vector2d::Zero();
  SurfacePoint ground;
  bool land = false;  // no road is over or under it
};

Spot SpotAt(const World& world, const Vector2d& p_W, double z_m) {
  thread_local std::vector<network::Surfacing> surfaces;
  world.network()->Surfaces(p_W.x(), p_W.y(), surfaces);
  return {p_W, world.At(p_W.x(), p_W.y(), z_m), surfaces.empty() && world.network()->GroundAt(p_W) == nullptr};
}

struct Step {
  double height_m = 0.0;
  Spot from, to;
};

// The greatest step between two places, by halves down to a micrometre: the slopes at both ends say what the ground may
// rise by.
void Seek(const World& world, const Spot& a, const Spot& b, Step& worst) {
  const Vector2d way = b.p_W - a.p_W;
  const double rise = b.ground.z_m - a.ground.z_m, begin = a.ground.slope_x * way.x() + a.ground.slope_y * way.y(),
               end = b.ground.slope_x * way.x() + b.ground.slope_y * way.y();
  if (std::fabs(rise - 0.5 * (begin + end)) + 0.5 * std::fabs(begin - end) < 5e-4) return;
  if (way.norm() < 1e-6) {
    if (std::fabs(rise) > worst.height_m) worst = {std::fabs(rise), a, b};
    return;
  }
  const Spot middle = SpotAt(world, a.p_W + 0.5 * way, a.ground.z_m);
  Seek(world, a, middle, worst);
  Seek(world, middle, b, worst);
}

// Whether the road beside which a step lies has one itself, as high or higher, within 5 m of there: between records of
// its elevation.
bool IsTheRoads(const Network& network, const Step& step) {
  constexpr double kAlong_m = 1e-3;
  const auto place = network.Locate(step.from.p_W.x(), step.from.p_W.y(), step.from.ground.z_m);
  const network::Road& road = network.roads()[place->lane.road];
  double most = 0.0;
  for (double s = std::max(0.0, place->s_m - 5.0); s + kAlong_m < std::min(road.length_m(), place->s_m + 5.0);
       s += kAlong_m) {
    most = std::max(most, std::fabs(road.Surface(s + kAlong_m, 0.0).p_W.z() - road.Surface(s, 0.0).p_W.z()));
  }
  return most >= step.height_m;
}

// Whether the road at a step is met past one of its ends: a road goes on over a gap of up to 5 cm, and the land does
// not know of that. Where it ends with a kerb beside grass it steps there.
bool IsPastAnEnd(const Network& network, const Step& step) {
  const Spot& on_road = step.from.land ? step.to : step.from;
  std::vector<network::Surfacing> surfaces;
  network.Surfaces(on_road.p_W.x(), on_road.p_W.y(), surfaces);
  return std::any_of(surfaces.begin(), surfaces.end(), [&](const network::Surfacing& at) {
    const double length_m = network.roads()[at.place.lane.road].length_m();
    return at.place.s_m < 1e-6 || at.place.s_m > length_m - 1e-6;
  });
}

bool IsOverDeck(const World& world, const Spot& spot) {
  std::vector<network::Surfacing> surfaces;
  world.network()->Surfaces(spot.p_W.x(), spot.p_W.y(), surfaces);
  return std::any_of(surfaces.begin(), surfaces.end(), [&](const network::Surfacing& road) {
    return world.land()->IsOnDeck(road.place.lane.road, road.place.s_m);
  });
}

// Straight walks across real files, off their roads and over them. A walk to a deck from the side goes through under
// it or stands before it: that is no step.
TEST(NetworkLand, NoWalkBesideTheRoadsOfARealFileMeetsAStep) {
  const auto files = opendrive::RealFiles();
  if (files.empty()) GTEST_SKIP() << "no real .xodr files beside the project";
  for (const auto& file : files) {
    const auto world = World::Load(file).value();
    const Extents within = world->extents();
    double walked_m = 0.0;
    int onto_roads = 0, a_roads = 0;
    double edge_m = 0.0;
    for (std::uint64_t i = 0; i < 300; ++i) {
      const double heading = base::RandomUniform({i, 3}, 0.0, 2.0 * M_PI);
      const Vector2d from(base::RandomUniform({i, 1}, within.west_m, within.east_m),
                          base::RandomUniform({i, 2}, within.south_m, within.north_m));
      const Vector2d ahead(std::cos(heading), std::sin(heading));
      std::optional<Spot> last;
      for (int k = 0; k < 800; ++k) {
        const Spot at =
            SpotAt(*world, from + 0.25 * k * ahead, last ? last->ground.z_m : std::numeric_limits<double>::quiet_NaN());
        if (!at.ground.inside) break;
        if (last && (last->land || at.land)) {
          walked_m += 0.25;
          Step step;
          Seek(*world, *last, at, step);
          if (step.height_m > 1e-3) {
            if (step.from.land && step.to.land) {
              ++a_roads;
              if (!IsTheRoads(*world->network(), step))
                ADD_FAILURE() << file.filename() << ": " << step.height_m << " m at ("
                              << fmt::format("{:.6f}, {:.6f}", step.from.p_W.x(), step.from.p_W.y()) << ")";
            } else if (!IsOverDeck(*world, step.from) && !IsOverDeck(*world, step.to)) {
              ++onto_roads;
              edge_m = std::max(edge_m, step.height_m);
              if (!IsPastAnEnd(*world->network(), step))
                ADD_FAILURE() << file.filename() << ": " << step.height_m << " m onto a road at ("
                              << fmt::format("{:.6f}, {:.6f}", step.from.p_W.x(), step.from.p_W.y()) << ")";
            }
          }
        }
        last = at;
      }
    }
    if (file.stem() != "esmini_multi_intersections") {  // there road 202 begins with a kerb beside grass
      EXPECT_EQ(onto_roads, 0) << file.filename();
    }
    EXPECT_LT(edge_m, 0.02) << file.filename();
    EXPECT_GT(walked_m, 5'000.0) << file.filename();
    RecordProperty(file.stem().string(),
                   fmt::format("{:.1f} km, {} steps that a road has itself, {} onto roads, worst {:.4f} m",
                               1e-3 * walked_m, a_roads, onto_roads, edge_m));
    std::printf("%s: %.1f km, %d steps that a road has itself, %d onto roads, worst %.4f m\n", file.stem().c_str(),
                1e-3 * walked_m, a_roads, onto_roads, edge_m);
  }
}

}  // namespace
}  // namespace rodeira::road
