// SPDX-License-Identifier: Apache-2.0
// All measures of the catalogue on one made drive: left and right exchanged, begun later, in two parts, at ten times
// the sample rate.
#include <gtest/gtest.h>

#include <string>

#include "common/analysis/measures/catalogue.hpp"
#include "common/analysis/measures/given_drive.hpp"
#include "common/analysis/measures/statistics.hpp"
#include "tests/common/analysis/measures/signals.hpp"

namespace rodeira::measures {
namespace {

constexpr double kSeconds = 130.0, kWidth = 3.5;

double Speed(double t) { return 22.0 + 3.0 * std::sin(0.21 * t) + std::sin(0.83 * t); }
// Across the road, from the middle of the right lane; into the left one from 60 s to 65 s.
double Across(double t) {
  const double done = std::clamp((t - 60.0) / 5.0, 0.0, 1.0);
  return 0.5 * std::sin(0.5 * t) + 0.25 * std::sin(1.3 * t + 1.0) +
         kWidth * 0.5 * (1.0 - std::cos(std::numbers::pi * done));
}
double Slope(double (*f)(double), double t) { return (f(t + 1e-5) - f(t - 1e-5)) / 2e-5; }
double Heading(double t) { return std::atan2(Slope(Across, t), Speed(t)); }
double Gap(double t) { return 30.0 + 14.0 * std::sin(0.11 * t); }
double Lag(double t) { return 40.0 + 25.0 * std::cos(0.1 * t); }
double Wheel(double t) {
  double sum = 0.0;
  for (const auto& [hz, deg] : {std::pair{0.07, 8.0}, {0.23, 5.0}, {0.41, 2.0}, {0.77, 1.0}, {1.31, 0.3}})
    sum += deg * std::sin(2.0 * std::numbers::pi * hz * t + 40.0 * hz);
  return sum;
}

// The drive from its begin, `before_s` after that of the samples; until then other values.
GivenDrive Made(double rate_hz, bool mirrored = false, double before_s = 0.0) {
  GivenDrive given;
  given.rate_hz = rate_hz;
  given.length_m = 4.4;
  given.front_m = 2.4;
  given.width_m = 1.8;
  auto& c = given.columns;
  const double side = mirrored ? -1.0 : 1.0;
  const std::string left = mirrored ? "right" : "left", right = mirrored ? "left" : "right";
  const auto before = std::llround(before_s * rate_hz), samples = std::llround(kSeconds * rate_hz);
  for (long long k = -before; k < samples; ++k) {
    const double t = static_cast<double>(k) / rate_hz;
    const double y = Across(t), lane_y = y > 0.5 * kWidth ? y - kWidth : y;
    c["lane_position_m"].push_back(side * lane_y);
    c["lane_width_m"].push_back(kWidth);
    c["lane_curvature_1pm"].push_back(0.0);
    c["heading_error_rad"].push_back(side * Heading(t));
    c["yaw_radps"].push_back(side * Slope(Heading, t));
    c["speed_mps"].push_back(Speed(t));
    c["speed_limit_mps"].push_back(22.5);
    c["steering_wheel_deg"].push_back(side * Wheel(t));
    c["throttle"].push_back(std::clamp(0.3 + 0.4 * std::cos(0.4 * t), 0.0, 1.0));
    c["brake"].push_back(std::max(0.0, 0.6 * std::sin(0.4 * t - 2.5) - 0.2));
    const bool turns = t > 58.0 && t < 66.0;
    c["indicator"].push_back(turns ? (mirrored ? 2.0 : 1.0) : 0.0);
    c["fuel_used_kg"].push_back(1.0 + 0.002 * t);
    c["road"].push_back(0.0);
    c["junction"].push_back(0.0);
    c["s_m"].push_back(50.0 + 22.0 * t);
    c["t_m"].push_back(side * y);
    c["leader_id"].push_back(1.0);
    c["leader_gap_m"].push_back(Gap(t));
    c["leader_speed_mps"].push_back(Speed(t) + Slope(Gap, t));
    c["leader_length_m"].push_back(4.5);
    for (const std::string& lag : {left + "_follower", std::string("follower")}) {
      c[lag + "_gap_m"].push_back(Lag(t));
      c[lag + "_speed_mps"].push_back(Speed(t) - Slope(Lag, t));
    }
    c[right + "_follower_gap_m"].push_back(kMissing);
  }
  return given;
}

// The measures of an interval of a drive, with its own begin as the baseline.
std::map<std::string, Measure> All(const Drive& drive, std::size_t from, std::size_t to) {
  std::map<std::string, Measure> all;
  const std::map<std::string, double> whole{{"ddof", 0.0}, {"min_valid_share", 0.5}, {"min_duration_s", 20.0}};
  for (const MeasureInfo& info : Catalogue()) {
    std::map<std::string, double> given;
    for (const OptionInfo& option : info.options) {
      if (whole.contains(option.name)) given[option.name] = whole.at(option.name);
    }
    all[info.name] = info.compute({drive, from, to, std::pair{from, to}}, OptionValues(info.options, given));
  }
  return all;
}
std::map<std::string, Measure> All(const GivenDrive& given, std::size_t from = 0) {
  const Drive drive = DriveOf(given).value();
  return All(drive, from, drive.size());
}

std::size_t Found(const std::map<std::string, Measure>& all) {
  std::size_t found = 0;
  for (const auto& [name, measure] : all) found += measure.value ? 1u : 0u;
  return found;
}

constexpr std::size_t kFewest = 70;  // of the measures have a value

TEST(CatalogueInvariances, LeftAndRightExchanged) {
  const auto plain = All(Made(100.0)), mirrored = All(Made(100.0, true));
  EXPECT_GE(Found(plain), kFewest);
  for (const auto& [name, measure] : plain) {
    const Measure& other = mirrored.at(name);
    ASSERT_EQ(measure.value.has_value(), other.value.has_value()) << name << ": " << measure.reason << other.reason;
    EXPECT_EQ(measure.n, other.n) << name;
    if (!measure.value) continue;
    const double sign = name == "lane_position_mean_m" || name == "heading_error_mean_deg" ? -1.0 : 1.0;
    EXPECT_NEAR(*measure.value, sign * *other.value, 1e-9 * (1.0 + std::abs(*measure.value))) << name;
  }
}

TEST(CatalogueInvariances, ALaterBeginning) {
  const auto plain = All(Made(100.0)), later = All(Made(100.0, false, 37.0), 3700);
  for (const auto& [name, measure] : plain) {
    const Measure& other = later.at(name);
    EXPECT_EQ(measure.value, other.value) << name;
    EXPECT_EQ(measure.n, other.n) << name;
    EXPECT_EQ(measure.reason, other.reason) << name;
  }
}

// Sums and counts of neighbours add up, means and shares by their numbers of samples, and extremes are those of a part.
// At 84 s no pedal is pressed and no line is crossed.
TEST(CatalogueInvariances, TwoParts) {
  const Drive drive = DriveOf(Made(100.0)).value();
  constexpr std::size_t kCut = 8400;
  const auto whole = All(drive, 0, drive.size()), first = All(drive, 0, kCut), second = All(drive, kCut, drive.size());
  const auto value = [](const std::map<std::string, Measure>& all, const char* name) { return *all.at(name).value; };
  for (const char* name : {"distance_m", "tet_s", "tit_s2", "fuel_l", "brake_integral_s", "brake_presses_n",
                           "lane_changes_n", "lane_departures_n", "lane_departure_area_ms", "stop_time_s"})
    EXPECT_NEAR(value(first, name) + value(second, name), value(whole, name), 1e-9 * (1.0 + value(whole, name)))
        << name;
  for (const char* name : {"speed_mean_mps", "lane_position_mean_m", "gap_mean_m", "time_gap_mean_s", "headway_mean_m",
                           "inverse_ttc_mean_1ps", "throttle_mean", "above_limit_share", "leader_share",
                           "tlc_below_share", "both_pedals_share"}) {
    const double n = static_cast<double>(first.at(name).n), m = static_cast<double>(second.at(name).n);
    EXPECT_NEAR((n * value(first, name) + m * value(second, name)) / (n + m), value(whole, name), 1e-9) << name;
  }
  for (const char* name : {"gap_min_m", "time_gap_min_s", "ttc_min_s", "tlc_min_s"})
    EXPECT_EQ(std::min(value(first, name), value(second, name)), value(whole, name)) << name;
  for (const char* name :
       {"speed_max_mps", "brake_max", "drac_max_mps2", "drac_braking_leader_max_mps2", "lane_departure_greatest_m"})
    EXPECT_EQ(std::max(value(first, name), value(second, name)), value(whole, name)) << name;
  for (const auto& [deviation, mean] :
       {std::pair{"speed_sd_mps", "speed_mean_mps"}, {"throttle_sd", "throttle_mean"}}) {
    const double n = static_cast<double>(first.at(mean).n), m = static_cast<double>(second.at(mean).n);
    const auto square = [&](const auto& all) {
      return std::pow(value(all, deviation), 2) + std::pow(value(all, mean), 2);
    };
    EXPECT_NEAR((n * square(first) + m * square(second)) / (n + m), square(whole), 1e-9) << deviation;
  }
}

// Means, deviations and shares within 1 %, counts within one, extremes and times by what a sample of 10 ms allows.
TEST(CatalogueInvariances, TenTimesTheRate) {
  const auto slow = All(Made(100.0)), fast = All(Made(1000.0));
  const auto has = [](const std::string& name, const char* part) { return name.find(part) != std::string::npos; };
  for (const auto& [name, measure] : slow) {
    const Measure& other = fast.at(name);
    ASSERT_EQ(measure.value.has_value(), other.value.has_value()) << name << ": " << measure.reason << other.reason;
    if (!measure.value) continue;
    double allowed = 0.01 * std::abs(*other.value);
    if (name.ends_with("_n")) allowed = 1.0;
    if (name.ends_with("_share")) allowed = 0.01;
    for (const char* part : {"_min_", "_max_", "greatest", "_at_", "onset", "first", "release", "movement", "urgency",
                             "severity", "time_s"})
      if (has(name, part)) allowed = std::max(allowed, 0.02);
    EXPECT_NEAR(*measure.value, *other.value, allowed + 1e-12) << name;
  }
}

// What pads a filter is a time: a wave that is cut anywhere has one modified deviation and one largest deceleration at
// every rate.
TEST(CatalogueInvariances, TheEndsOfFiltersDoNotDependOnTheRate) {
  const auto measured = [](double rate_hz, double phase_s, const char* name) {
    GivenDrive given;
    given.rate_hz = rate_hz;
    given.columns["lane_position_m"] = Sampled(35.0, rate_hz, [&](double t) { return Across(t + phase_s) * 0.3; });
    given.columns["speed_mps"] = Sampled(35.0, rate_hz, [&](double t) { return 40.0 - t + Wheel(t + phase_s) * 0.3; });
    const Drive drive = DriveOf(given).value();
    const MeasureInfo& info = *FindMeasure(name).value();
    return *info.compute({drive, 0, drive.size(), {}}, OptionValues(info.options, {})).value;
  };
  for (const auto& [name, allowed] : {std::pair{"modified_sdlp_m", 0.005}, {"deceleration_max_mps2", 0.02}}) {
    for (const double phase_s : {0.0, 1.1, 2.3, 3.7, 5.2, 7.9, 11.4}) {
      const double expected = measured(100.0, phase_s, name);
      for (const double rate_hz : {25.0, 30.0, 60.0, 1000.0})
        EXPECT_NEAR(measured(rate_hz, phase_s, name), expected, allowed * expected)
            << name << rate_hz << " " << phase_s;
    }
  }
}

}  // namespace
}  // namespace rodeira::measures
