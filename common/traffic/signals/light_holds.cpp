// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/signals/light_holds.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace rodeira::traffic {
namespace {

using network::LightColour;

constexpr std::int64_t kPlanStep_ns = 50'000'000;   // between two looks for the plan's red
constexpr std::int64_t kAmberStep_ns = 10'000'000;  // the same for the end of amber
constexpr std::size_t kWords = 3, kTimes = 4;       // of a saved hold

std::int64_t Ns(double seconds) { return std::llround(seconds * 1e9); }

bool IsLit(LightColour colour) { return colour == LightColour::kGreen || colour == LightColour::kAmber; }

// The first red of the plan from a moment on; that moment where there is none.
std::int64_t PlanIsRed_ns(const network::LightTimes& plan, std::int64_t from_ns) {
  const std::int64_t until_ns = from_ns + Ns(plan.cycle_s);
  for (std::int64_t at_ns = from_ns; at_ns < until_ns; at_ns += kPlanStep_ns) {
    if (network::ColourAt(plan, at_ns) == LightColour::kRed) return at_ns;
  }
  return from_ns;
}

// Where greens of a plan begin within (now_ns, until_ns].
void AddGreens(const network::LightTimes& plan, std::int64_t now_ns, std::int64_t until_ns,
               std::vector<std::int64_t>& moments_ns) {
  const std::int64_t cycle_ns = Ns(plan.cycle_s);
  const auto add = [&](double from_s) {
    const std::int64_t from_ns = Ns(from_s);
    for (std::int64_t at_ns = from_ns + (now_ns / cycle_ns - 1) * cycle_ns; at_ns <= until_ns; at_ns += cycle_ns) {
      if (at_ns > now_ns) moments_ns.push_back(at_ns);
    }
  };
  add(plan.green_from_s);
  for (const network::LightGreen& green : plan.more) add(green.from_s);
}

}  // namespace

LightColour LightHold::At(std::int64_t time_ns) const {
  if (time_ns < lead_to_ns) return lead;
  if (time_ns < main_to_ns) return main;
  return time_ns < amber_to_ns ? LightColour::kAmber : LightColour::kRed;
}

const LightHold* LightHolds::Of(std::uint32_t controller) const {
  const auto found = std::ranges::find_if(holds_, [&](const LightHold& hold) { return hold.controller == controller; });
  return found == holds_.end() ? nullptr : &*found;
}

LightColour LightHolds::At(std::uint32_t controller, const network::LightTimes& plan, std::int64_t time_ns) const {
  const LightHold* hold = holds_.empty() ? nullptr : Of(controller);
  return hold != nullptr && time_ns < hold->end_ns ? hold->At(time_ns) : network::ColourAt(plan, time_ns);
}

void LightHolds::Set(const LightHold& hold) {
  const auto at = std::ranges::lower_bound(holds_, hold.controller, {}, &LightHold::controller);
  if (at != holds_.end() && at->controller == hold.controller)
    *at = hold;
  else
    holds_.insert(at, hold);
}

void LightHolds::DropEnded(std::int64_t time_ns) {
  std::erase_if(holds_, [&](const LightHold& hold) { return hold.end_ns <= time_ns; });
}

void LightHolds::Save(base::StateWriter& writer) const {
  if (holds_.empty()) return;
  std::vector<std::uint32_t> words;
  std::vector<std::int64_t> times_ns;
  for (const LightHold& hold : holds_) {
    words.insert(words.end(),
                 {hold.controller, static_cast<std::uint32_t>(hold.lead), static_cast<std::uint32_t>(hold.main)});
    times_ns.insert(times_ns.end(), {hold.lead_to_ns, hold.main_to_ns, hold.amber_to_ns, hold.end_ns});
  }
  writer.Put("light_holds", words);
  writer.Put("light_holds_ns", times_ns);
}

void LightHolds::Restore(base::StateReader& reader, std::span<const network::Controller> controllers) {
  holds_.clear();
  if (!reader.Has("light_holds")) return;
  std::vector<std::uint32_t> words;
  std::vector<std::int64_t> times_ns;
  reader.Get("light_holds", words);
  reader.Get("light_holds_ns", times_ns);
  for (std::size_t i = 0; kWords * (i + 1) <= words.size() && kTimes * (i + 1) <= times_ns.size(); ++i) {
    const std::uint32_t* word = &words[kWords * i];
    const std::int64_t* time_ns = &times_ns[kTimes * i];
    constexpr auto kLast = static_cast<std::uint32_t>(LightColour::kAmber);
    if (word[0] >= controllers.size() || !controllers[word[0]].times || word[1] > kLast || word[2] > kLast) continue;
    Set({word[0], static_cast<LightColour>(word[1]), static_cast<LightColour>(word[2]), time_ns[0], time_ns[1],
         time_ns[2], time_ns[3]});
  }
}

LightHold HoldFor(const LightHolds& holds, std::uint32_t controller, const network::LightTimes& plan,
                  LightColour wanted, std::int64_t now_ns, std::int64_t duration_ns) {
  const LightColour shown = holds.At(controller, plan, now_ns);
  LightHold hold;
  hold.controller = controller, hold.main = wanted, hold.lead_to_ns = now_ns;
  if (wanted == LightColour::kGreen) {
    hold.lead = LightColour::kRedAmber;
    if (shown != LightColour::kGreen) hold.lead_to_ns += Ns(plan.red_amber_s);
  } else {
    hold.lead = LightColour::kAmber;
    const std::int64_t latest_ns = now_ns + Ns(plan.amber_s);
    if (shown == LightColour::kGreen) hold.lead_to_ns = latest_ns;
    while (hold.lead_to_ns < latest_ns && holds.At(controller, plan, hold.lead_to_ns) == LightColour::kAmber)
      hold.lead_to_ns = std::min(latest_ns, hold.lead_to_ns + kAmberStep_ns);
  }
  hold.main_to_ns = hold.lead_to_ns + duration_ns;
  hold.amber_to_ns = hold.main_to_ns + (wanted == LightColour::kGreen ? Ns(plan.amber_s) : 0);
  hold.end_ns = PlanIsRed_ns(plan, hold.amber_to_ns);
  return hold;
}

// Where two begin to be lit together one of them begins to be lit: now, at a green of its plan, or within a hold.
std::optional<std::int64_t> FirstTogether_ns(const LightHolds& holds, std::span<const network::Controller> controllers,
                                             std::uint32_t a, std::uint32_t b, std::int64_t now_ns) {
  std::int64_t until_ns = now_ns;
  for (const LightHold& hold : holds.all()) until_ns = std::max(until_ns, hold.end_ns);
  std::vector<std::int64_t> moments_ns{now_ns};
  for (const std::uint32_t controller : {a, b}) {
    AddGreens(*controllers[controller].times, now_ns, until_ns, moments_ns);
    if (const LightHold* hold = holds.Of(controller))
      moments_ns.insert(moments_ns.end(), {hold->lead_to_ns, hold->main_to_ns, hold->amber_to_ns, hold->end_ns});
  }
  std::ranges::sort(moments_ns);
  for (const std::int64_t at_ns : moments_ns) {
    if (at_ns >= now_ns && IsLit(holds.At(a, *controllers[a].times, at_ns)) &&
        IsLit(holds.At(b, *controllers[b].times, at_ns)))
      return at_ns;
  }
  return std::nullopt;
}

}  // namespace rodeira::traffic
