// SPDX-License-Identifier: Apache-2.0
#include "common/analysis/measures/encounter_finder.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "common/analysis/measures/statistics.hpp"

namespace rodeira::measures {
namespace {

constexpr double kRounding_s = 1e-6;
constexpr double kStill_m = 0.02, kStill_rad = 0.002;

double HalfDiagonal(const Footprint& f) { return 0.5 * std::hypot(f.length_m, f.width_m); }
double Apart(const Footprint& a, const Footprint& b) { return (a.middle_W - b.middle_W).norm(); }
double AngleBetween(const Footprint& a, const Footprint& b) {
  return std::abs(WrapAngle(a.heading_rad - b.heading_rad));
}
bool StandsStill(const Footprint& from, const Footprint& to) {
  return Apart(from, to) < kStill_m && AngleBetween(from, to) < kStill_rad;
}

template <class Poses>
std::vector<Footprint> FootprintsOf(const Poses& poses, std::size_t from, std::size_t to) {
  std::vector<Footprint> footprints;
  for (std::size_t i = from; i < to; ++i) footprints.push_back(poses[i].footprint);
  return footprints;
}

// The time at a fractional index of poses.
template <class Poses>
double TimeAt(const Poses& poses, double index) {
  const auto i = std::min(static_cast<std::size_t>(index), poses.size() - 1);
  if (i + 1 == poses.size()) return poses[i].time_s;
  return poses[i].time_s + (index - static_cast<double>(i)) * (poses[i + 1].time_s - poses[i].time_s);
}

}  // namespace

void EncounterFinder::PutKnot(const Pose& pose, bool breaks) {
  if (breaks && !knots_.empty()) ++part_;
  const bool goes_on = !knots_.empty() && !breaks;
  const double way = knots_.empty() ? 0.0 : knots_.back().way_m;
  knots_.push_back({pose, goes_on ? way + Apart(knots_.back().footprint, pose.footprint) : way, part_});
}

void EncounterFinder::AddOwn(double time_s, double z_m, const Footprint& footprint, bool breaks) {
  if (!breaks && time_s < next_own_s_ - kRounding_s) return;
  next_own_s_ = time_s + 1.0 / kEncounterRate_hz;
  const Pose pose{time_s, z_m, footprint};
  if (!breaks && !knots_.empty() && StandsStill(knots_.back().footprint, footprint)) {
    standing_ = pose;
    return;
  }
  if (standing_) PutKnot(*standing_, false);
  standing_.reset();
  PutKnot(pose, breaks);
}

EncounterFinder::Range EncounterFinder::TimesAround(double time_s) const {
  const auto at = [&](double t) {
    return static_cast<std::size_t>(std::ranges::upper_bound(knots_, t, {}, &Knot::time_s) - knots_.begin());
  };
  Range range{at(time_s - kEncounterHorizon_s), at(time_s + kEncounterHorizon_s)};
  if (range.from > 0) --range.from;
  if (range.to < knots_.size()) ++range.to;
  const std::size_t now = at(time_s);
  const int part = knots_.empty() ? 0 : knots_[now > 0 ? now - 1 : 0].part;
  while (range.from < range.to && knots_[range.from].part < part) ++range.from;
  while (range.from < range.to && knots_[range.to - 1].part > part) --range.to;
  return range;
}

EncounterFinder::Range EncounterFinder::PathOf(double time_s) const {
  Range range = TimesAround(time_s);
  const auto now = std::ranges::upper_bound(knots_, time_s, {}, &Knot::time_s);
  if (now == knots_.begin() || range.from == range.to) return range;
  const Knot& knot = *(now - 1);
  while (range.to < knots_.size() && knots_[range.to].part == knot.part &&
         knots_[range.to - 1].way_m <= knot.way_m + kEncounterWay_m)
    ++range.to;
  return range;
}

bool EncounterFinder::IsNear(const Footprint& footprint, double step_m, Range range) const {
  Footprint wide = footprint;
  wide.length_m += 2.0 * step_m;  // at each end
  constexpr double kBeside_m = 0.6;
  wide.width_m += kBeside_m;
  const double reach = HalfDiagonal(wide);
  for (std::size_t i = range.from; i < range.to; ++i) {
    const double step = i + 1 < range.to ? knots_[i + 1].way_m - knots_[i].way_m : 0.0;
    if (Apart(wide, knots_[i].footprint) > reach + HalfDiagonal(knots_[i].footprint) + step) continue;
    Footprint own = knots_[i].footprint;
    own.length_m += 2.0 * step;
    if (Overlap(wide, own)) return true;
  }
  return false;
}

void EncounterFinder::AddOthers(double time_s, std::span<const OtherVehicle> others) {
  if (time_s < next_others_s_ - kRounding_s || knots_.empty()) return;
  next_others_s_ = time_s + 1.0 / kEncounterRate_hz;
  const Range range = TimesAround(time_s);
  if (range.from == range.to) return;
  const auto now = std::ranges::upper_bound(knots_, time_s, {}, &Knot::time_s);
  const Knot& own = now == knots_.begin() ? knots_.front() : *(now - 1);
  const bool creeps = knots_[range.to - 1].way_m - own.way_m < kEncounterWay_m;
  Eigen::AlignedBox2d box;
  for (std::size_t i = range.from; i < range.to; ++i) box.extend(knots_[i].footprint.middle_W);
  for (const OtherVehicle& v : others) {
    const double ahead = v.front_m - 0.5 * v.length_m;
    const Eigen::Vector2d direction(std::cos(v.heading_rad), std::sin(v.heading_rad));
    const Footprint f{Eigen::Vector2d(v.x_m, v.y_m) + ahead * direction, v.heading_rad, v.length_m, v.width_m};
    if (std::isnan(f.middle_W.sum() + f.width_m + f.length_m)) continue;
    // Half as far again: a pose before the one that touches is needed, too, also where the vehicle brakes.
    const double step = 1.5 * std::abs(v.speed_mps) / kEncounterRate_hz + 0.5;
    constexpr double kBox_m = 30.0;  // more than two lorries
    if (box.exteriorDistance(f.middle_W) > kBox_m + step) continue;
    const bool waits_for = creeps && Apart(f, own.footprint) < kEncounterWay_m;
    if (!waits_for && !IsNear(f, step, range)) continue;
    std::vector<Pose>& kept = kept_[v.id];
    // Of a standstill the first pose and the last one are enough.
    if (kept.size() >= 2 && StandsStill(kept[kept.size() - 2].footprint, f) && StandsStill(kept.back().footprint, f))
      kept.pop_back();
    kept.push_back({time_s, v.z_m, f});
  }
}

bool EncounterFinder::Touches(const Footprint& footprint, std::size_t knot) const {
  const Footprint& own = knots_[knot].footprint;
  const bool last = knot + 1 == knots_.size() || knots_[knot + 1].part != knots_[knot].part;
  const double step = last ? 0.0 : Apart(own, knots_[knot + 1].footprint);
  if (Apart(footprint, own) > HalfDiagonal(footprint) + HalfDiagonal(own) + step) return false;
  if (last) return Overlap(footprint, own);
  return SweptArea(std::array{own, knots_[knot + 1].footprint}).Touches(footprint);
}

EncounterFinder::Contact EncounterFinder::ContactAt(const Pose& pose, Range range) const {
  Contact contact;
  contact.distance_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = range.from; i < range.to; ++i) {
    const double distance = Apart(knots_[i].footprint, pose.footprint);
    if (distance >= contact.distance_m) continue;
    contact.distance_m = distance;
    contact.nearest = i;
  }
  if (range.from == range.to) return contact;
  const Knot& own = knots_[contact.nearest];
  contact.angle_rad = AngleBetween(own.footprint, pose.footprint);
  if (std::abs(own.z_m - pose.z_m) > kEncounterHeight_m) return contact;
  for (std::size_t i = range.from; i < range.to && !contact.touches; ++i) contact.touches = Touches(pose.footprint, i);
  return contact;
}

std::vector<EncounterFinder::Pose> EncounterFinder::OwnPath(Range range) const {
  constexpr double kStep_m = 0.5;
  std::vector<Pose> path;
  for (std::size_t i = range.from; i < range.to; ++i) {
    path.push_back(knots_[i]);
    if (i + 1 == range.to) break;
    const Knot &a = knots_[i], &b = knots_[i + 1];
    const int pieces = static_cast<int>(std::ceil((b.way_m - a.way_m) / kStep_m));
    for (int piece = 1; piece < pieces; ++piece) {
      const double share = static_cast<double>(piece) / pieces;
      Pose pose = a;
      pose.time_s += share * (b.time_s - a.time_s);
      pose.footprint.middle_W += share * (b.footprint.middle_W - a.footprint.middle_W);
      pose.footprint.heading_rad += share * WrapAngle(b.footprint.heading_rad - a.footprint.heading_rad);
      path.push_back(pose);
    }
  }
  return path;
}

// The other's poses [from, to) touch the own path and have an angle to it.
std::optional<Encounter> EncounterFinder::EncounterOf(std::span<const Pose> track, std::size_t from, std::size_t to,
                                                      Range range) const {
  if (range.from >= range.to || knots_[range.from].part != knots_[range.to - 1].part) return std::nullopt;
  const std::size_t first = from - 1, behind = std::min(to + 1, track.size());
  const SweptArea other_area(FootprintsOf(track, first, behind));
  // Where the time limits the path, its vehicle may be in the area there already: some more seconds of it.
  const std::size_t more = std::min<std::size_t>(range.from, 5 * static_cast<std::size_t>(kEncounterRate_hz));
  for (std::size_t i = 0; i < more && knots_[range.from - 1].part == knots_[range.from].part; ++i) --range.from;
  const std::vector<Pose> own = OwnPath(range);
  // The own poses in it that have an angle to the nearest of the other's.
  const auto crosses = [&](const Pose& pose) {
    if (!other_area.Touches(pose.footprint)) return false;
    const auto nearest = std::ranges::min_element(track.subspan(first, behind - first), {}, [&](const Pose& other) {
      return Apart(other.footprint, pose.footprint);
    });
    return AngleBetween(nearest->footprint, pose.footprint) >= kEncounterAngle_rad;
  };
  const auto begin = std::ranges::find_if(own, crosses);
  if (begin == own.begin() || begin == own.end()) return std::nullopt;
  const auto enters = static_cast<std::size_t>(begin - own.begin());
  // The own vehicle came along the other's path: they part.
  const std::size_t before = from > 50 ? from - 50 : 0;
  if (SweptArea(FootprintsOf(track, before, behind)).Touches(own[enters - 1].footprint)) return std::nullopt;
  const auto end = std::find_if_not(begin, own.end(), crosses);
  const auto leaves = std::min(static_cast<std::size_t>(end - own.begin()) + 1, own.size());
  const SweptArea own_area(FootprintsOf(own, enters - 1, leaves));
  std::size_t other_end = to;
  while (other_end < track.size() && own_area.Touches(track[other_end].footprint)) ++other_end;
  std::size_t own_end = enters;
  while (own_end < own.size() && other_area.Touches(own[own_end].footprint)) ++own_end;
  const auto other_path = track.subspan(first, std::min(other_end + 1, track.size()) - first);
  const auto own_path = std::span(own).subspan(enters - 1, std::min(own_end + 1, own.size()) - enters + 1);
  const auto other_stay = StayIn(FootprintsOf(other_path, 0, other_path.size()), own_area);
  const auto own_stay = StayIn(FootprintsOf(own_path, 0, own_path.size()), other_area);
  if (!other_stay || !own_stay || !other_stay->begins || !own_stay->begins) return std::nullopt;
  Encounter e;
  e.own_enters_s = TimeAt(own_path, own_stay->enters);
  e.other_enters_s = TimeAt(other_path, other_stay->enters);
  if (own_stay->ends) e.own_leaves_s = TimeAt(own_path, own_stay->leaves);
  if (other_stay->ends) e.other_leaves_s = TimeAt(other_path, other_stay->leaves);
  return e;
}

void EncounterFinder::FindOnTrack(std::int64_t id, std::span<const Pose> track, std::vector<Encounter>& found) const {
  std::vector<Contact> contacts;
  std::vector<Range> ranges;
  for (const Pose& pose : track) {
    ranges.push_back(PathOf(pose.time_s));
    contacts.push_back(ContactAt(pose, ranges.back()));
  }
  const auto crosses = [&](std::size_t j) {
    return contacts[j].touches && contacts[j].angle_rad >= kEncounterAngle_rad;
  };
  for (std::size_t from = 0; from < track.size(); ++from) {
    if (!crosses(from)) continue;
    std::size_t to = from, nearest = from;
    for (; to < track.size() && crosses(to); ++to) {
      if (contacts[to].distance_m < contacts[nearest].distance_m) nearest = to;
    }
    // A pose that touches without an angle is before: the other came along the own path, and they part.
    if (from > 0 && !contacts[from - 1].touches) {
      auto encounter = EncounterOf(track, from, to, {ranges[from].from, ranges[to - 1].to});
      if (encounter) {
        encounter->other = id;
        encounter->angle_rad = contacts[nearest].angle_rad;
        found.push_back(*encounter);
      }
    }
    from = to;
  }
}

std::vector<Encounter> EncounterFinder::Finish() {
  if (standing_) PutKnot(*standing_, false);
  standing_.reset();
  std::vector<Encounter> found;
  constexpr double kHole_s = 3.5 / kEncounterRate_hz;
  for (const auto& [id, poses] : kept_) {
    std::size_t from = 0;
    for (std::size_t i = 1; i <= poses.size(); ++i) {
      const bool goes_on = i < poses.size() && (poses[i].time_s - poses[i - 1].time_s < kHole_s ||
                                                StandsStill(poses[i].footprint, poses[i - 1].footprint));
      if (goes_on) continue;
      FindOnTrack(id, std::span(poses).subspan(from, i - from), found);
      from = i;
    }
  }
  std::ranges::stable_sort(found, {}, [](const Encounter& e) { return TimeOf(e); });
  return found;
}

}  // namespace rodeira::measures
