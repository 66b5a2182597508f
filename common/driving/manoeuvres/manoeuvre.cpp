// SPDX-License-Identifier: Apache-2.0
#include "common/driving/manoeuvres/manoeuvre.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "common/core/base/suggest.hpp"

namespace rodeira::manoeuvres {

const Figure* Outcome::Find(std::string_view name) const {
  const auto found =
      std::find_if(figures.begin(), figures.end(), [&](const Figure& figure) { return figure.name == name; });
  return found == figures.end() ? nullptr : &*found;
}

const std::vector<Manoeuvre>& Manoeuvres() {
  static const std::vector<Manoeuvre> kManoeuvres = {
      {"acceleration", "from rest, throttle on the floor", Acceleration},
      {"braking", "from 100 km/h, brake on the floor", Braking},
      {"split_friction", "braking from 80 km/h, the right wheels on ice", SplitFriction},
      {"split_steered", "braking from 50 km/h, the right wheels on ice, hands hold the lane", SplitSteered},
      {"constant_radius", "a circle of 40 m, faster and faster", ConstantRadius},
      {"step_steer", "at 100 km/h, to 4 m/s²", StepSteer},
      {"sine", "at 80 km/h, 0.5 Hz", Sine},
      {"sine_with_dwell", "at 80 km/h, one sine of 0.7 Hz that dwells at its second peak", SineWithDwell},
      {"lane_change", "at 80 km/h, 3.5 m to the left and back", LaneChange},
      {"park", "a minute on a slope of 20 %, handbrake", Park},
      {"bump", "at 40 km/h, 5 cm high, 0.5 m long", Bump},
  };
  return kManoeuvres;
}

base::Result<const Manoeuvre*> FindManoeuvre(const std::string& name) {
  std::vector<std::string> names;
  for (const Manoeuvre& manoeuvre : Manoeuvres()) {
    if (manoeuvre.name == name) return &manoeuvre;
    names.push_back(manoeuvre.name);
  }
  return base::WrongInput(
      "scenario.unknown_manoeuvre",
      fmt::format("'{}' was found; {} was expected{}", name, fmt::join(names, ", "), base::DidYouMean(name, names)),
      "--manoeuvre");
}

base::Result<Outcome> Drive(const Manoeuvre& manoeuvre, dynamics::VehicleModel& car, double step_s) {
  auto outcome = manoeuvre.drive(car, step_s);
  if (const base::Status problem = car.problem(); !problem) return problem.error();
  return outcome;
}

}  // namespace rodeira::manoeuvres
