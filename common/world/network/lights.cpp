// SPDX-License-Identifier: Apache-2.0
#include "common/world/network/lights.hpp"

#include <cmath>
#include <initializer_list>

namespace rodeira::network {
namespace {

std::int64_t Ns(double seconds) { return std::llround(seconds * 1e9); }

std::int64_t Within(std::int64_t time, std::int64_t cycle) { return (time % cycle + cycle) % cycle; }

}  // namespace

LightColour ColourAt(const LightTimes& times, std::int64_t time_ns) {
  const std::int64_t cycle = Ns(times.cycle_s), green = Ns(times.green_s);
  if (green >= cycle) return LightColour::kGreen;
  const std::int64_t u = Within(time_ns - Ns(times.green_from_s), cycle);
  if (green <= 0) return LightColour::kRed;
  if (u < green) return LightColour::kGreen;
  if (u < green + Ns(times.amber_s)) return LightColour::kAmber;
  return u >= cycle - Ns(times.red_amber_s) ? LightColour::kRedAmber : LightColour::kRed;
}

bool MeetGreen(const LightTimes& a, const LightTimes& b) {
  if (a.green_s <= 0.0 || b.green_s <= 0.0) return false;
  const std::int64_t cycle = Ns(a.cycle_s);
  if (cycle != Ns(b.cycle_s) || a.green_s >= a.cycle_s || b.green_s >= b.cycle_s) return true;
  const std::int64_t b_after_a = Within(Ns(b.green_from_s) - Ns(a.green_from_s), cycle);
  return b_after_a < Ns(a.green_s) + Ns(a.amber_s) || cycle - b_after_a < Ns(b.green_s) + Ns(b.amber_s);
}

const char* WrongTimes(const LightTimes& times) {
  for (const double value : {times.cycle_s, times.green_from_s, times.green_s, times.amber_s, times.red_amber_s}) {
    if (!(value >= 0.0 && value <= 3600.0)) return "a time of lights is from 0 to 3600 s";
  }
  if (times.cycle_s < 1.0) return "the cycle of lights is at least 1 s";
  if (times.green_from_s >= times.cycle_s) return "green begins within the cycle";
  if (times.green_s > 0.0 && times.green_s < times.cycle_s &&
      times.green_s + times.amber_s + times.red_amber_s > times.cycle_s)
    return "green, amber, and red with amber are longer than the cycle";
  return nullptr;
}

}  // namespace rodeira::network
