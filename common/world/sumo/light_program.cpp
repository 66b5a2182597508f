// SPDX-License-Identifier: Apache-2.0
#include "common/world/sumo/light_program.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace rodeira::sumo {
namespace {

enum class Shows { kRed, kRedAmber, kGreen, kAmber };

// A light shows one thing for some time.
struct Span {
  Shows shows;
  double duration_s;
};

char Letter(const LightProgram& program, std::size_t phase, int light) {
  const std::string& state = program.phases[phase].state;
  const auto at = static_cast<std::size_t>(light);
  return light >= 0 && at < state.size() ? state[at] : 'o';
}

bool IsOff(char letter) { return letter == 'o' || letter == 'O'; }

Shows ShownBy(char letter) {
  switch (letter) {
    case 'G':
    case 'g':
    case 'o':
    case 'O':
      return Shows::kGreen;
    case 'y':
    case 'Y':
      return Shows::kAmber;
    case 'u':
      return Shows::kRedAmber;
    default:
      return Shows::kRed;
  }
}

// The spans of a cycle; neighbours show different things, the last and the first too, where there are several.
// `begin_s`: when the first one begins.
std::vector<Span> SpansOf(const LightProgram& program, int light, const std::vector<bool>& held, double& begin_s) {
  std::vector<Span> spans;
  for (std::size_t phase = 0; phase < program.phases.size(); ++phase) {
    Shows shows = ShownBy(Letter(program, phase, light));
    if (phase < held.size() && held[phase] && shows == Shows::kGreen) shows = Shows::kRed;
    const double duration_s = program.phases[phase].duration_s;
    if (duration_s <= 0.0) continue;
    if (!spans.empty() && spans.back().shows == shows)
      spans.back().duration_s += duration_s;
    else
      spans.push_back({shows, duration_s});
  }
  begin_s = 0.0;
  if (spans.size() > 1 && spans.front().shows == spans.back().shows) {
    begin_s = -spans.back().duration_s;
    spans.front().duration_s += spans.back().duration_s;
    spans.pop_back();
  }
  return spans;
}

// After how many spans a cycle begins again: two turns of the same spans in a program are one.
std::size_t PeriodOf(const std::vector<Span>& spans) {
  for (std::size_t period = 1; period < spans.size(); ++period) {
    if (spans.size() % period != 0) continue;
    bool same = true;
    for (std::size_t i = 0; same && i + period < spans.size(); ++i)
      same = spans[i].shows == spans[i + period].shows &&
             std::fabs(spans[i].duration_s - spans[i + period].duration_s) < 1e-9;
    if (same) return period;
  }
  return spans.size();
}

double Within(double time_s, double cycle_s) {
  double within_s = std::fmod(time_s, cycle_s);
  if (within_s < 0.0) within_s += cycle_s;
  within_s = std::round(within_s * 1e9) * 1e-9;
  return within_s >= cycle_s ? 0.0 : within_s;
}

}  // namespace

bool IsGreen(const LightProgram& program, std::size_t phase, int light) {
  return ShownBy(Letter(program, phase, light)) == Shows::kGreen;
}

bool IsYieldingGreen(const LightProgram& program, std::size_t phase, int light) {
  return Letter(program, phase, light) == 'g';
}

bool HasTimes(const LightProgram& program) {
  const double cycle_s = std::accumulate(program.phases.begin(), program.phases.end(), 0.0,
                                         [](double sum, const LightPhase& phase) { return sum + phase.duration_s; });
  return cycle_s >= 1.0 && cycle_s <= 3600.0;
}

std::optional<network::LightTimes> TimesOf(const LightProgram& program, int light, const std::vector<bool>& held) {
  bool off = true;
  for (std::size_t phase = 0; phase < program.phases.size(); ++phase) off = off && IsOff(Letter(program, phase, light));
  if (off || !HasTimes(program)) return std::nullopt;
  double begin_s = 0.0;
  std::vector<Span> spans = SpansOf(program, light, held, begin_s);
  spans.resize(PeriodOf(spans), {Shows::kRed, 0.0});
  double cycle_s = 0.0;
  for (const Span& span : spans) cycle_s += span.duration_s;
  if (spans.size() == 1 && spans.front().shows == Shows::kGreen)
    return network::LightTimes{cycle_s, 0.0, cycle_s, 0.0, 0.0, {}};
  std::vector<network::LightGreen> greens;
  double from_s = begin_s;
  for (std::size_t i = 0; i < spans.size(); ++i) {
    const Span &after = spans[(i + 1) % spans.size()], &before = spans[(i + spans.size() - 1) % spans.size()];
    if (spans[i].shows == Shows::kGreen)
      greens.push_back({Within(from_s + program.offset_s, cycle_s), spans[i].duration_s,
                        after.shows == Shows::kAmber ? after.duration_s : 0.0,
                        before.shows == Shows::kRedAmber ? before.duration_s : 0.0});
    from_s += spans[i].duration_s;
  }
  if (greens.empty()) return network::LightTimes{cycle_s, 0.0, 0.0, 0.0, 0.0, {}};
  const network::LightGreen first = greens.front();
  greens.erase(greens.begin());
  return network::LightTimes{cycle_s, first.from_s, first.green_s, first.amber_s, first.red_amber_s, std::move(greens)};
}

}  // namespace rodeira::sumo
