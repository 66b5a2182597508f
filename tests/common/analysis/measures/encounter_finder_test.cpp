// SPDX-License-Identifier: Apache-2.0
// Vehicles on given paths: the times of their encounters are closed forms.
#include "common/analysis/measures/encounter_finder.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace rodeira::measures {
namespace {

constexpr double kLength = 4.5, kWidth = 1.8, kEast = 0.0, kNorth = std::numbers::pi / 2.0;

// A pose of a reference point in the middle of the footprint.
struct Pose {
  double x = 0.0, y = 0.0, heading = 0.0, z = 0.0;
};

// Puts vehicles through the finder that go as functions of time say, each at its own rate.
class Encounters {
 public:
  template <class Own, class... Others>
  std::vector<Encounter> Of(double seconds, const Own& own, const Others&... others) {
    EncounterFinder finder;
    const auto samples = static_cast<int>(seconds * 100.0);
    const auto add_others = [&](int k) {
      if (k < 0 || k % 2 != 0) return;
      const double t = k * 0.01;
      std::vector<OtherVehicle> all;
      std::int64_t id = 0;
      for (const Pose& p : std::initializer_list<Pose>{others(t)...})
        all.push_back({++id, p.x, p.y, p.z, 10.0, kLength, kLength / 2.0, p.heading, kWidth});
      finder.AddOthers(t, all);
    };
    for (int k = 0; k < samples; ++k) {
      const Pose p = own(k * 0.01);
      finder.AddOwn(k * 0.01, p.z, {{p.x, p.y}, p.heading, kLength, kWidth}, false);
      add_others(k - 2000);
    }
    for (int k = std::max(0, samples - 2000); k < samples; ++k) add_others(k);
    return finder.Finish();
  }
};

// The own front is d1 before the crossing of the middle lines at time 0, the other's d2.
Pose Eastward(double t, double d1, double v1) { return {v1 * t - d1 - kLength / 2.0, 0.0, kEast}; }
Pose Northward(double t, double d2, double v2) { return {0.0, v2 * t - d2 - kLength / 2.0, kNorth}; }

// Two cars at right angles: PET = (d2 - w/2) / v2 - (d1 + w/2 + L) / v1, with either of them as the own one.
TEST(EncounterFinder, TwoCarsAtRightAngles) {
  for (const double d2 : {130.0, 160.0, 200.0}) {
    const auto first = [](double t) { return Eastward(t, 100.0, 10.0); };
    const auto second = [d2](double t) { return Northward(t, d2, 12.0); };
    const double enters = (d2 - kWidth / 2.0) / 12.0, leaves = (100.0 + kWidth / 2.0 + kLength) / 10.0;
    const auto own_first = Encounters().Of(30.0, first, second), own_second = Encounters().Of(30.0, second, first);
    ASSERT_EQ(own_first.size(), 1u) << d2;
    ASSERT_EQ(own_second.size(), 1u) << d2;
    for (const Encounter& e : {own_first[0], own_second[0]}) {
      EXPECT_NEAR(PostEncroachment_s(e), enters - leaves, 1e-6) << d2;
      EXPECT_NEAR(TimeOf(e), enters, 1e-6);
      EXPECT_NEAR(e.angle_rad, kNorth, 1e-9);
      EXPECT_EQ(e.other, 1);
    }
  }
}

// An oblique crossing at 50 degrees is what PostEncroachmentTime says of the whole paths.
TEST(EncounterFinder, AnObliqueCrossingIsThatOfTheWholePaths) {
  constexpr double kAngle = 50.0 * std::numbers::pi / 180.0;
  const auto own = [](double t) { return Eastward(t, 100.0, 10.0); };
  const auto other = [](double t) {
    const double s = 9.0 * t - 130.0;
    return Pose{s * std::cos(kAngle), s * std::sin(kAngle), kAngle};
  };
  std::vector<Footprint> a, b;
  for (int k = 0; k < 300; ++k) {
    const Pose p = own(0.1 * k), q = other(0.1 * k);
    a.push_back({{p.x, p.y}, p.heading, kLength, kWidth});
    b.push_back({{q.x, q.y}, q.heading, kLength, kWidth});
  }
  const auto found = Encounters().Of(30.0, own, other);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(PostEncroachment_s(found[0]), *PostEncroachmentTime(a, b, 10.0).value, 0.01);
}

// Following, an oncoming vehicle in its lane, a bridge, and a vehicle that passes 11 s later are none.
TEST(EncounterFinder, WhatIsNoEncounter) {
  const auto own = [](double t) { return Eastward(t, 100.0, 10.0); };
  EXPECT_TRUE(Encounters()
                  .Of(
                      30.0, own, [](double t) { return Eastward(t, 70.0, 10.0); },
                      [](double t) { return Eastward(t, 125.0, 10.0); },
                      [](double t) {
                        return Pose{200.0 - 10.0 * t, 3.5, std::numbers::pi};
                      },
                      [](double t) {
                        return Pose{0.0, 12.0 * t - 150.0, kNorth, 6.0};
                      })
                  .empty());
  EXPECT_TRUE(Encounters().Of(40.0, own, [](double t) { return Northward(t, 220.0, 10.0); }).empty());
  EXPECT_EQ(Encounters().Of(40.0, own, [](double t) { return Northward(t, 190.0, 10.0); }).size(), 1u);
}

// A quarter circle of 12 m from the south into the lane to the east, as a right turn: `s` from its begin.
Pose RightTurn(double s) {
  constexpr double kRadius = 12.0, kArc = kRadius * std::numbers::pi / 2.0;
  if (s < 0.0) return {-kRadius, -kRadius + s, kNorth};
  if (s > kArc) return {s - kArc, 0.0, kEast};
  const double angle = s / kRadius;
  return {-kRadius * std::cos(angle), -kRadius + kRadius * std::sin(angle), kNorth - angle};
}

// The own car joins the lane of one that has passed, and another one comes behind: two encounters. They follow one
// another from there on, which is no area of its own. One that turns off the common way meets none.
TEST(EncounterFinder, PathsThatJoinAndPathsThatPart) {
  const auto own = [](double t) { return RightTurn(6.0 * t - 90.0); };             // joins at some 17 s
  const auto ahead = [](double t) { return Pose{12.0 * t - 180.0, 0.0, kEast}; };  // at the joint at 15 s
  const auto behind = [](double t) { return Pose{6.0 * t - 130.0, 0.0, kEast}; };  // at the joint at 21.7 s
  const auto found = Encounters().Of(40.0, own, ahead, behind);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].other, 1);
  EXPECT_LT(found[0].other_leaves_s, found[0].own_enters_s);
  EXPECT_EQ(found[1].other, 2);
  // The area ends where 15 degrees of the turn are left (0.26 rad): the car has left it between the time at which its
  // middle is there and that at which it is two lengths on. The area begins between the middle of the side road and
  // that place, to which the other's front comes.
  const double place = 12.0 * (std::numbers::pi / 2.0 - 0.26);
  EXPECT_GT(found[1].own_leaves_s, (90.0 + place) / 6.0);
  EXPECT_LT(found[1].own_leaves_s, (90.0 + place + 2.0 * kLength) / 6.0);
  EXPECT_GT(found[1].other_enters_s, (130.0 - 12.0 - kLength / 2.0) / 6.0);
  EXPECT_LT(found[1].other_enters_s, (130.0 + RightTurn(place).x - kLength / 2.0) / 6.0);
  // The same in reverse: from the east lane a car turns off to the south, the other one goes on.
  const auto off = [](double t) {
    const Pose p = RightTurn(90.0 - 6.0 * t);
    return Pose{p.x, p.y, p.heading + std::numbers::pi};
  };
  const auto on = [](double t) { return Pose{110.0 - 6.0 * t, 0.0, std::numbers::pi}; };
  EXPECT_TRUE(Encounters().Of(30.0, off, on).empty());
  EXPECT_TRUE(Encounters().Of(30.0, on, off).empty());
}

// A car that waits for 40 s at the line: the vehicles that cross meanwhile are encounters, with long times.
TEST(EncounterFinder, AVehicleThatWaitsMeetsThoseThatPassBefore) {
  const auto own = [](double t) {
    const double s = t < 10.0 ? 9.0 * t : t < 50.0 ? 90.0 : 90.0 + 9.0 * (t - 50.0);
    return Pose{s - 100.0, 0.0, kEast};
  };
  const auto found = Encounters().Of(
      80.0, own, [](double t) { return Northward(t, 150.0, 10.0); }, [](double t) { return Northward(t, 300.0, 10.0); },
      [](double t) { return Northward(t, 560.0, 10.0); });
  ASSERT_EQ(found.size(), 3u);
  EXPECT_NEAR(found[0].other_enters_s, 15.0 - kWidth / 20.0, 1e-6);
  EXPECT_NEAR(found[1].other_enters_s, 30.0 - kWidth / 20.0, 1e-6);
  EXPECT_NEAR(PostEncroachment_s(found[2]), 56.0 - kWidth / 20.0 - found[2].own_leaves_s, 1e-9);
  for (const Encounter& e : found)
    EXPECT_NEAR(e.own_enters_s, 50.0 + (10.0 - kLength / 2.0 - kWidth / 2.0) / 9.0, 1e-6);
}

// A car that backs into a road meets one that comes along; one that backs along its lane before a follower meets none.
TEST(EncounterFinder, AReversingCar) {
  const auto backs = [](double t) { return Pose{2.0 * t - 30.0, 0.0, std::numbers::pi}; };
  const auto found = Encounters().Of(40.0, backs, [](double t) { return Northward(t, 180.0, 8.0); });
  ASSERT_EQ(found.size(), 1u);
  // Its rear reaches the band of the other one when its middle is half a length and half a width before it.
  const double enters = (30.0 - kLength / 2.0 - kWidth / 2.0) / 2.0,
               leaves = (30.0 + kLength / 2.0 + kWidth / 2.0) / 2.0;
  EXPECT_NEAR(found[0].own_enters_s, enters, 1e-6);
  EXPECT_NEAR(PostEncroachment_s(found[0]), (180.0 - kWidth / 2.0) / 8.0 - leaves, 1e-6);
  const auto along = [](double t) { return Pose{50.0 - 2.0 * t, 0.0, kEast}; };
  EXPECT_TRUE(Encounters().Of(20.0, along, [](double) { return Pose{0.0, 0.0, kEast}; }).empty());
}

// One that stops in the common area to the end has left nothing; what is beside the path, and a car that stands, meet
// none.
TEST(EncounterFinder, StandingVehicles) {
  const auto own = [](double t) { return Eastward(std::min(t, 12.0), 115.0, 10.0); };
  const auto stops = [](double t) { return Northward(std::min(t, 9.0), 88.0, 10.0); };
  const auto found = Encounters().Of(30.0, own, stops);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_TRUE(std::isnan(PostEncroachment_s(found[0])));
  EXPECT_TRUE(Encounters().Of(30.0, own, [](double) { return Pose{-20.0, 4.0, kNorth}; }).empty());
  const auto stands = [](double) { return Pose{-60.0, 0.0, kEast}; };
  EXPECT_TRUE(Encounters().Of(30.0, stands, [](double t) { return Northward(t, 100.0, 10.0); }).empty());
}

// A hole in the own path: nothing is swept across it. The same drive without the hole has one encounter.
TEST(EncounterFinder, NothingIsSweptAcrossAHole) {
  for (const bool has_hole : {true, false}) {
    EncounterFinder finder;
    for (int k = 0; k < 3000; ++k) {
      const double t = k * 0.01;
      if (has_hole && k >= 900 && k < 1200) continue;
      finder.AddOwn(t, 0.0, {{10.0 * t - 105.0, 0.0}, kEast, kLength, kWidth}, has_hole && k == 1200);
    }
    for (int k = 0; k < 3000; k += 2) {
      const double t = k * 0.01;
      finder.AddOthers(t,
                       std::vector<OtherVehicle>{{1, 0.0, 12.0 * t - 150.0, 0.0, 12.0, kLength, 2.25, kNorth, kWidth}});
    }
    EXPECT_EQ(finder.Finish().size(), has_hole ? 0u : 1u);
  }
}

}  // namespace
}  // namespace rodeira::measures
