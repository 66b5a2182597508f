// SPDX-License-Identifier: Apache-2.0
#include "common/analysis/measures/lane_change_test.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "common/analysis/measures/table.hpp"
#include "common/core/base/temporary_folder.hpp"
#include "tests/common/analysis/measures/signals.hpp"

namespace rodeira::measures {
namespace {

// Three signs, 3.5 m each: to the left, to the left, and back by two lanes.
const LaneChangeTest kTest{{{150.0, 0.0}, {300.0, 3.5}, {450.0, -3.5}}, -3.5, {}};

// The samples are 0.16 m apart: a line between two cuts a corner of the path by at most slope * 0.16^2 / 8. Over six
// corners of slopes 0.35, 0.35 and 0.7, and 400 m, that is 2.3e-5 m.
constexpr double kCorners_m = 2.3e-5;

// A person at 16 m/s with changes that begin `before_m` before the signs and are `length_m` long.
Drive DriveOf(double before_m, double length_m, double road = 0.0) {
  Drive drive;
  drive.s_m = Sampled(35.0, 100.0, [](double t) { return 16.0 * t; });
  GrowColumns(drive, drive.s_m.size());
  for (std::size_t k = 0; k < drive.size(); ++k) {
    drive.t_m[k] = ReferenceAt(drive.s_m[k], kTest.signs, {before_m, length_m, kTest.start_t_m});
    drive.road[k] = road;
  }
  return drive;
}

Measure Measured(const char* name, const Drive& drive, const LaneChangeTest& test,
                 std::optional<std::pair<std::size_t, std::size_t>> baseline = {}) {
  const MeasureInfo& info = *FindMeasure(name).value();
  static const std::map<std::string, double> kNone;
  return info.compute({drive, 0, drive.size(), baseline, &test}, OptionValues(info.options, kNone));
}

// A drive with changes of the path's length that begin d later: at each sign a parallelogram of the
// lanes' distance times d. Over the stretch from 100 to 500 m.
TEST(LaneChangeTest, ALateChangeIsAParallelogram) {
  for (const double late_m : {0.0, 4.0, 9.0}) {
    const double area_m2 = (3.5 + 3.5 + 7.0) * late_m;
    EXPECT_NEAR(*Measured("lct_mdev_m", DriveOf(30.0 - late_m, 10.0), kTest).value, area_m2 / 400.0, kCorners_m)
        << late_m;
  }
  EXPECT_EQ(Measured("lct_correct_share", DriveOf(30.0, 10.0), kTest).value, 1.0);
  EXPECT_EQ(Measured("lct_correct_share", DriveOf(-80.0, 10.0), kTest).value, 0.0) << "all 80 m behind the signs";
}

// The own path is that of the baseline: its begin and length are found, and such a drive deviates by nothing.
TEST(LaneChangeTest, ThePersonsOwnPathIsThatOfTheBaseline) {
  const Drive drive = DriveOf(18.0, 22.0);
  const OwnPath own = FindOwnPath(drive.s_m, drive.t_m, kTest);
  EXPECT_EQ(own.changes, 3u);
  EXPECT_NEAR(own.path.before_m, 18.0, 1e-6);
  EXPECT_NEAR(own.path.length_m, 22.0, 1e-6);
  EXPECT_NEAR(
      *Measured("lct_mdev_adaptive_m", drive, kTest, std::pair<std::size_t, std::size_t>(0, drive.size())).value, 0.0,
      kCorners_m);
  EXPECT_GT(*Measured("lct_mdev_m", drive, kTest).value, 0.3);
}

// At 16 m/s from 40 m before the sign to 18 m before it: 22 / 16 s.
TEST(LaneChangeTest, TheDelayIsThatFromReadingToTheChange) {
  EXPECT_NEAR(*Measured("lct_delay_s", DriveOf(18.0, 22.0), kTest).value, 22.0 / 16.0, 1e-6);
  EXPECT_NEAR(*Measured("lct_delay_s", DriveOf(45.0, 10.0), kTest).value, -5.0 / 16.0, 1e-6) << "begun before";
  Drive stays = DriveOf(18.0, 22.0);
  stays.t_m.assign(stays.size(), kTest.start_t_m);
  EXPECT_EQ(Measured("lct_delay_s", stays, kTest).reason, "there is no lane change at a sign");
  EXPECT_EQ(Measured("lct_mdev_correct_m", stays, kTest).n, 1u) << "the third sign demands that lane";
  stays.t_m.assign(stays.size(), 9.0);
  EXPECT_EQ(Measured("lct_mdev_correct_m", stays, kTest).reason, "no lane that a sign demands is reached");
}

// The second sign is passed in a wrong lane. What is left, from 100 to 270 m and from 420 to 500 m, deviates by a
// triangle at the third sign: the reference comes from 3.5 m, the drive from 0, over 10 m.
TEST(LaneChangeTest, AWrongLaneIsLeftOut) {
  Drive drive = DriveOf(30.0, 10.0);
  const std::vector<LaneChangeSign> driven{kTest.signs[0], kTest.signs[2]};
  for (std::size_t k = 0; k < drive.size(); ++k)
    drive.t_m[k] = ReferenceAt(drive.s_m[k], driven, {30.0, 10.0, kTest.start_t_m});
  EXPECT_NEAR(*Measured("lct_correct_share", drive, kTest).value, 2.0 / 3.0, 1e-12);
  EXPECT_NEAR(*Measured("lct_mdev_correct_m", drive, kTest).value, 0.5 * 3.5 * 10.0 / (170.0 + 80.0), kCorners_m);
  EXPECT_GT(*Measured("lct_mdev_m", drive, kTest).value, 1.0);
  EXPECT_NEAR(*Measured("lct_mdev_correct_m", DriveOf(30.0, 10.0), kTest).value, 0.0, kCorners_m);
}

TEST(LaneChangeTest, WhatIsMissingHasItsReason) {
  const Drive drive = DriveOf(30.0, 10.0, 2.0);
  EXPECT_NE(Measured("lct_mdev_m", drive, {}).reason.find("there are no signs"), std::string::npos);
  EXPECT_EQ(Measured("lct_mdev_adaptive_m", drive, kTest).reason, "no interval is named as the baseline");
  EXPECT_EQ(Measured("lct_mdev_adaptive_m", drive, kTest, std::pair<std::size_t, std::size_t>(0, 100)).reason,
            "the baseline has no lane change at a sign");
  LaneChangeTest other = kTest;
  other.road = 2;
  EXPECT_EQ(Measured("lct_mdev_m", drive, other).value, Measured("lct_mdev_m", drive, kTest).value);
  other.road = 1;
  EXPECT_EQ(Measured("lct_mdev_m", drive, other).reason, "the vehicle does not pass the stretch");
  EXPECT_EQ(Measured("lct_correct_share", drive, other).reason, "no sign is passed");
}

// The signs of a measures file reach the measures, and its sidecar reads back the same.
TEST(LaneChangeTest, TheSignsAreReadFromAMeasuresFile) {
  const auto folder = base::TemporaryFolder::Make("lane-change-test").value();
  const auto read = [&](const std::string& text) {
    std::ofstream(folder.path() / "m.yaml") << "rodeira: measures/1\nmeasures: [lct_mdev_m]\n" << text;
    return ReadSpec(folder.path() / "m.yaml");
  };
  const auto spec = read(
      "lane_change_test:\n  start_t_m: -3.5\n  road: 0\n"
      "  signs: [{s_m: 150, t_m: 0}, {s_m: 300, t_m: 3.5}, {s_m: 450, t_m: -3.5}]\n");
  ASSERT_TRUE(spec.ok()) << spec.error().Text();
  DriveReading reading;
  reading.drive = DriveOf(26.0, 10.0);
  const auto rows = ComputeRows(spec.value(), reading);
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_NEAR(*rows[0].values[0].value, 14.0 * 4.0 / 400.0, kCorners_m);
  const std::string sidecar = SidecarText(spec.value(), {}, {});
  std::ofstream(folder.path() / "again.yaml") << sidecar;
  const auto again = ReadSpec(folder.path() / "again.yaml");
  ASSERT_TRUE(again.ok()) << again.error().Text() << sidecar;
  EXPECT_EQ(SidecarText(again.value(), {}, {}), sidecar);
  ASSERT_EQ(again.value().lane_change_test.signs.size(), 3u);
  EXPECT_EQ(again.value().lane_change_test.signs[2].target_t_m, -3.5);
  EXPECT_EQ(again.value().lane_change_test.road, 0);

  const auto descending = read("lane_change_test: {start_t_m: 0, signs: [{s_m: 150, t_m: 0}, {s_m: 150, t_m: 3}]}\n");
  ASSERT_FALSE(descending.ok());
  EXPECT_EQ(descending.error().id.text(), "measure.signs_not_ascending");
  EXPECT_EQ(read("lane_change_test: {signs: [{s_m: 150, t_m: 0}]}\n").error().id.text(), "config.missing_key");
}

}  // namespace
}  // namespace rodeira::measures
