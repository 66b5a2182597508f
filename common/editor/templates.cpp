// SPDX-License-Identifier: Apache-2.0
#include "common/editor/templates.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "common/core/base/constants.hpp"
#include "common/editor/sketch.hpp"

namespace rodeira::editor {
namespace {

using traffic_map::BorderType;
using traffic_map::LaneMode;

constexpr int kArms = 4;
constexpr double kRing_m = 16.0;     // radius of the ring's middle
constexpr double kBeside_rad = 0.5;  // from an arm to where its ways leave and join the ring
constexpr double kMergeAngle_rad = base::kPi / 12.0;

// An arm's two lanes: the one that comes to the junction and the one that leaves it.
struct Arm {
  Pose in, out;  // where they end and begin, at the junction
  std::int32_t entry = 0, exit = 0;
};

Arm DrawArm(Sketch& sketch, const Pose& outward, double near_m, const TemplatePlace& place) {
  const double half = 0.5 * place.lane_m;
  Arm arm;
  arm.out = outward.Moved(near_m, -half);
  arm.in = outward.Moved(near_m, half).Turned(base::kPi);
  arm.entry = sketch.Lane(outward.Moved(near_m + place.arm_m, half).Turned(base::kPi), arm.in, place.lane_m,
                          BorderType::kSingle, BorderType::kBoundary, LaneMode::kStart);
  arm.exit = sketch.Lane(arm.out, outward.Moved(near_m + place.arm_m, -half), place.lane_m, BorderType::kSingle,
                         BorderType::kBoundary, LaneMode::kEnd);
  return arm;
}

void DrawCrossing(Sketch& sketch, const TemplatePlace& place) {
  const double near_m = 2.0 * place.lane_m + 6.0;
  std::array<Arm, kArms> arms;
  for (int i = 0; i < kArms; ++i)
    arms[static_cast<std::size_t>(i)] =
        DrawArm(sketch, Pose{place.middle_W, place.heading_rad + i * base::kPi / 2.0}, near_m, place);
  for (std::size_t i = 0; i < arms.size(); ++i) {
    for (std::size_t turn = 1; turn < arms.size(); ++turn) {
      const Arm& to = arms[(i + turn) % arms.size()];
      const std::int32_t way = sketch.Lane(arms[i].in, to.out, place.lane_m, BorderType::kNone, BorderType::kNone);
      sketch.Connect(arms[i].entry, way, i % 2 == 1);
      sketch.Connect(way, to.exit);
    }
  }
}

// Counter-clockwise, as right-hand traffic goes.
void DrawRoundabout(Sketch& sketch, const TemplatePlace& place) {
  const auto on_ring = [&](double angle_rad) {
    return Pose{place.middle_W, angle_rad}.Moved(kRing_m, 0.0).Turned(base::kPi / 2.0);
  };
  std::array<std::int32_t, kArms> onward{}, beside{},
      leave{};  // of each arm: the ring's lane from it to the next, the one past it, the way out
  for (std::size_t i = 0; i < onward.size(); ++i) {
    const double angle = place.heading_rad + static_cast<double>(i) * base::kPi / 2.0;
    const Arm arm = DrawArm(sketch, Pose{place.middle_W, angle}, kRing_m + 14.0, place);
    const Pose leaves = on_ring(angle - kBeside_rad), joins = on_ring(angle + kBeside_rad);
    beside[i] = sketch.Lane(leaves, joins, place.lane_m, BorderType::kBoundary, BorderType::kNone);
    onward[i] = sketch.Lane(joins, on_ring(angle + base::kPi / 2.0 - kBeside_rad), place.lane_m, BorderType::kBoundary,
                            BorderType::kBoundary);
    const std::int32_t join = sketch.Lane(arm.in, joins, place.lane_m, BorderType::kNone, BorderType::kBoundary);
    leave[i] = sketch.Lane(leaves, arm.out, place.lane_m, BorderType::kNone, BorderType::kBoundary);
    sketch.GiveWay(arm.entry);
    sketch.Connect(arm.entry, join);
    sketch.Connect(join, onward[i]);
    sketch.Connect(beside[i], onward[i]);
    sketch.Connect(leave[i], arm.exit);
  }
  for (std::size_t i = 0; i < onward.size(); ++i) {
    const std::size_t next = (i + 1) % onward.size();
    sketch.Connect(onward[i], beside[next]);
    sketch.Connect(onward[i], leave[next]);
  }
}

void DrawMerge(Sketch& sketch, const TemplatePlace& place) {
  const Pose joint{place.middle_W, place.heading_rad};
  const std::int32_t before = sketch.Lane(joint.Moved(-place.arm_m, 0.0), joint, place.lane_m, BorderType::kBoundary,
                                          BorderType::kBoundary, LaneMode::kStart);
  const Pose bend =
      joint.Moved(-0.5 * place.arm_m, -0.5 * place.arm_m * std::tan(0.5 * kMergeAngle_rad)).Turned(kMergeAngle_rad);
  const std::int32_t ramp = sketch.Lane(bend.Moved(-0.5 * place.arm_m, 0.0), bend, place.lane_m, BorderType::kBoundary,
                                        BorderType::kBoundary, LaneMode::kStart);
  const std::int32_t joining = sketch.Lane(bend, joint, place.lane_m, BorderType::kNone, BorderType::kBoundary);
  const std::int32_t after = sketch.Lane(joint, joint.Moved(place.arm_m, 0.0), place.lane_m, BorderType::kBoundary,
                                         BorderType::kBoundary, LaneMode::kEnd);
  sketch.Connect(before, after);
  sketch.Connect(ramp, joining);
  sketch.Connect(joining, after);
}

}  // namespace

base::Result<Edit> Place(Document& document, Template what, const TemplatePlace& place) {
  if (!(place.lane_m >= 2.5 && place.lane_m <= 5.0))
    return base::WrongInput("edit.out_of_range", fmt::format("lanes of {} m; 2.5 to 5 was expected", place.lane_m));
  if (!(place.arm_m >= 20.0 && place.arm_m <= 500.0))
    return base::WrongInput("edit.out_of_range", fmt::format("arms of {} m; 20 to 500 was expected", place.arm_m));
  if (!std::isfinite(place.heading_rad)) return base::WrongInput("edit.out_of_range", "the heading is no number");
  Sketch sketch(document);
  switch (what) {
    case Template::kCrossing:
      DrawCrossing(sketch, place);
      return sketch.Finish(document, "crossing made");
    case Template::kRoundabout:
      DrawRoundabout(sketch, place);
      return sketch.Finish(document, "roundabout made");
    case Template::kMerge:
      DrawMerge(sketch, place);
      break;
  }
  return sketch.Finish(document, "merge made");
}

}  // namespace rodeira::editor
