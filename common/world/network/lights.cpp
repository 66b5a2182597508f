// SPDX-License-Identifier: Apache-2.0
#include "common/world/network/lights.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <vector>

namespace rodeira::network {
namespace {

std::int64_t Ns(double seconds) { return std::llround(seconds * 1e9); }

std::int64_t Within(std::int64_t time, std::int64_t cycle) { return (time % cycle + cycle) % cycle; }

LightGreen FirstOf(const LightTimes& times) {
  return {times.green_from_s, times.green_s, times.amber_s, times.red_amber_s};
}

LightColour ColourBy(const LightGreen& by, std::int64_t cycle, std::int64_t time_ns) {
  const std::int64_t green = Ns(by.green_s), u = Within(time_ns - Ns(by.from_s), cycle);
  if (green <= 0) return LightColour::kRed;
  if (u < green) return LightColour::kGreen;
  if (u < green + Ns(by.amber_s)) return LightColour::kAmber;
  return u >= cycle - Ns(by.red_amber_s) ? LightColour::kRedAmber : LightColour::kRed;
}

// Whether green or amber of the one meets green or amber of the other.
bool Meet(const LightGreen& a, const LightGreen& b, std::int64_t cycle) {
  const std::int64_t b_after_a = Within(Ns(b.from_s) - Ns(a.from_s), cycle);
  return b_after_a < Ns(a.green_s) + Ns(a.amber_s) || cycle - b_after_a < Ns(b.green_s) + Ns(b.amber_s);
}

// How far a green begins behind another one, within the cycle.
double After(const LightGreen& from, const LightGreen& green, double cycle_s) {
  const double after_s = green.from_s - from.from_s;
  return after_s < 0.0 ? after_s + cycle_s : after_s;
}

bool InRange(std::initializer_list<double> times_s) {
  return std::all_of(times_s.begin(), times_s.end(), [](double time_s) { return time_s >= 0.0 && time_s <= 3600.0; });
}

}  // namespace

LightColour ColourAt(const LightTimes& times, std::int64_t time_ns) {
  const std::int64_t cycle = Ns(times.cycle_s);
  if (Ns(times.green_s) >= cycle) return LightColour::kGreen;
  const LightColour colour = ColourBy(FirstOf(times), cycle, time_ns);
  if (colour != LightColour::kRed) return colour;
  for (const LightGreen& green : times.more) {
    const LightColour other = ColourBy(green, cycle, time_ns);
    if (other != LightColour::kRed) return other;
  }
  return LightColour::kRed;
}

bool MeetGreen(const LightTimes& a, const LightTimes& b) {
  if (a.green_s <= 0.0 || b.green_s <= 0.0) return false;
  const std::int64_t cycle = Ns(a.cycle_s);
  if (cycle != Ns(b.cycle_s) || a.green_s >= a.cycle_s || b.green_s >= b.cycle_s) return true;
  const auto greens_of = [](const LightTimes& times) {
    std::vector<LightGreen> greens = times.more;
    greens.insert(greens.begin(), FirstOf(times));
    return greens;
  };
  const std::vector<LightGreen> of_a = greens_of(a), of_b = greens_of(b);
  return std::any_of(of_a.begin(), of_a.end(), [&](const LightGreen& one) {
    return std::any_of(of_b.begin(), of_b.end(), [&](const LightGreen& other) { return Meet(one, other, cycle); });
  });
}

const char* WrongTimes(const LightTimes& times) {
  constexpr const char* kRange = "a time of lights is from 0 to 3600 s";
  constexpr const char* kBegin = "green begins within the cycle";
  if (!InRange({times.cycle_s, times.green_from_s, times.green_s, times.amber_s, times.red_amber_s})) return kRange;
  if (times.cycle_s < 1.0) return "the cycle of lights is at least 1 s";
  if (times.green_from_s >= times.cycle_s) return kBegin;
  if (times.green_s > 0.0 && times.green_s < times.cycle_s &&
      times.green_s + times.amber_s + times.red_amber_s > times.cycle_s)
    return "green, amber, and red with amber are longer than the cycle";
  // From the end of a green's amber to the next one's red with amber.
  const LightGreen first = FirstOf(times);
  const LightGreen* before = &first;
  for (const LightGreen& green : times.more) {
    if (!InRange({green.from_s, green.green_s, green.amber_s, green.red_amber_s})) return kRange;
    if (green.from_s >= times.cycle_s) return kBegin;
    if (!(green.green_s > 0.0 && first.green_s > 0.0)) return "a further green lasts longer than 0 s";
    const double behind_s = After(first, green, times.cycle_s), ahead_s = After(first, *before, times.cycle_s);
    if (Ns(behind_s) < Ns(ahead_s) + Ns(before->green_s) + Ns(before->amber_s) + Ns(green.red_amber_s))
      return "the greens of a cycle overlap, or are not in its order";
    before = &green;
  }
  if (before != &first &&
      Ns(After(first, *before, times.cycle_s)) + Ns(before->green_s) + Ns(before->amber_s) + Ns(first.red_amber_s) >
          Ns(times.cycle_s))
    return "the greens of a cycle overlap, or are not in its order";
  return nullptr;
}

}  // namespace rodeira::network
