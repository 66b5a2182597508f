// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "common/core/base/state.hpp"
#include "common/world/network/lights.hpp"
#include "common/world/network/network.hpp"

namespace rodeira::traffic {

// A light that shows a colour on request instead of its plan: amber before a red that ends a green, red with amber
// before a green, amber and red behind it, until the plan shows red. So no colour is left out on either side. Times
// since the run's beginning, ascending.
struct LightHold {
  std::uint32_t controller = 0;                                  // index into the network's
  network::LightColour lead = network::LightColour::kRed;        // until lead_to_ns
  network::LightColour main = network::LightColour::kRed;        // until main_to_ns: red or green
  std::int64_t lead_to_ns = 0, main_to_ns = 0, amber_to_ns = 0;  // amber behind a green until the third
  std::int64_t end_ns = 0;                                       // red until here, from here on the plan

  // Precondition: before end_ns.
  network::LightColour At(std::int64_t time_ns) const;
};

// The holds of all lights, at most one a controller.
class LightHolds {
 public:
  // What a controller shows: its hold's colour, without one that of its plan.
  network::LightColour At(std::uint32_t controller, const network::LightTimes& plan, std::int64_t time_ns) const;
  // Null where its plan holds.
  const LightHold* Of(std::uint32_t controller) const;
  std::span<const LightHold> all() const { return holds_; }
  // In place of the controller's own, if it has one.
  void Set(const LightHold& hold);
  // Those with an end at or before this time.
  void DropEnded(std::int64_t time_ns);

  // Nothing is written where there are no holds.
  void Save(base::StateWriter& writer) const;
  // Holds of unknown controllers, and of those without a plan, are left out.
  void Restore(base::StateReader& reader, std::span<const network::Controller> controllers);

 private:
  std::vector<LightHold> holds_;  // ascending by controller
};

// A hold from a moment on for that long, red or green, by what the light shows then. Red that the plan goes on from is
// looked for within one cycle; a light that is always green has none. An amber that is shown ends as it would have.
LightHold HoldFor(const LightHolds& holds, std::uint32_t controller, const network::LightTimes& plan,
                  network::LightColour wanted, std::int64_t now_ns, std::int64_t duration_ns);

// The first moment from now on at which both are green or amber, with their holds; nothing where they never are, until
// all holds have ended.
std::optional<std::int64_t> FirstTogether_ns(const LightHolds& holds, std::span<const network::Controller> controllers,
                                             std::uint32_t a, std::uint32_t b, std::int64_t now_ns);

}  // namespace rodeira::traffic
