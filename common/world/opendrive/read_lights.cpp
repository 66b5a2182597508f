// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <charconv>
#include <optional>
#include <string_view>
#include <vector>

#include "common/world/opendrive/read.hpp"

namespace rodeira::opendrive {
namespace {

// Cycle, green from, green, amber, red with amber; the last four again for each further green of the cycle; seconds.
constexpr std::string_view kTimes = "rodeira:times";
constexpr std::size_t kFirst = 5, kFurther = 4, kMaxGreens = 100;

std::optional<network::LightTimes> TimesOf(std::string_view text) {
  std::vector<double> numbers;
  while (text.find_first_not_of(' ') != std::string_view::npos) {
    text.remove_prefix(text.find_first_not_of(' '));
    double number = 0.0;
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (problem != std::errc() || numbers.size() >= kFirst + kFurther * kMaxGreens) return std::nullopt;
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    numbers.push_back(number);
  }
  if (numbers.size() < kFirst || (numbers.size() - kFirst) % kFurther != 0) return std::nullopt;
  network::LightTimes times{numbers[0], numbers[1], numbers[2], numbers[3], numbers[4], {}};
  for (std::size_t i = kFirst; i < numbers.size(); i += kFurther)
    times.more.push_back({numbers[i], numbers[i + 1], numbers[i + 2], numbers[i + 3]});
  return times;
}

}  // namespace

network::Controller ReadController(const Node& controller) {
  network::Controller read;
  read.id = controller.Text("id");
  read.name = controller.Text("name", "");
  for (const Node& control : controller.Children("control"))
    read.controls.push_back({control.Text("signalId"), control.Text("type", "")});
  for (const Node& data : controller.Children("userData")) {
    if (data.Text("code", "") != kTimes) continue;
    read.times = TimesOf(data.Text("value", ""));
    if (!read.times) {
      data.Wrong(
          "rodeira.times",
          "the times of controller '" + read.id + "' are '" + data.Text("value", "") +
              "'; five numbers of seconds were expected: cycle, green from, green, amber, red with amber, and the "
              "last four again for each further green");
    } else if (const char* wrong = network::WrongTimes(*read.times)) {
      data.Wrong("rodeira.times", "the times of controller '" + read.id + "': " + wrong);
      read.times.reset();
    }
  }
  return read;
}

}  // namespace rodeira::opendrive
