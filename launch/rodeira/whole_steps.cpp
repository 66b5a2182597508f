// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/whole_steps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace rodeira::cli {

base::Result<lockstep::Step> WholeSteps(double seconds, std::int64_t base_step_ns, const char* option,
                                        const std::string& place) {
  constexpr double kNear = 1e-6, kDigits = 1e-12;  // of a step: decimals that are no binary numbers
  const double step_s = 1e-9 * static_cast<double>(base_step_ns), steps = seconds / step_s;
  if (std::fabs(steps - std::round(steps)) <= std::max(kNear, kDigits * std::fabs(steps)))
    return static_cast<lockstep::Step>(std::llround(steps));
  return base::WrongInput(
      "command.wrong_value",
      fmt::format("{} {} s was found; a multiple of the base step of {} s was expected", option, seconds, step_s),
      place);
}

}  // namespace rodeira::cli
