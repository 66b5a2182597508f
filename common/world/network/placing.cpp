// SPDX-License-Identifier: Apache-2.0
#include "common/world/network/placing.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/geometry/angle.hpp"

namespace rodeira::network {
namespace {

constexpr double kMaxOfARepeat = 1e5;

double Between(double start, double end, double share) { return start + share * (end - start); }

// s, t and what stands there are known; the rest follows from the road.
void Stand(const Road& road, double turn_rad, Placed& placed) {
  placed.foot_W = road.Surface(placed.s_m, placed.t_m).p_W;
  placed.heading_rad = road.axis().Evaluate(placed.s_m).heading_rad + turn_rad;
}

Placed PlaceSignal(const Network& network, std::uint32_t index, const Signal& signal) {
  Placed placed;
  placed.signal = &signal;
  placed.road = index;
  const Road& road = network.roads()[index];
  placed.s_m = signal.s_m, placed.t_m = signal.t_m, placed.z_offset_m = signal.z_offset_m;
  placed.width_m = signal.width_m, placed.height_m = signal.height_m;
  placed.both_sides = signal.orientation != "+" && signal.orientation != "-" && signal.board.empty() &&
                      !IsBoard(signal);  // a board is read from before it
  const double facing_rad = signal.orientation == "-" ? 0.0 : geometry::kPi;
  Stand(road, signal.h_offset_rad + facing_rad, placed);
  if (const auto* seen = std::get_if<SeenAtRoad>(&signal.seen)) {
    const auto other = network.FindRoad(seen->road);
    if (!other) return placed;
    placed.road = *other;
    placed.s_m = seen->s_m, placed.t_m = seen->t_m, placed.z_offset_m = seen->z_offset_m;
    Stand(network.roads()[*other], seen->h_offset_rad + facing_rad, placed);
  } else if (const auto* in_world = std::get_if<SeenInWorld>(&signal.seen)) {
    placed.foot_W.head<2>() = Eigen::Vector2d(in_world->x_m, in_world->y_m);
    placed.z_W_m = in_world->z_m;
    placed.heading_rad = in_world->heading_rad + geometry::kPi;
  }
  return placed;
}

// A sign on a board is higher than the board by its place on it; how far it lies beside the board's middle is the
// reader's to add: the board stands on one foot.
Placed PlaceOnBoard(const Network& network, std::uint32_t index, const Signal& signal) {
  Placed placed = PlaceSignal(network, index, signal);
  placed.z_offset_m += signal.board_up_m;
  if (placed.z_W_m) *placed.z_W_m += signal.board_up_m;
  return placed;
}

Placed PlaceObject(const Road& road, const Object& object) {
  Placed placed;
  placed.object = &object;
  placed.s_m = object.s_m, placed.t_m = object.t_m, placed.z_offset_m = object.z_offset_m;
  placed.length_m = object.length_m, placed.width_m = object.width_m;
  placed.height_m = object.height_m, placed.radius_m = object.radius_m;
  Stand(road, object.hdg_rad, placed);
  return placed;
}

// A size along a repeat; one that it leaves open is the object's own.
struct Taper {
  double start_m, end_m;

  Taper(double start, double end, double own)
      : start_m(start != 0.0 || end != 0.0 ? start : own), end_m(start != 0.0 || end != 0.0 ? end : own) {}
  double At(double share) const { return Between(start_m, end_m, share); }
};

struct Sizes {
  Taper height, width, length, radius;

  Sizes(const Repeat& repeat, const Object& object)
      : height(repeat.height_start_m, repeat.height_end_m, object.height_m),
        width(repeat.width_start_m, repeat.width_end_m, object.width_m),
        length(repeat.length_start_m, repeat.length_end_m, object.length_m),
        radius(repeat.radius_start_m, repeat.radius_end_m, object.radius_m) {}
};

// The straight line of a repeat, seen from above: between the places of its beginning and end that are on the road.
struct Chord {
  Eigen::Vector2d from_W, way_W;
  double from_s_m, to_s_m;
  double from_share = 0.0, shares = 1.0;  // of the repeat's length: where it begins, and how much of it it is

  Chord(const Road& road, const Repeat& repeat)
      : from_s_m(std::clamp(repeat.s_m, 0.0, road.length_m())),
        to_s_m(std::clamp(repeat.s_m + repeat.length_m, 0.0, road.length_m())) {
    if (to_s_m > from_s_m)
      from_share = (from_s_m - repeat.s_m) / repeat.length_m, shares = (to_s_m - from_s_m) / repeat.length_m;
    from_W = road.Surface(from_s_m, Between(repeat.t_start_m, repeat.t_end_m, from_share)).p_W.head<2>();
    way_W = road.Surface(to_s_m, Between(repeat.t_start_m, repeat.t_end_m, from_share + shares)).p_W.head<2>() - from_W;
  }
  // The thing stands where the road lies under the chord.
  void Stand(const Road& road, double share_of_repeat, double turn_rad, Placed& placed) const {
    const double share = (share_of_repeat - from_share) / shares;
    const Eigen::Vector2d p = from_W + share * way_W;
    placed.s_m = Between(from_s_m, to_s_m, share);
    road.Settle(p, 0.0, road.length_m(), placed.s_m, placed.t_m);
    placed.foot_W = {p.x(), p.y(), road.Surface(placed.s_m, placed.t_m).p_W.z()};
    const bool short_way = way_W.squaredNorm() == 0.0;
    placed.heading_rad =
        (short_way ? road.axis().Evaluate(placed.s_m).heading_rad : std::atan2(way_W.y(), way_W.x())) + turn_rad;
  }
};

void PlaceRow(const Road& road, const Object& object, const Repeat& repeat, std::uint32_t index,
              std::vector<Placed>& things) {
  const Sizes sizes(repeat, object);
  const std::optional<Chord> chord = repeat.straight ? std::optional<Chord>(Chord(road, repeat)) : std::nullopt;
  const double last = std::min(std::floor(repeat.length_m / repeat.distance_m + 1e-9), kMaxOfARepeat);
  for (double i = 0.0; i <= last; i += 1.0) {
    const double s = repeat.s_m + i * repeat.distance_m;
    if (s > road.length_m() + 1e-6) break;
    const double share = repeat.length_m > 0.0 ? i * repeat.distance_m / repeat.length_m : 0.0;
    Placed placed = PlaceObject(road, object);
    placed.road = index;
    placed.s_m = s;
    placed.t_m = Between(repeat.t_start_m, repeat.t_end_m, share);
    placed.z_offset_m = Between(repeat.z_start_m, repeat.z_end_m, share);
    placed.height_m = sizes.height.At(share), placed.width_m = sizes.width.At(share);
    placed.length_m = sizes.length.At(share), placed.radius_m = sizes.radius.At(share);
    if (chord)
      chord->Stand(road, share, object.hdg_rad, placed);
    else
      Stand(road, object.hdg_rad, placed);
    things.push_back(placed);
  }
}

void PlaceRun(const Road& road, const Object& object, const Repeat& repeat, std::uint32_t index,
              std::vector<PlacedRun>& runs) {
  PlacedRun run;
  run.road = index;
  run.object = &object;
  run.from_s_m = std::max(0.0, repeat.s_m);
  run.to_s_m = std::min(repeat.s_m + repeat.length_m, road.length_m());
  if (!(run.to_s_m > run.from_s_m)) return;
  const Sizes sizes(repeat, object);
  const auto at = [&](double s, double start, double end) {
    return Between(start, end, (s - repeat.s_m) / repeat.length_m);
  };
  const auto share = [&](double s) { return (s - repeat.s_m) / repeat.length_m; };
  run.t_start_m = at(run.from_s_m, repeat.t_start_m, repeat.t_end_m),
  run.t_end_m = at(run.to_s_m, repeat.t_start_m, repeat.t_end_m);
  run.z_start_m = at(run.from_s_m, repeat.z_start_m, repeat.z_end_m),
  run.z_end_m = at(run.to_s_m, repeat.z_start_m, repeat.z_end_m);
  // What is round is as wide as it is thick.
  const auto width_at = [&](double s) {
    return sizes.width.At(share(s)) > 0.0 ? sizes.width.At(share(s)) : 2.0 * sizes.radius.At(share(s));
  };
  run.height_start_m = sizes.height.At(share(run.from_s_m)), run.height_end_m = sizes.height.At(share(run.to_s_m));
  run.width_start_m = width_at(run.from_s_m), run.width_end_m = width_at(run.to_s_m);
  run.straight = repeat.straight;
  runs.push_back(run);
}

}  // namespace

PlacedRun::Point PlacedRun::At(const Road& on, double share) const {
  if (!straight) {
    const double s = Between(from_s_m, to_s_m, share);
    return {on.Surface(s, Between(t_start_m, t_end_m, share)).p_W, on.axis().Evaluate(s).left_W()};
  }
  const Eigen::Vector3d begin = on.Surface(from_s_m, t_start_m).p_W, end = on.Surface(to_s_m, t_end_m).p_W;
  const Eigen::Vector2d way = (end - begin).head<2>();
  const Eigen::Vector2d left = way.squaredNorm() > 0.0
                                   ? Eigen::Vector2d(Eigen::Vector2d(-way.y(), way.x()).normalized())
                                   : on.axis().Evaluate(from_s_m).left_W();
  return {begin + share * (end - begin), left};
}

double PlacedRun::Step(const Road& on, double longest_m, double chord_m) const {
  if (straight) return longest_m;
  const double length = to_s_m - from_s_m;
  const int looks = std::max(2, static_cast<int>(length));
  double step = longest_m;
  for (int i = 0; i <= looks; ++i) {
    const double share = static_cast<double>(i) / looks,
                 k = on.axis().Evaluate(from_s_m + share * length).curvature_1pm;
    const double bend = std::fabs(k / std::max(0.1, 1.0 - k * Between(t_start_m, t_end_m, share)));
    if (bend > 0.0) step = std::min(step, std::max(0.5, std::sqrt(8.0 * chord_m / bend)));
  }
  return step;
}

Furniture PlaceFurniture(const Network& network) {
  Furniture furniture;
  for (std::uint32_t index = 0; index < network.roads().size(); ++index) {
    const Road& road = network.roads()[index];
    for (const Signal& signal : road.spec().signals) furniture.things.push_back(PlaceOnBoard(network, index, signal));
    for (const Object& object : road.spec().objects) {
      for (const Repeat& repeat : object.repeats) {
        if (repeat.distance_m > 0.0)
          PlaceRow(road, object, repeat, index, furniture.things);
        else
          PlaceRun(road, object, repeat, index, furniture.runs);
      }
      if (!object.repeats.empty()) continue;
      furniture.things.push_back(PlaceObject(road, object));
      furniture.things.back().road = index;
    }
  }
  return furniture;
}

Placed PlaceProp(const Props& props, const Props::Placement& thing, const Eigen::Vector3d& foot_W) {
  const Object& object = props.objects[thing.object];
  Placed placed;
  placed.object = &object;
  placed.z_offset_m = object.z_offset_m;
  placed.foot_W = foot_W;
  placed.heading_rad = thing.heading_rad;
  placed.length_m = object.length_m, placed.width_m = object.width_m;
  placed.height_m = object.height_m, placed.radius_m = object.radius_m;
  return placed;
}

bool HoldsFor(int lane, bool along, std::string_view orientation, const std::vector<LaneValidity>& validity) {
  if (orientation == "+" && !along) return false;
  if (orientation == "-" && along) return false;
  return validity.empty() || std::any_of(validity.begin(), validity.end(), [&](const LaneValidity& lanes) {
           return lane >= std::min(lanes.from_lane, lanes.to_lane) && lane <= std::max(lanes.from_lane, lanes.to_lane);
         });
}

std::vector<SignalOnLane> SignalsFor(const Network& network, const LaneKey& key) {
  const RoadSpec& road = network.roads()[key.road].spec();
  const LaneSection& section = network.Section(key);
  const Lane* lane = network.Find(key);
  std::vector<SignalOnLane> signals;
  if (lane == nullptr) return signals;
  const auto add = [&](double s_m, std::string_view orientation, const std::vector<LaneValidity>& validity,
                       const Signal* signal) {
    const bool here =
        signal != nullptr && s_m >= section.s_m && (s_m < section.end_s_m || key.section + 1 == road.sections.size());
    const bool meant = (lane->direction >= 0 && HoldsFor(key.lane, true, orientation, validity)) ||
                       (lane->direction <= 0 && HoldsFor(key.lane, false, orientation, validity));
    if (here && meant) signals.push_back({s_m, signal});
  };
  for (const Signal& signal : road.signals) add(signal.s_m, signal.orientation, signal.validity, &signal);
  for (const SignalReference& reference : road.signal_references) {
    const Signal* found = nullptr;
    for (const Road& other : network.roads()) {
      for (const Signal& signal : other.spec().signals) {
        if (signal.id == reference.id) found = &signal;
      }
    }
    add(reference.s_m, reference.orientation, reference.validity, found);
  }
  std::stable_sort(signals.begin(), signals.end(),
                   [](const SignalOnLane& a, const SignalOnLane& b) { return a.s_m < b.s_m; });
  return signals;
}

}  // namespace rodeira::network
