// SPDX-License-Identifier: Apache-2.0
// The motions are closed forms on roads with known lanes: what the builder says must be what was put in.
#include "common/analysis/measures/drive_builder.hpp"

#include <gtest/gtest.h>

#include "common/analysis/measures/catalogue.hpp"
#include "tests/common/analysis/measures/drive_roads.hpp"
#include "tests/common/analysis/measures/signals.hpp"

namespace rodeira::measures {
namespace {

constexpr double kRate = 100.0, kLength = 4.4, kFront = 2.4, kWidth = 1.8;

// Puts a motion through the builder: pose(t) gives x, y, heading; the others are given at each time.
template <class Pose, class Others>
Drive Driven(const network::Network& network, double seconds, const Pose& pose, const Others& others) {
  DriveBuilder builder(&network, kRate);
  builder.SetFootprint(kLength, kFront, kWidth);
  builder.ExpectTraffic();
  for (std::size_t k = 0; k < static_cast<std::size_t>(seconds * kRate); ++k) {
    const double t = static_cast<double>(k) / kRate;
    const Eigen::Vector3d p = pose(t), q = pose(t + 1e-5);
    SubjectSample sample{p.x(), p.y(), 0.0, p.z(), std::hypot(q.x() - p.x(), q.y() - p.y()) / 1e-5};
    sample.yaw_radps = (q.z() - p.z()) / 1e-5;
    builder.AddSubject(k, sample);
    builder.AddOthers(k, others(t), true);
  }
  return builder.Finish();
}

std::vector<OtherVehicle> NoOthers(double) { return {}; }

OtherVehicle Car(std::int64_t id, double x, double y, double speed) { return {id, x, y, 0.0, speed, 4.0, 2.0}; }

// A weaving drive along lane -1, with its middle at t = -1.75: position, heading error, lines and limit.
TEST(DriveBuilder, LanePositionOfAWeavingDrive) {
  const auto network = OneRoad();
  const double w = 2.0 * std::numbers::pi * 0.2;
  const auto pose = [&](double t) {
    const double y = 0.3 * std::sin(w * t), slope = 0.3 * w * std::cos(w * t) / 20.0;
    return Eigen::Vector3d(50.0 + 20.0 * t, -1.75 + y, std::atan(slope));
  };
  const Drive d = Driven(*network, 20.0, pose, NoOthers);
  ASSERT_EQ(d.size(), 2000u);
  for (const std::size_t k : {0u, 333u, 1999u}) {
    const double t = static_cast<double>(k) / kRate;
    EXPECT_EQ(d.lane[k], -1.0);
    EXPECT_NEAR(d.s_m[k], 50.0 + 20.0 * t, 1e-6);
    EXPECT_NEAR(d.lane_position_m[k], 0.3 * std::sin(w * t), 1e-6);
    EXPECT_NEAR(d.heading_error_rad[k], pose(t).z(), 1e-9);
    EXPECT_NEAR(d.lane_width_m[k], 3.5, 1e-9);
    EXPECT_EQ(d.speed_limit_mps[k], 25.0);
    const double swing = std::sin(pose(t).z());
    EXPECT_NEAR(d.left_line_m[k],
                1.75 - (0.3 * std::sin(w * t) + std::max(kFront * swing, (kFront - kLength) * swing) +
                        kWidth / 2.0 * std::cos(pose(t).z())),
                1e-6);
    EXPECT_TRUE(std::isnan(d.leader.gap_m[k]));
  }
  const DriveCut cut{d, 0, d.size(), std::nullopt};
  const auto value = [&](const char* name) {
    const MeasureInfo* info = FindMeasure(name).value();
    return info->compute(cut, {info->options, {}});
  };
  EXPECT_NEAR(*value("sdlp_m").value, 0.3 / std::numbers::sqrt2, 2e-4);
  EXPECT_EQ(*value("lane_changes_n").value, 0.0);
  EXPECT_EQ(*value("lane_departures_n").value, 0.0);
  EXPECT_EQ(*value("leader_share").value, 0.0);
  EXPECT_EQ(value("gap_mean_m").reason, "no leader");
  EXPECT_EQ(value("ttc_min_s").reason, "no leader");
}

// The same drive on the left lane, against the road's stations: left stays the driver's left.
TEST(DriveBuilder, TheRoadsDirectionChangesNothing) {
  const auto network = OneRoad();
  const auto along = [](double t) { return Eigen::Vector3d(50.0 + 20.0 * t, -1.75 + 0.02 * t, 0.001); };
  const auto against = [](double t) {
    return Eigen::Vector3d(950.0 - 20.0 * t, 1.75 - 0.02 * t, std::numbers::pi + 0.001);
  };
  const auto ahead = [](double t) { return std::vector{Car(1, 110.0 + 17.0 * t, -1.75, 17.0)}; };
  const auto ahead_against = [](double t) { return std::vector{Car(1, 890.0 - 17.0 * t, 1.75, 17.0)}; };
  const Drive a = Driven(*network, 15.0, along, ahead), b = Driven(*network, 15.0, against, ahead_against);
  for (const std::size_t k : {10u, 700u, 1400u}) {
    EXPECT_NEAR(a.lane_position_m[k], b.lane_position_m[k], 1e-6);
    EXPECT_NEAR(a.heading_error_rad[k], b.heading_error_rad[k], 1e-9);
    EXPECT_NEAR(a.left_line_m[k], b.left_line_m[k], 1e-6);
  }
  EXPECT_EQ(b.lane[0], 1.0);
  std::size_t found = 0;
  for (const MeasureInfo& info : Catalogue()) {
    const Measure m = info.compute({a, 0, a.size(), std::nullopt}, {info.options, {}});
    const Measure n = info.compute({b, 0, b.size(), std::nullopt}, {info.options, {}});
    ASSERT_EQ(m.value.has_value(), n.value.has_value()) << info.name << ": " << m.reason << n.reason;
    EXPECT_EQ(m.n, n.n) << info.name;
    if (!m.value) continue;
    ++found;
    EXPECT_NEAR(*m.value, *n.value, 1e-6 * (1.0 + std::abs(*m.value))) << info.name;
  }
  EXPECT_GT(found, 30u);
}

// Left-hand traffic: lane 1 is driven along the road, and left is left.
TEST(DriveBuilder, LeftHandTraffic) {
  const auto network = OneRoad(0.0, true);
  const auto pose = [](double t) { return Eigen::Vector3d(50.0 + 20.0 * t, 1.75 + 0.25, 0.0); };
  const auto others = [](double t) { return std::vector<OtherVehicle>{Car(3, 100.0 + 20.0 * t, 1.75, 20.0)}; };
  const Drive d = Driven(*network, 5.0, pose, others);
  EXPECT_EQ(d.lane[100], 1.0);
  EXPECT_NEAR(d.lane_position_m[100], 0.25, 1e-6);
  EXPECT_NEAR(d.leader.gap_m[100], 50.0 - kFront - 2.0, 1e-3);
}

// From lane -1 to lane -2, a change to the right; then onto the shoulder, and beside the road.
TEST(DriveBuilder, ChangesShouldersAndBesideTheRoad) {
  const auto network = OneRoad();
  const auto pose = [](double t) {
    const double change = std::clamp((t - 5.0) / 4.0, 0.0, 1.0), off = std::max(0.0, t - 15.0);
    return Eigen::Vector3d(50.0 + 20.0 * t, -1.75 - 3.5 * change - 1.0 * off, 0.0);
  };
  const Drive d = Driven(*network, 25.0, pose, NoOthers);
  std::size_t crossings = 0;
  for (const std::int8_t c : d.crossing) crossings += c != 0 ? 1u : 0u;
  EXPECT_EQ(crossings, 1u);
  EXPECT_EQ(d.crossing[701], -1);  // beyond the line at -3.5 m, 2 s after 5 s
  EXPECT_NE(d.episode[600], d.episode[800]);
  EXPECT_EQ(d.episode[800], d.episode[1700]) << "on the shoulder it keeps its lane";
  EXPECT_EQ(d.lane[1850], -2.0);
  EXPECT_NEAR(d.lane_position_m[1850], -3.5, 1e-6);
  EXPECT_LT(d.right_line_m[1850], 0.0);
  EXPECT_TRUE(std::isnan(d.lane_position_m[2450])) << "9.5 m beside its lane";
}

// A leader 40 m ahead (middle to reference point), a follower, cars in the next lane, an oncoming one; then the leader
// is passed by a nearer one.
TEST(DriveBuilder, LeadersFollowersAndNeighbours) {
  const auto network = OneRoad();
  const auto pose = [](double t) { return Eigen::Vector3d(200.0 + 20.0 * t, -1.75, 0.0); };
  const auto others = [](double t) {
    const double x = 200.0 + 20.0 * t;
    return std::vector<OtherVehicle>{Car(1, x + 40.0, -1.75, 18.0), Car(2, x + 90.0, -1.75, 25.0),
                                     Car(3, x - 30.0, -1.6, 22.0),  Car(4, x + 10.0, -5.25, 15.0),
                                     Car(5, x - 12.0, -5.25, 15.0), Car(6, x + 20.0, 1.75, 30.0),
                                     Car(7, x + 15.0, -30.0, 0.0)};
  };
  const Drive d = Driven(*network, 25.0, pose, others);
  for (const std::size_t k : {0u, 1234u, 2499u}) {
    EXPECT_EQ(d.leader.id[k], 1.0);
    EXPECT_NEAR(d.leader.gap_m[k], 40.0 - 2.0 - kFront, 1e-3);
    EXPECT_EQ(d.leader.speed_mps[k], 18.0);
    EXPECT_EQ(d.follower.id[k], 3.0);
    EXPECT_NEAR(d.follower.gap_m[k], 30.0 - 2.0 - (kLength - kFront), 1e-3);
    EXPECT_EQ(d.right_leader.id[k], 4.0);
    EXPECT_EQ(d.right_follower.id[k], 5.0);
    EXPECT_TRUE(std::isnan(d.left_leader.id[k])) << "the next lane to the left is oncoming";
  }
}

// On a circle the stations begin again: the gap across the seam is the arc's length, and the lane goes on.
TEST(DriveBuilder, ACircleAcrossItsStart) {
  constexpr double kRadius = 80.0, kMiddle = kRadius + 1.75;  // lane -1 lies outside
  const auto network = OneRoad(kRadius);
  const auto at = [](double angle) {
    return Eigen::Vector3d(kMiddle * std::sin(angle), kRadius - kMiddle * std::cos(angle), angle);
  };
  const double omega = 15.0 / kMiddle;
  const auto pose = [&](double t) { return at(5.5 + omega * t); };
  const auto others = [&](double t) {
    const Eigen::Vector3d p = at(5.5 + omega * t + 35.0 / kMiddle);
    return std::vector<OtherVehicle>{Car(9, p.x(), p.y(), 15.0)};
  };
  const Drive d = Driven(*network, 30.0, pose, others);
  for (std::size_t k = 0; k < d.size(); ++k) {
    ASSERT_EQ(d.episode[k], d.episode[0]) << k;
    ASSERT_EQ(d.crossing[k], 0) << k;
    ASSERT_NEAR(d.lane_position_m[k], 0.0, 1e-3) << k;
    ASSERT_NEAR(d.leader.gap_m[k], 35.0 - 2.0 - kFront, 0.02) << k;
    ASSERT_NEAR(d.lane_curvature_1pm[k], 1.0 / kMiddle, 1e-9) << k;
  }
}

// Samples that are missing stay missing, and no lane change is seen across the hole; a reversing car keeps its nose.
TEST(DriveBuilder, HolesAndReverse) {
  const auto network = OneRoad();
  DriveBuilder builder(network.get(), kRate);
  builder.SetFootprint(kLength, kFront, kWidth);
  for (std::size_t k = 0; k < 300; ++k) {
    if (k >= 100 && k < 200) continue;
    const double t = static_cast<double>(k) / kRate;
    builder.AddSubject(k, {100.0 - 3.0 * t, k < 100 ? -1.75 : -5.25, 0.0, 0.0, -3.0});
  }
  const Drive d = builder.Finish();
  EXPECT_TRUE(std::isnan(d.speed_mps[150]));
  EXPECT_EQ(d.crossing[200], 0);
  EXPECT_NE(d.episode[250], d.episode[50]);
  EXPECT_EQ(d.speed_mps[250], -3.0);
  EXPECT_NEAR(d.heading_error_rad[250], 0.0, 1e-9);
}

// A car crosses the road at right angles behind the driven one, by the closed form, and another one follows: the least
// post-encroachment time is that of the crossing. On a plane it is the same.
TEST(DriveBuilder, PostEncroachmentTimeOfACrossing) {
  const auto network = OneRoad();
  constexpr double kOther = 1.7;  // width
  const auto others = [](double t) {
    // The front is 170 m before the middle of the lane at time 0.
    const OtherVehicle crosses{5,   300.0, -1.75 - 170.0 - 2.0 + 12.0 * t, 0.0,   12.0,
                               4.0, 2.0,   std::numbers::pi / 2.0,         kOther};
    const OtherVehicle follows{6, 60.0 + 20.0 * t, -1.75, 0.0, 20.0, 4.0, 2.0, 0.0, kOther};
    return std::vector<OtherVehicle>{crosses, follows};
  };
  const double enters = (170.0 - kWidth / 2.0) / 12.0, leaves = (200.0 + kOther / 2.0 + kLength - kFront) / 20.0;
  const auto least = [&](const network::Network* roads) {
    DriveBuilder builder(roads, kRate);
    builder.SetFootprint(kLength, kFront, kWidth);
    builder.ExpectTraffic();
    for (std::size_t k = 0; k < 3500; ++k) {
      const double t = static_cast<double>(k) / kRate;
      builder.AddSubject(k, {100.0 + 20.0 * t, -1.75, 0.0, 0.0, 20.0});
      builder.AddOthers(k, others(t), true);
    }
    const Drive d = builder.Finish();
    const MeasureInfo* info = FindMeasure("pet_min_s").value();
    return info->compute({d, 0, d.size(), std::nullopt}, {info->options, {}});
  };
  for (const Measure& pet : {least(network.get()), least(nullptr)}) {
    ASSERT_TRUE(pet.value) << pet.reason;
    EXPECT_NEAR(*pet.value, enters - leaves, 1e-6);
    EXPECT_EQ(pet.n, 1u);
  }
}

TEST(DriveBuilder, WithoutRoadsLanesAreMissing) {
  DriveBuilder builder(nullptr, kRate);
  builder.SetFootprint(kLength, kFront, kWidth);
  for (std::size_t k = 0; k < 200; ++k) builder.AddSubject(k, {0.1 * static_cast<double>(k), 0.0, 0.0, 0.0, 10.0});
  const Drive d = builder.Finish();
  EXPECT_FALSE(d.notes.empty());
  const DriveCut cut{d, 0, d.size(), std::nullopt};
  std::size_t found = 0;
  for (const MeasureInfo& info : Catalogue()) {
    const Measure m = info.compute(cut, {info.options, {}});
    EXPECT_EQ(m.value.has_value(), m.reason.empty()) << info.name;
    if (m.value) {
      EXPECT_TRUE(std::isfinite(*m.value)) << info.name;
      ++found;
    }
  }
  EXPECT_GT(found, 8u) << "speeds are there";
  EXPECT_FALSE(
      FindMeasure("leader_share").value()->compute(cut, {FindMeasure("leader_share").value()->options, {}}).value);
  EXPECT_FALSE(FindMeasure("sdlp_m").value()->compute(cut, {FindMeasure("sdlp_m").value()->options, {}}).value);
}

// The distances of neighbouring half-open intervals add up to that of both, and that is the way of the positions.
TEST(DriveBuilder, DistancesOfNeighboursAddUp) {
  DriveBuilder builder(nullptr, kRate);
  builder.SetFootprint(kLength, kFront, kWidth);
  double x_m = 0.0;
  for (std::size_t k = 0; k < 401; ++k) {
    const double speed_mps = 10.0 + 0.02 * static_cast<double>(k);
    builder.AddSubject(k, {x_m, 0.0, 0.0, 0.0, speed_mps});
    x_m += (speed_mps + 0.01) / kRate;
  }
  const Drive d = builder.Finish();
  const auto distance_m = [&](std::size_t from, std::size_t to) {
    const MeasureInfo& info = *FindMeasure("distance_m").value();
    return info.compute({d, from, to, std::nullopt}, {info.options, {}}).value.value();
  };
  EXPECT_NEAR(distance_m(0, 401), 56.0, 1e-9) << "4 s from 10 to 18 m/s";
  EXPECT_NEAR(distance_m(0, 150) + distance_m(150, 210) + distance_m(210, 401), distance_m(0, 401), 1e-9);
}

}  // namespace
}  // namespace rodeira::measures
