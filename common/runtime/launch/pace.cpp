// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/launch/pace.hpp"

#include <charconv>
#include <cmath>

namespace rodeira::launch {

base::Result<double> ParsePace(const std::string& text, std::string_view place) {
  if (text == "max") return 0.0;
  if (text == "real") return 1.0;
  double pace = 0.0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), pace);
  if (problem != std::errc{} || end != text.data() + text.size() || !std::isfinite(pace) || pace <= 0.0) {
    return base::WrongInput("launch.wrong_pace",
                            "'" + text + "' was found; max, real or a positive number was expected", place);
  }
  return pace;
}

}  // namespace rodeira::launch
