// SPDX-License-Identifier: Apache-2.0
// What a minor road carries across a major one: Siegloch's formula with the gaps that its own cars take.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <random>
#include <vector>

#include "common/traffic/traffic_model.hpp"
#include "tests/common/traffic/identical.hpp"
#include "tests/common/world/opendrive/sample.hpp"
#include "tests/long_form.hpp"

namespace rodeira::traffic {
namespace {

// A minor road across a major one, with cars that are given from outside at chosen times. The minor road's cars queue;
// how many of them cross is counted.
class Crossroads {
 public:
  static constexpr double kMajor_mps = 50.0 / 3.6, kHalf_m = 300.0, kStep_s = 0.05;

  // `times_s`: when a major car's front is at the crossing's middle; ascending. Returns when a minor one's middle is
  // there.
  static std::vector<double> Crossed(const std::vector<double>& times_s, double duration_s,
                                     const driver::SmoothSettings& smooth = {}, double time_gap_s = 1.5) {
    TrafficSettings settings = Identical(40, 1.4);
    settings.smooth = smooth;
    settings.idm.time_gap_s = time_gap_s;
    TrafficModel model = TrafficModel::Make(settings, Roads(), {}).value();
    std::vector<double> crossed, before(settings.vehicles, 1e9);
    std::vector<driver::Footprint> others;
    for (int i = 1; i * kStep_s < duration_s; ++i) {
      const double now = i * kStep_s;
      others.clear();
      const auto first = std::lower_bound(times_s.begin(), times_s.end(), now - kHalf_m / kMajor_mps);
      for (auto n = static_cast<std::size_t>(first - times_s.begin());
           n < times_s.size() && times_s[n] < now + kHalf_m / kMajor_mps; ++n) {
        const double x = (now - times_s[n]) * kMajor_mps;
        if (std::fabs(x) < kHalf_m - 5.0)
          others.push_back({100000 + static_cast<std::uint32_t>(n), x - 2.2, -1.75, 0.0, kMajor_mps, 4.4, 1.8});
      }
      model.Step(kStep_s, others);
      for (const AgentPose& pose : model.poses()) {
        const double y = pose.p_WB_W.y();
        if (before[pose.id] < 0.0 && y >= 0.0 && std::fabs(pose.p_WB_W.x()) < 5.0) crossed.push_back(now);
        before[pose.id] = y;
        for (const driver::Footprint& other : others) {
          EXPECT_FALSE(std::fabs(y) < 20.0 && driver::Overlap(FootprintOf(pose, model.traits(pose.id)), other)) << now;
        }
      }
    }
    return crossed;
  }

 private:
  // The major road's lane begins too narrow to be entered: its traffic is only what is given.
  static std::shared_ptr<const network::Network> Roads() {
    opendrive::RoadText major, minor;
    const auto sign = [](double s, const char* type) {
      return fmt::format(
          "<signals><signal s=\"{}\" t=\"-4\" id=\"1\" dynamic=\"no\" orientation=\"+\" zOffset=\"2\" "
          "type=\"{}\" subtype=\"-1\" country=\"DE\"/></signals>",
          s, type);
    };
    const auto line = [](double x, double y, double heading) {
      return fmt::format("<geometry s=\"0\" x=\"{}\" y=\"{}\" hdg=\"{}\" length=\"{}\"><line/></geometry>", x, y,
                         heading, 2.0 * kHalf_m);
    };
    major.length = minor.length = 2.0 * kHalf_m;
    major.left = minor.left = "";
    minor.id = "2";
    major.geometry = line(-kHalf_m, 0.0, 0.0);
    minor.geometry = line(0.0, -kHalf_m, 0.5 * std::numbers::pi);
    major.right =
        "<lane id=\"-1\" type=\"driving\"><width sOffset=\"0\" a=\"1.9\" b=\"0.016\" c=\"0\" d=\"0\"/>"
        "<width sOffset=\"100\" a=\"3.5\" b=\"0\" c=\"0\" d=\"0\"/></lane>";
    major.more = sign(kHalf_m - 20.0, "301");
    minor.more = sign(kHalf_m - 8.0, "205");
    return opendrive::MustRead(opendrive::Document(major.Text() + minor.Text()));
  }
};

constexpr driver::SmoothSettings kAtOnce{1e6, 1e6};  // as the theory's drivers, who brake and start without any time

// Exponential gaps, from 60 s on.
std::vector<double> RandomArrivals(double mean_gap_s, double until_s) {
  std::mt19937 random(7);
  std::vector<double> arrivals;
  for (double t = 60.0; t < until_s;) {
    t -= mean_gap_s * std::log(1.0 - (static_cast<double>(random()) + 0.5) / 4294967296.0);
    arrivals.push_back(t);
  }
  return arrivals;
}

// Siegloch: n cars use a gap of t0 + n tf, found from single gaps in a dense stream. Random gaps of a flow q then let
// (1/tf) exp(-q t0) cross (Siegloch 1973).
TEST(MinorRoad, AMinorRoadCarriesWhatItsOwnGapsSay) {
  constexpr double kDense_s = 1.2, kDenseFor_s = 25.0, kRandomFor_s = 5400.0;
  std::vector<double> times, begins, gaps;
  double at = 60.0;
  for (double gap = 8.0; gap < 32.0; gap += 0.5) {
    for (double t = 0.0; t < kDenseFor_s; t += kDense_s) times.push_back(at + t);
    begins.push_back(times.back());
    gaps.push_back(gap);
    at = times.back() + gap;
  }
  times.push_back(at);
  const std::vector<double> crossed = Crossroads::Crossed(times, at, kAtOnce);
  double n = 0.0, sum_k = 0.0, sum_g = 0.0, sum_kk = 0.0, sum_kg = 0.0;
  for (std::size_t i = 0; i < gaps.size(); ++i) {
    const auto k = static_cast<double>(std::count_if(
        crossed.begin(), crossed.end(), [&](double t) { return t > begins[i] && t < begins[i] + gaps[i]; }));
    if (k < 1.0) continue;
    n += 1.0, sum_k += k, sum_g += gaps[i], sum_kk += k * k, sum_kg += k * gaps[i];
  }
  ASSERT_GT(n, 20.0);
  const double follow_up = (n * sum_kg - sum_k * sum_g) / (n * sum_kk - sum_k * sum_k);
  const double zero =
      (sum_g - follow_up * sum_k) / n - 0.5 * follow_up;  // of the line through the middles of the stairs
  RecordProperty("follow_up_s", std::to_string(follow_up));
  RecordProperty("critical_gap_s", std::to_string(zero + 0.5 * follow_up));
  for (const double flow_per_h : BriefOrLong<std::vector<double>>({200.0, 600.0}, {200.0, 400.0, 600.0})) {
    const std::vector<double> arrivals = RandomArrivals(3600.0 / flow_per_h, kRandomFor_s);
    const auto passed = Crossroads::Crossed(arrivals, kRandomFor_s, kAtOnce);
    const double measured =
        static_cast<double>(std::count_if(passed.begin(), passed.end(), [](double t) { return t > 60.0; })) * 3600.0 /
        (kRandomFor_s - 60.0);
    const double capacity = 3600.0 / follow_up * std::exp(-flow_per_h / 3600.0 * zero);
    EXPECT_NEAR(measured, capacity, 0.1 * capacity) << flow_per_h;
  }
}

// Drivers who come to each acceleration smoothly count the time that this takes: nobody touches anybody between dense
// cars (Crossed looks at each step), and no fewer than four fifths of those cross.
TEST(MinorRoad, SmoothDriversCrossAsSafely) {
  const double kFor_s = BriefOrLong(1500.0, 2400.0);
  const std::vector<double> arrivals = RandomArrivals(6.0, kFor_s);
  EXPECT_GT(Crossroads::Crossed(arrivals, kFor_s).size(),
            Crossroads::Crossed(arrivals, kFor_s, kAtOnce).size() * 4 / 5);
}

// A close follower is kept by its leader from clearing the road as soon as it could alone, and looks as far along it as
// it then needs.
TEST(MinorRoad, CloseFollowersCrossAsSafely) {
  const double kFor_s = BriefOrLong(1500.0, 2400.0);
  const std::vector<double> arrivals = RandomArrivals(6.0, kFor_s);
  EXPECT_GT(Crossroads::Crossed(arrivals, kFor_s, {}, 1.0).size(),
            Crossroads::Crossed(arrivals, kFor_s).size() * 4 / 5);
}

}  // namespace
}  // namespace rodeira::traffic
