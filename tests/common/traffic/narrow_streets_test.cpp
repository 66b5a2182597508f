// SPDX-License-Identifier: Apache-2.0
// Two streets in a row that are too narrow for oncoming vehicles: both are longer than a driver sees at rest.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "common/traffic/results/study.hpp"
#include "tests/common/traffic/scripted.hpp"
#include "tests/common/world/lanes/lane_networks.hpp"
#include "tests/common/world/opendrive/sample.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kWide_m = 3.5, kNarrow_m = 2.2, kOutside_m = 300.0, kTaper_m = 60.0;

struct Street {
  double length_m = 0.0, from_width_m = kNarrow_m,
         to_width_m = kNarrow_m;  // of a lane; it changes over the first or last metres
};

// A lane each way.
std::string Lane(int id, const Street& street) {
  const double more = street.to_width_m - street.from_width_m;
  const double from = more < 0.0 ? street.length_m - kTaper_m : 0.0, c = 3.0 * more / (kTaper_m * kTaper_m),
               d = -2.0 * more / (kTaper_m * kTaper_m * kTaper_m);
  std::string widths;
  if (from > 0.0) widths += fmt::format("<width sOffset=\"0\" a=\"{}\" b=\"0\" c=\"0\" d=\"0\"/>", street.from_width_m);
  widths += fmt::format("<width sOffset=\"{}\" a=\"{}\" b=\"0\" c=\"{}\" d=\"{}\"/>", from, street.from_width_m, c, d);
  if (more > 0.0)
    widths += fmt::format("<width sOffset=\"{}\" a=\"{}\" b=\"0\" c=\"0\" d=\"0\"/>", kTaper_m, street.to_width_m);
  return fmt::format(
      "<lane id=\"{0}\" type=\"driving\"><link><predecessor id=\"{0}\"/><successor id=\"{0}\"/></link>{1}</lane>", id,
      widths);
}

// One after another, to the east.
std::shared_ptr<const network::Network> InARow(const std::vector<Street>& streets) {
  std::string text;
  double x_m = 0.0;
  for (std::size_t i = 0; i < streets.size(); ++i) {
    opendrive::RoadText road;
    road.id = std::to_string(i);
    road.length = streets[i].length_m;
    if (i > 0)
      road.link += fmt::format("<predecessor elementType=\"road\" elementId=\"{}\" contactPoint=\"end\"/>", i - 1);
    if (i + 1 < streets.size())
      road.link += fmt::format("<successor elementType=\"road\" elementId=\"{}\" contactPoint=\"start\"/>", i + 1);
    road.geometry =
        fmt::format("<geometry s=\"0\" x=\"{}\" y=\"0\" hdg=\"0\" length=\"{}\"><line/></geometry>", x_m, road.length);
    road.left = Lane(1, streets[i]), road.right = Lane(-1, streets[i]);
    text += road.Text();
    x_m += road.length;
  }
  return opendrive::MustRead(opendrive::Document(text));
}

// Both are taken together: one that went in as far as the end of the first one would stand in it before one that went
// into the other one from the far side, each in the other's way for ever.
TEST(NarrowStreets, AreTakenTogether) {
  for (const double length_m : {100.0, 150.0, 250.0}) {
    StudySettings settings;
    settings.traffic.vehicles = 10;
    settings.traffic.mix.shares = {0.6, 0.1, 0.2, 0.1};
    settings.duration_s = 900.0;
    settings.step_s = 0.05;
    int looks_from_both = 0;
    const StudyResult r =
        RunStudy(settings,
                 InARow({{kOutside_m, kWide_m, kNarrow_m}, {length_m}, {length_m}, {kOutside_m, kNarrow_m, kWide_m}}),
                 [&](const StudyMoment& moment) {
                   int with = 0, against = 0;
                   for (const AgentPose& pose : moment.model.poses()) {
                     if (pose.road == 1 || pose.road == 2) ++(pose.lane < 0 ? with : against);
                   }
                   looks_from_both += with > 0 && against > 0 ? 1 : 0;
                 })
            .value();
    RecordProperty(fmt::format("{} m", length_m),
                   fmt::format("{} trips, stands of {:.0f} s at most", r.arrivals, r.longest_stand_s));
    EXPECT_EQ(looks_from_both, 0) << length_m;
    EXPECT_LT(r.longest_stand_s, 300.0) << length_m;
    EXPECT_GT(r.arrivals, 15) << length_m;
    EXPECT_EQ(r.collisions, 0) << length_m;
    EXPECT_EQ(r.hurried_steps, 0) << length_m;
  }
}

// One that stands at its line before a street has room ahead as long as none stands where it would behind it, however
// far that is away; one that comes against it makes no difference.
TEST(NarrowStreets, HaveRoomBehindThemWhereNoVehicleStands) {
  constexpr double kStreet_m = 150.0, kFor_s = 40.0;
  for (const bool taken : {true, false}) {  // too narrow beside a bus, though none comes
    TrafficModel model =
        TrafficModel::Make(OnlyScripted({kCar, kCar, VehicleKind::kBus}),
                           InARow({{kOutside_m, kWide_m, kNarrow_m}, {kStreet_m}, {kOutside_m, kNarrow_m, kWide_m}}),
                           {})
            .value();
    // In the way of the first one at the street's far end, on its own lane or, against it, on the other one.
    if (taken)
      Put(model, 1, "2:-1", 30.0, 0.0);
    else
      Put(model, 1, "2:1", kTaper_m + 15.0, 8.0);
    Put(model, 0, "0:-1", 180.0, 8.0);
    if (taken) model.Brake(1, 2.0);
    int stood = 0;
    for (int i = 0; i * kStep_s < kFor_s; ++i) {
      Step(model);
      const AgentPose* pose = PoseOf(model, 0);
      ASSERT_NE(pose, nullptr);
      if (pose->speed_mps > 0.0 || pose->road != 0) continue;
      ++stood;
      ASSERT_EQ(model.RoomAhead(0), !taken) << i * kStep_s;
    }
    EXPECT_GT(stood, 100) << taken;
  }
}

}  // namespace
}  // namespace rodeira::traffic
